// SPDX-License-Identifier: MIT
// The small relief of a material, so that light shows its grain: slopes computed from its picture or from a
// height map. Without better knowledge, darker is assumed to be deeper (Khan, Reinhard, Fleming, Buelthoff
// 2006). This applies between the finest grain of a picture and the large stains and shades that are no
// relief.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tribo::elastic {

// Slopes are stored in steps of kSteepest / 127. Steeper ones are compressed towards kSteepest.
inline constexpr float kSteepest = 0.75F;

struct SmallRelief {
    int width = 0, height = 0;
    // For each pixel, from the top: (-dh/dx, -dh/dy), the lean of the normal to the right and downwards.
    std::vector<std::int8_t> slopes;
};

// Computes the relief from width x height pixels of four bytes (RGBA, sRGB), from the top. White is highest;
// opacity is ignored. Keeps heights from 1/400 to 1/32 of the longer side (a difference of Gaussians with
// these sigmas). Scales them so that the root mean square of the slopes is `rms_slope`, 0..1. A picture with
// less contrast than the noise of 8 bits stays almost smooth. Any thread; allocates.
SmallRelief small_relief(std::span<const std::uint8_t> rgba, int width, int height, float rms_slope);

}  // namespace tribo::elastic
