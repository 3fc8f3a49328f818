// SPDX-License-Identifier: MIT
// Runs `tribo stability` after its flags are read: points, limits and the chart of a steady cut.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamics/stability_chart.hpp"
#include "session/chatter/advice.hpp"
#include "session/chatter/critical_row.hpp"
#include "session/chatter/simulated_cut.hpp"
#include "sweep/band.hpp"

namespace tribo::app {

struct StabilityPoint {
    double spindle_rpm = 0, axial_depth_mm = 0;
    dynamics::Stability stability{};
    std::optional<double> probability{};  // of chatter, where modes or forces have a spread
};

struct StabilityLimit {
    double spindle_rpm = 0;
    dynamics::DepthLimit limit{};
    std::optional<sweep::Band> band_mm{};  // of its depth in the cases of --uncertain
};

struct StabilityCall {
    std::string job, out;  // out: a folder; empty: none
    std::vector<StabilityPoint> at;
    std::vector<double> limit_rpm;
    std::optional<dynamics::ChartRange> speeds, depths;  // each with its half of the range
    std::optional<session::Simulation> simulation;
    session::CutPlace place;
    std::optional<double> resolution_mm;
    std::optional<int> uncertain;  // cases of what is known with a spread only
    bool json = false;

    bool wants_chart() const { return speeds || (at.empty() && limit_rpm.empty() && !simulation); }
};

struct ComputedChart {
    dynamics::ChartRange range;
    dynamics::StabilityChart chart;
    session::Advice advice;
};

struct StabilityAnswer {
    session::SteadyCut cut;
    std::vector<job::JobFrf> frfs;  // with their fits
    Warnings warnings;
    std::vector<StabilityPoint> points;
    std::vector<StabilityLimit> limits;
    std::optional<ComputedChart> chart;
    std::optional<session::SimulationPeaks> simulated;
};

// Returns the exit code. Prints errors to stderr, the answer to stdout.
int stability(const StabilityCall& call);

}  // namespace tribo::app
