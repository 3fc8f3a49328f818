// SPDX-License-Identifier: MIT
#include "milling/force/force.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/engagement/engagement_probe.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using contact::ToolForce;
using reference::Case;
using reference::Cut;
using reference::difference;
using reference::engaged;
using reference::kPi;
using reference::rad;

constexpr double kPublishedSlackN = 0.5;  // of the published extremes, which are those of 1,440 samples

TEST(Force, extremes_of_the_reference_cuts_are_met) {
    for (const Case& v : reference::cases()) {
        const EngagedEdges edges = engaged(v.cut);
        Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        double xy = 0, torque = 0;
        for (int i = 0; i < 1440; ++i) {
            const ToolForce f = force_at(edges, 2 * kPi * i / 1440);
            for (int axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], f.force_n[axis]);
                high[axis] = std::max(high[axis], f.force_n[axis]);
            }
            xy = std::max(xy, std::hypot(f.force_n.x, f.force_n.y));
            torque = std::max(torque, f.torque_nmm);
        }
        EXPECT_NEAR(low.x, v.x[0], kPublishedSlackN) << v.name;
        EXPECT_NEAR(high.x, v.x[1], kPublishedSlackN) << v.name;
        EXPECT_NEAR(low.y, v.y[0], kPublishedSlackN) << v.name;
        EXPECT_NEAR(high.y, v.y[1], kPublishedSlackN) << v.name;
        EXPECT_NEAR(low.z, v.z[0], kPublishedSlackN) << v.name;
        EXPECT_NEAR(high.z, v.z[1], kPublishedSlackN) << v.name;
        EXPECT_NEAR(xy, v.max_xy, kPublishedSlackN) << v.name;
        EXPECT_NEAR(torque * 1e-3, v.max_torque_nm, 0.002) << v.name;
    }
}

TEST(Force, means_of_the_reference_cuts_are_met) {
    for (const Case& v : reference::cases()) {
        const ToolForce mean = mean_force(engaged(v.cut));
        const double scale = length(v.mean);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(mean.force_n[axis], v.mean[axis], 0.006) << v.name;  // as printed, two decimals
        }
        EXPECT_GT(scale, 50);
    }
}

// Altintas 2012, means over a turn as elementary functions of the borders; the slot's are the simplest.
TEST(Force, mean_of_a_slot_is_elementary) {
    const Cut c = reference::cases()[0].cut;
    const double na = 2 * 2.0, f = 0.10;
    const ToolForce mean = mean_force(engaged(c));
    EXPECT_NEAR(mean.force_n.x, -na * (f * c.k.krc / 4 + c.k.kre / kPi), 1e-10);
    EXPECT_NEAR(mean.force_n.y, na * (f * c.k.ktc / 4 + c.k.kte / kPi), 1e-10);
    EXPECT_NEAR(mean.force_n.z, -na * (f * c.k.kac / kPi + c.k.kae / 2), 1e-10);
    EXPECT_NEAR(mean.torque_nmm, na * 6 * (f * c.k.ktc / kPi + c.k.kte / 2), 1e-9);
}

