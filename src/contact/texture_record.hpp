// SPDX-License-Identifier: MIT
// The grooves around one cutter position as eight textured triangles: what a hand feels of them and a picture
// may show ("Haptic and aural rendering of a virtual milling process", 3.2, 4.1 and its figures 2 to 4).
#pragma once

#include <array>

#include "base/vec3.hpp"

namespace tribo::contact {

// What a pass and its neighbours leave, across the feed, and what single teeth leave, along it. 0: nothing
// to be found.
struct GrooveGeometry {
    double pitch_across_mm = 0, height_across_mm = 0;  // sidestep and scallop
    double pitch_along_mm = 0, height_along_mm = 0;    // feed marks
};

struct TexturedTriangle {
    std::array<Vec3, 3> corners_mm;  // on the machined surface, counter-clockwise seen from outside
    Vec3 normal;                     // unit: the smooth surface's, perturbed in direction
    double height_mm = 0;            // of its middle over the smooth surface: the perturbation in magnitude
};

// A patch of three by three points of the machined surface about a place: two squares of four along the feed
// and two across, each two triangles.
struct TextureRecord {
    static constexpr int kEdge = 3;

    Vec3 place_mm;                                 // on the smooth surface, below the cutter's position
    Vec3 normal{0, 0, 1};                          // of the smooth surface, unit
    Vec3 along{1, 0, 0};                           // unit, feed direction in the surface
    double half_along_mm = 0, half_across_mm = 0;  // from the middle of the patch to its edges
    // Over the smooth surface; [across][along], across to the left of the feed.
    std::array<std::array<double, kEdge>, kEdge> height_mm{};
    GrooveGeometry grooves;

    Vec3 across() const { return cross(normal, along); }
    std::array<TexturedTriangle, 8> triangles() const;
};

// How much of the heights that vary along and across is kept, 0 ... 1: what a loop carries of them.
struct TextureBand {
    double along = 1, across = 1;
};

// The texture normal N_tex of a place near the record's, in mm: stiffness times it is the texture force. A
// triangle's is (press + height) n_triangle - press n, what a spring pressed `press_mm` into the surface
// feels more than on the smooth surface; the eight are combined by how near the place is to each (weights
// that fall off within half a patch and sum to one). Beyond the patch its edge goes on. Real-time safe.
Vec3 texture_normal(const TextureRecord& record, Vec3 place_mm, double press_mm,
                    const TextureBand& band = {});

// As printed: the eight with equal weights, one normal for the position.
Vec3 combined_normal(const TextureRecord& record, double press_mm);

}  // namespace tribo::contact
