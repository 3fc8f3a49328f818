// SPDX-License-Identifier: MIT
#include "milling/sweep/scallop.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "base/vec3.hpp"

using namespace tribo;
using namespace tribo::milling;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Cutter flat(double diameter) {
    Cutter c;
    c.diameter_mm = diameter;
    return c;
}
Cutter ball(double diameter) {
    Cutter c = flat(diameter);
    c.kind = CutterKind::ball;
    return c;
}
Cutter bull(double diameter, double corner) {
    Cutter c = flat(diameter);
    c.kind = CutterKind::bull;
    c.corner_mm = corner;
    return c;
}

// Chord of the tool at a height above its lowest point, by sampling its surface (corner, bottom circle,
// flank) and projecting it along the feed: an independent, brute computation.
struct Sampled {
    double left = 1e300, right = -1e300;
    double width() const { return right - left; }
};
Sampled sampled_chord(const Cutter& c, Inclination in, double height) {
    const double st = std::sin(in.tilt_rad), ct = std::cos(in.tilt_rad);
    const Vec3 axis{st * std::cos(in.turn_rad), st * std::sin(in.turn_rad), ct};
    const Vec3 a{-std::sin(in.turn_rad), std::cos(in.turn_rad), 0}, b = cross(axis, a);
    const double r = c.corner_radius_mm(), rc = c.radius_mm() - r;
    std::vector<std::vector<Vec3>> rings;
    const auto ring = [&](double radius, double z) {
        std::vector<Vec3> points;
        for (int i = 0; i < 1200; ++i) {
            const double p = 2 * std::numbers::pi * i / 1200;
            points.push_back(z * axis + radius * (std::cos(p) * a + std::sin(p) * b));
        }
        rings.push_back(points);
    };
    const int steps = r > 0 ? 120 : 0;
    for (int i = 0; i <= steps; ++i) {
        const double q = steps > 0 ? 90 * kDeg * i / steps : 0;
        ring(rc + r * std::sin(q), r * (1 - std::cos(q)));
    }
    ring(c.radius_mm(), 10 * c.diameter_mm);
    double lowest = 1e300;
    for (const auto& points : rings)
        for (const Vec3& p : points) lowest = std::min(lowest, p.z);
    // Where the lines between neighbouring rings pass the height.
    Sampled s;
    for (std::size_t k = 0; k < rings.size(); ++k)
        for (std::size_t i = 0; i < rings[k].size(); ++i) {
            const Vec3 p = rings[k][i];
            for (const Vec3& q :
                 {rings[k][(i + 1) % rings[k].size()], rings[k + 1 < rings.size() ? k + 1 : k][i]}) {
                const double from = p.z - lowest - height, to = q.z - lowest - height;
                if ((from < 0) == (to < 0)) continue;
                const double y = p.y + (q.y - p.y) * from / (from - to);
                s.left = std::min(s.left, y);
                s.right = std::max(s.right, y);
            }
        }
    return s;
}

}  // namespace

TEST(Scallop, of_an_inclined_flat_end_mill_matches_the_exact_table) {
    // R 6, sidestep 4, pure lead.
    for (const auto& [deg, height] : {std::pair{2, 0.0120}, {5, 0.0299}, {10, 0.0596}, {20, 0.1174}}) {
        EXPECT_NEAR(scallop_height_mm(flat(12), {deg * kDeg, 0}, 4), height, 5e-5);
    }
}

TEST(Scallop, of_a_ball_is_the_sagitta_of_its_circle_whatever_the_tilt) {
    EXPECT_NEAR(scallop_height_mm(ball(8), {}, 2), 4 - std::sqrt(15.0), 1e-15);
    EXPECT_NEAR(scallop_height_mm(ball(8), {0.3, 0.4}, 2), 4 - std::sqrt(15.0), 1e-15);
    EXPECT_NEAR(scallop_height_mm(ball(8), {}, 1e-6), 1e-12 / 32, 1e-22);
}

