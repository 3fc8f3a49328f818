// SPDX-License-Identifier: MIT
// Reads models from files; the content determines the format.
#pragma once

#include "files/files.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::files {

FileResult<readers::Model> read_model_file(const readers::ModelFile& file, Pipes pipes = Pipes::read);

}  // namespace tribo::files
