// SPDX-License-Identifier: MIT
#pragma once

#include "readers/mesh/model.hpp"

namespace tribo::readers {

// True when the first statement is one that OBJ files start with: the format has no mark of its own.
bool looks_like_obj(std::string_view bytes);

// Wavefront OBJ: vertices and polygons, indices from the start or (negative) from the end of what was read
// so far. Normals, texture, groups and materials are passed over; points and lines have no surface: a
// warning; free-form curves and surfaces are refused by name, and so is any word that is not OBJ.
Result<Model> read_obj(std::string_view bytes, const ModelOptions& options);

}  // namespace tribo::readers
