// SPDX-License-Identifier: MIT
#pragma once

#include "readers/mesh/model.hpp"

namespace tribo::readers {

// True when the first statement is a typical start of an OBJ file: the format has no magic number.
bool looks_like_obj(std::string_view bytes);

// Wavefront OBJ: vertices and polygons, with indices from the start or (negative) from the end of the
// vertices read so far. Normals, textures, groups and materials are ignored. Points and lines have no surface
// and give a warning. Free-form curves and surfaces, and words that are not OBJ, are refused by name.
Result<Model> read_obj(std::string_view bytes, const ModelOptions& options);

}  // namespace tribo::readers