TEST(Scallop, an_upright_flat_bottom_leaves_none_and_a_bull_nose_only_beyond_its_flat) {
    EXPECT_EQ(scallop_height_mm(flat(12), {0, 0}, 11), 0);
    EXPECT_NEAR(scallop_height_mm(bull(12, 2), {0, 0}, 7.9), 0, 1e-12);
    EXPECT_NEAR(scallop_height_mm(bull(12, 2), {0, 0}, 10), 2 - std::sqrt(3.0), 1e-12);
}

TEST(Scallop, passes_that_do_not_meet_leave_all_the_material) {
    EXPECT_TRUE(std::isinf(scallop_height_mm(flat(12), {10 * kDeg, 0}, 12.01)));
    EXPECT_TRUE(std::isinf(scallop_height_mm(ball(8), {}, 8.01)));
    EXPECT_TRUE(std::isinf(scallop_height_mm(bull(12, 2), {0.1, 0.1}, 13)));
    EXPECT_TRUE(std::isfinite(scallop_height_mm(flat(12), {10 * kDeg, 0}, 11.99)));
}

TEST(Scallop, widths_equal_those_of_the_sampled_tool) {
    for (const Cutter& c : {flat(12), ball(12), bull(12, 2)})
        for (const Inclination in : {Inclination{5 * kDeg, 0},
                                     {20 * kDeg, 60 * kDeg},
                                     {40 * kDeg, -30 * kDeg},
                                     {60 * kDeg, 80 * kDeg}})
            for (const double height : {0.1, 1.5, 4.0, 8.0}) {
                const Sampled s = sampled_chord(c, in, height);
                EXPECT_NEAR(effective_width_mm(c, in, height), s.width(), 3e-3)
                    << static_cast<int>(c.kind) << ' ' << in.tilt_rad << ' ' << in.turn_rad << ' ' << height;
            }
}

namespace {
double uniform(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}
}  // namespace

RC_GTEST_PROP(ScallopProperty, the_width_at_the_scallop_is_the_sidestep, ()) {
    const double corner = uniform(0.01, 5.99);
    const int kind = *rc::gen::inRange(0, 3);
    const Cutter c = kind == 0 ? flat(12) : kind == 1 ? ball(12) : bull(12, corner);
    const Inclination in{uniform(0.01, 1.3), uniform(-1.5, 1.5)};
    const double sidestep = uniform(0.05, 9);
    const double h = scallop_height_mm(c, in, sidestep);
    RC_PRE(std::isfinite(h));
    RC_ASSERT(std::abs(effective_width_mm(c, in, h) - sidestep) < 1e-9);
    // To second order it is s^2 / (8 rho), rho = r + (R - r) cos^2(turn) / sin(tilt).
    const double r = c.corner_radius_mm(), cosine = std::cos(in.turn_rad);
    const double rho = r + (c.radius_mm() - r) * cosine * cosine / std::sin(in.tilt_rad);
    const double small = 1e-3 * rho;
    if (small < 1e-2)
        RC_ASSERT(std::abs(scallop_height_mm(c, in, small) * 8 * rho / (small * small) - 1) < 2e-2);
}

RC_GTEST_PROP(ScallopProperty, a_bull_nose_lies_between_flat_and_ball, ()) {
    const Inclination in{uniform(0.02, 0.5), 0};
    const double sidestep = uniform(0.1, 5);
    const double none = scallop_height_mm(flat(12), in, sidestep);
    const double all = scallop_height_mm(ball(12), in, sidestep);
    RC_ASSERT(std::abs(scallop_height_mm(bull(12, 1e-9), in, sidestep) - none) < 1e-7);
    RC_ASSERT(std::abs(scallop_height_mm(bull(12, 6 - 1e-9), in, sidestep) - all) < 1e-7);
    const double some = scallop_height_mm(bull(12, uniform(0.1, 5.9)), in, sidestep);
    RC_ASSERT(some > none - 1e-12);
    RC_ASSERT(some < all + 1e-12);
}
