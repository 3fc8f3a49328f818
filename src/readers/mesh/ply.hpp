// SPDX-License-Identifier: MIT
#pragma once

#include "readers/mesh/model.hpp"

namespace tribo::readers {

bool looks_like_ply(std::string_view bytes);

// PLY (Turk 1994): text, little- and big-endian binary. Elements and properties may have any type; `vertex`
// (x, y, z) and `face` (vertex_indices or vertex_index) are used. The counts of the header are compared with
// the available bytes before memory is allocated. Files without faces, and triangle strips, are refused.
Result<Model> read_ply(std::string_view bytes, const ModelOptions& options);

}  // namespace tribo::readers
