// SPDX-License-Identifier: MIT
// Scripted taps on a sampled wall, with positions as coarse as an encoder's: the energy that the hand gets
// back beyond what it put in stays above a bound.
#include "haptics/servo/passivity.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "haptics/servo/servo.hpp"
#include "haptics/servo/simulated_hand.hpp"

namespace tribo::haptics {
namespace {

// The promise of docs/servo.md, N mm: the observer's energy never falls below the first, the hand's own below
// the second. A 0.055 mm step (a Touch) on a 2 N/mm wall is worth 0.006 by itself.
constexpr double kBoundNmm = 0.01, kTrueBoundNmm = 0.06;

double rounded_to(double value, double step) {
    return step > 0 ? step * std::round(value / step) : value;
}

struct Tap {
    double lowest_nmm = 0;       // of the observer
    double true_lowest_nmm = 0;  // of the hand's own motion, not rounded
    double deepest_mm = 0;
    double late_swing_mm = 0;  // how far the hand still moves when it should have come to rest
};

// A hand of the default model taps a wall at z = 0, rests on it, and goes away.
Tap tap(double stiffness, double rate_hz, double quantum_mm, bool controlled = true) {
    const double tick_s = 1 / rate_hz;
    SimulatedHand hand(
        Stroke({{0, {0, 0, 2}}, {0.05, {0, 0, -1}}, {0.5, {0, 0, -1}}, {0.6, {0, 0, 3}}, {0.8, {0, 0, 3}}}),
        tick_s);
    PassivityController controller(quantum_mm, 0, tick_s);
    HandReading reading;
    Tap result;
    Vec3 last_sent, last_true;
    double energy = 0, low = 1e9, high = -1e9;
    const int ticks = static_cast<int>(0.8 * rate_hz);
    for (int n = 0; n < ticks; ++n) {
        hand.read(reading);
        const double z = rounded_to(reading.position_mm.z, quantum_mm);
        if (n > 0) energy -= dot(last_sent, reading.position_mm - last_true);
        last_true = reading.position_mm;
        result.true_lowest_nmm = std::min(result.true_lowest_nmm, energy);
        const Vec3 wall{0, 0, z < 0 ? -stiffness * z : 0};
        const Vec3 passive = controller.tick(wall, {0, 0, z}, z < 0);
        last_sent = controlled ? passive : wall;
        hand.write(last_sent);
        result.deepest_mm = std::max(result.deepest_mm, -reading.position_mm.z);
        if (n > ticks * 0.5 && n < ticks * 0.6) {
            low = std::min(low, reading.position_mm.z);
            high = std::max(high, reading.position_mm.z);
        }
    }
    result.lowest_nmm = controller.lowest_energy_nmm();
    result.late_swing_mm = high - low;
    return result;
}

TEST(Passivity, keeps_the_observed_energy_above_its_bound_for_every_tap) {
    for (const double stiffness : {0.1, 0.2, 0.5, 1.0, 2.0}) {
        for (const double rate : {1000.0, 2000.0, 5000.0, 10'000.0}) {
            for (const double quantum : {0.0, 0.01, 0.055}) {
                const Tap t = tap(stiffness, rate, quantum);
                EXPECT_GE(t.lowest_nmm, -kBoundNmm)
                    << stiffness << " N/mm " << rate << " Hz " << quantum << " mm";
                EXPECT_GE(t.true_lowest_nmm, -kTrueBoundNmm)
                    << stiffness << " N/mm " << rate << " Hz " << quantum << " mm";
                EXPECT_GT(t.deepest_mm, 0.05);
                EXPECT_LT(t.late_swing_mm, 0.06)
                    << stiffness << " N/mm " << rate << " Hz " << quantum << " mm";
            }
        }
    }
}

// A sampled wall by itself gives back K T v^2 / 2 or so too much at every tap.
TEST(Passivity, has_something_to_do) {
    EXPECT_LT(tap(2.0, 1000, 0, false).true_lowest_nmm, -0.05);
    EXPECT_GT(tap(2.0, 1000, 0, true).true_lowest_nmm, -0.001);
}

TEST(Passivity, leaves_a_spring_alone_that_gives_back_no_more_than_it_took) {
    PassivityController controller;
    for (int n = 0; n < 1000; ++n) {
        const double z = -1e-3 * n;
        EXPECT_EQ(controller.tick({0, 0, -z}, {0, 0, z}, true), (Vec3{0, 0, -z}));
    }
    EXPECT_NEAR(controller.energy_nmm(), 0.5, 0.002);
    // Sampling has cost a thousandth of a millimetre times the largest force: the last 0.045 mm.
    for (int n = 999; n > 60; --n) {
        const double z = -1e-3 * n;
        EXPECT_EQ(controller.tick({0, 0, -z}, {0, 0, z}, true), (Vec3{0, 0, -z}));
    }
}

TEST(Passivity, gives_nothing_that_it_did_not_take) {
    PassivityController controller;
    // A wall that pushes the hand away without having been pushed: 1 N, 0.1 mm a tick.
    controller.tick({0, 0, 1}, {0, 0, 0}, true);
    for (int n = 1; n < 10; ++n) EXPECT_EQ(controller.tick({0, 0, 1}, {0, 0, 0.1 * n}, true), Vec3{});
    EXPECT_NEAR(controller.lowest_energy_nmm(), -0.1, 1e-12);
}

// A force that a plugin makes from nothing, on a hand that rests: it gives hardly more than one tap may.
TEST(Passivity, lets_a_force_from_nothing_end) {
    for (const double force : {0.1, 0.5, 2.0, 10.0}) {
        for (const double rate : {1000.0, 4000.0}) {
            SimulatedHand hand(Stroke({{0, {0, 0, 30}}, {5, {0, 0, 30}}}), 1 / rate);
            PassivityController controller(0, 0, 1 / rate);
            HandReading reading;
            Vec3 last, sent;
            double given = 0, most = 0;
            for (int n = 0; n < 5 * rate; ++n) {
                hand.read(reading);
                if (n > 0) given += dot(sent, reading.position_mm - last);
                most = std::max(most, given);
                last = reading.position_mm;
                sent = controller.tick({0, 0, force}, reading.position_mm, true);
                hand.write(sent);
            }
            // A tick's motion under the full force comes before the controller sees it.
            EXPECT_LE(most, 0.1 + 0.03 * force) << force << " N at " << rate << " Hz";
        }
    }
}

TEST(Passivity, takes_a_place_that_flickers_between_two_steps_for_one) {
    PassivityController controller(0.05);
    controller.tick({0, 0, 1}, {0, 0, -1}, true);
    for (int n = 0; n < 1000; ++n) controller.tick({0, 0, 1}, {0, 0, n % 2 == 0 ? -1.05 : -1}, true);
    EXPECT_NEAR(controller.energy_nmm(), 0.025, 1e-9);
}

TEST(Passivity, gives_no_credit_for_friction_of_an_earlier_contact) {
    PassivityController controller;
    for (int n = 0; n < 100; ++n) controller.tick({-1, 0, 0}, {0.1 * n, 0, 0}, true);
    EXPECT_GT(controller.energy_nmm(), 5);
    controller.tick({}, {10, 0, 1}, false);
    EXPECT_LE(controller.energy_nmm(), 0);
}

}  // namespace
}  // namespace tribo::haptics
