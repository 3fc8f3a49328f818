// SPDX-License-Identifier: MIT
// A scripted hand: where it means to be at a time.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

struct StrokePoint {
    double t_s = 0;
    Vec3 position_mm;
};

// Straight between its points, still before the first and after the last. One thread per object: it remembers
// where it was asked last, so that a servo's ticks cost the same at any length.
class Stroke {
  public:
    // At least one point, times rising.
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
    std::size_t next_ = 1;  // the piece asked for last ends there
};

}  // namespace tribo::haptics
