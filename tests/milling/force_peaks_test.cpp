// SPDX-License-Identifier: MIT
#include "milling/force/force_peaks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using contact::ToolForce;
using reference::Case;
using reference::Cut;
using reference::kPi;
using reference::rad;

double extreme(double a, double b) {
    return std::abs(b) > std::abs(a) ? b : a;
}

// By brute force: `samples` spindle angles, and both sides of every angle at which an end of a piece meets a
// border of its window.
ForcePeaks sampled(const EngagedEdges& edges, int samples) {
    ForcePeaks p;
    const auto look = [&](double theta) {
        const ToolForce f = force_at(edges, theta);
        p.peak_n = {extreme(p.peak_n.x, f.force_n.x), extreme(p.peak_n.y, f.force_n.y),
                    extreme(p.peak_n.z, f.force_n.z)};
        p.peak_xy_n = std::max(p.peak_xy_n, std::hypot(f.force_n.x, f.force_n.y));
        p.peak_force_n = std::max(p.peak_force_n, length(f.force_n));
        p.peak_torque_nmm = extreme(p.peak_torque_nmm, f.torque_nmm);
    };
    for (int i = 0; i < samples; ++i) look(2 * kPi * (i + 0.5) / samples);
    for (const EngagedEdge& e : edges.edges()) {
        for (const double lag : {e.lag0_rad, e.lag1_rad}) {
            for (const double border : {e.entry_rad, e.exit_rad}) {
                for (const double side : {-1e-7, 1e-7}) look(border + lag - e.phase_rad + side);
            }
        }
    }
    return p;
}

double difference(const ForcePeaks& a, const ForcePeaks& b, double radius) {
    double worst = std::max(std::abs(a.peak_xy_n - b.peak_xy_n), std::abs(a.peak_force_n - b.peak_force_n));
    for (int axis = 0; axis < 3; ++axis) {
        // Which of two extremes of nearly one size wins is left to the samples.
        worst = std::max(worst, std::abs(std::abs(a.peak_n[axis]) - std::abs(b.peak_n[axis])));
    }
    return std::max(worst, std::abs(a.peak_torque_nmm - b.peak_torque_nmm) / radius);
}

TEST(Peaks, of_the_reference_cuts_are_good_to_a_tenth_of_a_newton) {
    for (const Case& v : reference::cases()) {
        ForceModel model(v.cut.cutter, v.cut.k);
        model.engage(v.cut.engagement, v.cut.feed);
        const ForcePeaks p = model.peaks(), dense = sampled(model.edges(), 200000);
        EXPECT_LT(difference(p, dense, v.cut.cutter.radius_mm()), 0.1) << v.name;
        EXPECT_NEAR(p.peak_xy_n, v.max_xy, 0.5) << v.name;
        EXPECT_NEAR(p.peak_torque_nmm * 1e-3, v.max_torque_nm, 0.003) << v.name;
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(p.mean_n[axis], v.mean[axis], 0.006) << v.name;
        EXPECT_NEAR(p.peak_n.x, extreme(v.x[0], v.x[1]), 0.5) << v.name;
        EXPECT_NEAR(p.peak_n.y, extreme(v.y[0], v.y[1]), 0.5) << v.name;
        EXPECT_NEAR(p.peak_n.z, extreme(v.z[0], v.z[1]), 0.5) << v.name;
    }
}

TEST(Peaks, are_kept_when_a_model_is_used_again) {
    const std::vector<Case> cases = reference::cases();
    ForceModel model(cases[1].cut.cutter, cases[1].cut.k);
    model.engage(cases[2].cut.engagement, cases[2].cut.feed);
    (void)model.peaks();
    model.engage(cases[1].cut.engagement, cases[1].cut.feed);
    const ForcePeaks again = model.peaks();
    ForceModel fresh(cases[1].cut.cutter, cases[1].cut.k);
    fresh.engage(cases[1].cut.engagement, cases[1].cut.feed);
    const ForcePeaks once = fresh.peaks();
    EXPECT_EQ(again.peak_n, once.peak_n);
    EXPECT_EQ(again.peak_torque_nmm, once.peak_torque_nmm);
}

RC_GTEST_PROP(Peaks, agree_with_dense_samples_for_any_cutter_and_cut, ()) {
    Cut c = reference::cases()[1].cut;
    c.cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball, CutterKind::bull);
    c.cutter.corner_mm = 2;
    c.cutter.flutes = *rc::gen::inRange(1, 6);
    c.cutter.helix_deg = *rc::gen::element(0.0, 1e-9, 5.0, 15.0, 30.0, 45.0, -20.0);
    c.cutter.runout_mm = *rc::gen::element(0.0, 0.0, 0.01);
    c.engagement.bands.clear();
    double z = 0;
    for (int bands = *rc::gen::inRange(1, 5); bands > 0; --bands) {
        const int entry = *rc::gen::inRange(0, 150);
        const double z1 = z + 0.1 * *rc::gen::inRange(1, 20);
        c.engagement.bands.push_back({z, z1, rad(entry), rad(*rc::gen::inRange(entry + 5, 181))});
        z = z1;
    }
    c.feed = {0.08, *rc::gen::element(0.0, 0.02), *rc::gen::element(0.0, 0.01, -0.02),
              *rc::gen::element(0.0, 0.01, -0.005)};
    c.engagement.bottom = {{0, 4, 1, 2.5}};
    ForceModel model(c.cutter, c.k);
    model.engage(c.engagement, c.feed);
    const ForcePeaks dense = sampled(model.edges(), 20000);
    RC_ASSERT(difference(model.peaks(), dense, 6) < 2e-3 * (1 + dense.peak_force_n));
}

TEST(Peaks, of_nothing_are_nothing) {
    const Cut c = reference::cases()[0].cut;
    ForceModel model(c.cutter, c.k);
    const ForcePeaks p = model.peaks();
    EXPECT_EQ(p.peak_force_n, 0);
    EXPECT_EQ(p.mean_torque_nmm, 0);
}

// A bottom that plunges alone gives one constant thrust.
TEST(Peaks, of_a_plunge_are_its_mean) {
    Cut c = reference::cases()[1].cut;
    c.engagement.bands.clear();
    c.engagement.bottom = {{0, 6, 0, 2 * reference::kPi}};
    c.feed = {0, 0.05};
    ForceModel plunge(c.cutter, c.k);
    plunge.engage(c.engagement, c.feed);
    const ForcePeaks p = plunge.peaks();
    EXPECT_GT(p.peak_n.z, 100);
    EXPECT_DOUBLE_EQ(p.peak_n.z, p.mean_n.z);
    EXPECT_DOUBLE_EQ(p.peak_torque_nmm, p.mean_torque_nmm);
}

}  // namespace
}  // namespace tribo::milling
