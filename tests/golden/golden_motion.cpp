// SPDX-License-Identifier: MIT
#include <vector>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "golden/golden.hpp"
#include "motion/curve/fitting.hpp"
#include "motion/curve/keyframe_motion.hpp"
#include "motion/path/timing.hpp"

namespace tribo::golden {
namespace {

void add(Hash& hash, const motion::ToolPose& pose) {
    hash.add(pose.tip_mm);
    hash.add(pose.axis);
}

// A five-axis spiral over a saddle, the axis leaning outwards.
motion::ToolPose spiral(double turn) {
    const double radius = 5 + 2 * turn, x = radius * math::cos(turn), y = radius * math::sin(turn);
    return {{x, y, 0.01 * (x * x - y * y)}, normalized({0.02 * x, 0.02 * y, 1})};
}

}  // namespace

// Keyframes to moves to a time law; a stream of poses to fitted motions.
std::uint64_t motion() {
    Hash hash;
    std::vector<motion::Keyframe> keyframes;
    for (int i = 0; i < 40; ++i) {
        motion::Keyframe keyframe;
        keyframe.pose = spiral(0.3 * i);
        keyframe.weight = 1 + 0.1 * (i % 3);
        keyframes.push_back(keyframe);
    }
    const auto moves = motion::keyframe_moves(keyframes, 900);
    if (!moves) return 0;
    motion::TimingOptions timing;
    timing.acceleration_mm_per_s2 = 500;
    const auto schedule = motion::schedule(*moves, timing);
    if (!schedule) return 0;
    hash.add(schedule->duration_s);
    for (int i = 0; i <= 500; ++i)
        add(hash, motion::pose_at_time(*moves, *schedule, schedule->duration_s * i / 500));
    for (const motion::Move& move : *moves) {
        hash.add(motion::path_length_mm(move));
        hash.add(motion::tip_bounds(move).max);
    }

    std::vector<motion::ToolPose> poses;
    for (int i = 0; i < 400; ++i) poses.push_back(spiral(0.03 * i));
    const auto fit = motion::fit_motion(poses);
    if (!fit) return 0;
    hash.add(fit->control_points);
    for (const motion::FittedRun& run : fit->runs)
        for (const double parameter : run.parameters) add(hash, run.motion.pose(parameter));
    return hash.value();
}

}  // namespace tribo::golden
