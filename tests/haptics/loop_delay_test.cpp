// SPDX-License-Identifier: MIT
// Taps on a wall through a loop with delay: arm, line and encoder as they are, the servo as it is shipped.
// What the hand gets back beyond what it put in is measured on the hand itself, and the wall stays a wall.
#include "haptics/servo/loop_delay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "base/draw.hpp"
#include "groove_field.hpp"
#include "haptics/contact/field_contact.hpp"
#include "haptics/servo/servo.hpp"
#include "haptics/servo/simulated_hand.hpp"

namespace tribo::haptics {
namespace {

constexpr double kQuantumMm = 0.01;
constexpr double kBoundNmm = 0.1;  // given to the hand in a press and release

// What is known of the hand itself.
struct Truth {
    double energy_nmm = 0, lowest_nmm = 0;  // put in by the hand; gone below 0: given to it
    double depth_mm = 0, force_n = 0;       // mean over the end of the hold
    double low_mm = 1e9, high_mm = -1e9;    // of the place in that time
    int held_ticks = 0;
};

// A hand with an encoder, and an account of what the motors do to it.
class Arm final : public Device {
  public:
    Arm(Stroke stroke, double tick_s, const HandModel& model, Truth& truth)
        : hand_(std::move(stroke), tick_s, model), truth_(truth) {}
    const DeviceLimits& limits() const override { return limits_; }
    bool has_motors() const override { return false; }
    DeviceState read(HandReading& reading) noexcept override {
        const DeviceState state = hand_.read(reading);
        const Vec3 at = reading.position_mm;
        if (begun_) truth_.energy_nmm -= dot(force_, at - at_);
        truth_.lowest_nmm = std::min(truth_.lowest_nmm, truth_.energy_nmm);
        begun_ = true;
        at_ = at;
        const auto rounded = [](double v) { return kQuantumMm * std::round(v / kQuantumMm); };
        reading.position_mm = {rounded(at.x), rounded(at.y), rounded(at.z)};
        return state;
    }
    DeviceState write(Vec3 force_n) noexcept override {
        force_ = force_n;
        if (hand_.now_s() > 0.55 && hand_.now_s() < 0.6) {
            truth_.depth_mm += -at_.z;
            truth_.force_n += force_n.z;
            truth_.low_mm = std::min(truth_.low_mm, at_.z);
            truth_.high_mm = std::max(truth_.high_mm, at_.z);
            ++truth_.held_ticks;
        }
        return hand_.write(force_n);
    }

  private:
    SimulatedHand hand_;
    Truth& truth_;
    DeviceLimits limits_{"arm", 50, 10, 0.02, kQuantumMm};
    bool begun_ = false;
    Vec3 at_, force_;
};

// A wall at z = 0.
class Flat final : public ForceSource {
  public:
    Flat(double stiffness, double tick_s) : contact_(floor_, options(stiffness, tick_s)) {}
    RenderedForce render(const HandReading& hand, double now_s, double) noexcept override {
        const ProbeContact c = contact_.update(hand.position_mm);
        RenderedForce felt;
        felt.contact_n = c.force_n;
        felt.touching = c.in_contact;
        felt.simulation_s = now_s;
        return felt;
    }

