// SPDX-License-Identifier: MIT
// Kinematics of a Novint Falcon: three legs of a delta robot, each an arm on a motor and a parallelogram (a
// shin) with offset joints. Leg angles after Stamper 1997 (PhD 97-4, University of Maryland), lengths as
// libnifalcon measured them.
#pragma once

#include <array>
#include <optional>

#include "base/vec3.hpp"

namespace tribo::devices {

// mm and rad. Axes of the Falcon: x right, y up, z from the base to the user. Angles of the arms from the
// plane of the base; on a grip in the middle all three are equal. No allocation; any thread.
namespace falcon {

using Angles = std::array<double, 3>;

// The middle of the workspace; about 40 mm each way can be reached.
inline constexpr Vec3 kMiddle{0, 0, 125};

// Angles for a position of the grip, in closed form. Nothing where the grip cannot reach.
std::optional<Angles> angles_at(Vec3 grip_mm);

// Gradients of the three angles over the position, rad/mm. Nothing where the grip cannot reach, or where a
// leg is stretched.
std::optional<std::array<Vec3, 3>> gradients_at(Vec3 grip_mm);

// Position for the angles, by Newton's method from `near_mm` (a position before, or kMiddle). Nothing where
// it does not converge to 1e-6 mm.
std::optional<Vec3> grip_at(const Angles& angles, Vec3 near_mm);

// Torques on the arms, N mm, that make `force_n` at the grip: their work equals the work of the force
// (transposed Jacobian). Zero where gradients_at() has nothing.
std::array<double, 3> torques_for(Vec3 force_n, Vec3 grip_mm);

}  // namespace falcon
}  // namespace tribo::devices
