// SPDX-License-Identifier: MIT
// The modes from sample to sample, two modes at a time.
#pragma once

#include <span>
#include <vector>

#include "dynamics/mode.hpp"
#include "dynamics/step/tool_place.hpp"

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

    // Displacement at this sample if the force were that of the last step, mm.
    LaneVec3 foreseen() const { return {free_.xy + pushed_.xy, free_.z + pushed_.z}; }

    // Goes to the next sample under the force of this step. Returns the displacement at this sample, mm.
    LaneVec3 step(const LaneVec3& force_n) {
        push(force_n);
        const LaneVec3 displacement_mm = foreseen();
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
        return displacement_mm;
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
    void push(const LaneVec3& force_n) {
        force_n_ = force_n;
        pushed_.xy = both(force_n.xy[0]) * push_x_ + both(force_n.xy[1]) * push_y_;
        if (level_) return;
        pushed_.xy += both(force_n.z) * push_z_.xy;
        pushed_.z = push_z_.xy[0] * force_n.xy[0] + push_z_.xy[1] * force_n.xy[1] + push_z_.z * force_n.z;
    }
    void sum_up();

    std::vector<Two> twos_;
    bool level_ = true;  // no mode goes along z
    LaneVec3 force_n_;   // of the last step
    // Sums over the modes: displacement without force, by that one, and by a newton along x, y and z.
    LaneVec3 free_, pushed_;
    D2 push_x_{}, push_y_{};
    LaneVec3 push_z_;
};

}  // namespace tribo::dynamics
