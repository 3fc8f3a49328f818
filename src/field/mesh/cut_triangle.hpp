// SPDX-License-Identifier: MIT
// The mean of a value over a triangle that is cut into pieces.
#pragma once

#include <functional>
#include <span>

#include "field/mesh/triangles_apart.hpp"

namespace tribo::field {

struct Segment {
    Vec3 from, to;
};

// Returns the mean of `value` over a triangle, exact but for rounding: the value is the same at all places of
// a piece. The pieces lie between the cuts, segments in the plane of the triangle that may cross and may
// leave it. `value` is asked once for each of the trapezoids between the lines through all ends and
// crossings. 0 of a triangle without an area.
double mean_over(const Corners& triangle, std::span<const Segment> cuts,
                 const std::function<double(Vec3)>& value);

}  // namespace tribo::field
