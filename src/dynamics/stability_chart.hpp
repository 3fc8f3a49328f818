// SPDX-License-Identifier: MIT
// The stability of one cut over spindle speeds and axial depths.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "dynamics/stability.hpp"

namespace tribo::dynamics {

// Speeds from, from + step ... up to to; depths step, 2 step ... up to most.
struct ChartRange {
    double from_rpm = 0, to_rpm = 0, step_rpm = 0;
    double most_mm = 0, step_mm = 0;

    // Absent: no speed or no depth, or more than kMostSpeeds or kMostDepths.
    std::optional<std::vector<double>> speeds_rpm() const;
    std::optional<std::vector<double>> depths_mm() const;
};
inline constexpr std::size_t kMostSpeeds = 2000, kMostDepths = 1000;  // of a chart: seconds

struct StabilityChart {
    std::vector<double> speeds_rpm, depths_mm;  // ascending
    std::vector<Stability> points;              // speed by speed, all depths of each
    std::vector<DepthLimit> limits;             // one per speed, down to the last depth
    // Of chatter, as `points`; empty where nothing has a spread. Never falls with depth.
    std::vector<double> probability{};

    const Stability& at(std::size_t speed, std::size_t depth) const {
        return points[speed * depths_mm.size() + depth];
    }
    // The border; with probabilities the last depth that rarely chatters, or 0. The last depth at most.
    double safe_mm(std::size_t speed) const;
};

inline constexpr double kRarely = 0.1;  // a probability of chatter up to which a cut counts as safe

// `at` is called from the threads of `parallel`; `range` must have speeds and depths (asserted). `may_go_on`
// is called from them too, with the finished share; where it returns false, the rest of the chart is empty.
StabilityChart stability_chart(const ChartRange& range,
                               const std::function<Stability(double rpm, double depth_mm)>& at,
                               const ParallelFor& parallel,
                               const std::function<bool(double fraction)>& may_go_on = {});

// A speed that may be recommended: also with the spindle 1 % slower or faster the cut is stable to that
// depth, with probabilities in nine of ten cases (kRarely).
struct SafePocket {
    double spindle_rpm = 0, depth_mm = 0;
    bool deeper = false;  // stable to the last depth of the chart: perhaps deeper
};
// The deepest first, `most` of them, each at least half as deep again as the median of the limits, and with a
// shallower speed between any two. Of equal neighbours the middle is named.
std::vector<SafePocket> safe_pockets(const StabilityChart& chart, std::size_t most);

}  // namespace tribo::dynamics
