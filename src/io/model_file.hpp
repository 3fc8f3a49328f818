// SPDX-License-Identifier: MIT
// Models from files, whatever format their content shows.
#pragma once

#include "formats/job.hpp"
#include "formats/model.hpp"
#include "io/files.hpp"

namespace tribo::io {

FileResult<formats::Model> read_model_file(const formats::ModelFile& file);

}  // namespace tribo::io
