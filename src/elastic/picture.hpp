// SPDX-License-Identifier: MIT
// The picture of a sheet: its image seen in perspective by an eye that looks a little from below, shaded by
// one light with a soft shadow. The page's fragment shader (web/touch/src/shader.ts) computes the same; a
// sheet at rest gives the image itself, byte by byte. Any thread; allocates nothing.
//
// With a finish the light falls on the sheet and on the material's small relief together: the image is taken
// for what this light shows of the relief at rest, so each pixel is multiplied by the light that it gets now
// over the light that it got then. Diffuse: Lambert 1760, as in hill shading (Horn 1981). Gloss: the lobe of
// Blinn 1977 with Schlick's quotient (1994) for its power.
#pragma once

#include <cstdint>
#include <span>

#include "elastic/sheet.hpp"
#include "elastic/small_relief.hpp"

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

// How a material takes the light.
struct Finish {
    // As many pixels as the sheet has nodes; null: smooth.
    const SmallRelief* relief = nullptr;
    // Share of the light that is mirrored, 0..1: 0.04 is that of most plastics, paper and glass (Schlick
    // 1994).
    float gloss = 0.04F;
    // How wide the mirrored light is spread, 0.05 (polished) .. 1 (matt). The power of the lobe is
    // 2 / roughness^2 - 2.
    float roughness = 0.5F;
    // The sheet's slopes are lit `steeper` times as steep as they are drawn, and bent towards `steepest`, at
    // which the darkest wall is still lit.
    float steeper = 2, steepest = 0.8F;
    // What is pressed gets smoother: at this depth, as it is drawn, slopes are half of what they were.
    float flatten_mm = 3;
    // Light above the knee (what is brighter at rest: above its own) is compressed into this share of what is
    // left up to white, so that nothing turns white and a white grain still shows.
    float knee = 0.7F, headroom = 0.75F;
};
// Rows `first` .. `first + rows - 1` of the picture. `image` and `out`: four bytes a node (RGBA, sRGB, the
// opacity is kept), width x height of the sheet, from the top. Rows may be drawn at the same time. Without a
// finish the sheet is smooth and dull, and too much light is cut off: the look of the published model.
void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const Finish* finish = nullptr, const PictureView& view = {});

}  // namespace tribo::elastic
