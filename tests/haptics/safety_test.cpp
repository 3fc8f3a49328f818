// SPDX-License-Identifier: MIT
// Fault injection: each fault of docs/servo.md, with the outcome and the number of ticks that it promises.
#include "haptics/servo/safety.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

namespace tribo::haptics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

class Loop {
  public:
    explicit Loop(SafetyLimits limits = {}) : guard(limits) {}

    // A tick after the last one, with everything as it should be but what `change` alters.
    template <class Change>
    Vec3 tick(Change change) {
        now_s += guard.limits().tick_s;
        SafetyInput in;
        in.now_s = in.device_s = in.simulation_s = now_s;
        in.velocity_mm_per_s = velocity;
        in.wanted_n = wanted;
        change(in);
        return force = guard.tick(in);
    }
    Vec3 tick() {
        return tick([](SafetyInput&) {});
    }
    void run(int ticks) {
        for (int n = 0; n < ticks; ++n) tick();
    }

    SafetyGuard guard;
    double now_s = 100;
    Vec3 wanted{0, 0, 1.5}, velocity{50, 0, 0}, force;
};

double slew_step(const SafetyLimits& limits) {
    return limits.slew_n_per_ms * limits.tick_s * 1e3;
}

TEST(Safety, ramps_up_from_zero_over_half_a_second) {
    Loop loop;
    EXPECT_EQ(loop.tick(), Vec3{});
    loop.run(250);
    EXPECT_NEAR(loop.force.z, 0.75, 0.01);
    loop.run(251);
    EXPECT_EQ(loop.force.z, 1.5);
    EXPECT_EQ(loop.guard.fault(), Fault::none);
}

TEST(Safety, clamps_without_turning_the_force) {
    SafetyLimits limits;
    limits.ramp_s = 0;
    Loop loop(limits);
    loop.wanted = {30, -40, 120};  // 130 N
    loop.run(10);
    EXPECT_NEAR(length(loop.force), limits.max_force_n, 1e-12);
    EXPECT_LT(length(cross(loop.force, loop.wanted)), 1e-9);
    EXPECT_GT(dot(loop.force, loop.wanted), 0);
}

TEST(Safety, lets_no_force_rise_faster_than_the_slew_limit) {
    SafetyLimits limits;
    limits.ramp_s = 0;
    limits.slew_n_per_ms = 0.5;
    Loop loop(limits);
    loop.wanted = {0, 0, 3};
    Vec3 last;
    for (int n = 0; n < 20; ++n) {
        if (n == 10) loop.wanted = {0, 0, -3};
        loop.tick();
        EXPECT_LE(length(loop.force - last), slew_step(limits) + 1e-12);
        last = loop.force;
    }
}

TEST(Safety, does_not_let_a_late_tick_make_up_for_itself) {
    SafetyLimits limits;
    limits.ramp_s = 0;
    Loop loop(limits);
    loop.wanted = {};
    loop.run(10);
    loop.wanted = {0, 0, 3.3};
    loop.now_s += 0.045;  // late, but not yet a jump
    loop.tick();
    EXPECT_EQ(loop.guard.fault(), Fault::none);
    EXPECT_LE(length(loop.force), slew_step(limits) + 1e-12);
}

struct Injection {
    const char* what;
    Fault fault;
    void (*change)(SafetyInput&);
    bool damped;  // the hand's speed is known during the fault
};

const Injection kInjections[] = {
    {"the device is silent for 6 ms", Fault::device_silent, [](SafetyInput& in) { in.device_s -= 0.006; },
     false},
    {"the simulation has stood for 251 ms", Fault::simulation_stalled,
     [](SafetyInput& in) { in.simulation_s -= 0.251; }, true},
    {"the force is not a number", Fault::not_finite, [](SafetyInput& in) { in.wanted_n.y = kNan; }, true},
    {"the force is infinite", Fault::not_finite, [](SafetyInput& in) { in.wanted_n.x = -kInf; }, true},
    {"the speed is not a number", Fault::not_finite, [](SafetyInput& in) { in.velocity_mm_per_s.x = kNan; },
     false},
    {"the hand is too fast", Fault::too_fast, [](SafetyInput& in) { in.velocity_mm_per_s = {0, 1600, 0}; },
     true},
    {"the arm refuses", Fault::device_refused, [](SafetyInput& in) { in.device_refused = true; }, true},
    {"the simulation's time is not a number", Fault::simulation_stalled,
     [](SafetyInput& in) { in.simulation_s = kNan; }, true},
};

class SafetyFault : public ::testing::TestWithParam<Injection> {};

TEST_P(SafetyFault, gives_zero_in_the_second_tick_then_damping_alone_and_comes_back_by_the_ramp) {
    const Injection& injection = GetParam();
    Loop loop;
    loop.run(1000);
    ASSERT_EQ(loop.force, loop.wanted);
    loop.tick(injection.change);
    EXPECT_EQ(loop.guard.fault(), injection.fault) << injection.what;
    EXPECT_EQ(loop.force, 0.5 * loop.wanted) << injection.what;
    Vec3 last = loop.force;
    for (int n = 0; n < 100; ++n) {
        Vec3 speed;
        loop.tick([&](SafetyInput& in) {
            injection.change(in);
            speed = in.velocity_mm_per_s;
        });
        // Nothing of the wanted force is left; what there is opposes the hand.
        EXPECT_EQ(loop.force.z, 0) << injection.what;
        if (injection.damped) {
            EXPECT_LE(dot(loop.force, speed), 0);
            EXPECT_LE(length(loop.force), loop.guard.limits().damping_n_s_per_mm * length(speed) + 1e-12);
        } else {
            EXPECT_EQ(loop.force, Vec3{}) << injection.what;
        }
        if (n > 0) {
            EXPECT_LE(length(loop.force - last), slew_step(loop.guard.limits()) + 1e-12);
        }
        last = loop.force;
    }
    if (injection.damped) {
        EXPECT_LT(dot(loop.force, loop.velocity) + dot(loop.force, Vec3{0, 1600, 0}), 0);
    }
    EXPECT_EQ(loop.guard.count(injection.fault), 1U);
    // The cause is gone: a tenth of a second of quiet, then half a second of ramp.
    for (int n = 0; n < 1000; ++n) {
        const double before = loop.force.z;
        loop.tick();
        EXPECT_LE(loop.force.z - before, 1.5 / 500 + 1e-9) << n;
        if (n < 98) {
            EXPECT_EQ(loop.force.z, 0);
        }
    }
    EXPECT_EQ(loop.force, loop.wanted);
    EXPECT_EQ(loop.guard.fault(), Fault::none);
}

