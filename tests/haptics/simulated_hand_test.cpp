// SPDX-License-Identifier: MIT
#include "haptics/servo/simulated_hand.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "haptics/servo/servo.hpp"

namespace tribo::haptics {
namespace {

TEST(Stroke, is_straight_between_its_points_and_still_outside) {
    Stroke stroke({{1, {0, 0, 0}}, {2, {10, 0, 0}}, {4, {10, -4, 0}}});
    EXPECT_EQ(stroke.at(0).position_mm, (Vec3{0, 0, 0}));
    EXPECT_EQ(stroke.at(1.5).position_mm, (Vec3{5, 0, 0}));
    EXPECT_EQ(stroke.at(1.5).velocity_mm_per_s, (Vec3{10, 0, 0}));
    EXPECT_EQ(stroke.at(3).velocity_mm_per_s, (Vec3{0, -2, 0}));
    EXPECT_EQ(stroke.at(1.25).position_mm, (Vec3{2.5, 0, 0}));  // and back
    EXPECT_EQ(stroke.at(9).position_mm, (Vec3{10, -4, 0}));
    EXPECT_EQ(stroke.at(9).velocity_mm_per_s, Vec3{});
}

TEST(PlaybackHand, stands_on_the_stroke_whatever_pushes_it) {
    PlaybackHand hand(Stroke({{0, {}}, {1, {100, 0, 0}}}), 1e-3);
    HandReading reading;
    for (int n = 0; n < 1001; ++n) {
        ASSERT_EQ(hand.read(reading), DeviceState::ready);
        EXPECT_NEAR(reading.position_mm.x, 0.1 * n, 1e-9);
        EXPECT_EQ(reading.sequence, static_cast<std::uint64_t>(n + 1));
        hand.write({-20, 0, 0});
    }
}

// At rest the spring of the hand carries the force: x = F / k. The way there is that of a damped oscillator;
// its energy never rises on the way.
TEST(SimulatedHand, yields_to_a_steady_force_by_force_over_stiffness) {
    const HandModel model;
    SimulatedHand hand(Stroke({{0, {1, 2, 3}}, {100, {1, 2, 3}}}), 1e-3, model);
    HandReading reading;
    for (int n = 0; n < 2000; ++n) {
        hand.read(reading);
        hand.write({0, 0, 0.6});
    }
    EXPECT_NEAR(reading.position_mm.z, 3 + 0.6 / model.stiffness_n_per_mm, 1e-6);
    EXPECT_NEAR(length(reading.velocity_mm_per_s), 0, 1e-6);
    EXPECT_EQ(reading.position_mm.x, 1);
}

TEST(PointerDevice, comes_to_where_it_is_led_and_yields_there) {
    const HandModel model;
    PointerDevice hand({0, 0, 5}, 1e-3, model);
    HandReading reading;
    hand.set_target({100, 0, 5});
    hand.set_target({std::nan(""), 0, 0});
    double fastest = 0;
    for (int n = 0; n < 3000; ++n) {
        ASSERT_EQ(hand.read(reading), DeviceState::ready);
        ASSERT_EQ(reading.sequence, static_cast<std::uint64_t>(n + 1));
        fastest = std::max(fastest, length(reading.velocity_mm_per_s));
        hand.write({0, 0, 0.9});
    }
    EXPECT_NEAR(reading.position_mm.x, 100, 1e-6);
    EXPECT_NEAR(reading.position_mm.z, 5 + 0.9 / model.stiffness_n_per_mm, 1e-6);
    EXPECT_LT(fastest, 1.3 * PointerDevice::kAimMmPerS);  // far below what the servo's guard allows a hand
}

TEST(SimulatedHand, follows_a_stroke_with_no_lag_at_even_speed_and_stays_finite_at_any_tick) {
    for (const double tick_s : {1e-4, 1e-3, 1e-2}) {
        SimulatedHand hand(Stroke({{0, {}}, {10, {500, 0, 0}}}), tick_s);
        HandReading reading;
        for (int n = 0; n < static_cast<int>(5 / tick_s); ++n) {
            hand.read(reading);
            hand.write({});
        }
        EXPECT_NEAR(reading.position_mm.x, 50 * hand.now_s(), 1e-3);
        EXPECT_NEAR(reading.velocity_mm_per_s.x, 50, 1e-3);
    }
}

// Half the wall's stiffness against half the hand's own: they share the way, F = k h / (k + h) depth.
class Wall final : public ForceSource {
  public:
    explicit Wall(double stiffness) : stiffness_(stiffness) {}
    RenderedForce render(const HandReading& hand, double now_s, double) noexcept override {
        RenderedForce felt;
        felt.simulation_s = now_s;
        felt.touching = hand.position_mm.z < 0;
        if (felt.touching) felt.contact_n = {0, 0, -stiffness_ * hand.position_mm.z};
        return felt;
    }

