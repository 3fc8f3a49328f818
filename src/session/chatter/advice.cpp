// SPDX-License-Identifier: MIT
#include "session/chatter/advice.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "session/chatter/probability.hpp"

namespace tribo::session {
namespace {

constexpr double kSpeeds = 200, kDepths = 100;  // of a chart that nobody asked for in other steps
constexpr std::size_t kMostPockets = 4;

// The round number (1, 2 or 5 times a power of ten) below a value.
double round_below(double value) {
    const double decade = math::pow(10.0, std::floor(math::log10(value)));
    for (const double times : {5.0, 2.0})
        if (times * decade <= value) return times * decade;
    return decade;
}

}  // namespace

dynamics::ChartRange default_speeds(const SteadyCut& cut) {
    double fastest_hz = 0;
    for (const dynamics::Mode& mode : cut.modes) fastest_hz = std::max(fastest_hz, mode.frequency_hz);
    const double whole = 60 * fastest_hz / cut.cutter.flutes;
    const double least = std::max(0.5 * cut.spindle_rpm, cut.least_rpm(cut.cutter.length_mm));
    const double most = std::min(2 * cut.spindle_rpm, std::max(1.25 * cut.spindle_rpm, 1.2 * whole));
    dynamics::ChartRange range;
    range.step_rpm = round_below(std::max(most - least, 0.1 * least) / kSpeeds);
    range.from_rpm = range.step_rpm * std::ceil(least / range.step_rpm);
    range.to_rpm = range.step_rpm * std::ceil(std::max(most, 1.1 * least) / range.step_rpm);
    return range;
}

void add_default_depths(const SteadyCut& cut, dynamics::ChartRange& range) {
    // The first unstable one of depths that double, at some speeds of the chart.
    constexpr int kAsked = 40, kDoublings = 10;
    std::vector<double> first;
    for (int n = 0; n < kAsked; ++n) {
        const double rpm = range.from_rpm + n * (range.to_rpm - range.from_rpm) / (kAsked - 1);
        double depth = std::ldexp(cut.cutter.length_mm, -kDoublings);
        while (depth < cut.cutter.length_mm && cut.at(rpm, depth).multiplier <= 1) depth *= 2;
        first.push_back(depth);
    }
    const double most = chart_depth_mm(cut, std::move(first));
    range.step_mm = round_below(most / kDepths);
    range.most_mm = range.step_mm * std::ceil(std::min(most, cut.cutter.length_mm) / range.step_mm);
}

double chart_depth_mm(const SteadyCut& cut, std::vector<double> first) {
    const auto middle = first.begin() + static_cast<std::ptrdiff_t>(first.size() / 2);
    std::nth_element(first.begin(), middle, first.end());
    return std::min(std::max(4 * *middle, 2 * cut.axial_depth_mm),
                    std::max(cut.cutter.length_mm, cut.axial_depth_mm));
}

Advice advise(const SteadyCut& cut, const dynamics::StabilityChart& chart, const ParallelFor& parallel,
              std::size_t count) {
    Advice advice;
    advice.here = cut.at(cut.spindle_rpm, cut.axial_depth_mm);
    advice.limit = cut.limit(cut.spindle_rpm);
    advice.pockets = dynamics::safe_pockets(chart, kMostPockets);
    const std::vector<SteadyCut> cases = cases_of(cut, count);
    if (!cases.empty()) {
        advice.probability = probability_of_chatter(cases, cut.spindle_rpm, cut.axial_depth_mm);
        std::vector<std::size_t> stable;
        stable.reserve(cases.size());
        for (const SteadyCut& c : cases) stable.push_back(stable_depths(c, cut.spindle_rpm, chart.depths_mm));
        const double rarely = dynamics::kRarely * static_cast<double>(cases.size());
        const auto rare = stable.begin() + static_cast<std::ptrdiff_t>(rarely);
        std::nth_element(stable.begin(), rare, stable.end());
        advice.safe_mm = *rare > 0 ? chart.depths_mm[*rare - 1] : 0;
    }
    std::vector<char> stable(chart.speeds_rpm.size());
    parallel(stable.size(), [&](std::size_t n) {
        const double rpm = chart.speeds_rpm[n], depth_mm = cut.axial_depth_mm;
        if (chart.probability.empty()) {
            stable[n] = cut.at(rpm, depth_mm).multiplier <= 1;
        } else if (depth_mm <= chart.depths_mm.back()) {
            stable[n] = chart.safe_mm(n) >= depth_mm;
        } else {
            stable[n] = probability_of_chatter(cases, rpm, depth_mm) <= dynamics::kRarely;
        }
    });
    for (std::size_t n = 0; n < stable.size(); ++n) {
        const double rpm = chart.speeds_rpm[n];
        if (stable[n] && (!advice.nearest_rpm ||
                          std::abs(rpm - cut.spindle_rpm) < std::abs(*advice.nearest_rpm - cut.spindle_rpm)))
            advice.nearest_rpm = rpm;
    }
    return advice;
}

}  // namespace tribo::session
