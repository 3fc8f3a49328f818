// SPDX-License-Identifier: MIT
#include "dynamics/stability_chart.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "dynamics/benchmark_slot.hpp"

namespace tribo::dynamics {
namespace {

// A multiplier that grows with the depth and is 1 at a limit that depends on the speed.
double limit_at(double rpm) {
    return 1 + 0.5 * std::sin(rpm / 1000);
}
Stability made_up(double rpm, double depth_mm) {
    const double multiplier = std::pow(depth_mm / limit_at(rpm), 0.7);
    return {multiplier, 0, 0, 0, multiplier > 1 ? ChatterKind::quasi_periodic : ChatterKind::stable};
}

TEST(ChartRange, counts_in_steps_with_both_ends) {
    const ChartRange range{1000, 2000, 250, 0.3, 0.1};
    EXPECT_EQ(*range.speeds_rpm(), (std::vector<double>{1000, 1250, 1500, 1750, 2000}));
    ASSERT_EQ(range.depths_mm()->size(), 3u);
    EXPECT_NEAR(range.depths_mm()->back(), 0.3, 1e-15);
    // One speed is a chart too.
    EXPECT_EQ(*(ChartRange{1000, 1000, 1, 1, 1}.speeds_rpm()), (std::vector<double>{1000}));
    EXPECT_FALSE((ChartRange{2000, 1000, 250, 1, 1}.speeds_rpm()));
    EXPECT_FALSE((ChartRange{1000, 2000, 0, 1, 1}.speeds_rpm()));
    EXPECT_FALSE((ChartRange{1000, 2000, -1, 1, 1}.speeds_rpm()));
    EXPECT_FALSE((ChartRange{1000, 2000, 1e-300, 1, 1}.speeds_rpm()));
    EXPECT_FALSE((ChartRange{1000, 1000.0 + kMostSpeeds, 1, 1, 1}.speeds_rpm()));
    EXPECT_FALSE((ChartRange{1, 1, 1, 0.1, 0.2}.depths_mm()));
}

TEST(StabilityChart, asks_for_every_point_and_narrows_the_limits) {
    const ChartRange range{1000, 9000, 100, 1.4, 0.02};
    const StabilityChart chart = stability_chart(range, made_up, serial_for);
    ASSERT_EQ(chart.points.size(), 81u * 70u);
    bool some_deeper = false;
    for (std::size_t s = 0; s < chart.speeds_rpm.size(); ++s) {
        const double rpm = chart.speeds_rpm[s], limit = limit_at(rpm);
        for (std::size_t d = 0; d < chart.depths_mm.size(); ++d)
            EXPECT_EQ(chart.at(s, d).multiplier, made_up(rpm, chart.depths_mm[d]).multiplier);
        if (limit < 1.4) {
            ASSERT_TRUE(chart.limits[s].depth_mm);
            EXPECT_NEAR(*chart.limits[s].depth_mm, limit, 1e-7);
            EXPECT_EQ(chart.limits[s].there.kind, ChatterKind::quasi_periodic);
        } else {
            EXPECT_FALSE(chart.limits[s].depth_mm);
            some_deeper = true;
        }
    }
    EXPECT_TRUE(some_deeper);
}

TEST(StabilityChart, has_the_known_limits_of_the_benchmark) {
    const Mode mode = benchmark_mode();
    const auto at = [&](double rpm, double depth_mm) {
        const milling::EngagementBand slot{0, depth_mm, 0, math::kPi};
        return stability({&mode, 1}, CutFeedback(kCutter, kAluminium, {&slot, 1}, rpm));
    };
    const StabilityChart chart = stability_chart({5000, 10'000, 1000, 3.5, 0.05}, at, serial_for);
    const double known[] = {0.4086, 0.3532, 1.1520,
                            0.6764, 3.0090, 0.3224};  // notes of the literature's case
    for (std::size_t s = 0; s < 6; ++s) EXPECT_NEAR(*chart.limits[s].depth_mm, known[s], 1e-3 * known[s]);
}

TEST(StabilityChart, ends_where_it_may_not_go_on) {
    int calls = 0;
    const StabilityChart chart =
        stability_chart({1000, 9000, 100, 1, 0.1}, made_up, serial_for, [&](double) { return ++calls < 5; });
    EXPECT_EQ(chart.points.back().multiplier, 0);
}

TEST(SafePockets, are_the_deepest_speeds_that_stay_stable_one_percent_off) {
    // A narrow high tooth at 3000 rpm, a wide pocket at 6000, a shallow one at 8000.
    StabilityChart chart;
    chart.depths_mm = {1, 2, 3, 4, 5};
    for (double rpm = 1000; rpm <= 9000; rpm += 20) {
        chart.speeds_rpm.push_back(rpm);
        double limit = 0.5;
        if (rpm == 3000) limit = 4.5;
        if (std::abs(rpm - 6000) < 450) limit = 3 - 0.004 * std::abs(rpm - 6000);
        if (std::abs(rpm - 8000) < 300) limit = 0.6;
        chart.limits.push_back({limit, {}});
    }
    const std::vector<SafePocket> pockets = safe_pockets(chart, 4);
    ASSERT_EQ(pockets.size(), 1u);
    EXPECT_NEAR(pockets[0].spindle_rpm, 6000, 20);
    EXPECT_NEAR(pockets[0].depth_mm, 3 - 0.004 * 60, 1e-12);
    EXPECT_FALSE(pockets[0].deeper);
    // Stable all the way down is as deep as the chart.
    for (std::size_t n = 0; n < chart.limits.size(); ++n)
        if (chart.speeds_rpm[n] > 7900 && chart.speeds_rpm[n] < 8300) chart.limits[n].depth_mm.reset();
    const std::vector<SafePocket> two = safe_pockets(chart, 4);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_NEAR(two[0].spindle_rpm, 8100, 20);
    EXPECT_TRUE(two[0].deeper);
    EXPECT_EQ(safe_pockets(chart, 1).size(), 1u);
}

}  // namespace
}  // namespace tribo::dynamics
