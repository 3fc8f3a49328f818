// SPDX-License-Identifier: MIT
// The files that a page has put into the module's memory, and the solids in them. What files/files.hpp and
// files/model/model_file.hpp read from disk elsewhere.
#pragma once

#include <string>

#include "job/job.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::wasm {

// Names may hold folders ("bowl/bowl.csv"). A file that was put before under that name is replaced.
void put_file(std::string name, std::string bytes);
void forget_files();

// glTF is refused: its reader is not part of the module.
Result<readers::Model> read_model(const readers::ModelFile& file);

}  // namespace tribo::wasm
