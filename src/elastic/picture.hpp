// SPDX-License-Identifier: MIT
// The picture of a sheet: its image seen in perspective by an eye that looks a little from below, shaded by
// one light with a soft shadow. The page's fragment shader (web/touch/src/shader.ts) computes the same; a
// sheet at rest gives the image itself, byte by byte. Any thread; allocates nothing.
#pragma once

#include <cstdint>
#include <span>

#include "elastic/sheet.hpp"

namespace tribo::elastic {

// Lengths in the image's longer side, x to the right, y down, z out of the image.
struct PictureView {
    // The eye stands over the point (0.5 width, 0.5 height + eye_below) at this height.
    float eye_below = 0.5F, eye_height = 1.0F;
    // Unit vector to the light: from the upper left.
    float light_x = -0.45F, light_y = -0.6F, light_z = 0.6614378F;
    float ambient = 0.3F;
    // The light is a disc that stands between these slopes above the horizon; what the sheet itself hides of
    // it is in shadow, at most by `shadow`, looked for up to `shadow_reach` away.
    float slope_low = 0.25F, slope_high = 1.5F, shadow = 0.55F, shadow_reach = 0.12F;
};
inline constexpr int kParallaxSteps = 3, kShadowSteps = 8;

// Rows `first` .. `first + rows - 1` of the picture. `image` and `out`: four bytes a node (RGBA, sRGB, the
// opacity is kept), width x height of the sheet, from the top. Rows may be drawn at the same time.
void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const PictureView& view = {});

}  // namespace tribo::elastic
