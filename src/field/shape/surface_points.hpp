// SPDX-License-Identifier: MIT
// Points on the surface of the remaining material.
#pragma once

#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"

namespace tribo::field {

// Returns points of the exact surface, spread over all of it. They are the foot points of the nodes of the
// grid that are within half a cell of the surface, or of every n-th of these nodes if there are more than
// `most`. Their order depends on the field alone. Cost: one visit to each brick of the surface, and three
// queries for each point.
std::vector<Vec3> surface_points(const CarvedField& field, std::size_t most,
                                 const ParallelFor& parallel = serial_for);

// Returns the surface point that is reached by steps along the normal from a point close to it. Nothing if
// the steps do not end on the surface, or end on a skin much thinner than 1 um: a cut that ends at a face of
// the blank leaves one of no thickness.
std::optional<Vec3> onto_surface(const contact::DistanceField& field, Vec3 point_mm);

}  // namespace tribo::field
