// SPDX-License-Identifier: MIT
// A still of a part, drawn on the processor: three-quarter view in perspective, two lights, antialiased, the
// tool path as a line in it where wanted. For reports, READMEs and `inspect --picture`; no window and no GPU
// needed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.hpp"
#include "base/vec3.hpp"
#include "files/image/png.hpp"

namespace tribo::report {

// sRGB, 0..1.
using Colour = std::array<float, 3>;

// A line in space, one colour a point; hidden where the part stands before it.
struct PictureLine {
    std::vector<Vec3> points_mm;
    std::vector<Colour> colours;  // as many as points, or one for all
    double width_px = 1.5;
};

struct PictureOptions {
    int width = 1200, height = 900;        // pixels, 1..8192
    Vec3 towards_viewer{0.55, -1.0, 0.9};  // from the part; any length above 0
    Colour colour{0.70F, 0.73F, 0.77F};
    double margin = 0.04;  // of the shorter side, kept free around the part
    // One for each triangle, in the place of `colour`; sRGB. Empty: all are of that one.
    std::span<const std::array<std::uint8_t, 3>> triangle_colours = {};
};

// The image behind the part is transparent, so that it stands on any page. The same mesh gives the same
// bytes. About 0.1 s for a million triangles at 1200 x 900; takes 40 bytes a pixel and 12 bytes a vertex
// meanwhile.
files::Image draw_part(const TriangleMesh& mesh, const std::vector<PictureLine>& lines = {},
                       const PictureOptions& options = {});

}  // namespace tribo::report
