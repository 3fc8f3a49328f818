// SPDX-License-Identifier: MIT
// The files that a page has put into the module's memory, and the solids in them. What io/files.hpp and
// io/model_file.hpp read from disk elsewhere.
#pragma once

#include <string>

#include "formats/job.hpp"
#include "formats/model.hpp"

namespace tribo::wasm {

// Names may hold folders ("bowl/bowl.csv"). A file that was put before under that name is replaced.
void put_file(std::string name, std::string bytes);
void forget_files();

// glTF is refused: its reader is not part of the module.
Result<formats::Model> read_model(const formats::ModelFile& file);

}  // namespace tribo::wasm
