// SPDX-License-Identifier: MIT
// What the tests of program readers ask of a program.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <string_view>

#include "base/math.hpp"
#include "motion/path/path.hpp"
#include "motion/path/program.hpp"

namespace tribo::readers {

using math::kPi;

inline double feed_mm(const motion::Program& program) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) sum += motion::path_length_mm(move);
    }
    return sum;
}

inline double rapid_mm(const motion::Program& program) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::rapid) sum += motion::path_length_mm(move);
    }
    return sum;
}

// The tip where the feed moves have run a length.
inline Vec3 fed_to(const motion::Program& program, double length) {
    Vec3 last;
    for (const motion::Move& move : program.moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        const double whole = motion::path_length_mm(move);
        if (length <= whole) return motion::pose_at(move, motion::parameter_at_length(move, length)).tip_mm;
        length -= whole;
        last = move.end.tip_mm;
    }
    return last;
}

// The largest distance of two programs, at the same lengths of their feeds.
inline double apart_mm(const motion::Program& a, const motion::Program& b) {
    const double whole = std::max(feed_mm(a), feed_mm(b));
    constexpr int steps = 2000;
    double most = 0;
    for (int i = 0; i <= steps; ++i)
        most = std::max(most, distance(fed_to(a, whole * i / steps), fed_to(b, whole * i / steps)));
    return most;
}

inline bool warns_of(const motion::Program& program, int line, std::string_view fragment) {
    for (const Warning& warning : program.warnings) {
        if (warning.line == line && warning.text.find(fragment) != std::string::npos) return true;
    }
    return false;
}

inline void expect_near(Vec3 actual, Vec3 expected, double tolerance = 1e-12) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

}  // namespace tribo::readers
