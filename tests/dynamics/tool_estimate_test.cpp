// SPDX-License-Identifier: MIT
#include "dynamics/tool_estimate.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace tribo::dynamics {
namespace {

milling::Cutter tool() {
    milling::Cutter cutter{.diameter_mm = 12, .length_mm = 26};
    cutter.stickout_mm = 50;
    return cutter;
}

double inertia_mm4(double diameter_mm) {
    return std::pow(diameter_mm, 4) * 3.14159265358979 / 64;
}

TEST(ToolEstimate, yields_as_the_fluted_bar_its_shank_and_both_joints) {
    const std::vector<Mode> modes = estimated_modes(tool());
    ASSERT_EQ(modes.size() % 2, 0u);
    EXPECT_EQ(modes[0].direction.x, 1);
    EXPECT_EQ(modes[1].direction.y, 1);
    for (const Mode& mode : modes) {
        EXPECT_TRUE(mode.estimated);
        EXPECT_EQ(mode.on, ModeOn::tool);
        EXPECT_EQ(mode.damping_ratio, 0.02);
        EXPECT_EQ(1 + mode.spread.stiffness, 2);
    }
    const double fluted = std::pow(26.0, 3) / (3 * 600e3 * inertia_mm4(0.8 * 12));
    const double shank = (std::pow(50.0, 3) - std::pow(26.0, 3)) / (3 * 600e3 * inertia_mm4(12));
    const double joints = 1 / 20e3 + 1 / 50e3 + 2 * 50 * 50 / 1.5e9;
    double yields = 0;
    for (std::size_t n = 0; n < modes.size(); n += 2) {
        EXPECT_EQ(modes[n].stiffness_n_per_mm, modes[n + 1].stiffness_n_per_mm);
        yields += 1 / modes[n].stiffness_n_per_mm;
    }
    // Shear adds some per cent; of the stiffer modes, which are left out, none has more than a third.
    EXPECT_LT(yields / (fluted + shank + joints), 1.05);
    EXPECT_GT(yields / (fluted + shank + joints), 0.7);
}

TEST(ToolEstimate, bends_more_with_a_neck_of_steel_and_on_a_slender_holder) {
    const auto of = [](const milling::Cutter& cutter) { return estimated_modes(cutter)[0]; };
    const Mode carbide = of(tool());
    milling::Cutter other = tool();
    other.body = milling::CutterBody::high_speed_steel;
    EXPECT_LT(of(other).stiffness_n_per_mm, 0.7 * carbide.stiffness_n_per_mm);
    other = tool();
    other.neck_mm = 9;
    const Mode necked = of(other);
    EXPECT_LT(necked.stiffness_n_per_mm, carbide.stiffness_n_per_mm);
    other.reach_mm = 30;
    EXPECT_GT(of(other).stiffness_n_per_mm, necked.stiffness_n_per_mm);
    EXPECT_LT(of(other).stiffness_n_per_mm, carbide.stiffness_n_per_mm);
    other = tool();
    other.shank_mm = 16;
    EXPECT_GT(of(other).stiffness_n_per_mm, carbide.stiffness_n_per_mm);
    other = tool();
    other.holder = {{24, 60}, {40, 40}};
    EXPECT_LT(of(other).stiffness_n_per_mm, carbide.stiffness_n_per_mm);
    EXPECT_LT(of(other).frequency_hz, carbide.frequency_hz);
}

TEST(ToolEstimate, finds_the_mode_of_a_thin_tip_above_those_of_its_holder) {
    milling::Cutter cutter{.diameter_mm = 1, .length_mm = 3};
    cutter.stickout_mm = 20;
    cutter.shank_mm = 3;
    const double alone = estimated_modes(cutter)[0].stiffness_n_per_mm;
    cutter.holder = {{28, 50}, {50, 30}};
    double least = 1e9;
    for (const Mode& mode : estimated_modes(cutter)) least = std::min(least, mode.stiffness_n_per_mm);
    EXPECT_NEAR(least / alone, 1, 0.2);
}

TEST(ToolEstimate, follows_the_cube_of_a_long_stick_out) {
    // A slender tool hides its joints.
    milling::Cutter cutter{.diameter_mm = 3, .length_mm = 8};
    cutter.stickout_mm = 40;
    const double near = estimated_modes(cutter)[0].stiffness_n_per_mm;
    cutter.stickout_mm = 80;
    EXPECT_NEAR(near / estimated_modes(cutter)[0].stiffness_n_per_mm, 8, 0.6);
}

}  // namespace
}  // namespace tribo::dynamics
