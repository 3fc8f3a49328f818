// SPDX-License-Identifier: MIT
// Checks whether the blank is large enough for the designed part.
#pragma once

#include <optional>
#include <string>

#include "base/mesh.hpp"
#include "base/result.hpp"
#include "field/shape/shape.hpp"

namespace tribo::session {

struct OutsidePoint {
    double mm = 0;  // distance outside the blank
    Vec3 at_mm;
};

// Returns the point of the part that is farthest outside the blank; none if all points are inside or closer
// to it than kOutsideMm. Exact for a box. For other blanks, tests the corners of the part and points at
// distances of a hundredth of its size.
inline constexpr double kOutsideMm = 0.01;
std::optional<OutsidePoint> farthest_outside(const TriangleMesh& part, const field::Shape& blank);

// Adds a warning about this point: a cut cannot make material that is missing in the blank.
void warn_of_part_outside(const TriangleMesh& part, const field::Shape& blank, const std::string& job,
                          Warnings& warnings);

}  // namespace tribo::session
