// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using contact::ForceHarmonic;
using contact::ForceSpectrum;
using contact::ToolForce;
using reference::Case;
using reference::Cut;
using reference::difference;
using reference::kPi;
using reference::rad;

ForceSpectrum spectrum_of(const Cut& c, int harmonics) {
    ForceSpectrum out;
    force_spectrum(c.cutter, c.k, c.engagement, c.feed, harmonics, out);
    return out;
}

double largest(const ForceSpectrum& s, double radius) {
    double size = 0;
    for (const ForceHarmonic& h : s.harmonics) size = std::max(size, difference(h, {}, radius));
    return size;
}

// The largest difference from quadrature, as a share of the largest harmonic.
double error_of(const Cut& c, int harmonics, int panels_z, int panels_phi) {
    const ForceSpectrum s = spectrum_of(c, harmonics);
    const double radius = c.cutter.radius_mm();
    double worst = 0;
    for (std::size_t n = 0; n < s.harmonics.size(); ++n) {
        const ForceHarmonic exact = reference::harmonic(c, s.order(n), panels_z, panels_phi);
        worst = std::max(worst, difference(s.harmonics[n], exact, radius));
    }
    return worst / largest(s, radius);
}

TEST(Spectrum, every_harmonic_of_the_reference_cuts_agrees_with_quadrature) {
    for (const Case& v : reference::cases()) {
        const ForceSpectrum s = spectrum_of(v.cut, 16);
        EXPECT_EQ(s.order_step, v.cut.cutter.flutes);
        EXPECT_EQ(s.harmonics.size(), 17u);
        EXPECT_LT(error_of(v.cut, 16, 8, 32), 1e-9) << v.name;
    }
}

RC_GTEST_PROP(Spectrum, agrees_with_quadrature_for_any_cut, ()) {
    Cut c = reference::cases()[0].cut;
    c.cutter.flutes = *rc::gen::inRange(1, 6);
    c.cutter.helix_deg = *rc::gen::inRange(0, 61);
    const int entry = *rc::gen::inRange(0, 175);
    c.engagement.bands[0] = {1, 1 + 0.1 * *rc::gen::inRange(1, 80), rad(entry),
                             rad(*rc::gen::inRange(entry + 1, 181))};
    c.engagement.bands.push_back({0.0, 0.7, rad(30), rad(110)});
    RC_ASSERT(error_of(c, 4, 6, 12) < 1e-9);
}

TEST(Spectrum, one_flute_and_two_meet_the_orders_where_the_phase_cancels) {
    // e^{i q phi} of the load (|q| <= 2) against e^{-i m phi}: m = 1 and 2 are reached with one or two
    // flutes.
    for (const int flutes : {1, 2}) {
        Cut c = reference::cases()[0].cut;
        c.cutter.flutes = flutes;
        EXPECT_LT(error_of(c, 4, 4, 8), 1e-12);
    }
}

TEST(Spectrum, is_continuous_down_to_straight_flutes) {
    Cut c = reference::cases()[1].cut;
    c.cutter.helix_deg = 0;
    const ForceSpectrum straight = spectrum_of(c, 16);
    for (const double helix : {1e-10, 1e-7, 1e-5, 1e-3}) {
        c.cutter.helix_deg = helix;
        const ForceSpectrum nearly = spectrum_of(c, 16);
        for (std::size_t n = 0; n < straight.harmonics.size(); ++n) {
            EXPECT_LT(difference(nearly.harmonics[n], straight.harmonics[n], 6), 1e-10 + 3e4 * rad(helix));
        }
    }
}

TEST(Spectrum, mean_is_real_and_the_mean_over_a_turn) {
    for (const Case& v : reference::cases()) {
        const ForceSpectrum s = spectrum_of(v.cut, 2);
        EXPECT_EQ(s.harmonics[0].x.imag(), 0);
        EXPECT_EQ(s.harmonics[0].torque.imag(), 0);
        const ToolForce mean = mean_force(s);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean.force_n[axis], v.mean[axis], 0.006) << v.name;
    }
}

TEST(Spectrum, sums_to_the_force_over_time_between_jumps) {
    for (const Case& v : reference::cases()) {
        EngagedEdges edges(v.cut.cutter, v.cut.k);
        edges.engage(v.cut.engagement, v.cut.feed);
        ForceSpectrum s;
        force_spectrum(edges, 2000, s);
        for (int i = 0; i < 60; ++i) {
            const double theta = 0.027 * i;
            // Edge terms jump in the load, so that the force has kinks and its harmonics fall as 1 / n^2.
            EXPECT_LT(difference(evaluate(s, theta), force_at(edges, theta), v.cut.cutter.radius_mm()), 0.1)
                << v.name;
        }
    }
}

// Sixteen harmonics of V2 stay within 4.7 N of its 363 N.
TEST(Spectrum, sixteen_harmonics_carry_the_second_reference_cut) {
    const Cut c = reference::cases()[1].cut;
    EngagedEdges edges(c.cutter, c.k);
    edges.engage(c.engagement, c.feed);
    const ForceSpectrum s = spectrum_of(c, 16);
    double worst = 0;
    for (int i = 0; i < 720; ++i) {
        const double theta = 2 * kPi * i / 720;
        const Vec3 d = evaluate(s, theta).force_n - force_at(edges, theta).force_n;
        worst = std::max({worst, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    EXPECT_NEAR(worst, 4.7, 0.1);
}

TEST(Spectrum, evaluation_stops_at_the_highest_order_asked_for) {
    const Cut c = reference::cases()[1].cut;
    const ForceSpectrum s = spectrum_of(c, 16), two = spectrum_of(c, 2);
    for (const double theta : {0.0, 0.4, 2.9}) {
        EXPECT_LT(difference(evaluate(s, theta, 11), evaluate(two, theta), 6), 1e-10);  // orders 4 and 8
        EXPECT_EQ(difference(evaluate(s, theta, 3), mean_force(s), 6), 0);
    }
    EXPECT_EQ(difference(evaluate(ForceSpectrum{}, 1.0), {}, 6), 0);
}

TEST(Spectrum, reuses_the_room_it_is_given) {
    const Cut c = reference::cases()[1].cut;
    EngagedEdges edges(c.cutter, c.k);
    edges.engage(c.engagement, c.feed);
    ForceSpectrum s;
    force_spectrum(edges, 16, s);
    const ForceHarmonic* room = s.harmonics.data();
    force_spectrum(edges, 12, s);
    EXPECT_EQ(s.harmonics.size(), 13u);
    force_spectrum(edges, 16, s);
    EXPECT_EQ(s.harmonics.data(), room);
}

}  // namespace
}  // namespace tribo::milling
