// SPDX-License-Identifier: MIT
// A material's own small relief, so that light shows its grain: as slopes, out of its picture or a height
// map. Where nothing better is known the darker is taken for the deeper (Khan, Reinhard, Fleming, Buelthoff
// 2006), between the finest grain that a picture holds and the large stains and shades that are no relief.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tribo::elastic {

// Slopes are stored in steps of kSteepest / 127; the steepest are bent towards kSteepest.
inline constexpr float kSteepest = 0.75F;

struct SmallRelief {
    int width = 0, height = 0;
    // For each pixel, from the top, (-dh/dx, -dh/dy): what the normal leans to the right and downwards.
    std::vector<std::int8_t> slopes;
};

// Of width x height pixels of four bytes (RGBA, sRGB), from the top; white is highest, opacity does not
// count. Heights are kept from 1/400 to 1/32 of the longer side (a difference of Gaussians with these
// sigmas), and scaled so that the root mean square of the slopes is `rms_slope`, 0..1. A picture of less
// contrast than noise of 8 bits has stays as good as smooth. Any thread; allocates.
SmallRelief small_relief(std::span<const std::uint8_t> rgba, int width, int height, float rms_slope);

}  // namespace tribo::elastic
