// SPDX-License-Identifier: MIT
// One part on two machines, as APT and as keyframes: the tip runs the same way to a micrometre.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

#include "job/program_file.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"

namespace tribo::job {
namespace {

using job::PathKind;
constexpr double kDeg = std::numbers::pi / 180;

struct Pose {
    Vec3 tip, axis;
};

// Along the flank of a twisted blade: the tool leans up to 35 degrees and swings round by 120.
std::vector<Pose> blade(int steps) {
    std::vector<Pose> poses;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double lean = (10 + 25 * t) * kDeg, swing = (20 + 120 * t) * kDeg;
        poses.push_back(
            {{60 * t - 30, 8 * std::sin(3 * t), 12 * t * t - 4},
             {std::sin(lean) * std::cos(swing), std::sin(lean) * std::sin(swing), std::cos(lean)}});
    }
    return poses;
}

template <class... Numbers>
std::string print(const char* format, Numbers... numbers) {
    char text[256];
    std::snprintf(text, sizeof text, format, numbers...);
    return text;
}

std::string apt(const std::vector<Pose>& poses) {
    std::string text = "UNITS/MM\nMULTAX/ON\nFEDRAT/600,MMPM\n";
    for (const Pose& p : poses)
        text += print("GOTO/%.9f,%.9f,%.9f,%.9f,%.9f,%.9f\n", p.tip.x, p.tip.y, p.tip.z, p.axis.x, p.axis.y,
                      p.axis.z);
    return text;
}

std::string keyframes(const std::vector<Pose>& poses) {
    std::string text = "x,y,z,i,j,k,feed_mm_per_min\n";
    for (const Pose& p : poses)
        text += print("%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,600\n", p.tip.x, p.tip.y, p.tip.z, p.axis.x, p.axis.y,
                      p.axis.z);
    return text;
}

// xyzac-trt: the tool's axis in the part is (sin C sin A, cos C sin A, cos A).
std::string on_ac_table(const std::vector<Pose>& poses) {
    std::string text = "G21 G90 M3 S1000\nM428\nF600\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Pose& p = poses[i];
        text += print("G%d X%.9f Y%.9f Z%.9f A%.9f C%.9f\n", i == 0 ? 0 : 1, p.tip.x, p.tip.y, p.tip.z,
                      std::acos(p.axis.z) / kDeg, std::atan2(p.axis.x, p.axis.y) / kDeg);
    }
    return text;
}

// head-table: (sin B cos C, sin B sin C, cos B); Fanuc's words.
std::string on_head_and_table(const std::vector<Pose>& poses) {
    std::string text = "%\nO0001\nG21 G90 M3 S1000\nG43.4 H1\nF600\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Pose& p = poses[i];
        text += print("G%d X%.9f Y%.9f Z%.9f B%.9f C%.9f\n", i == 0 ? 0 : 1, p.tip.x, p.tip.y, p.tip.z,
                      std::acos(p.axis.z) / kDeg, std::atan2(p.axis.y, p.axis.x) / kDeg);
    }
    return text + "G49\nM30\n%\n";
}

// xyzbc-trt without tip control: the axis is (-cos C sin B, sin C sin B, cos B) in the part, and the
// machine's X Y Z are the tip turned by C about z, then by B about y, the pivot being 40 mm under the part's
// zero.
std::string on_bc_table(const std::vector<Pose>& poses) {
    std::string text = "G21 G90 M3 S1000\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Pose& p = poses[i];
        const double b = std::acos(p.axis.z), c = std::atan2(p.axis.y, -p.axis.x);
        const double x = std::cos(c) * p.tip.x - std::sin(c) * p.tip.y,
                     y = std::sin(c) * p.tip.x + std::cos(c) * p.tip.y;
        const double z = p.tip.z + 40;
        text += print("G%d X%.9f Y%.9f Z%.9f B%.9f C%.9f F600\n", i == 0 ? 0 : 1,
                      std::cos(b) * x + std::sin(b) * z, y, -std::sin(b) * x + std::cos(b) * z - 40, b / kDeg,
                      c / kDeg);
    }
    return text;
}

