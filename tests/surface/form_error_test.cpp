// SPDX-License-Identifier: MIT
// Form error of a wall from the marks of its teeth: places, later passes, and waves that neighbours cut off.
#include "surface/form_error.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "surface/straight_wall.hpp"

namespace tribo::surface {
namespace {

// A trace along x from x0, 0.5 mm long, at a height; its marks displaced as `value` says of their number.
template <class Value>
void add(ToothTraces& all, double x0, double z, int marks, Value&& value, double start_s = 0) {
    ToothTrace t;
    t.from_mm = {x0, 0, z};
    t.to_mm = {x0 + 0.5, 0, z};
    t.inner_mm = {x0 + 0.25, 0, z};
    t.normal = {0, -1, 0};
    t.arc_mm = 5;
    t.width_mm = 1;
    t.start_s = start_s;
    t.end_s = start_s + 0.01;
    t.line = 7;
    t.first = all.marks.size();
    t.count = static_cast<std::size_t>(marks);
    for (int n = 0; n < marks; ++n)
        all.marks.push_back({static_cast<float>((n + 0.5) / marks), static_cast<float>(value(n)), 0});
    if (!all.traces.empty() && all.traces.back().to_mm == t.from_mm)
        t.before = static_cast<std::uint32_t>(all.traces.size() - 1);
    all.traces.push_back(t);
}

TEST(FormError, is_known_where_a_tooth_passed_and_nowhere_else) {
    ToothTraces all;
    for (int n = 0; n < 4; ++n) add(all, 0.5 * n, 1, 5, [](int) { return 0.02; }, 0.01 * n);
    const FormError error(all, tribo::test::StraightWall());
    EXPECT_NEAR(error.at({0.7, 0, 1}).value(), 0.02, 1e-7);
    EXPECT_NEAR(error.at({0.5, 0.01, 1.6}).value(), 0.02, 1e-7);
    EXPECT_FALSE(error.at({0.7, 0.1, 1}));  // beside the surface
    EXPECT_FALSE(error.at({0.7, 0, 2.5}));  // above
    EXPECT_FALSE(error.at({-0.5, 0, 1}));   // before
    EXPECT_FALSE(error.at({NAN, 0, 1}));
    EXPECT_FALSE(FormError().at({0, 0, 0}));
    EXPECT_NEAR(error.extremes().left_mm, 0.02, 1e-7);
    EXPECT_EQ(error.extremes().left_line, 7);
    EXPECT_EQ(error.extremes().overcut_mm, 0);
    EXPECT_EQ(error.extremes().overcut_line, 0);
}

TEST(FormError, between_two_heights_is_between_their_errors) {
    ToothTraces all;
    add(all, 0, 1, 5, [](int) { return 0.0; });
    add(all, 0, 2, 5, [](int) { return -0.01; });
    const FormError error(all, tribo::test::StraightWall());
    EXPECT_NEAR(error.at({0.25, 0, 1.3}).value(), -0.003, 1e-7);
    EXPECT_NEAR(error.at({0.25, 0, 2}).value(), -0.01, 1e-7);
}

TEST(FormError, is_that_of_the_last_pass) {
    ToothTraces all;
    add(all, 0, 1, 5, [](int) { return 0.02; }, 0);
    add(all, 0, 1, 5, [](int) { return -0.03; }, 50);
    const FormError error(all, tribo::test::StraightWall());
    EXPECT_NEAR(error.at({0.25, 0, 1}).value(), -0.03, 1e-7);
}

TEST(FormError, forgets_what_was_cut_away) {
    for (const double off_mm : {0.5, 0.02, 0.005}) {
        ToothTraces all;
        add(all, 0, 1, 5, [](int) { return 0.02; });
        // In front of the finished part.
        for (ToothTrace& t : all.traces) t.from_mm.y = t.inner_mm.y = t.to_mm.y = -off_mm;
        const FormError error(all, tribo::test::StraightWall());
        EXPECT_TRUE(error.empty()) << off_mm;
        EXPECT_EQ(error.extremes().left_mm, 0);
    }
}

TEST(FormError, keeps_the_traces_of_a_bent_path) {
    // Beside its chord, which stands in front of a hollow wall.
    ToothTraces all;
    add(all, 0, 1, 5, [](int) { return 0.02; });
    for (ToothTrace& t : all.traces) t.from_mm.y = t.to_mm.y = -0.01;
    EXPECT_NEAR(FormError(all, tribo::test::StraightWall()).extremes().left_mm, 0.02, 1e-7);
}

// Every other tooth cuts 0.02 mm too deep: on its arcs, 0.1 mm apart from the others, nothing else is left.
TEST(FormError, of_a_short_wave_is_what_its_deepest_teeth_leave) {
    ToothTraces all;
    const auto alternate = [](int n) { return n % 2 == 0 ? -0.02 : 0.02; };
    add(all, 0, 1, 5, alternate, 0);
    add(all, 0.5, 1, 5, [&](int n) { return alternate(n + 1); }, 0.01);
    const FormError error(all, tribo::test::StraightWall());
    const double crest = -0.02 + 0.1 * 0.1 / (2 * 5);
    for (int n = 0; n < 10; ++n) {
        const double x = 0.05 + 0.1 * n;
        EXPECT_NEAR(error.at({x, 0, 1}).value(), n % 2 == 0 ? -0.02 : crest, 1e-6) << n;
    }
    EXPECT_NEAR(error.extremes().wave_mm, 0.1 * 0.1 / (2 * 5), 1e-6);
}

// A long wave stays, but that a tooth on its slope cuts with the side of its arc: R slope^2 / 2 deeper.
TEST(FormError, of_a_long_wave_is_the_wave) {
    ToothTraces all;
    const double w = 2 * 3.14159265358979 / 8;
    const auto height = [&](double x) { return 0.02 * std::sin(w * x); };
    for (int row = 0; row < 40; ++row) {
        const auto value = [&](int n) { return height(0.5 * row + 0.1 * (n + 0.5)); };
        add(all, 0.5 * row, 1, 5, value, 0.01 * row);
    }
    const FormError error(all, tribo::test::StraightWall());
    for (double x = 0.3; x < 19; x += 0.37) {
        const double slope = 0.02 * w * std::cos(w * x);
        EXPECT_NEAR(error.at({x, 0, 1}).value(), height(x) - 5 * slope * slope / 2, 3e-4) << x;
    }
}

TEST(SurfaceWithFormError, stands_off_by_it) {
    ToothTraces all;
    add(all, 0, 1, 5, [](int) { return 0.015; });
    const tribo::test::StraightWall plane;
    const FormError error(all, plane);
    const SurfaceWithFormError bent(plane, error);
    EXPECT_NEAR(bent.distance_mm({0.25, -0.015, 1}), 0, 1e-7);
    EXPECT_NEAR(bent.distance_mm({0.25, 0.01, 1}), -0.025, 1e-7);
    EXPECT_NEAR(bent.distance_mm({5, 0.01, 1}), -0.01, 1e-12);
    // Far from it a lower bound.
    EXPECT_NEAR(bent.distance_mm({0.25, -1, 1}), 1 - 0.015, 1e-7);
}

}  // namespace
}  // namespace tribo::surface
