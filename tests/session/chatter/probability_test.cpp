// SPDX-License-Identifier: MIT
// Cases within the bands, and the probability of chatter: against the normal distribution.
#include "session/chatter/probability.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "session/chatter/advice.hpp"

namespace tribo::session {
namespace {

const ParallelFor kOneByOne = [](std::size_t count, const std::function<void(std::size_t)>& body) {
    for (std::size_t n = 0; n < count; ++n) body(n);
};

// The slot of the benchmark: its limit at 8000 rpm is 0.6764 mm.
SteadyCut slot() {
    SteadyCut cut;
    cut.cutter = {.diameter_mm = 10, .flutes = 2, .helix_deg = 0, .length_mm = 20};
    cut.coefficients = {600, 200, 0, 0, 0, 0};
    cut.modes = {{{1, 0, 0}, 922, 0.011, 1340.0496480507}};
    cut.bands = {{0, 1, 0, std::numbers::pi}};
    cut.axial_depth_mm = 1;
    cut.spindle_rpm = 8000;
    return cut;
}

// Of a standard deviation, 9 of 10 lie within 1 / (1 + spread) and 1 + spread.
double sigma(double spread) {
    return std::log(1 + spread) / 1.6448536;
}
double normal(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(Cases, are_none_without_a_spread) {
    EXPECT_TRUE(cases_of(slot()).empty());
}

TEST(Cases, have_nine_of_ten_values_within_each_band_and_are_independent) {
    SteadyCut cut = slot();
    cut.force_low_factor = 0.7;
    cut.force_high_factor = 2.1;
    cut.modes.push_back({{0, 1, 0}, 600, 0.02, 5000});
    cut.modes[0].spread = {0.1, 0.5, 0.3};
    cut.modes[1].spread = {0.2, 0.4, 1};
    const std::vector<SteadyCut> cases = cases_of(cut);
    ASSERT_EQ(cases.size(), kCases);
    struct Value {
        double low, high;
        std::function<double(const SteadyCut&)> of;
    };
    std::vector<Value> values{{0.7, 2.1, [](const SteadyCut& c) { return c.coefficients.ktc / 600; }}};
    for (std::size_t m = 0; m < 2; ++m) {
        const dynamics::Mode& stated = cut.modes[m];
        const auto add = [&](double spread, double dynamics::Mode::* value) {
            const double whole = stated.*value;
            values.push_back({1 / (1 + spread), 1 + spread,
                              [=](const SteadyCut& c) { return c.modes[m].*value / whole; }});
        };
        add(stated.spread.frequency, &dynamics::Mode::frequency_hz);
        add(stated.spread.damping, &dynamics::Mode::damping_ratio);
        add(stated.spread.stiffness, &dynamics::Mode::stiffness_n_per_mm);
    }
    std::vector<std::vector<double>> deviates;
    for (const Value& value : values) {
        std::vector<double> z;
        int within = 0;
        for (const SteadyCut& c : cases) {
            const double factor = value.of(c);
            within += factor >= value.low && factor <= value.high ? 1 : 0;
            const double middle = 0.5 * std::log(value.low * value.high);
            z.push_back((std::log(factor) - middle) / (0.5 * std::log(value.high / value.low) / 1.6448536));
        }
        EXPECT_EQ(within, 36);
        deviates.push_back(z);
        std::sort(z.begin(), z.end());
        for (std::size_t n = 0; n < z.size(); ++n)
            EXPECT_NEAR(normal(z[n]), (static_cast<double>(n) + 0.5) / 40, 2e-4);
    }
    for (std::size_t a = 0; a < deviates.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::size_t n = 0; n < kCases; ++n) sum += deviates[a][n] * deviates[b][n];
            EXPECT_LT(std::abs(sum / static_cast<double>(kCases)), 0.45) << a << " " << b;
        }
    }
    EXPECT_DOUBLE_EQ(cases[3].coefficients.krc / cases[3].coefficients.ktc, 200.0 / 600);
}

TEST(Cases, change_the_estimated_modes_of_a_tool_together) {
    SteadyCut cut = slot();
    cut.modes = {cut.modes[0], cut.modes[0]};
    for (dynamics::Mode& mode : cut.modes) {
        mode.spread = {0.25, 1, 1};
        mode.estimated = true;
    }
    const auto same = [](const SteadyCut& c) {
        return c.modes[0].stiffness_n_per_mm == c.modes[1].stiffness_n_per_mm &&
               c.modes[0].frequency_hz == c.modes[1].frequency_hz;
    };
    EXPECT_TRUE(std::ranges::all_of(cases_of(cut), same));
    for (dynamics::Mode& mode : cut.modes) mode.estimated = false;
    EXPECT_LT(std::ranges::count_if(cases_of(cut), same), 4);
}

// The border is proportional to the stiffness and to one over the force; so its distribution is known.
TEST(Probability, of_chatter_is_that_of_the_border) {
    SteadyCut stiffness = slot(), force = slot(), both = slot();
    stiffness.modes[0].spread.stiffness = 1;
    force.force_low_factor = 0.5;
    force.force_high_factor = 2;
    both.modes[0].spread.stiffness = 0.4;
    both.force_low_factor = 1 / 1.5;
    both.force_high_factor = 1.5;
    const double limit = *slot().limit(8000).depth_mm;
    const double root = std::sqrt(sigma(0.4) * sigma(0.4) + sigma(0.5) * sigma(0.5));
    for (const double depth : {0.3, 0.5, limit, 0.9, 1.3}) {
        const double away = std::log(depth / limit);
        EXPECT_NEAR(probability_of_chatter(cases_of(stiffness), 8000, depth), normal(away / sigma(1)), 0.026);
        EXPECT_NEAR(probability_of_chatter(cases_of(force), 8000, depth), normal(away / sigma(1)), 0.026);
        EXPECT_NEAR(probability_of_chatter(cases_of(both), 8000, depth), normal(away / root), 0.08);
    }
}

TEST(Probability, of_a_chart_counts_the_first_borders_of_all_cases) {
    SteadyCut cut = slot();
    cut.modes[0].spread = {0.05, 0.3, 0.5};
    const dynamics::ChartRange range{7000, 10'000, 500, 3, 0.1};
    auto chart = dynamics::stability_chart(
        range, [&](double rpm, double depth_mm) { return cut.at(rpm, depth_mm); }, kOneByOne);
    add_probability(cut, chart, kOneByOne);
    ASSERT_EQ(chart.probability.size(), chart.points.size());
    const std::vector<SteadyCut> cases = cases_of(cut);
    std::size_t differ = 0;
    for (std::size_t s = 0; s < chart.speeds_rpm.size(); ++s) {
        std::vector<double> limits;
        for (const SteadyCut& c : cases)
            limits.push_back(
                dynamics::depth_limit([&](double depth_mm) { return c.at(chart.speeds_rpm[s], depth_mm); }, 3)
                    .depth_mm.value_or(1e9));
        for (std::size_t d = 0; d < chart.depths_mm.size(); ++d) {
            const auto above =
                std::ranges::count_if(limits, [&](double limit) { return limit < chart.depths_mm[d]; });
            const double found = chart.probability[s * chart.depths_mm.size() + d];
            if (d > 0) {
                EXPECT_GE(found, chart.probability[s * chart.depths_mm.size() + d - 1]);
            }
            // An island narrower than the steps may be missed.
            if (std::abs(found - static_cast<double>(above) / 40) > 1e-9) ++differ;
        }
    }
    EXPECT_LE(differ, chart.points.size() / 50);
    // The advice keeps to what is safe.
    const Advice advice = advise(cut, chart, kOneByOne);
    ASSERT_TRUE(advice.probability && advice.safe_mm);
    EXPECT_GT(*advice.probability, 0.5);
    EXPECT_LT(*advice.safe_mm, 0.6764);
    EXPECT_GT(*advice.safe_mm, 0.2);
    for (const dynamics::SafePocket& pocket : advice.pockets)
        EXPECT_LE(probability_of_chatter(cases, pocket.spindle_rpm, pocket.depth_mm), dynamics::kRarely);
}

TEST(Probability, is_absent_without_a_spread) {
    const SteadyCut cut = slot();
    const dynamics::ChartRange range{8000, 9000, 500, 1, 0.5};
    auto chart = dynamics::stability_chart(
        range, [&](double rpm, double depth_mm) { return cut.at(rpm, depth_mm); }, kOneByOne);
    add_probability(cut, chart, kOneByOne);
    EXPECT_TRUE(chart.probability.empty());
    EXPECT_FALSE(advise(cut, chart, kOneByOne).probability);
}

}  // namespace
}  // namespace tribo::session
