// SPDX-License-Identifier: MIT
// Roughness of a profile: the height of a surface along a straight line.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/distance_field.hpp"

namespace tribo::surface {

// Returns heights along `up` (unit) at `points` places on the line from start to end, in the middle of equal
// pieces. Returns nothing if the surface is farther than limit_mm from the line somewhere.
std::optional<std::vector<double>> height_profile(const contact::DistanceField& field, Vec3 start_mm,
                                                  Vec3 end_mm, Vec3 up, int points, double limit_mm = 5);

// ISO 4287 / ISO 21920-2 parameters about the least-squares line of the whole profile. No waviness filter is
// applied: choose a length with a few cusps and little form. (A row of parabolic cusps of height h has Ra = 4
// h / (9 sqrt 3) = 0.2566 h and Rq = 2 h / sqrt 45 = 0.2981 h.)
struct Roughness {
    double ra_mm = 0;  // mean distance from the line
    double rq_mm = 0;  // root mean square of it
    double rz_mm = 0;  // mean over the fifths of the profile of highest peak to deepest valley
    double rt_mm = 0;  // highest peak to deepest valley of the whole profile
};

// At least five heights, evenly spaced.
Roughness roughness(std::span<const double> heights_mm);

}  // namespace tribo::surface
