// SPDX-License-Identifier: MIT
// Rounded bottoms: ball and bull-nose cutters, moving across, plunging and climbing.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using contact::ForceSpectrum;
using contact::ToolForce;
using reference::Cut;
using reference::difference;
using reference::engaged;
using reference::kPi;
using reference::rad;

Cut ball_cut() {
    Cut c = reference::cases()[1].cut;
    c.cutter.kind = CutterKind::ball;
    c.cutter.diameter_mm = 10;
    c.engagement.bands = {{0, 1.2, rad(0), rad(180)}};
    return c;
}

// 4,000 slices of equal kappa, each cut at the rotation of its middle.
ToolForce sliced(const Cut& c, double theta) {
    constexpr int kSlices = 4000;
    const milling::EngagementBand& band = c.engagement.bands[0];
    const double r = c.cutter.corner_radius_mm(),
                 lag_per_mm = std::tan(rad(c.cutter.helix_deg)) / c.cutter.radius_mm();
    const double from = std::acos(1 - band.z0_mm / r), to = std::acos(1 - band.z1_mm / r);
    ToolForce sum;
    for (int j = 0; j < c.cutter.flutes; ++j) {
        for (int i = 0; i < kSlices; ++i) {
            const double kappa = from + (to - from) * (i + 0.5) / kSlices, z = r * (1 - std::cos(kappa));
            double phi = std::fmod(theta + 2 * kPi * j / c.cutter.flutes - lag_per_mm * z, 2 * kPi);
            if (phi < 0) phi += 2 * kPi;
            if (phi < band.entry_rad || phi > band.exit_rad) continue;
            const reference::Place place{c.cutter.radius_mm() - r + r * std::sin(kappa), z, kappa};
            const ToolForce f = reference::per_mm(c, phi, place, j, lag_per_mm * z, reference::plain_chip);
            sum.force_n += (to - from) * r / kSlices * f.force_n;
            sum.torque_nmm += (to - from) * r / kSlices * f.torque_nmm;
        }
    }
    return sum;
}

TEST(BallForce, agrees_with_four_thousand_slices) {
    Cut c = ball_cut();
    for (const double depth : {0.05, 1.2, 5.0}) {
        c.engagement.bands[0] = {0, depth, rad(20), rad(150)};
        const EngagedEdges edges = engaged(c);
        for (int i = 0; i < 60; ++i) {
            const double theta = 0.1046 * i, size = 1 + reference::size(sliced(c, theta), 5);
            EXPECT_LT(difference(force_at(edges, theta), sliced(c, theta), 5), 2e-3 * size)
                << depth << " " << theta;
        }
    }
}

RC_GTEST_PROP(BallForce, over_time_agrees_with_split_quadrature, ()) {
    Cut c = ball_cut();
    c.cutter.kind = *rc::gen::element(CutterKind::ball, CutterKind::bull);
    c.cutter.corner_mm = 2;
    c.cutter.helix_deg = *rc::gen::element(0.0, 20.0, 30.0, 45.0);
    const double z0 = 0.1 * *rc::gen::inRange(0, 20);
    const int entry = *rc::gen::inRange(0, 120);
    c.engagement.bands[0] = {z0, z0 + 0.05 * *rc::gen::inRange(1, 60), rad(entry),
                             rad(*rc::gen::inRange(entry + 10, 181))};
    const EngagedEdges edges = engaged(c);
    for (int i = 0; i < 12; ++i) {
        const double theta = 0.0137 + 0.5217 * i;  // away from the jumps of straight flutes
        const ToolForce exact = reference::force_at(c, theta, 8);
        RC_ASSERT(difference(force_at(edges, theta), exact, 5) < 1e-5 * (1 + reference::size(exact, 5)));
    }
}

TEST(BallForce, spectrum_agrees_with_quadrature) {
    Cut c = ball_cut();
    for (const double depth : {0.1, 1.2, 6.0}) {  // 6: a millimetre of the cylinder too
        c.engagement.bands[0] = {0, depth, rad(30), rad(140)};
        ForceSpectrum s;
        force_spectrum(c.cutter, c.k, c.engagement, c.feed, 12, s);
        double size = 0, worst = 0;
        for (std::size_t n = 0; n < s.harmonics.size(); ++n) {
            size = std::max(size, difference(s.harmonics[n], {}, 5));
            worst = std::max(worst, difference(s.harmonics[n], reference::harmonic(c, s.order(n), 8, 16), 5));
        }
        EXPECT_LT(worst, 1e-6 * size) << depth;
    }
}

// Lee and Altintas 1996: h db = f sin(phi) dz, so a ball's tangential chip area is the cylinder's.
TEST(BallForce, has_the_tangential_shear_force_of_a_flat_end_mill) {
    Cut ball = ball_cut(), flat = ball;
    for (Cut* c : {&ball, &flat}) c->k = {.ktc = 800};
    flat.cutter.kind = CutterKind::flat;
    const EngagedEdges of_ball = engaged(ball), of_flat = engaged(flat);
    for (int i = 0; i < 30; ++i) {
        const ToolForce a = force_at(of_ball, 0.05 * i), b = force_at(of_flat, 0.05 * i);
        EXPECT_NEAR(a.force_n.x, b.force_n.x, 1e-6);
        EXPECT_NEAR(a.force_n.y, b.force_n.y, 1e-6);
    }
}

TEST(BallForce, goes_over_into_the_cylinder_for_a_small_corner) {
    Cut bull = reference::cases()[1].cut;
    const EngagedEdges flat = engaged(bull);
    bull.cutter.kind = CutterKind::bull;
    bull.cutter.corner_mm = 1e-4;
    const EngagedEdges nearly = engaged(bull);
    for (int i = 0; i < 30; ++i) {
        EXPECT_LT(difference(force_at(nearly, 0.05 * i), force_at(flat, 0.05 * i), 6), 0.02);
    }
}

// Plunging and climbing move the border of the cut along the profile, which pieces follow in steps.
TEST(BallForce, follows_a_ramp_down_and_up) {
    Cut c = ball_cut();
    for (const double axial : {0.05, 0.01, -0.01}) {
        c.feed.down_mm = axial;
        c.engagement.bands[0] = {0, 3, 0, 2 * kPi};
        const EngagedEdges edges = engaged(c);
        const ToolForce mean = mean_force(edges);
        const contact::ForceHarmonic exact = reference::harmonic(c, 0, 24, 4);
        const ToolForce expected = {{exact.x.real(), exact.y.real(), exact.z.real()}, exact.torque.real()};
        EXPECT_LT(difference(mean, expected, 5), 2e-3 * reference::size(expected, 5)) << axial;
    }
}

// Straight down everything cuts alike all around: no force across the axis.
TEST(BallForce, of_a_plunge_is_along_the_axis) {
    Cut c = ball_cut();
    c.feed = {0, 0.05};
    c.engagement.bands[0] = {0, 2, 0, 2 * kPi};
    const EngagedEdges edges = engaged(c);
    const ToolForce f = force_at(edges, 0.3);
    EXPECT_NEAR(f.force_n.x, 0, 1e-9);
    EXPECT_NEAR(f.force_n.y, 0, 1e-9);
    EXPECT_GT(f.force_n.z, 100);
    EXPECT_GT(f.torque_nmm, 100);
}

}  // namespace
}  // namespace tribo::milling
