// SPDX-License-Identifier: MIT
// What the tests of program readers ask of a program.
#pragma once

#include <gtest/gtest.h>
#include <string_view>

#include "base/math.hpp"
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
