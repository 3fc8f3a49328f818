// SPDX-License-Identifier: MIT
// Height of a surface over a point, along a direction.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"

namespace tribo::surface {

// Returns the signed distance t from `foot_mm` along the unit vector `up` to the end of the material:
// positive if the foot is in material, negative if it is in air above it. Returns nothing if there is no
// border within `limit_mm`. The search steps by the values of the field, which are lower bounds of the
// distance, so that it steps over no border. It ends within 1e-6 mm for surfaces that are not edge-on. At
// most a hundred queries if the field knows its distances; if the field clamps them to c, limit_mm / c more.
// No allocation, any thread.
std::optional<double> height_over(const contact::DistanceField& field, Vec3 foot_mm, Vec3 up,
                                  double limit_mm);

}  // namespace tribo::surface
