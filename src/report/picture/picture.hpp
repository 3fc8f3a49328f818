// SPDX-License-Identifier: MIT
// A still picture of a part, rendered on the processor: three-quarter view in perspective, metal in a studio
// (studio.hpp), antialiased, optionally with the tool path as a line. For reports, READMEs and `inspect
// --picture`; needs no window and no GPU.
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

// A line in space, one colour per point. The part hides it where it is in front.
struct PictureLine {
    std::vector<Vec3> points_mm;
    std::vector<Colour> colours;  // one per point, or one for all
    double width_px = 1.5;
};

struct PictureOptions {
    int width = 1200, height = 900;          // pixels, 1..8192
    Vec3 towards_viewer{0.42, -0.95, 0.62};  // from the part; length > 0
    Colour colour{0.81F, 0.82F, 0.835F};     // of machined metal
    bool on_ground = false;  // the part throws a shadow on ground below it, and the frame has room for that
    double margin = 0.04;    // of the shorter side, free around the part
    // One per triangle, instead of metal: dull paint; sRGB. Empty: all triangles are metal.
    std::span<const std::array<std::uint8_t, 3>> triangle_colours = {};
    // One per triangle: 1 where the stock is untouched, which is sawn metal. Empty: all metal is machined.
    std::span<const std::uint8_t> sawn = {};
};

// The background of the image is transparent. The same mesh gives the same bytes. Takes about 0.1 s for a
// million triangles at 1200 x 900, and 40 bytes a pixel and 12 bytes a vertex during the call.
files::Image draw_part(const TriangleMesh& mesh, const std::vector<PictureLine>& lines = {},
                       const PictureOptions& options = {});

}  // namespace tribo::report