TEST(Force, two_thousand_random_segments_agree_with_simpson) {
    std::uint64_t state = 1;
    const auto uniform = [&](double low, double high) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return low + (high - low) * static_cast<double>(state >> 11) * 0x1p-53;
    };
    double worst = 0;
    for (int n = 0; n < 2000; ++n) {
        const CuttingCoefficients k{uniform(100, 3000), uniform(50, 1500), uniform(0, 500),
                                    uniform(0, 100),    uniform(0, 100),   uniform(0, 10)};
        const double radius = uniform(0.5, 20), feed = uniform(0.001, 0.5), height = uniform(0.01, 30);
        const double low = uniform(-7, 7), high = low + uniform(0, 1) * uniform(0, 3);
        const ToolForce exact = flute_segment_force(k, radius, feed, low, high, height);
        constexpr int kIntervals = 400;
        ToolForce sum;
        double size = 0;
        for (int i = 0; i <= kIntervals; ++i) {
            const double weight = (i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2) / (3.0 * kIntervals);
            const double phi = low + (high - low) * i / kIntervals;
            const double t = k.ktc * feed * std::sin(phi) + k.kte, r = k.krc * feed * std::sin(phi) + k.kre;
            const double a = -(k.kac * feed * std::sin(phi) + k.kae), w = weight * height;
            sum.force_n +=
                w * Vec3{-t * std::cos(phi) - r * std::sin(phi), t * std::sin(phi) - r * std::cos(phi), a};
            sum.torque_nmm += w * radius * t;
            size += w * (std::abs(t) + std::abs(r) + std::abs(a));
        }
        worst = std::max(worst, difference(exact, sum, radius) / size);
    }
    EXPECT_LT(worst, 1e-10);
}

RC_GTEST_PROP(Force, closed_form_over_time_agrees_with_split_quadrature, ()) {
    Cut c = reference::cases()[3].cut;
    c.cutter.flutes = *rc::gen::inRange(1, 7);
    c.cutter.helix_deg = *rc::gen::inRange(0, 61);
    const int entry = *rc::gen::inRange(0, 170);
    const int exit = *rc::gen::inRange(entry + 1, 181);
    const double z0 = 0.1 * *rc::gen::inRange(0, 100);
    c.engagement.bands[0] = {z0, z0 + 0.1 * *rc::gen::inRange(1, 300), rad(entry), rad(exit)};
    const EngagedEdges edges = engaged(c);
    for (int i = 0; i < 20; ++i) {
        const double theta = 0.3217 * i - 2.0;
        const ToolForce exact = reference::force_at(c, theta);
        RC_ASSERT(difference(force_at(edges, theta), exact, c.cutter.radius_mm()) <
                  1e-9 * (1 + reference::size(exact, c.cutter.radius_mm())));
    }
}

RC_GTEST_PROP(Force, bands_that_split_a_cut_add_up_to_it, ()) {
    Cut c = reference::cases()[1].cut;
    c.cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball, CutterKind::bull);
    c.cutter.corner_mm = 2.5;
    const double split = 5.0 * *rc::gen::inRange(1, 100) / 100;
    const EngagedEdges whole = engaged(c);
    const EngagementBand band = c.engagement.bands[0];
    c.engagement.bands = {{0, split, band.entry_rad, band.exit_rad},
                          {split, 5, band.entry_rad, band.exit_rad}};
    // Together they may be merged into one piece again; alone they may not.
    Cut other = c;
    other.engagement.bands = {{0, split, band.entry_rad, band.exit_rad}};
    const EngagedEdges lower = engaged(other);
    other.engagement.bands = {{split, 5, band.entry_rad, band.exit_rad}};
    const EngagedEdges upper = engaged(other);
    const EngagedEdges both = engaged(c);
    for (int i = 0; i < 24; ++i) {
        const double theta = 0.0711 * i;
        ToolForce sum = force_at(lower, theta);
        const ToolForce rest = force_at(upper, theta), one = force_at(whole, theta);
        sum.force_n += rest.force_n;
        sum.torque_nmm += rest.torque_nmm;
        RC_ASSERT(difference(sum, one, 6) < 2e-5 * reference::size(one, 6));
        RC_ASSERT(difference(force_at(both, theta), one, 6) < 2e-5 * reference::size(one, 6));
        if (c.cutter.kind == CutterKind::flat)
            RC_ASSERT(difference(sum, one, 6) < 1e-10 * reference::size(one, 6));
    }
}

