// SPDX-License-Identifier: MIT
// Teeth that do not cut alike: run-out and unequal pitch.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using contact::ForceHarmonic;
using contact::ForceSpectrum;
using contact::ToolForce;
using reference::Cut;
using reference::difference;
using reference::engaged;
using reference::kPi;
using reference::rad;

Cut random_uneven(CutterKind kind) {
    Cut c = reference::cases()[1].cut;
    c.cutter.kind = kind;
    c.cutter.corner_mm = 2;
    c.cutter.runout_mm = 0.001 * *rc::gen::inRange(0, 80);  // up to more than the feed: teeth that miss
    c.cutter.runout_deg = *rc::gen::inRange(0, 360);
    if (*rc::gen::arbitrary<bool>()) c.cutter.pitch_deg = {83, 97, 85, 95};
    return c;
}

// The chips of all teeth at one rotation and height add up to the feed per turn along the normal.
RC_GTEST_PROP(Runout, chips_of_all_teeth_add_up_to_the_feed, ()) {
    Cut c = random_uneven(CutterKind::flat);
    c.engagement.bands[0] = {0, 5, 0, kPi};
    const EngagedEdges edges = engaged(c);
    for (const double z : {0.01, 1.3, 2.5, 4.9}) {
        for (double phi = 0.03; phi < kPi; phi += 0.11) {
            double sum = 0;
            for (const EngagedEdge& e : edges.edges()) {
                if (z < e.z0_mm || z >= e.z1_mm || phi < e.entry_rad || phi >= e.exit_rad) continue;
                const double h = e.chip.travel.across_mm * std::sin(phi) + e.chip.offset_mm;
                RC_ASSERT(h > -1e-12);
                sum += h;
            }
            if (edges.uniform()) sum *= 4;  // each piece stands for all teeth
            RC_ASSERT(std::abs(sum - 4 * 0.05 * std::sin(phi)) < 1e-12);
        }
    }
}

// Without edge terms force is chip times coefficient, so the mean must not feel run-out or pitch.
RC_GTEST_PROP(Runout, keeps_the_mean_of_the_shear_force, ()) {
    Cut c = random_uneven(*rc::gen::element(CutterKind::flat, CutterKind::ball, CutterKind::bull));
    c.k.kte = c.k.kre = c.k.kae = 0;
    Cut even = c;
    even.cutter.runout_mm = 0;
    even.cutter.pitch_deg.clear();
    const ToolForce mean = mean_force(engaged(c)), expected = mean_force(engaged(even));
    RC_ASSERT(difference(mean, expected, 6) < 1e-6 * reference::size(expected, 6));
}

// Held against chips looked up tooth by tooth in the history, run-out varying along the helix.
TEST(Runout, force_over_time_agrees_with_the_history_of_the_teeth) {
    Cut c = reference::cases()[2].cut;
    c.cutter.runout_deg = 40;
    for (const double runout : {0.004, 0.02, 0.06}) {
        for (const bool uneven : {false, true}) {
            c.cutter.runout_mm = runout;
            c.cutter.pitch_deg = uneven ? std::vector<double>{80, 95, 88, 97} : std::vector<double>{};
            const EngagedEdges edges = engaged(c);
            double worst = 0, size = 0;
            for (int i = 0; i < 200; ++i) {
                const double theta = 0.0314 * i;
                const ToolForce exact = reference::force_at(c, theta, 16, reference::worn_chip);
                worst = std::max(worst, difference(force_at(edges, theta), exact, 6));
                size = std::max(size, reference::size(exact, 6));
            }
            // Over a cell of lag run-out counts as constant.
            EXPECT_LT(worst, 0.03 * size) << runout << uneven;
        }
    }
}

TEST(Runout, straight_flutes_have_no_cells_to_err_by) {
    Cut c = reference::cases()[2].cut;
    c.cutter.helix_deg = 0;
    c.cutter.runout_mm = 0.02;
    c.cutter.runout_deg = 40;
    c.cutter.pitch_deg = {80, 95, 88, 97};
    const EngagedEdges edges = engaged(c);
    for (int i = 0; i < 200; ++i) {
        const double theta = 0.0314 * i + 1e-3;
        const ToolForce exact = reference::force_at(c, theta, 1, reference::worn_chip);
        EXPECT_LT(difference(force_at(edges, theta), exact, 6), 1e-9) << theta;
    }
}

