// SPDX-License-Identifier: MIT
// The places where passes touched the designed surface. They separate scallops from unreached material.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/designed_surface.hpp"

namespace tribo::surface {

// Two touched places on opposite sides of a sample.
struct Crossing {
    Vec3 way;                            // unit, along the surface, towards the first
    double first_mm = 0, second_mm = 0;  // distances of the two places
};

// Stores the touched samples of one comparison, reduced to the lowest one in each cell of a sixteenth of the
// pass width. Any thread may query.
class TouchedSamples {
  public:
    // One height for each sample, along its normal. Samples up to touch_mm high count as touched.
    TouchedSamples(std::span<const SurfaceSample> samples, std::span<const float> heights_mm, double touch_mm,
                   double pass_width_mm);

    // Returns the nearest two touched samples less than half as high that lie on opposite sides (within 22
    // degrees) of this one. Together they are at most a pass width away and on the same face of the part:
    // normals within 60 degrees, 27 degrees of the tangent plane. Cost: the cells within a pass width.
    std::optional<Crossing> around(const SurfaceSample& sample, double height_mm) const;

  private:
    struct Touched {
        std::uint64_t block;  // cube of one pass width that contains it
        Vec3 point, normal;
        double height;
    };
    std::uint64_t block_of(Vec3 point, int dx, int dy, int dz) const;

    Vec3 origin_;
    double width_;
    std::vector<Touched> touched_;  // by block
};

}  // namespace tribo::surface
