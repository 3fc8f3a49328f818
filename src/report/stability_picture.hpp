// SPDX-License-Identifier: MIT
// The chart of stable speeds and depths as a picture.
#pragma once

#include <optional>
#include <string>

#include "dynamics/stability_chart.hpp"
#include "report/chart/drawing.hpp"

namespace tribo::report {

// What stands in the chart besides its points.
struct StabilityNotes {
    std::string title;                           // ASCII
    double spindle_rpm = 0, axial_depth_mm = 0;  // the job's own point
    bool stable = false;                         // there
    std::optional<double> probability{};         // of chatter there
};

// Speed to the right, depth upwards. Stable points are white, others the darker the faster a vibration grows:
// readable in grey. A chart with probabilities shows these instead. With the border of stability, the job's
// point and the deepest pockets. The chart must have points.
Drawing draw_stability(const dynamics::StabilityChart& chart, const StabilityNotes& notes);

}  // namespace tribo::report
