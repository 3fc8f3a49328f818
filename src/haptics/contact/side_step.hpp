// SPDX-License-Identifier: MIT
// How far a proxy steps along a smooth side: as far as would settle it, were the side to bend on as it did
// over the last step (BFGS with a memory of one step: Nocedal 1980). Real-time safe.
#pragma once

#include <span>

#include "base/vec3.hpp"

namespace tribo::haptics {

class SideStep {
  public:
    // Another surface: the next step is that of a plane, the whole remaining way.
    void reset();
    // A step was taken from a place with the remaining way `rest` along the surface. `same`: the same sides
    // hold the place that it led to; `smooth`: one smooth side does.
    void take(Vec3 rest_mm, Vec3 step_mm, bool same, bool smooth);
    // What was taken last is not followed by the next step: a step was refused, or the probe has moved.
    void interrupt() { last_.known = false; }

    // Learns from the last step. `rest`: the remaining way now.
    void learn(Vec3 rest_mm);
    // On one smooth side with this normal.
    Vec3 on_side(Vec3 rest_mm, Vec3 normal) const;
    // Of a ball that touches an edge or a peak: its centre moves on a circle about that, with the probe
    // `press` below it, until it lies on one of the sides that meet there, and on along that one.
    Vec3 round_edge(Vec3 rest_mm, std::span<const Vec3> meeting, double press_mm,
                    double ball_radius_mm) const;
    // Step per remaining way where nothing else is known: 1 on a plane, less in a hollow.
    double ease() const { return ease_; }

  private:
    struct Step {
        Vec3 rest, way;
        bool known = false;
    };
    // Over `step` the remaining way became shorter by `change`.
    struct Bend {
        Vec3 step, change;
        bool known = false;
        double ease() const { return squared_length(step) / dot(step, change); }
    };
    Step last_;
    Bend bend_;
    double ease_ = 1;
};

}  // namespace tribo::haptics
