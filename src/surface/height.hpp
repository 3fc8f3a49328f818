// SPDX-License-Identifier: MIT
// How high a surface stands over a point, along a direction.
#pragma once

#include <optional>

#include "contact/distance_field.hpp"

namespace tribo::surface {

// Signed way t from `foot_mm` along the unit vector `up` to where material ends: positive when the foot is in
// material, negative when it is in air above it. None when no border is met within `limit_mm`. Walks by what
// the field answers (a lower bound of the distance, so no border is stepped over) and ends within 1e-6 mm for
// surfaces that are not edge-on. A hundred queries at most where the field knows distances; where it clamps
// them to c, limit_mm / c more. No allocation, any thread.
std::optional<double> height_over(const contact::DistanceField& field, Vec3 foot_mm, Vec3 up,
                                  double limit_mm);

}  // namespace tribo::surface
