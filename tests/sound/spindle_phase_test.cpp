// SPDX-License-Identifier: MIT
#include "sound/cut/spindle_phase.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "sound/cut/voice.hpp"

namespace tribo::sound {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// Distance between two angles, whole turns left out.
double apart(double a, double b) {
    return std::abs(std::remainder(a - b, kTurn));
}

TEST(SpindlePhase, runs_evenly_at_a_constant_rate) {
    SpindlePhase spindle;
    spindle.set_target(0.25, 0.4, 0, false);
    spindle.set_target(0.25 + 50 * 0.4, 0.4, 50, true);
    for (int q = 0; q < 80; ++q) {  // 30 of them beyond the last thing told
        const PhasePiece piece = spindle.advance();
        EXPECT_NEAR(apart(piece.at(0), 0.25 + q * 0.4), 0, 1e-12);
        EXPECT_NEAR(piece.slope(20) * kQuantumFrames, 0.4, 1e-12);
    }
}

TEST(SpindlePhase, follows_a_ramp_of_the_rate_exactly) {
    // rate = 0.3 + 0.002 q, angle its integral.
    const auto angle = [](double q) { return 0.3 * q + 0.001 * q * q; };
    SpindlePhase spindle;
    spindle.set_target(angle(0), 0.3, 0, false);
    spindle.set_target(angle(40), 0.38, 40, true);
    for (int q = 0; q < 40; ++q) {
        const PhasePiece piece = spindle.advance();
        for (const double frame : {0.0, 17.0, 63.0}) {
            EXPECT_NEAR(apart(piece.at(frame), angle(q + frame / kQuantumFrames)), 0, 1e-12);
        }
    }
}

TEST(SpindlePhase, does_not_mind_missing_turns) {
    SpindlePhase whole, wrapped;
    for (SpindlePhase* s : {&whole, &wrapped}) s->set_target(1, 2.0, 0, false);
    whole.set_target(1 + 2.0 * 100, 2.0, 100, true);
    wrapped.set_target(std::remainder(1 + 2.0 * 100, kTurn), 2.0, 100, true);
    for (int q = 0; q < 100; ++q) {
        EXPECT_NEAR(apart(whole.advance().at(30), wrapped.advance().at(30)), 0, 1e-9);
    }
}

TEST(SpindlePhase, that_is_told_late_begins_so_that_it_arrives_right) {
    SpindlePhase spindle;
    spindle.set_target(2.0, 0.5, 10, false);
    for (int q = 0; q < 10; ++q) EXPECT_NEAR(apart(spindle.advance().at(0), 2.0 + (q - 10) * 0.5), 0, 1e-12);
    EXPECT_NEAR(apart(spindle.advance().at(0), 2.0), 0, 1e-12);
}

TEST(SpindlePhase, jumps_to_the_truth_where_nobody_hears_it) {
    SpindlePhase spindle;
    spindle.set_target(0, 0.5, 0, false);
    for (int q = 0; q < 5; ++q) spindle.advance();
    spindle.set_target(1.0, 3.0, 0, false);
    EXPECT_NEAR(apart(spindle.advance().at(0), 1.0), 0, 1e-12);
}

// Whatever it is told while it sounds, and whenever: angle and rate go on without a step, and an angle that
// is wrong by half a turn bends the rate by at most half a turn over 32 quanta, times 1.5 at the middle.
RC_GTEST_PROP(SpindlePhase, never_jumps_while_it_sounds, ()) {
    SpindlePhase spindle;
    double rate = *rc::gen::inRange(0, 100) / 100.0;
    spindle.set_target(*rc::gen::inRange(0, 628) / 100.0, rate, 0, false);
    PhasePiece last = spindle.advance();
    for (int told = 0; told < 6; ++told) {
        const double next = *rc::gen::inRange(0, 100) / 100.0;
        const int quanta = *rc::gen::inRange(0, 60);
        spindle.set_target(*rc::gen::inRange(-628, 628) / 100.0, next, quanta, true);
        const int played = *rc::gen::inRange(1, 70);
        for (int q = 0; q < played; ++q) {
            const PhasePiece piece = spindle.advance();
            RC_ASSERT(apart(piece.at(0), last.at(kQuantumFrames)) < 1e-9);
            RC_ASSERT(std::abs(piece.slope(0) - last.slope(kQuantumFrames)) < 1e-9);
            last = piece;
        }
    }
}

}  // namespace
}  // namespace tribo::sound