TEST(Force, repeats_with_the_tooth) {
    for (const Case& v : reference::cases()) {
        const EngagedEdges edges = engaged(v.cut);
        const double period = 2 * kPi / v.cut.cutter.flutes;
        EXPECT_DOUBLE_EQ(edges.period_rad(), period);
        for (int i = 0; i < 50; ++i) {
            const double theta = 0.0317 * i;
            EXPECT_LT(difference(force_at(edges, theta), force_at(edges, theta + 3 * period), 6), 1e-9);
        }
    }
}

TEST(Force, is_constant_when_the_lag_is_a_whole_number_of_pitches) {
    Cut c = reference::cases()[1].cut;
    // a tan(helix) / R = 2 pi / N
    const double depth = 2 * kPi / 4 * 6 / std::tan(rad(30));
    for (const int pitches : {1, 2}) {
        c.engagement.bands[0].z1_mm = pitches * depth;
        const EngagedEdges edges = engaged(c);
        const ToolForce mean = mean_force(edges);
        for (int i = 0; i < 40; ++i) EXPECT_LT(difference(force_at(edges, 0.05 * i), mean, 6), 1e-9);
        contact::ForceSpectrum spectrum;
        force_spectrum(edges, 16, spectrum);
        for (std::size_t n = 1; n < spectrum.harmonics.size(); ++n) {
            EXPECT_LT(difference(spectrum.harmonics[n], {}, 6), 1e-10);
        }
    }
}

TEST(Force, mean_does_not_depend_on_the_helix) {
    for (const Case& v : reference::cases()) {
        Cut c = v.cut;
        const ToolForce at30 = mean_force(engaged(c));
        for (const double helix : {0.0, 1e-6, 0.5, 15.0, 45.0, 60.0}) {
            c.cutter.helix_deg = helix;
            EXPECT_LT(difference(mean_force(engaged(c)), at30, 6), 1e-10) << v.name << " helix " << helix;
        }
    }
}

TEST(Force, goes_over_into_straight_flutes_without_a_step) {
    Cut c = reference::cases()[1].cut;
    c.cutter.helix_deg = 0;
    const EngagedEdges straight = engaged(c);
    for (const double helix : {1e-12, 1e-9, 1e-6, 1e-4}) {
        c.cutter.helix_deg = helix;
        const EngagedEdges nearly = engaged(c);
        for (int i = 1; i < 30; ++i) {
            const double theta = 0.05 * i;  // away from the jumps at 0 and pi/2
            EXPECT_LT(difference(force_at(nearly, theta), force_at(straight, theta), 6),
                      1e-9 + 400 * rad(helix));
        }
    }
}

TEST(Force, is_nothing_where_the_tool_moves_away) {
    Cut c = reference::cases()[1].cut;
    c.engagement.bands[0].entry_rad = rad(180);
    c.engagement.bands[0].exit_rad = rad(360);
    const EngagedEdges edges = engaged(c);
    EXPECT_TRUE(edges.empty());
    EXPECT_EQ(force_at(edges, 4).torque_nmm, 0);
    contact::ForceSpectrum spectrum;
    force_spectrum(edges, 8, spectrum);
    EXPECT_TRUE(spectrum.empty());
}

TEST(Force, of_a_bottom_that_plunges_is_that_of_radial_edges) {
    Cut c = reference::cases()[1].cut;
    c.engagement.bands.clear();
    c.engagement.bottom = {{0, 6, 0, kPi}};
    c.feed = {0, 0.04};
    const EngagedEdges edges = engaged(c);
    // Four edges 6 mm long, two of them in material: thrust (Krc h + Kre) per mm, torque (Ktc h + Kte) r per
    // mm, and towards +y what pushes the two edges sideways.
    const ToolForce f = force_at(edges, 1.0);
    EXPECT_NEAR(f.force_n.z, 2 * 6 * (168.8 * 0.04 + 26.6), 1e-9);
    EXPECT_NEAR(f.torque_nmm, 2 * 18 * (767.01 * 0.04 + 27.7), 1e-9);
    const ToolForce mean = mean_force(edges);
    EXPECT_NEAR(mean.force_n.y, 4 / (2 * kPi) * 2 * 6 * (767.01 * 0.04 + 27.7), 1e-9);
    EXPECT_NEAR(mean.force_n.x, 4 / (2 * kPi) * 2 * 6 * (222 * 0.04 + 0.7), 1e-9);
    c.feed.down_mm = -0.04;  // climbing: the bottom leaves the material
    EXPECT_TRUE(engaged(c).empty());
}

