// SPDX-License-Identifier: MIT
// Roughness parameters of profiles that have closed forms.
#include "surface/roughness.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "grooves.hpp"

namespace tribo::surface {
namespace {

TEST(Roughness, parabolic_cusps_have_their_closed_form) {
    const double h = 0.02;
    std::vector<double> heights;
    for (int i = 0; i < 10'000; ++i) {
        const double t = 2 * ((i + 0.5) / 1000 - std::floor((i + 0.5) / 1000)) - 1;  // ten cusps
        heights.push_back(h * t * t);
    }
    const Roughness r = roughness(heights);
    EXPECT_NEAR(r.ra_mm, 4 * h / (9 * std::sqrt(3)), 1e-4 * h);  // 0.2566 h
    EXPECT_NEAR(r.rq_mm, 2 * h / std::sqrt(45), 1e-4 * h);       // 0.2981 h
    EXPECT_NEAR(r.rz_mm, h, 3e-3 * h);
    EXPECT_NEAR(r.rt_mm, h, 3e-3 * h);
}

TEST(Roughness, a_sine_has_its_closed_form) {
    std::vector<double> heights;
    for (int i = 0; i < 10'000; ++i)
        heights.push_back(0.5 * std::cos(2 * 3.141592653589793 * (i + 0.5) / 500));
    const Roughness r = roughness(heights);
    EXPECT_NEAR(r.ra_mm, 0.5 * 2 / 3.141592653589793, 1e-4);
    EXPECT_NEAR(r.rq_mm, 0.5 / std::sqrt(2), 1e-4);
    EXPECT_NEAR(r.rz_mm, 1, 1e-3);
}

TEST(Roughness, one_high_peak_counts_once_in_rz_and_whole_in_rt) {
    std::vector<double> heights(1000, 0.0);
    heights[500] = 1;
    const Roughness r = roughness(heights);
    EXPECT_NEAR(r.rt_mm, 1, 1e-2);
    EXPECT_NEAR(r.rz_mm, 0.2, 1e-2);
}

TEST(Roughness, fine_ball_passes_measured_through_the_field_have_parabolic_cusps) {
    const double radius = 4, sidestep = 0.2, cusp = sidestep * sidestep / (8 * radius);
    const test::Grooves field(1, radius, test::row(0, sidestep, 30));
    const auto heights = height_profile(field, {3, 1, 0.01}, {3, 5, 0.01}, {0, 0, 1}, 2000);
    ASSERT_TRUE(heights.has_value());
    const Roughness r = roughness(*heights);
    EXPECT_NEAR(r.ra_mm, 0.2566 * cusp, 1e-3 * cusp);
    EXPECT_NEAR(r.rq_mm, 0.2981 * cusp, 1e-3 * cusp);
    EXPECT_EQ(height_profile(field, {3, 1, 9}, {3, 5, 9}, {0, 0, 1}, 10, 2), std::nullopt);
}

RC_GTEST_PROP(Roughness, a_tilt_and_a_shift_change_nothing_and_a_scale_scales, ()) {
    const auto values = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-100, 101));
    RC_PRE(values.size() >= 5U);
    const double tilt = *rc::gen::inRange(-10, 11), shift = *rc::gen::inRange(-10, 11);
    std::vector<double> plain, moved;
    for (std::size_t i = 0; i < values.size(); ++i) {
        plain.push_back(values[i]);
        moved.push_back(3 * values[i] + shift + tilt * static_cast<double>(i));
    }
    const Roughness a = roughness(plain), b = roughness(moved);
    RC_ASSERT(std::abs(3 * a.ra_mm - b.ra_mm) < 1e-8);
    RC_ASSERT(std::abs(3 * a.rq_mm - b.rq_mm) < 1e-8);
    RC_ASSERT(std::abs(3 * a.rz_mm - b.rz_mm) < 1e-8);
    RC_ASSERT(std::abs(3 * a.rt_mm - b.rt_mm) < 1e-8);
}

}  // namespace
}  // namespace tribo::surface
