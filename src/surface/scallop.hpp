// SPDX-License-Identifier: MIT
// Where passes touched the designed surface, to tell scallops from material that was never reached.
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
    double first_mm = 0, second_mm = 0;  // how far away they are
};

// Knows the touched samples of one comparison, thinned to the lowest in each cell of a sixteenth of the pass
// width. Asking is for any thread.
class TouchedSamples {
  public:
    // One height for each sample; touched are those up to touch_mm high.
    TouchedSamples(std::span<const SurfaceSample> samples, std::span<const float> heights_mm, double touch_mm,
                   double pass_width_mm);

    // The nearest two touched samples less than half as high that stand on opposite sides (give or take 22
    // degrees) of this one, together no more than a pass width away, on the same face of the part: normals
    // within 60 degrees, 27 degrees of the tangent plane. Cost: the cells within a pass width.
    std::optional<Crossing> around(const SurfaceSample& sample, double height_mm) const;

  private:
    struct Touched {
        std::uint64_t block;  // cube of one pass width in which it lies
        Vec3 point, normal;
        double height;
    };
    std::uint64_t block_of(Vec3 point, int dx, int dy, int dz) const;

    Vec3 origin_;
    double width_;
    std::vector<Touched> touched_;  // by block
};

}  // namespace tribo::surface
