// SPDX-License-Identifier: MIT
// Models from files, whatever format their content shows.
#pragma once

#include "files/files.hpp"
#include "readers/mesh/model.hpp"

namespace tribo::files {

FileResult<readers::Model> read_model_file(const readers::ModelFile& file);

}  // namespace tribo::files
