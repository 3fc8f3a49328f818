// SPDX-License-Identifier: MIT
// Tests if two solids share a place, without a grid: the sweep of a tool and a fixture.
#pragma once

#include <optional>

#include "field/shape/shape.hpp"

namespace tribo::field {

// Finest size of the search, mm. An overlap may be missed if its depth exceeds the requested depth by no more
// than four times this size. A thin `fixed` (from 1 um on) is not missed for being thin.
inline constexpr double kFinestOverlapMm = 0.01;

// Returns a point of `fixed` that lies deeper than `depth_mm` >= 0 in `moving`, if there is one. The point is
// in both solids, to the last bit of their distances, and depends on the shapes alone. The search halves the
// box in which both can be and skips the parts that the distances (slope at most 1) prove to be free. Cost:
// two distances for each part: about ten parts if the solids are apart or overlap clearly; about the area of
// the gap divided by its width squared if they come close. No allocation, any thread.
std::optional<Vec3> shared_place(const Shape& moving, const Shape& fixed, double depth_mm);

}  // namespace tribo::field
