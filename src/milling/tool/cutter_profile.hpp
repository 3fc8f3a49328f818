// SPDX-License-Identifier: MIT
// The cutter's meridian as a curve: from the axis out along the flat bottom, around the corner, up the
// cylinder. Real-time safe, any thread.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "milling/force/edge_force.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// A point of the meridian is given by its distance s along the meridian from the axis, mm.
class CutterProfile {
  public:
    explicit CutterProfile(const Cutter& cutter)
        : core_(cutter.radius_mm() - cutter.corner_radius_mm()),
          corner_(cutter.corner_radius_mm()),
          end_(core_ + corner_ * math::kHalfPi + cutter.length_mm - corner_) {}

    double bottom_end() const { return core_; }
    double corner_end() const { return core_ + corner_ * math::kHalfPi; }
    double end() const { return end_; }

    ProfilePoint at(double s) const {
        if (s <= core_) return {s, 0, 0, 1};
        if (s >= corner_end()) return {core_ + corner_, corner_ + s - corner_end(), 1, 0};
        double sine, cosine;
        math::sincos((s - core_) / corner_, sine, cosine);
        return {core_ + corner_ * sine, corner_ * (1 - cosine), sine, cosine};
    }
    // Returns s of the lateral edge at this height above the tip.
    double at_height(double z_mm) const {
        if (z_mm >= corner_) return corner_end() + z_mm - corner_;
        return core_ + corner_ * math::acos(std::clamp(1 - z_mm / corner_, -1.0, 1.0));
    }

  private:
    double core_, corner_, end_;
};

}  // namespace tribo::milling
