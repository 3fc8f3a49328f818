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
    // A depth d is drawn as relief d / (1 + d / half_mm): small ones `relief` times as deep as they are, as
    // maps draw mountains, and one of half_mm half as many times, so that stiff and soft materials both show
    // and the deeper is always drawn deeper. It is the picture's alone; heights, depths that are told, and
    // files of them are the true ones.
    float relief = 18, half_mm = 0.8F;
    // The eye stands over the point (0.5 width, 0.5 height + eye_below) at this height.
    float eye_below = 0.5F, eye_height = 1.0F;
    // Unit vector to the light: from the upper left.
    float light_x = -0.45F, light_y = -0.6F, light_z = 0.6614378F;
    // Share of the light that comes from the whole sky; of it reaches the floor of a pit whose walls rise
    // with slope m, met sky_reach away, 1 / (1 + m^2).
    float ambient = 0.35F, sky_reach = 0.09F;
    // The light is a disc that stands between these slopes above the horizon; what the sheet itself hides of
    // it is in shadow, at most by `shadow`, looked for up to `shadow_reach` away.
    float slope_low = 0.25F, slope_high = 1.5F, shadow = 0.55F, shadow_reach = 0.12F;
};
inline constexpr int kParallaxSteps = 6, kShadowSteps = 8;

// Rows `first` .. `first + rows - 1` of the picture. `image` and `out`: four bytes a node (RGBA, sRGB, the
// opacity is kept), width x height of the sheet, from the top. Rows may be drawn at the same time.
void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const PictureView& view = {});

}  // namespace tribo::elastic
