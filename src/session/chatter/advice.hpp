// SPDX-License-Identifier: MIT
// The chart of a steady cut: which part of it to compute, and what it says about the job.
#pragma once

#include <optional>
#include <vector>

#include "dynamics/stability_chart.hpp"
#include "session/chatter/probability.hpp"
#include "session/chatter/steady_cut.hpp"

namespace tribo::session {

// Half to twice the job's speed, but hardly beyond the speed at which a tooth comes with each vibration of
// the fastest mode. 200 speeds or more.
dynamics::ChartRange default_speeds(const SteadyCut& cut);
// Down to chart_depth_mm(). 100 depths or more.
void add_default_depths(const SteadyCut& cut, dynamics::ChartRange& range);

// How deep a chart reaches, from the first unstable depths at some of its speeds: to twice the job's depth
// and to four times the middle one of these, at most the whole edge.
double chart_depth_mm(const SteadyCut& cut, std::vector<double> first_unstable_mm);

struct Advice {
    dynamics::Stability here;    // at the job's speed and depth
    dynamics::DepthLimit limit;  // at the job's speed
    // The speed of the chart nearest to the job's at which its depth is stable.
    std::optional<double> nearest_rpm;
    std::vector<dynamics::SafePocket> pockets;
    // Where modes or forces have a spread: the probability of chatter at the job's speed and depth, and the
    // last depth of the chart that rarely chatters at its speed, or 0. `nearest_rpm` is then a speed at which
    // the depth rarely does (dynamics::kRarely).
    std::optional<double> probability, safe_mm;
};

// The chart with its probabilities. `count`: of the cases of a spread. `parallel` as in stability_chart().
Advice advise(const SteadyCut& cut, const dynamics::StabilityChart& chart, const ParallelFor& parallel,
              std::size_t count = kCases);

}  // namespace tribo::session
