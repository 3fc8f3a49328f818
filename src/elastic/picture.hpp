// SPDX-License-Identifier: MIT
// The picture of a sheet: its image seen in perspective by an eye that looks a little from below, shaded by
// one light with a soft shadow. The page's fragment shader (web/touch/src/shader.ts) computes the same. A
// sheet at rest gives the image itself, byte by byte. Any thread; allocates nothing.
//
// With a finish the light falls on the sheet and on the material's small relief together. The image is
// assumed to show the relief at rest under this light. Each pixel is therefore multiplied by its present
// light over its light at rest. Diffuse: Lambert 1760, as in hill shading (Horn 1981). Gloss: the lobe of
// Blinn 1977 with Schlick's quotient (1994) for its power.
#pragma once

#include <cstdint>
#include <span>

#include "elastic/pile.hpp"
#include "elastic/sheet.hpp"
#include "elastic/small_relief.hpp"

namespace tribo::elastic {

// Lengths relative to the longer side of the image, x to the right, y down, z out of the image.
struct PictureView {
    // A depth d is drawn as relief d / (1 + d / half_mm). Small depths are enlarged `relief` times, as maps
    // draw mountains; a depth of half_mm is enlarged half as much. So stiff and soft materials are both
    // visible, and a deeper point is always drawn deeper. Only the picture uses this: heights, reported
    // depths and files contain the true values.
    float relief = 18, half_mm = 0.8F;
    // The eye is over the point (0.5 width, 0.5 height + eye_below) at this height.
    float eye_below = 0.5F, eye_height = 1.0F;
    // Unit vector to the light: from the upper left.
    float light_x = -0.45F, light_y = -0.6F, light_z = 0.6614378F;
    // Share of the light that comes from the whole sky. The floor of a pit with walls of slope m, measured
    // sky_reach away, receives 1 / (1 + m^2) of it.
    float ambient = 0.35F, sky_reach = 0.09F;
    // The light is a disc between these slopes above the horizon. The share of it that the sheet itself hides
    // is shadow, at most `shadow`; the search goes up to `shadow_reach` away.
    float slope_low = 0.25F, slope_high = 1.5F, shadow = 0.55F, shadow_reach = 0.12F;
};
inline constexpr int kParallaxSteps = 6, kShadowSteps = 8;

// Optical properties of a material.
struct Finish {
    // One pixel for each node of the sheet; null: smooth.
    const SmallRelief* relief = nullptr;
    // Share of mirrored light, 0..1: 0.04 for most plastics, paper and glass (Schlick 1994).
    float gloss = 0.04F;
    // Spread of the mirrored light, 0.05 (polished) .. 1 (matt). The power of the lobe is 2 / roughness^2 -
    // 2.
    float roughness = 0.5F;
    // Depth of a full press of a finger, 2 N. A share p of it is drawn as the mean of what PictureView says
    // and of 1.1 p^2 / (p^2 + 0.1) of the full press, so that a dent has a floor, steep walls and a rim.
    float full_mm = 0.5F;
    // Hairs that lean, and their slope where they lean most; null: there are none. Their tips, hair_mm above
    // the ground when they stand, are what the image shows; light falls on their sides.
    const Pile* hairs = nullptr;
    float pile = 0, hair_mm = 2;
    // For the light, the slopes of the sheet are `steeper` times as steep as drawn, and bent towards
    // `steepest`, at which the darkest wall is still lit.
    float steeper = 2, steepest = 0.8F;
    // Pressed material becomes smoother: at this depth, as drawn, the slopes of the relief are halved.
    float flatten_mm = 3;
    // Light above the knee (or above the light at rest, if that is brighter) is compressed into this share of
    // the remaining range up to white. So nothing turns white and a white grain is still visible.
    float knee = 0.7F, headroom = 0.75F;
};
// Draws rows `first` .. `first + rows - 1` of the picture. `image` and `out`: four bytes per node (RGBA,
// sRGB, the opacity is kept), width x height of the sheet, from the top. Several threads may draw rows at the
// same time. Without a finish the sheet is smooth and dull, and too much light is cut off: the look of the
// published model.
void draw_rows(const Sheet& sheet, std::span<const std::uint8_t> image, std::span<std::uint8_t> out,
               int first, int rows, const Finish* finish = nullptr, const PictureView& view = {});

}  // namespace tribo::elastic
