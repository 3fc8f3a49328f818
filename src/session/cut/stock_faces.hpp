// SPDX-License-Identifier: MIT
// Which faces of a part are still those of its blank.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/shape/shape.hpp"

namespace tribo::session {

// One per vertex: 1 on the surface of the blank, or less than a micrometre off: positions have single
// precision.
std::vector<std::uint8_t> vertices_on_blank(const TriangleMesh& mesh, const field::Shape& blank,
                                            const ParallelFor& parallel);
// One per triangle: 1 if all its vertices are on the blank. There the stock is untouched.
std::vector<std::uint8_t> untouched_triangles(const TriangleMesh& mesh,
                                              std::span<const std::uint8_t> on_blank);

}  // namespace tribo::session