  private:
    double stiffness_;
};

TEST(Servo, lets_hand_and_wall_share_the_way_by_their_stiffness) {
    SimulatedHand hand(Stroke({{0, {0, 0, 5}}, {1, {0, 0, -2}}, {5, {0, 0, -2}}}), 1e-3);
    Wall wall(0.5);
    SafetyLimits limits;
    limits.max_force_n = 20;
    limits.ramp_s = 0;
    Servo servo(hand, wall, limits);
    ServoTick tick;
    for (int n = 0; n < 4000; ++n) tick = servo.tick(n * 1e-3);
    EXPECT_NEAR(tick.force_n.z, 0.5 * 0.3 / 0.8 * 2, 1e-3);
    EXPECT_TRUE(tick.touching);
    EXPECT_EQ(tick.fault, Fault::none);
    EXPECT_EQ(servo.ticks(), 4000U);
}

// A plugin may give a contact force without a touch: it is kept passive, too, and does not buzz.
class PushFromAfar final : public ForceSource {
  public:
    RenderedForce render(const HandReading&, double now_s, double) noexcept override {
        RenderedForce felt;
        felt.simulation_s = now_s;
        felt.contact_n = {0, 0, 1};
        return felt;
    }
};

TEST(Servo, keeps_a_contact_force_without_a_touch_passive) {
    SimulatedHand hand(Stroke({{0, {}}, {2, {}}}), 1e-3);
    PushFromAfar source;
    SafetyLimits limits;
    limits.max_force_n = 20;
    limits.ramp_s = 0;
    Servo servo(hand, source, limits);
    double given_nmm = 0;
    int jumps = 0;
    ServoTick before = servo.tick(0);
    for (int n = 1; n < 2000; ++n) {
        const ServoTick now = servo.tick(n * 1e-3);
        given_nmm += dot(before.force_n, now.position_mm - before.position_mm);
        jumps += distance(now.force_n, before.force_n) > 0.5 ? 1 : 0;
        before = now;
    }
    EXPECT_LE(given_nmm, 0.1 + 0.03);
    EXPECT_LE(jumps, 2);
}

// A device whose readings stop coming.
class FadingHand final : public Device {
  public:
    const DeviceLimits& limits() const override { return kSimulatedLimits; }
    DeviceState read(HandReading& reading) noexcept override {
        if (gone) return DeviceState::gone;
        if (silent) return DeviceState::silent;
        reading.position_mm = {0, 0, broken ? 0.0 / zero_ : -1.0};
        ++reading.sequence;
        return DeviceState::ready;
    }
    DeviceState write(Vec3 force) noexcept override {
        sent = force;
        return answer;
    }
    bool silent = false, gone = false, broken = false;
    DeviceState answer = DeviceState::ready;  // to a force
    Vec3 sent{9, 9, 9};

