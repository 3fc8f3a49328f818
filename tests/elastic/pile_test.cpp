// SPDX-License-Identifier: MIT
// Hairs that turn under a finger and rise again.
#include "elastic/pile.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace tribo::elastic {
namespace {

constexpr SheetSize kSheet{240, 160, 0.5};  // 120 x 80 mm, a hair every 2 mm

ContactEllipse finger(double x_mm, double y_mm) {
    ContactEllipse c;
    c.x_mm = x_mm;
    c.y_mm = y_mm;
    c.force_n = 1;
    return c;
}

struct Lean {
    float x, y;
};
Lean at(const Pile& pile, double x_mm, double y_mm) {
    const int i = static_cast<int>(x_mm / 2), j = static_cast<int>(y_mm / 2);
    const float* lean = pile.leans().data() + 2 * (j * pile.width() + i);
    return {lean[0], lean[1]};
}

TEST(Pile, leans_along_the_way_of_the_finger_and_nowhere_else) {
    Pile pile(kSheet);
    pile.brush(finger(91, 41), 60, 0);
    for (double x = 41; x < 85; x += 2) {
        EXPECT_GT(at(pile, x, 41).x, 0.8) << x;
        EXPECT_LT(at(pile, x, 41).x, 1) << x;
        EXPECT_EQ(at(pile, x, 41).y, 0) << x;
    }
    for (double x = 1; x < 120; x += 2) {
        EXPECT_EQ(at(pile, x, 33).x, 0) << x;
        EXPECT_EQ(at(pile, x, 49).x, 0) << x;
    }
    EXPECT_EQ(at(pile, 21, 41).x, 0);
    EXPECT_EQ(at(pile, 101, 41).x, 0);
}

TEST(Pile, turns_when_it_is_brushed_the_other_way) {
    Pile pile(kSheet);
    pile.brush(finger(91, 41), 60, 0);
    pile.brush(finger(61, 21), 0, -60);
    EXPECT_LT(at(pile, 61, 41).y, -0.8);
    EXPECT_LT(std::abs(at(pile, 61, 41).x), 0.2);
    EXPECT_GT(at(pile, 81, 41).x, 0.8);
}

// Frames of a slow and a fast screen see the same way in other pieces.
TEST(Pile, hardly_depends_on_the_frame_rate) {
    Pile slow(kSheet), fast(kSheet);
    slow.brush(finger(90, 40), 60, 0);
    for (int n = 1; n <= 60; ++n) fast.brush(finger(30 + n, 40), 1, 0);
    for (double y = 35; y < 46; y += 2) EXPECT_NEAR(at(slow, 61, y).x, at(fast, 61, y).x, 0.1) << y;
}

TEST(Pile, rises_at_one_speed_to_exact_rest) {
    Pile pile(kSheet);
    EXPECT_FALSE(pile.rise(1));
    pile.brush(finger(90, 40), 60, 0);
    const float before = at(pile, 61, 41).x;
    for (int n = 0; n < 10; ++n) EXPECT_TRUE(pile.rise(0.5));
    EXPECT_NEAR(at(pile, 61, 41).x, before - 0.25, 1e-5);
    while (pile.rise(0.5)) {
    }
    EXPECT_TRUE(std::ranges::all_of(pile.leans(), [](float lean) { return lean == 0; }));
}

TEST(Pile, takes_any_contact_and_any_way) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Pile pile({3, 5, 0.1});
    EXPECT_EQ(pile.leans().size(), 2);
    for (const double x : {-1e6, 0.0, 1e6, kNan}) {
        for (const double way : {0.0, 1e-300, 1e6, 1e300, kNan}) {
            pile.brush(finger(x, x), way, -way);
            pile.rise(way);
        }
    }
    for (const float lean : pile.leans()) EXPECT_LE(std::abs(lean), 1);
}

}  // namespace
}  // namespace tribo::elastic
