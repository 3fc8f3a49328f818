// SPDX-License-Identifier: MIT
#include "dynamics/step/modal_steps.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {

ModalSteps::ModalSteps(std::span<const Mode> modes, double rate_hz) : twos_((modes.size() + 1) / 2) {
    const double half_s = 0.5 / rate_hz;
    for (std::size_t n = 0; n < modes.size(); ++n) {
        const Mode& mode = modes[n];
        const double w = math::kTwoPi * mode.frequency_hz, zeta = mode.damping_ratio;
        const double damped = w * std::sqrt(1 - zeta * zeta), decay = math::exp(-zeta * w * half_s);
        double sine, cosine;
        math::sincos(damped * half_s, sine, cosine);
        const double qq = decay * (cosine + zeta * w / damped * sine), qv = decay * sine / damped;
        const double vq = -decay * w * w / damped * sine;
        const double vv = decay * (cosine - zeta * w / damped * sine);
        const double q_push = (1 - qq) / mode.stiffness_n_per_mm, v_push = -vq / mode.stiffness_n_per_mm;
        // The force pushes the state in the half step to the sample, and again in the one after it.
        Two& t = twos_[n / 2];
        const std::size_t lane = n % 2;
        t.push[lane] = q_push;
        t.q_by_q[lane] = qq * qq + qv * vq;
        t.q_by_v[lane] = qq * qv + qv * vv;
        t.v_by_q[lane] = vq * qq + vv * vq;
        t.v_by_v[lane] = vq * qv + vv * vv;
        t.q_by_force[lane] = t.q_by_q[lane] * q_push + t.q_by_v[lane] * v_push + qq * q_push + qv * v_push;
        t.v_by_force[lane] = t.v_by_q[lane] * q_push + t.v_by_v[lane] * v_push + vq * q_push + vv * v_push;
    }
    turn(modes);
}

void ModalSteps::turn(std::span<const Mode> modes) {
    for (std::size_t n = 0; n < modes.size(); ++n) {
        const Vec3 direction = normalized(modes[n].direction);
        Two& t = twos_[n / 2];
        t.x[n % 2] = direction.x;
        t.y[n % 2] = direction.y;
        t.z[n % 2] = direction.z;
    }
    sum_up();
}

void ModalSteps::scale(double factor) {
    for (Two& t : twos_) {
        t.q *= both(factor);
        t.v *= both(factor);
    }
    sum_up();
}

void ModalSteps::sum_up() {
    free_ = {};
    push_x_ = push_y_ = D2{};
    push_z_ = {};
    level_ = true;
    for (const Two& t : twos_) {
        for (std::size_t lane = 0; lane < 2; ++lane) {
            const D2 xy{t.x[lane], t.y[lane]};
            const double z = t.z[lane];
            free_.xy += both(t.q[lane]) * xy;
            free_.z += t.q[lane] * z;
            push_x_ += both(t.push[lane] * xy[0]) * xy;
            push_y_ += both(t.push[lane] * xy[1]) * xy;
            push_z_.xy += both(t.push[lane] * z) * xy;
            push_z_.z += t.push[lane] * z * z;
            level_ = level_ && z == 0;
        }
    }
    pushed_ = {};
    push(force_n_);
}

}  // namespace tribo::dynamics