  private:
    double zero_ = 0;
};

TEST(Servo, sends_zero_within_two_ticks_once_a_device_has_been_silent_for_5_ms) {
    FadingHand hand;
    Wall wall(1);
    Servo servo(hand, wall, {});
    int n = 0;
    for (; n < 1000; ++n) servo.tick(n * 1e-3);
    ASSERT_EQ(hand.sent.z, 1);
    hand.silent = true;
    int ticks = 0;
    while (hand.sent.z > 0 && ticks < 100) {
        servo.tick(n++ * 1e-3);
        ++ticks;
    }
    EXPECT_GE(ticks, 5 + 1);
    EXPECT_LE(ticks, 5 + 2);
    EXPECT_EQ(servo.safety().fault(), Fault::device_silent);
}

TEST(Servo, gives_no_force_for_a_place_that_is_not_a_number) {
    FadingHand hand;
    Wall wall(1);
    Servo servo(hand, wall, {});
    int n = 0;
    for (; n < 1000; ++n) servo.tick(n * 1e-3);
    hand.broken = true;
    servo.tick(n++ * 1e-3);
    EXPECT_EQ(servo.safety().fault(), Fault::not_finite);
    servo.tick(n++ * 1e-3);
    EXPECT_EQ(hand.sent, Vec3{});
    hand.broken = false;
    for (int k = 0; k < 1000; ++k) servo.tick(n++ * 1e-3);
    EXPECT_EQ(hand.sent.z, 1);
}

TEST(Servo, sends_nothing_to_a_device_that_is_gone) {
    FadingHand hand;
    Wall wall(1);
    Servo servo(hand, wall, {});
    int n = 0;
    for (; n < 1000; ++n) servo.tick(n * 1e-3);
    hand.gone = true;
    hand.sent = {7, 7, 7};
    for (int k = 0; k < 20; ++k) servo.tick(n++ * 1e-3);
    EXPECT_FALSE(servo.is_device_connected());
    EXPECT_EQ(hand.sent, (Vec3{7, 7, 7}));
}

// An arm whose motors are off answers and gives no force: once they are on again it may not come at once.
// Nor may the force of a device that only does not take it.
TEST(Servo, comes_back_by_the_ramp_where_a_device_has_not_taken_its_force) {
    for (const DeviceState answer : {DeviceState::refused, DeviceState::silent}) {
        FadingHand hand;
        Wall wall(1);
        Servo servo(hand, wall, {});
        int n = 0;
        for (; n < 1000; ++n) servo.tick(n * 1e-3);
        ASSERT_EQ(hand.sent.z, 1);
        hand.answer = answer;
        for (int k = 0; k < 4; ++k) servo.tick(n++ * 1e-3);
        EXPECT_EQ(hand.sent, Vec3{});
        EXPECT_EQ(servo.safety().fault(), Fault::device_refused);
        hand.answer = DeviceState::ready;
        double last = 0;
        for (int k = 0; k < 1000; ++k) {
            servo.tick(n++ * 1e-3);
            EXPECT_LT(hand.sent.z, last + 0.01);
            last = hand.sent.z;
        }
        EXPECT_EQ(hand.sent.z, 1);
    }
}

TEST(Servo, hears_from_the_answer_to_a_force_that_a_device_is_gone) {
    FadingHand hand;
    Wall wall(1);
    Servo servo(hand, wall, {});
    int n = 0;
    for (; n < 100; ++n) servo.tick(n * 1e-3);
    hand.answer = DeviceState::gone;
    servo.tick(n++ * 1e-3);
    EXPECT_FALSE(servo.is_device_connected());
}

TEST(Servo, gives_a_device_that_never_spoke_no_force) {
    FadingHand hand;
    hand.silent = true;
    Wall wall(1);
    Servo servo(hand, wall, {});
    for (int n = 0; n < 1000; ++n) {
        servo.tick(n * 1e-3);
        EXPECT_EQ(hand.sent, Vec3{});
    }
    EXPECT_EQ(servo.safety().fault(), Fault::device_silent);
}

}  // namespace
}  // namespace tribo::haptics
