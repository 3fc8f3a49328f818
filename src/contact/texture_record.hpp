// SPDX-License-Identifier: MIT
// The grooves around one cutter position as eight textured triangles, for haptic texture and display
// ("Haptic and aural rendering of a virtual milling process", 3.2, 4.1 and its figures 2 to 4).
#pragma once

#include <array>

#include "base/vec3.hpp"

namespace tribo::contact {

// Grooves across the feed come from neighbouring passes, grooves along the feed from single teeth. 0: none
// found.
struct GrooveGeometry {
    double pitch_across_mm = 0, height_across_mm = 0;  // sidestep and scallop
    double pitch_along_mm = 0, height_along_mm = 0;    // feed marks
};

struct TexturedTriangle {
    std::array<Vec3, 3> corners_mm;  // on the machined surface, counter-clockwise seen from outside
    Vec3 normal;                     // unit: of the smooth surface, perturbed in direction
    double height_mm = 0;            // of its centre over the smooth surface: the perturbation in magnitude
};

// A patch of three by three points of the machined surface: two squares along the feed and two across, with
// two triangles each.
struct TextureRecord {
    static constexpr int kEdge = 3;

    Vec3 place_mm;                                 // on the smooth surface, below the cutter
    Vec3 normal{0, 0, 1};                          // of the smooth surface, unit
    Vec3 along{1, 0, 0};                           // unit, feed direction in the surface
    double half_along_mm = 0, half_across_mm = 0;  // from the middle of the patch to its edges
    // Heights over the smooth surface, [across][along]; `across` is to the left of the feed.
    std::array<std::array<double, kEdge>, kEdge> height_mm{};
    GrooveGeometry grooves;

    Vec3 across() const { return cross(normal, along); }
    std::array<TexturedTriangle, 8> triangles() const;
};

// Gains of the heights that vary along and across, 0 ... 1, against aliasing in the servo loop.
struct TextureBand {
    double along = 1, across = 1;
};

// Returns the texture normal N_tex at a place near the record, in mm. Stiffness times N_tex is the texture
// force. The value of a triangle is (press + height) n_triangle - press n: the difference to the smooth
// surface for a spring with the penetration `press_mm`. The eight values are averaged with weights that
// decrease with the distance within half a patch; their sum is 1. Beyond the patch its edge continues.
// Real-time safe.
Vec3 texture_normal(const TextureRecord& record, Vec3 place_mm, double press_mm,
                    const TextureBand& band = {});

}  // namespace tribo::contact