TEST(Runout, spectrum_agrees_with_quadrature_at_every_order) {
    Cut c = reference::cases()[2].cut;
    c.cutter.helix_deg = 0;  // the cells are exact
    c.cutter.runout_mm = 0.02;
    c.cutter.runout_deg = 40;
    c.cutter.pitch_deg = {80, 95, 88, 97};
    ForceSpectrum s;
    force_spectrum(c.cutter, c.k, c.engagement, c.feed, 3, s);
    EXPECT_EQ(s.order_step, 1);
    ASSERT_EQ(s.harmonics.size(), 13u);
    double size = 0, worst = 0;
    for (int m = 0; m <= 12; ++m) {
        const ForceHarmonic& h = s.harmonics[static_cast<std::size_t>(m)];
        size = std::max(size, difference(h, {}, 6));
        // The chip law has kinks that the reference does not split at: many panels.
        worst = std::max(worst, difference(h, reference::harmonic(c, m, 1, 400, reference::worn_chip), 6));
    }
    EXPECT_LT(worst, 1e-6 * size);
}

RC_GTEST_PROP(Runout, spectrum_sums_to_the_force_over_time, ()) {
    const Cut c = random_uneven(*rc::gen::element(CutterKind::flat, CutterKind::ball));
    const EngagedEdges edges = engaged(c);
    ForceSpectrum s;
    force_spectrum(edges, 150, s);
    double size = 0;
    for (const ForceHarmonic& h : s.harmonics) size = std::max(size, difference(h, {}, 6));
    for (int i = 0; i < 20; ++i) {
        const double theta = 0.317 * i;
        RC_ASSERT(difference(evaluate(s, theta), force_at(edges, theta), 6) < 0.04 * size);
    }
}

TEST(Runout, brings_lines_of_rotation_into_the_spectrum) {
    Cut c = reference::cases()[2].cut;
    c.cutter.runout_mm = 0.01;
    ForceSpectrum s, even;
    force_spectrum(c.cutter, c.k, c.engagement, c.feed, 2, s);
    c.cutter.runout_mm = 0;
    force_spectrum(c.cutter, c.k, c.engagement, c.feed, 2, even);
    EXPECT_GT(std::abs(s.harmonics[1].y), 1);
    EXPECT_EQ(even.order_step, 4);
}

TEST(Runout, pitch_given_as_even_is_even) {
    Cut c = reference::cases()[1].cut;
    const EngagedEdges plain = engaged(c);
    c.cutter.pitch_deg = {90, 90, 90, 90};
    const EngagedEdges even = engaged(c);
    EXPECT_TRUE(even.uniform());
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(difference(force_at(even, 0.1 * i), force_at(plain, 0.1 * i), 6), 0);
}

TEST(Runout, pitch_that_is_all_but_even_gives_all_but_the_even_force) {
    Cut c = reference::cases()[1].cut;
    const EngagedEdges plain = engaged(c);
    ForceSpectrum even;
    force_spectrum(plain, 4, even);
    c.cutter.pitch_deg = {90 + 1e-5, 90, 90, 90 - 1e-5};
    const EngagedEdges nearly = engaged(c);
    ASSERT_FALSE(nearly.uniform());
    for (int i = 0; i < 40; ++i) {
        const double theta = 0.0771 * i;
        EXPECT_LT(difference(force_at(nearly, theta), force_at(plain, theta), 6), 2e-3);
    }
    ForceSpectrum s;
    force_spectrum(nearly, 4, s);
    for (std::size_t m = 0; m < s.harmonics.size(); ++m) {
        const ForceHarmonic expected = m % 4 == 0 ? even.harmonics[m / 4] : ForceHarmonic{};
        EXPECT_LT(difference(s.harmonics[m], expected, 6), 2e-3) << m;
    }
}

}  // namespace
}  // namespace tribo::milling
