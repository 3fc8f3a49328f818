// SPDX-License-Identifier: MIT
// Points on the surface of what is left of a blank.
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Points of the exact surface, spread over all of it: those below the nodes of the grid that are within half
// a cell of it, or every n-th of them where there are more than `most`. In an order that depends on the field
// alone. Cost: a look at each brick of the surface, and three queries for each point.
std::vector<Vec3> surface_points(const CarvedField& field, std::size_t most,
                                 const ParallelFor& parallel = serial_for);

// The surface point that steps along the normal lead to from a point close to it; none where they do not end
// on it.
std::optional<Vec3> onto_surface(const contact::DistanceField& field, Vec3 point_mm);

}  // namespace tribo::field