INSTANTIATE_TEST_SUITE_P(Injected, SafetyFault, ::testing::ValuesIn(kInjections));

TEST(Safety, takes_a_clock_that_jumps_for_a_fault_in_either_direction) {
    for (const double jump : {0.051, 3600.0, -0.002, -50.0, kNan, kInf}) {
        Loop loop;
        loop.run(1000);
        loop.tick([&](SafetyInput& in) { in.now_s = in.device_s = in.simulation_s = loop.now_s += jump; });
        EXPECT_EQ(loop.guard.fault(), Fault::clock_jump) << jump;
        EXPECT_EQ(loop.force, 0.5 * loop.wanted) << jump;
        if (!std::isfinite(jump)) loop.now_s = 200;  // the next tick jumps again
        loop.tick();
        EXPECT_EQ(loop.force.z, 0) << jump;
        loop.run(700);
        EXPECT_EQ(loop.force, loop.wanted) << jump;
    }
}

TEST(Safety, allows_what_is_just_within_its_limits) {
    Loop loop;
    loop.run(1000);
    loop.tick([](SafetyInput& in) { in.device_s -= 0.0049; });
    loop.tick([](SafetyInput& in) { in.simulation_s -= 0.249; });
    loop.now_s += 0.048;
    loop.tick();
    loop.tick([](SafetyInput& in) { in.velocity_mm_per_s = {1499, 0, 0}; });
    EXPECT_EQ(loop.guard.fault(), Fault::none);
    EXPECT_EQ(loop.force, loop.wanted);
}

TEST(Safety, goes_on_only_when_a_hand_that_was_too_fast_is_half_as_fast) {
    Loop loop;
    loop.run(1000);
    loop.tick([](SafetyInput& in) { in.velocity_mm_per_s = {1501, 0, 0}; });
    loop.velocity = {800, 0, 0};
    loop.run(300);
    EXPECT_EQ(loop.guard.fault(), Fault::too_fast);
    loop.velocity = {700, 0, 0};
    loop.run(150);
    EXPECT_EQ(loop.guard.fault(), Fault::none);
}

// One packet of the arm 95 mm off: over 8 ticks of 1 ms, 12 m/s to there and back.
TEST(Safety, answers_no_jump_of_a_position) {
    Loop loop;
    loop.wanted = {};
    loop.run(600);
    for (const double speed : {11'900.0, -11'900.0}) {
        loop.velocity = {speed, 0, 0};
        for (int n = 0; n < 8; ++n) {
            EXPECT_EQ(loop.tick(), Vec3{}) << n;
            EXPECT_EQ(loop.guard.fault(), Fault::too_fast);
        }
    }
    // A hand that is too fast is braked.
    loop.velocity = {3000, 0, 0};
    loop.run(8);
    EXPECT_LT(loop.force.x, -0.5);
}

// Whatever comes in, what goes out is finite, within the arm's force, and rises no faster than it may.
RC_GTEST_PROP(Safety, holds_its_promises_for_any_input, ()) {
    SafetyLimits limits;
    limits.ramp_s = *rc::gen::element(0.0, 0.01, 0.5);
    SafetyGuard guard(limits);
    const auto any = rc::gen::map(rc::gen::inRange(0, 40), [](int n) {
        if (n == 0) return kNan;
        if (n == 1) return kInf;
        if (n == 2) return -1e300;
        return (n - 20) * 1.0;
    });
    double now_s = 0;
    Vec3 last;
    Fault before = Fault::none;
    for (int n = 0; n < 200; ++n) {
        now_s += *rc::gen::element(1e-3, 1e-3, 1e-3, 1e-3, 0.0, 0.02, 0.06, -0.01);
        SafetyInput in{now_s,
                       now_s - *rc::gen::element(0.0, 0.0, 0.0, 0.01),
                       now_s - *rc::gen::element(0.0, 0.0, 0.0, 0.3),
                       {},
                       {}};
        in.velocity_mm_per_s = {*any, *any, *any};
        in.wanted_n = {*any, *any, *any};
        const Vec3 force = guard.tick(in);
        RC_ASSERT(is_finite(force));
        RC_ASSERT(length(force) <= limits.max_force_n + 1e-12);
        // A fault may take force away at once; nothing may add it faster than the slew limit.
        const bool falling =
            guard.fault() != Fault::none && length(force) <= length(last) + slew_step(limits);
        RC_ASSERT(falling || before != Fault::none || length(force - last) <= slew_step(limits) + 1e-12);
        last = force;
        before = guard.fault();
    }
}

}  // namespace
}  // namespace tribo::haptics