// Any cutter with any rigid motion, against quadrature of the definition. Pieces judge where a chip begins in
// their middle, so both stay a little apart.
RC_GTEST_PROP(Force, of_any_rigid_motion_is_its_definition, ()) {
    Cut c = reference::cases()[static_cast<std::size_t>(*rc::gen::inRange(0, 4))].cut;
    c.cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball, CutterKind::bull);
    c.cutter.corner_mm = 2.5;
    c.cutter.helix_deg = *rc::gen::element(-40.0, 0.0, 20.0, 45.0);
    const auto part = [] { return 0.01 * *rc::gen::inRange(-100, 101); };
    c.feed = {0.1 * std::abs(part()), 0.05 * part(), 0.02 * part(), 0.02 * part()};
    const double radius = c.cutter.radius_mm();
    const double entry = 3 + 3 * part(), exit = std::min(2 * kPi, entry + 0.2 + 2 * std::abs(part()));
    c.engagement.bands = {{0.5 + 0.4 * part(), 4 + 2 * part(), entry, exit}};
    if (c.cutter.kind != CutterKind::ball) c.engagement.bottom = {{0.2 * radius, 0.5 * radius, entry, exit}};
    const EngagedEdges edges = engaged(c);
    const contact::ForceHarmonic exact = reference::harmonic(c, 0, 40, 4);
    const ToolForce expected = {{exact.x.real(), exact.y.real(), exact.z.real()}, exact.torque.real()};
    const double size = reference::size(expected, radius);
    // Without edge coefficients the mean torque is ktc times what the chips take out of the metal.
    const double teeth = c.cutter.flutes / (2 * kPi);
    const double shear = mean_force(edges).torque_nmm - edges.mean_edge_torque_nmm();
    const double chips = c.k.ktc * teeth * chip_mm3(c.cutter, c.engagement, c.feed);
    Cut around = c;
    for (auto& band : around.engagement.bands) band.entry_rad = 0, band.exit_rad = 2 * kPi;
    for (auto& band : around.engagement.bottom) band.entry_rad = 0, band.exit_rad = 2 * kPi;
    const double most = c.k.ktc * teeth * chip_mm3(c.cutter, around.engagement, c.feed);
    RC_ASSERT(std::abs(shear - chips) < 0.01 * (chips + most) + 0.1);
    // A sliver of a window is judged as well as the whole turn. A piece whose chip vanishes in its middle is
    // left out whole, with the edge force of two hundredths of a millimetre of edge.
    const double whole = reference::size(mean_force(engaged(around)), radius);
    const double edge_n = 0.02 * length(Vec3{c.k.kte, c.k.kre, c.k.kae});
    RC_ASSERT(difference(mean_force(edges), expected, radius) < 0.01 * (size + whole) + edge_n);
}

TEST(Force, pulls_a_right_hand_tool_out_of_its_holder_and_pushes_a_left_hand_one) {
    Cut c = reference::cases()[0].cut;
    const ToolForce right = mean_force(engaged(c));
    c.cutter.helix_deg = -c.cutter.helix_deg;
    const ToolForce left = mean_force(engaged(c));
    EXPECT_LT(right.force_n.z, -20);
    EXPECT_NEAR(left.force_n.z, -right.force_n.z, 1e-9);
    EXPECT_NEAR(left.force_n.x, right.force_n.x, 1e-9);
    EXPECT_NEAR(left.torque_nmm, right.torque_nmm, 1e-9);
}

}  // namespace
}  // namespace tribo::milling
