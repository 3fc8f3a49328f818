// SPDX-License-Identifier: MIT
// Whether the blank is large enough for the designed part.
#pragma once

#include <optional>
#include <string>

#include "base/mesh.hpp"
#include "base/result.hpp"
#include "field/shape/shape.hpp"

namespace tribo::session {

struct OutsidePoint {
    double mm = 0;  // how far it is outside the blank
    Vec3 at_mm;
};

// The point of the part that is farthest outside the blank, none where all of it is inside or nearer than
// kOutsideMm. Exact for a box; in a blank of any shape the part's corners are looked at, and points a
// hundredth of its size apart.
inline constexpr double kOutsideMm = 0.01;
std::optional<OutsidePoint> farthest_outside(const TriangleMesh& part, const field::Shape& blank);

// Warns of it: what is missing in the blank no cut can make.
void warn_of_part_outside(const TriangleMesh& part, const field::Shape& blank, const std::string& job,
                          Warnings& warnings);

}  // namespace tribo::session
