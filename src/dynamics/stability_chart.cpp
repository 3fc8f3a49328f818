// SPDX-License-Identifier: MIT
#include "dynamics/stability_chart.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

namespace tribo::dynamics {
namespace {

// `from` + n `step`, up to `to`.
std::optional<std::vector<double>> steps(double from, double to, double step, std::size_t most) {
    constexpr double kRoundoff = 1e-9;  // of a step
    if (!(step > 0) || !(to >= from)) return std::nullopt;
    const double count = std::floor((to - from) / step + kRoundoff) + 1;
    if (count > static_cast<double>(most)) return std::nullopt;
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(count));
    for (int n = 0; n < static_cast<int>(count); ++n) values.push_back(from + n * step);
    return values;
}

}  // namespace

std::optional<std::vector<double>> ChartRange::speeds_rpm() const {
    return steps(from_rpm, to_rpm, step_rpm, kMostSpeeds);
}

std::optional<std::vector<double>> ChartRange::depths_mm() const {
    return steps(step_mm, most_mm, step_mm, kMostDepths);
}

double StabilityChart::safe_mm(std::size_t speed) const {
    if (probability.empty()) return limits[speed].depth_mm.value_or(depths_mm.back());
    double safe = 0;
    for (std::size_t n = 0; n < depths_mm.size(); ++n)
        if (probability[speed * depths_mm.size() + n] <= kRarely) safe = depths_mm[n];
    return safe;
}

StabilityChart stability_chart(const ChartRange& range,
                               const std::function<Stability(double rpm, double depth_mm)>& at,
                               const ParallelFor& parallel,
                               const std::function<bool(double fraction)>& may_go_on) {
    const auto speeds = range.speeds_rpm(), depths = range.depths_mm();
    assert(speeds && depths);
    StabilityChart chart{*speeds, *depths, {}, {}, {}};
    chart.points.resize(speeds->size() * depths->size());
    chart.limits.resize(speeds->size());
    std::atomic<std::size_t> done = 0;
    parallel(speeds->size(), [&](std::size_t speed) {
        const double rpm = (*speeds)[speed];
        const double share = static_cast<double>(done) / static_cast<double>(speeds->size());
        const auto asked = [&](double depth_mm) { return at(rpm, depth_mm); };
        double stable = 0;
        DepthLimit& limit = chart.limits[speed];
        for (std::size_t n = 0; n < depths->size(); ++n) {
            if (may_go_on && !may_go_on(share)) return;
            const double depth = (*depths)[n];
            const Stability& found = chart.points[speed * depths->size() + n] = asked(depth);
            if (limit.depth_mm) continue;
            limit.there = found;
            if (found.multiplier > 1) limit = limit_between(asked, stable, depth, found);
            stable = depth;
        }
        ++done;
    });
    return chart;
}

std::vector<SafePocket> safe_pockets(const StabilityChart& chart, std::size_t most) {
    constexpr double kOff = 0.01, kAboveMedian = 1.5, kShallower = 0.8;
    const std::size_t count = chart.speeds_rpm.size();
    std::vector<double> limits;
    limits.reserve(count);
    for (std::size_t n = 0; n < count; ++n) limits.push_back(chart.safe_mm(n));
    // The least limit within 1 % of each speed, but at least of its neighbours.
    std::vector<double> safe = limits;
    for (std::size_t n = 0; n < count; ++n) {
        for (std::size_t k = n; k-- > 0;) {
            if (k + 1 < n && chart.speeds_rpm[k] < (1 - kOff) * chart.speeds_rpm[n]) break;
            safe[n] = std::min(safe[n], limits[k]);
        }
        for (std::size_t k = n + 1; k < count; ++k) {
            if (k > n + 1 && chart.speeds_rpm[k] > (1 + kOff) * chart.speeds_rpm[n]) break;
            safe[n] = std::min(safe[n], limits[k]);
        }
    }
    std::vector<double> sorted = limits;
    std::sort(sorted.begin(), sorted.end());
    const double least = kAboveMedian * sorted[count / 2];
    std::vector<std::size_t> peaks;
    for (std::size_t n = 0; n < count;) {
        std::size_t end = n;
        while (end < count && safe[end] == safe[n]) ++end;
        const bool rises = n == 0 || safe[n - 1] < safe[n];
        const bool falls = end == count || safe[end] < safe[n];
        if (rises && falls && safe[n] >= least && safe[n] > 0) peaks.push_back((n + end - 1) / 2);
        n = end;
    }
    std::sort(peaks.begin(), peaks.end(), [&](std::size_t a, std::size_t b) {
        return safe[a] > safe[b] || (safe[a] == safe[b] && a < b);
    });
    std::vector<std::size_t> chosen;
    for (const std::size_t peak : peaks) {
        const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](std::size_t other) {
            const auto between = std::minmax(peak, other);
            return *std::min_element(safe.begin() + static_cast<std::ptrdiff_t>(between.first),
                                     safe.begin() + static_cast<std::ptrdiff_t>(between.second)) <
                   kShallower * safe[peak];
        });
        if (apart && chosen.size() < most) chosen.push_back(peak);
    }
    std::vector<SafePocket> pockets;
    pockets.reserve(chosen.size());
    for (const std::size_t n : chosen)
        pockets.push_back({chart.speeds_rpm[n], safe[n], safe[n] == chart.depths_mm.back()});
    return pockets;
}

}  // namespace tribo::dynamics
