// SPDX-License-Identifier: MIT
// Whether two programs move the tool along one path: within 1 um.
#pragma once

#include <gtest/gtest.h>
#include <vector>

#include "readers/program_checks.hpp"

namespace tribo::readers {

// The tool at steps of 0.25 mm of the whole path, and at its end.
inline std::vector<motion::ToolPose> samples_of(const motion::Program& program) {
    std::vector<motion::ToolPose> samples;
    double next = 0, reached = 0;
    for (const motion::Move& move : program.moves) {
        const double length = motion::path_length_mm(move);
        for (; length > 0 && next <= reached + length; next += 0.25) {
            samples.push_back(motion::pose_at(move, (next - reached) / length));
        }
        reached += length;
    }
    samples.push_back(program.moves.back().end);
    return samples;
}

inline void expect_one_path(const motion::Program& one, const Result<motion::Program>& other,
                            const char* language) {
    ASSERT_TRUE(other.has_value()) << language << ": " << other.error().text();
    EXPECT_NEAR(feed_mm(one), feed_mm(*other), 1e-3) << language;
    EXPECT_NEAR(rapid_mm(one), rapid_mm(*other), 1e-3) << language;
    const auto a = samples_of(one), b = samples_of(*other);
    ASSERT_EQ(a.size(), b.size()) << language;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_LT(distance(a[i].tip_mm, b[i].tip_mm), 1e-3) << language << " at sample " << i;
        ASSERT_LT(distance(a[i].axis, b[i].axis), 1e-6) << language << " at sample " << i;
    }
}

}  // namespace tribo::readers
