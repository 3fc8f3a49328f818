// SPDX-License-Identifier: MIT
// Shapes of a probe as balls for FieldContact: the tip of a stylus, a whole stylus, a finger.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// Centres of the balls in the frame of the stylus: z points from the tip to the hand.
class ProbeShape {
  public:
    // One ball at the tip.
    ProbeShape() : balls_(1) {}
    // A row of balls along the stylus (ray-based method of the paper).
    static ProbeShape ray(double length_mm = 20);
    // A cylinder with a flat lower end (the finger of the paper): points on its side and rim.
    static ProbeShape cylinder(double radius_mm, double length_mm = 20);

    std::size_t size() const { return balls_.size(); }
    // The centres, rotated so that z is `stylus` (unit). `out` has size() elements. Real-time safe.
    void turned(Vec3 stylus, std::span<Vec3> out) const noexcept;

  private:
    std::vector<Vec3> balls_;
};

}  // namespace tribo::haptics
