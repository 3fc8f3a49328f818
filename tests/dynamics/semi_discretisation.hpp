// SPDX-License-Identifier: MIT
// A second way to the multiplier: semi-discretisation (Insperger and Stepan 2004) in small steps of time, and
// the growth of a vibration over many periods. It shares only the force's matrices with the first.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.hpp"
#include "dynamics/cut_feedback.hpp"
#include "dynamics/mode.hpp"

namespace tribo::dynamics::test {

template <std::size_t kModeCount>
double growth(const std::array<Mode, kModeCount>& modes, const CutFeedback& cut) {
    constexpr auto kModes = static_cast<Eigen::Index>(kModeCount);
    using System = Eigen::Matrix<double, 2 * kModes, 2 * kModes>;
    using Held = Eigen::Matrix<double, 2 * kModes, 3>;
    constexpr int kPeriods = 400, kSettled = 100;
    double shortest = cut.period_s();
    for (int tooth = 0; tooth < cut.teeth(); ++tooth) shortest = std::min(shortest, cut.delay_s(tooth));
    const int steps_of_period = 400 * static_cast<int>(std::lround(cut.period_s() / shortest));
    constexpr Eigen::Index count = kModes;
    const double step = cut.period_s() / steps_of_period;
    Eigen::Matrix<double, 3, kModes> directions;
    System free = System::Zero();
    Eigen::Vector<double, kModes> inverse_mass;
    for (Eigen::Index n = 0; n < count; ++n) {
        const Mode& m = modes[static_cast<std::size_t>(n)];
        const double w = math::kTwoPi * m.frequency_hz;
        const Vec3 d = normalized(m.direction);
        directions.col(n) << d.x, d.y, d.z;
        inverse_mass[n] = w * w / m.stiffness_n_per_mm;
        free(n, count + n) = 1;
        free(count + n, n) = -w * w;
        free(count + n, count + n) = -2 * m.damping_ratio * w;
    }
    // One step: x -> flow x + sum over the teeth of held (the displacement a delay ago, mean of its two
    // ends).
    struct Step {
        System flow;
        std::vector<Held> held;
    };
    std::vector<Step> steps;
    for (int n = 0; n < steps_of_period; ++n) {
        std::vector<Held> forces;
        System system = free;
        for (int tooth = 0; tooth < cut.teeth(); ++tooth) {
            // The mean over the step, in which a tooth may enter or leave.
            constexpr int kLooks = 16;
            Eigen::Matrix3d k = Eigen::Matrix3d::Zero();
            for (int look = 0; look < kLooks; ++look) {
                const Matrix3 s = cut.stiffness(tooth, (n + (look + 0.5) / kLooks) * step);
                for (int row = 0; row < 3; ++row) {
                    const Vec3& v = s[static_cast<std::size_t>(row)];
                    k.row(row) += Eigen::RowVector3d(v.x, v.y, v.z) / kLooks;
                }
            }
            Held force = Held::Zero();
            force.template bottomRows<count>() = inverse_mass.asDiagonal() * directions.transpose() * k;
            system.template leftCols<count>() += force * directions;
            forces.push_back(-force);
        }
        Eigen::MatrixXd flow = Eigen::MatrixXd::Identity(2 * count, 2 * count), sum = step * flow,
                        term = flow;
        for (int power = 1; power < 14; ++power) {
            term = (term * system * (step / power)).eval();
            flow += term;
            sum += term * (step / (power + 1));
        }
        Step& made = steps.emplace_back(Step{flow, {}});
        for (const Held& force : forces) made.held.push_back(sum * force);
    }
    double longest = 0;
    for (int tooth = 0; tooth < cut.teeth(); ++tooth) longest = std::max(longest, cut.delay_s(tooth));
    const auto memory = static_cast<std::size_t>(std::ceil(longest / step)) + 3;
    std::vector<Eigen::Vector3d> past(memory, Eigen::Vector3d(1e-3, 2e-3, -1e-3));
    using State = Eigen::Vector<double, 2 * kModes>;
    State x = State::Zero();
    std::size_t at = 0;
    double log_size = 0, sum = 0, moment = 0;  // for the slope of the logarithm over the settled periods
    for (int period = 0; period < kPeriods; ++period) {
        for (const Step& s : steps) {
            past[at % memory] = directions * x.template head<count>();
            State next = s.flow * x;
            for (int tooth = 0; tooth < cut.teeth(); ++tooth) {
                // The middle of the step, a delay ago.
                const double back = cut.delay_s(tooth) / step - 0.5;
                const auto whole = static_cast<std::size_t>(std::floor(back));
                const double part = back - std::floor(back);
                const Eigen::Vector3d before = (1 - part) * past[(at + memory - whole) % memory] +
                                               part * past[(at + memory - whole - 1) % memory];
                next += s.held[static_cast<std::size_t>(tooth)] * before;
            }
            x = next;
            ++at;
        }
        double size = 0;
        for (const Eigen::Vector3d& r : past) size += r.squaredNorm();
        size = std::sqrt(size);
        log_size += std::log(size);
        x /= size;
        for (Eigen::Vector3d& r : past) r /= size;
        if (period < kSettled) continue;
        const double from_middle = period - 0.5 * (kSettled + kPeriods - 1);
        sum += from_middle * log_size;
        moment += from_middle * from_middle;
    }
    return std::exp(sum / moment);
}

}  // namespace tribo::dynamics::test
