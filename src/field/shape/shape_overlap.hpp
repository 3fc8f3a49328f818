// SPDX-License-Identifier: MIT
// Whether two solids share a place: a tool's sweep and a fixture, without a grid between them.
#pragma once

#include <optional>

#include "field/shape/shape.hpp"

namespace tribo::field {

// Overlaps are searched down to this size, mm: where `fixed` comes no deeper into `moving` than four times as
// much more than was asked for, it may be missed. However thin `fixed` is (from 1 um on), it is not.
inline constexpr double kFinestOverlapMm = 0.01;

// A point of `fixed` that lies deeper than `depth_mm` >= 0 in `moving`, if there is one: in both solids, to
// the last bit of their distances. Halves the box in which both can be, and leaves out the parts that the
// distances (whose slope is at most 1) show to be free. The place does not depend on anything but the shapes.
// Cost: two distances for each part: some ten where the solids are apart or overlap plainly, about the area
// of the gap by its width squared where they come close. No allocation, any thread.
std::optional<Vec3> shared_place(const Shape& moving, const Shape& fixed, double depth_mm);

}  // namespace tribo::field