std::string conversational(const std::vector<Pose>& poses) {
    std::string text = "0 BEGIN PGM BLADE MM\nM3\nM128\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Pose& p = poses[i];
        text += print("L X%+.9f Y%+.9f Z%+.9f A%+.9f C%+.9f R0 %s\n", p.tip.x, p.tip.y, p.tip.z,
                      std::acos(p.axis.z) / kDeg, std::atan2(p.axis.x, p.axis.y) / kDeg,
                      i == 0 ? "FMAX" : "F600");
    }
    return text + "M129\nEND PGM BLADE MM\n";
}

// The tip after each thousandth of the way at feed.
std::vector<Pose> sampled(const motion::Program& program) {
    double whole = 0;
    for (const motion::Move& m : program.moves)
        if (m.kind == motion::MoveKind::feed) whole += path_length_mm(m);
    std::vector<Pose> samples;
    double done = 0;
    constexpr int count = 1000;
    for (const motion::Move& m : program.moves) {
        if (m.kind != motion::MoveKind::feed) continue;
        const double length = path_length_mm(m);
        while (samples.size() <= count) {
            const double at = whole * static_cast<double>(samples.size()) / count;
            if (at > done + length * (1 + 1e-12) && &m != &program.moves.back()) break;
            const auto pose = pose_at(m, motion::parameter_at_length(m, std::min(at - done, length)));
            samples.push_back({pose.tip_mm, pose.axis});
            if (at > done + length) break;
        }
        done += length;
    }
    return samples;
}

motion::Program read(const std::string& text, PathKind kind, const char* machine = nullptr,
                     Vec3 stock_mm = {}) {
    motion::Machine described;
    ProgramFileOptions options;
    options.interpolation = motion::Interpolation::linear;
    if (machine != nullptr) {
        described = *motion::named_machine(machine);
        described.stock_mm = stock_mm;
        options.machine = &described;
    }
    auto program = parse_program(text, "blade", kind, options);
    if (!program) {
        ADD_FAILURE() << program.error().text();
        return {};
    }
    return *std::move(program);
}

void expect_same_path(const motion::Program& is, const motion::Program& should, double axis_rad) {
    const std::vector<Pose> a = sampled(is), b = sampled(should);
    ASSERT_EQ(a.size(), b.size());
    double tip = 0, axis = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        tip = std::max(tip, distance(a[i].tip, b[i].tip));
        axis = std::max(axis, motion::angle_rad(a[i].axis, b[i].axis));
    }
    EXPECT_LT(tip, 1e-3);
    EXPECT_LT(axis, axis_rad);
}

TEST(OnePart, HasOnePathWhateverItIsWrittenIn) {
    const std::vector<Pose> poses = blade(60);
    const motion::Program should = read(apt(poses), PathKind::apt);
    ASSERT_EQ(should.moves.size(), 60u);
    expect_same_path(read(keyframes(poses), PathKind::keyframes), should, 1e-6);
    // Machines lead the axis over their joints, not along great circles: two degrees of C between points lead
    // it off by less than 0.01 degrees.
    const double joints = 2e-4;
    expect_same_path(read(on_ac_table(poses), PathKind::gcode, "xyzac-trt"), should, joints);
    expect_same_path(read(on_head_and_table(poses), PathKind::gcode, "head-table"), should, joints);
    expect_same_path(read(conversational(poses), PathKind::gcode, "xyzac-trt"), should, joints);
}

TEST(OnePart, HasOnePathWithoutTipControlWhereItsPointsAreDense) {
    // Between points the joints run evenly and the tip sags: 70 mm from the pivot and 0.06 degrees a step it
    // is less than a tenth of a micrometre.
    const std::vector<Pose> poses = blade(2000);
    expect_same_path(read(on_bc_table(poses), PathKind::gcode, "xyzbc-trt", {0, 0, 40}),
                     read(apt(poses), PathKind::apt), 1e-5);
}

}  // namespace
}  // namespace tribo::job