  private:
    static ContactOptions options(double stiffness, double tick_s) {
        ContactOptions o;
        o.stiffness_n_per_mm = stiffness;
        o.tick_s = tick_s;
        return o;
    }
    test::Floor floor_;
    FieldContact contact_;
};

struct Loop {
    double stiffness = 1, rate_hz = 1000, delay_s = 0;  // the delay both ways together
    double told_s = 0;                                  // what the servo is told of it
    double speed = 1;                                   // of the tap, 60 mm/s
    HandModel model;
};

SafetyLimits loose_limits(double tick_s) {
    SafetyLimits limits;
    limits.max_force_n = 50;
    limits.slew_n_per_ms = 1e3;
    limits.ramp_s = 0;
    limits.tick_s = tick_s;
    limits.max_speed_mm_per_s = 1e4;
    return limits;
}

Truth tap(const Loop& loop) {
    const double tick_s = 1 / loop.rate_hz, down_s = 0.05 / loop.speed;
    Truth truth;
    auto arm = std::make_unique<Arm>(
        Stroke({{0, {0, 0, 2}}, {down_s, {0, 0, -1}}, {0.6, {0, 0, -1}}, {0.7, {0, 0, 3}}, {0.9, {0, 0, 3}}}),
        tick_s, loop.model, truth);
    DelayedHand hand(std::move(arm), static_cast<int>(std::round(loop.delay_s / tick_s)));
    const double stiffness = std::min(loop.stiffness, passive_stiffness_n_per_mm(tick_s, loop.told_s));
    Flat wall(stiffness, tick_s);
    Servo servo(hand, wall, loose_limits(tick_s), loop.told_s);
    for (int n = 0; n < static_cast<int>(0.9 * loop.rate_hz); ++n) servo.tick(n * tick_s);
    truth.depth_mm /= truth.held_ticks;
    truth.force_n /= truth.held_ticks;
    return truth;
}

TEST(LoopDelay, a_tap_gives_the_hand_nothing_and_the_wall_stays_a_wall) {
    for (const double stiffness : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
        for (const double rate : {1000.0, 4000.0}) {
            for (const double each_way_ms : {0.0, 0.5, 1.0, 2.0, 3.0}) {
                for (const double speed : {1.0, 5.0}) {
                    Loop loop{stiffness, rate, 2e-3 * each_way_ms, 2e-3 * each_way_ms, speed, {}};
                    const Truth t = tap(loop);
                    char what[120];
                    std::snprintf(what, sizeof what, "%g N/mm, %g Hz, %g ms each way, %g times 60 mm/s",
                                  stiffness, rate, each_way_ms, speed);
                    EXPECT_GE(t.lowest_nmm, -kBoundNmm) << what;
                    const double goal = std::min(
                        stiffness, passive_stiffness_n_per_mm(1 / rate, 2e-3 * each_way_ms, kHandDamping));
                    EXPECT_GE(t.force_n / t.depth_mm, 0.9 * goal) << what;
                    EXPECT_LE(t.force_n / t.depth_mm, 1.15 * goal) << what;
                    EXPECT_LT(t.high_mm - t.low_mm, 0.05) << what;
                }
            }
        }
    }
}

// The same walls where nobody knows of the delay.
TEST(LoopDelay, has_something_to_do) {
    EXPECT_LT(tap({5, 1000, 6e-3, 0, 1, {}}).lowest_nmm, -20 * kBoundNmm);
    EXPECT_LT(tap({1, 1000, 2e-3, 0, 1, {}}).lowest_nmm, -kBoundNmm / 2);
}

TEST(LoopDelay, other_hands_get_nothing_either) {
    for (const double mass_kg : {0.15, 0.25, 0.5}) {
        for (const double damping : {0.005, 0.02}) {
            for (const double stiffness : {0.5, 2.0}) {
                const HandModel hand{mass_kg, 0.3, damping};
                const Truth t = tap({stiffness, 1000, 4e-3, 4e-3, 1, hand});
                EXPECT_GE(t.lowest_nmm, -kBoundNmm)
                    << mass_kg << " kg " << damping << " N s/mm " << stiffness;
            }
        }
    }
}

// Presses that nobody planned: taps, a little way into the air, then a hold. However much the taps cost, the
// wall is there again, and it does not flicker.
TEST(LoopDelay, any_hold_after_any_taps_is_steady) {
    constexpr int kHolds = 200;
    int taps = 0, unsteady = 0, weak = 0;
    for (int n = 0; n < kHolds; ++n) {
        tribo::test::Draw draw(1, static_cast<std::uint64_t>(n));
        const double asked = draw.one_of({0.2, 0.5, 1.0, 2.0, 5.0}), rate = draw.one_of({1000.0, 4000.0});
        const double tick_s = 1 / rate, delay_s = draw.one_of({0.0, 0.0, 1e-3, 3e-3, 6e-3});
        const double speed = draw.between(40, 300), depth = draw.between(0.5, 2);
        std::vector<StrokePoint> way{{0, {0, 0, 5}}, {0.1, {0, 0, 5}}};
        const auto go_to = [&](double z, double mm_per_s) {
            const auto& [t, from] = way.back();
            way.push_back({t + std::abs(from.z - z) / mm_per_s, {0, 0, z}});
        };
        for (int k = static_cast<int>(draw.between(0, 4)); k > 0; --k, ++taps) {
            go_to(-depth, speed);
            go_to(draw.between(0.3, 3), speed);
        }
        go_to(-1.5, draw.between(40, 300));
        way.push_back({way.back().t_s + 0.8, way.back().position_mm});
        const double end = way.back().t_s;
        Truth truth;
        DelayedHand hand(std::make_unique<Arm>(Stroke(way), tick_s, HandModel{}, truth),
                         static_cast<int>(std::round(delay_s / tick_s)));
        const double stiffness = std::min(asked, passive_stiffness_n_per_mm(tick_s, delay_s));
        Flat wall(stiffness, tick_s);
        Servo servo(hand, wall, loose_limits(tick_s), delay_s);
        double least = 1e9, most = 0, depth_mm = 0, force_n = 0;
        for (int k = 0; k < static_cast<int>(end * rate); ++k) {
            const ServoTick tick = servo.tick(k * tick_s);
            if (tick.now_s < end - 0.3) continue;
            least = std::min(least, tick.force_n.z);
            most = std::max(most, tick.force_n.z);
            depth_mm -= tick.position_mm.z;
            force_n += tick.force_n.z;
        }
        // A step of the encoder is felt, with a delay also as a speed to and fro of the predicted hand.
        const double steps = delay_s > 0 ? 1 + 2 * 1.5 * (delay_s + 0.5 * tick_s) / 2e-3 : 1;
        unsteady += most - least < 1.01 * stiffness * kQuantumMm * steps + 0.1 * most ? 0 : 1;
        weak += force_n / depth_mm >= 0.9 * stiffness ? 0 : 1;
        EXPECT_GE(force_n / depth_mm, 0.5 * stiffness) << n;
    }
    EXPECT_GT(taps, kHolds);
    // A hand that came fast may have been given all that it may get before it is at rest.
    EXPECT_LE(unsteady, kHolds / 100);
    EXPECT_LE(weak, kHolds / 100);
}

TEST(LoopDelay, without_delay_the_hand_is_where_it_is) {
    HandPredictor ahead(1e-3, 0);
    for (int n = 0; n < 10; ++n) EXPECT_EQ(ahead.at({1.0 * n, 0, 0}), (Vec3{1.0 * n, 0, 0}));
}

TEST(LoopDelay, a_steady_hand_is_ahead_by_one_and_a_half_times_the_delay_and_half_a_tick) {
    HandPredictor ahead(1e-3, 4e-3);
    EXPECT_EQ(ahead.at({5, 0, 0}), (Vec3{5, 0, 0}));
    for (int n = 1; n < 10; ++n) {
        const double at = 5 + 0.1 * n;  // 0.1 mm a tick
        EXPECT_NEAR(ahead.at({at, 0, 0}).x, at + 0.1 * 1.5 * 4.5, 1e-12) << n;
    }
}

TEST(LoopDelay, damping_bears_less_the_later_the_force_comes) {
    EXPECT_NEAR(passive_stiffness_n_per_mm(1e-3, 0, 0.02), 40, 1e-9);
    EXPECT_NEAR(passive_stiffness_n_per_mm(1e-3, 6e-3, 0.02), 0.02 / 6.5e-3, 1e-12);
}

TEST(LoopDelay, a_delayed_hand_is_the_hand_of_some_ticks_ago) {
    const Stroke stroke({{0, {0, 0, 0}}, {1, {100, 0, 0}}});
    PlaybackHand now(stroke, 1e-3);
    DelayedHand late(std::make_unique<PlaybackHand>(stroke, 1e-3), 7);
    HandReading a, b;
    for (int n = 0; n < 50; ++n) {
        now.read(a);
        late.read(b);
        EXPECT_EQ(b.sequence, a.sequence);
        EXPECT_NEAR(b.position_mm.x, 0.1 * std::max(0, n - 3), 1e-9);
    }
}

}  // namespace
}  // namespace tribo::haptics
