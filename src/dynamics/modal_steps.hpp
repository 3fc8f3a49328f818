// SPDX-License-Identifier: MIT
// The modes from sample to sample, two modes at a time.
#pragma once

#include <span>
#include <vector>

#include "dynamics/mode.hpp"
#include "dynamics/tool_place.hpp"

namespace tribo::dynamics {

// Samples stand in the middles of steps, and a force is constant over its step. Each step turns the modes
// exactly. One thread; all but the constructor are real-time safe.
class ModalSteps {
  public:
    // At rest. rate_hz: samples per second. No modes: nothing moves.
    ModalSteps(std::span<const Mode> modes, double rate_hz);

    // Other directions, of as many modes.
    void turn(std::span<const Mode> modes);
    // Multiplies displacement and speed.
    void scale(double factor);

    // Displacement at this sample under a force since the begin of its step, mm.
    LaneVec3 displacement(const LaneVec3& force_n) const {
        LaneVec3 sum{free_.xy + (both(force_n.xy[0]) * push_x_ + both(force_n.xy[1]) * push_y_), free_.z};
        if (level_) return sum;
        sum.xy += both(force_n.z) * push_z_.xy;
        sum.z += push_z_.xy[0] * force_n.xy[0] + push_z_.xy[1] * force_n.xy[1] + push_z_.z * force_n.z;
        return sum;
    }

    // To the next sample: the force acts until the end of its step.
    void advance(const LaneVec3& force_n) {
        D2 x{}, y{}, z{};
        const D2 fx = both(force_n.xy[0]), fy = both(force_n.xy[1]), fz = both(force_n.z);
        for (Two& t : twos_) {
            D2 along = fx * t.x + fy * t.y;
            if (!level_) along += fz * t.z;
            const D2 q = t.q_by_q * t.q + t.q_by_v * t.v + t.q_by_force * along;
            t.v = t.v_by_q * t.q + t.v_by_v * t.v + t.v_by_force * along;
            t.q = q;
            x += q * t.x;
            y += q * t.y;
            if (!level_) z += q * t.z;
        }
        free_.xy = D2{x[0], y[0]} + D2{x[1], y[1]};
        free_.z = z[0] + z[1];
    }

  private:
    // Two modes, in lanes; one that lacks does not move. q and v: displacement and speed at the sample if
    // there were no force in the first half of its step.
    struct Two {
        D2 x{}, y{}, z{};  // direction
        D2 push{};         // displacement by a force in that half of a step
        D2 q_by_q{}, q_by_v{}, q_by_force{}, v_by_q{}, v_by_v{}, v_by_force{};
        D2 q{}, v{};
    };
    void sum_up();

    std::vector<Two> twos_;
    bool level_ = true;  // no mode goes along z
    // Sums over the modes: displacement without force, and by a force along x, y and z.
    LaneVec3 free_;
    D2 push_x_{}, push_y_{};
    LaneVec3 push_z_;
};

}  // namespace tribo::dynamics
