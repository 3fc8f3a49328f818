// SPDX-License-Identifier: MIT
#include "session/chatter/steady_cut.hpp"

#include <gtest/gtest.h>
#include <random>

#include "motion/machine/machine_path.hpp"
#include "session/chatter/critical_row.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {
namespace {

using milling::EngagementBand;

double area(const std::vector<EngagementBand>& bands) {
    double sum = 0;
    for (const EngagementBand& b : bands) sum += (b.z1_mm - b.z0_mm) * (b.exit_rad - b.entry_rad);
    return sum;
}

TEST(SteadyCut, at_another_depth_is_cut_off_or_goes_on_at_its_top) {
    SteadyCut cut;
    // A step: engaged twice in its lower half.
    cut.bands = {{1, 2, 0, 1}, {1, 2, 2, 3}, {2, 3, 0, 3}};
    EXPECT_EQ(cut.bands_at(0.5).size(), 2u);
    EXPECT_DOUBLE_EQ(cut.bands_at(0.5)[1].z1_mm, 1.5);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(0.5)), 0.5 * 2);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(1.5)), 1 * 2 + 0.5 * 3);
    EXPECT_DOUBLE_EQ(area(cut.bands_at(4)), 1 * 2 + 3 * 3);
    EXPECT_EQ(cut.entry_rad(), 0);
    EXPECT_EQ(cut.exit_rad(), 3);
}

TEST(FewerBands, join_the_most_alike_and_keep_the_area) {
    std::vector<EngagementBand> bands;
    for (int n = 0; n < 40; ++n) {
        const double z = 0.1 * n;
        bands.push_back({z, 0.1 * (n + 1), z < 2 ? 0.1 : 1.0, 2 + 0.01 * n});
    }
    const std::vector<EngagementBand> few = with_fewer_bands(bands, 6);
    ASSERT_EQ(few.size(), 6u);
    EXPECT_NEAR(area(few), area(bands), 1e-12);
    // The step stays a step.
    for (const EngagementBand& b : few) {
        EXPECT_TRUE(std::abs(b.entry_rad - 0.1) < 1e-12 || std::abs(b.entry_rad - 1) < 1e-12);
        EXPECT_TRUE(b.z1_mm < 2 + 1e-9 || b.z0_mm > 2 - 1e-9);
    }
    // Bands apart from each other stay.
    EXPECT_EQ(with_fewer_bands({{0, 1, 0, 1}, {2, 3, 0, 1}, {4, 5, 0, 1}}, 1).size(), 3u);
}

motion::ToolPose pose_of(const motion::Kinematics& machine, const Vec3& rotary_rad, bool tip_control) {
    motion::MachineBlock block;
    block.tip_control = tip_control;
    block.start_mm = block.end_mm = {3, -4, 5};
    block.start_rad = block.end_rad = rotary_rad;
    return motion::pose_at(machine, block, 0);
}

void expect_near(Vec3 is, Vec3 should) {
    EXPECT_LT(length(is - should), 1e-9);
}

// The slides carry the head along the axes of the machine: where a table turns, they show these in the stock.
TEST(HeadFrame, stays_with_the_machine_where_tables_turn) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> angle(-3, 3);
    for (const char* name : {"xyzac-trt", "xyzbc-trt", "xyza"}) {
        const motion::Kinematics machine(*motion::named_machine(name));
        for (int n = 0; n < 50; ++n) {
            const Vec3 rotary{angle(random), angle(random), angle(random)};
            const milling::ToolFrame head = head_frame(pose_of(machine, rotary, n % 2 == 0));
            const Vec3 from = machine.pose({{}, rotary}).tip_mm;
            expect_near(head.x, machine.pose({{1, 0, 0}, rotary}).tip_mm - from);
            expect_near(head.y, machine.pose({{0, 1, 0}, rotary}).tip_mm - from);
            expect_near(head.z, machine.pose({{0, 0, 1}, rotary}).tip_mm - from);
        }
    }
}

// By the matrices of ISO 841: the first axis of the chain carries the second.
TEST(HeadFrame, turns_with_a_head) {
    const auto about_y = [](Vec3 v, double a) {
        return Vec3{std::cos(a) * v.x + std::sin(a) * v.z, v.y, std::cos(a) * v.z - std::sin(a) * v.x};
    };
    const auto about_z = [](Vec3 v, double a) {
        return Vec3{std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
    };
    std::mt19937 random(4);
    std::uniform_real_distribution<double> angle(-3, 3);
    const motion::Kinematics head_head(*motion::named_machine("head-head"));
    const motion::Kinematics head_table(*motion::named_machine("head-table"));
    for (int n = 0; n < 50; ++n) {
        const Vec3 rotary{0, angle(random), angle(random)};
        // C in the head carries B; a table that turns about -z turns the head about +z against the part.
        for (const motion::Kinematics* machine : {&head_head, &head_table}) {
            const milling::ToolFrame head = head_frame(pose_of(*machine, rotary, true));
            expect_near(head.x, about_z(about_y({1, 0, 0}, rotary.y), rotary.z));
            expect_near(head.y, about_z(about_y({0, 1, 0}, rotary.y), rotary.z));
        }
    }
}

// A mode of the tool across an indexed table is a mode along the feed.
TEST(Modes, of_the_tool_stay_with_the_head_and_those_of_the_part_with_the_part) {
    const motion::Kinematics machine(*motion::named_machine("xyzac-trt"));
    const motion::ToolPose pose = pose_of(machine, {0, 0, -math::kPi / 2}, true);
    const std::vector<dynamics::Mode> modes{{{1, 0, 0}, 900, 0.02, 1000, dynamics::ModeOn::tool},
                                            {{1, 0, 0}, 900, 0.02, 1000, dynamics::ModeOn::part}};
    const milling::ToolFrame along_y = milling::tool_frame({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
    const auto turned = modes_in(along_y, head_frame(pose), modes);
    // The table turns by -90 deg about +z, so the x of the machine is the y of the part.
    expect_near(turned[0].direction, {1, 0, 0});
    expect_near(turned[1].direction, {0, -1, 0});
}

}  // namespace
}  // namespace tribo::session
