// SPDX-License-Identifier: MIT
// What the hand holds against a surface, as balls for FieldContact: the tip of a stylus, the stylus itself, a
// finger.
#pragma once

#include <span>
#include <vector>

#include "base/vec3.hpp"

namespace tribo::haptics {

// Places of the balls' centres in the stylus' own frame: z from the tip to the hand.
class ProbeShape {
  public:
    // One ball at the tip.
    ProbeShape() : balls_(1) {}
    // A row along the stylus (the paper's ray-based method: a segment whose direction matters).
    static ProbeShape ray(double length_mm = 20);
    // A cylinder with a flat lower end (the paper's finger): points on its side and rim.
    static ProbeShape cylinder(double radius_mm, double length_mm = 20);

    std::size_t size() const { return balls_.size(); }
    // The centres from the tip on, turned so that z is `stylus` (unit). Real-time safe; `out` has size()
    // places.
    void turned(Vec3 stylus, std::span<Vec3> out) const noexcept;

  private:
    std::vector<Vec3> balls_;
};

}  // namespace tribo::haptics
