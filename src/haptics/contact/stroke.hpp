// SPDX-License-Identifier: MIT
// Target positions of a scripted hand over time.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

struct StrokePoint {
    double t_s = 0;
    Vec3 position_mm;
};

// Linear between its points, constant before the first and after the last. One thread per object: it keeps
// the segment of the last call, so that the cost of a tick does not depend on the length.
class Stroke {
  public:
    // At least one point, with rising times.
    explicit Stroke(std::vector<StrokePoint> points);

    struct At {
        Vec3 position_mm;
        Vec3 velocity_mm_per_s;
    };
    // Real-time safe.
    At at(double t_s);
    double start_s() const { return points_.front().t_s; }
    double end_s() const { return points_.back().t_s; }

  private:
    std::vector<StrokePoint> points_;
    std::size_t next_ = 1;  // end of the segment of the last call
};

}  // namespace tribo::haptics
