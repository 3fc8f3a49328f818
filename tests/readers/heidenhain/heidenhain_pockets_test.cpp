// SPDX-License-Identifier: MIT
// Pockets and studs whose rings the reader lays: lengths in closed form.
#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

motion::Program milled(const std::string& cycle, const std::string& call = "L X+50 Y+40 R0 FMAX M99\n") {
    GcodeOptions options;
    options.tools = {{1, 10}};
    return conversational(after_start("3 " + cycle + "\n" + call), options);
}

// Feed length at the lowest height.
double at_bottom_mm(const motion::Program& program) {
    double bottom = 0, total = 0;
    for (const motion::Move& move : program.moves) bottom = std::min(bottom, move.end.tip_mm.z);
    for (const motion::Move& move : program.moves) {
        const bool lies = move.start.tip_mm.z == bottom && move.end.tip_mm.z == bottom;
        if (lies) total += motion::path_length_mm(move);
    }
    return total;
}

Box3 reached(const motion::Program& program) {
    Box3 box{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
    for (const motion::Move& move : program.moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        for (int k = 0; k < 3; ++k) {
            box.min[k] = std::min(box.min[k], move.end.tip_mm[k]);
            box.max[k] = std::max(box.max[k], move.end.tip_mm[k]);
        }
    }
    return box;
}

TEST(HeidenhainPockets, fill_a_rectangle_with_rings_up_to_its_walls) {
    // Of 60 by 40: rings of half sides 25 15, 20 10, 15 5, each 5 mm apart, and one line of 10 mm each way.
    const motion::Program program = milled(
        "CYCL DEF 251 POCKET Q215=0 Q218=60 Q219=40 Q220=0 Q368=0 Q224=0 Q367=0 Q207=500 Q351=+1 Q201=-20 "
        "Q202=5 Q369=0 Q206=150 Q338=0 Q200=2 Q203=0 Q204=50 Q370=1 Q366=1 Q385=500");
    EXPECT_TRUE(warns_of(program, 4, "the way of the tool within cycle 251 is the control's own"));
    const Box3 box = reached(program);
    EXPECT_LT(distance(box.min, {25, 25, -20}), 1e-9);
    EXPECT_LT(distance(box.max, {75, 55, -5}), 1e-9);
    const double rings = 4 * (25 + 15 + 20 + 10 + 15 + 5) + 20 + 20;
    // The line goes from -10 to 10 and back; from its end to each ring below the middle, and back to the
    // start.
    const double ways = std::hypot(10, 5) + 5 + 5 + std::hypot(10, 15);
    EXPECT_NEAR(at_bottom_mm(program), rings + ways, 1e-9);
}

TEST(HeidenhainPockets, stand_where_q367_says) {
    const std::string cycle =
        "CYCL DEF 251 POCKET Q215=0 Q218=60 Q219=40 Q220=0 Q368=0 Q224=+90 Q367=1 Q207=500 Q351=-1 Q201=-5 "
        "Q202=5 Q369=0 Q206=150 Q200=2 Q203=0 Q204=2 Q370=1";
    // From its lower left corner at 50 40, turned by 90 degrees: to the left and upwards.
    const Box3 box = reached(milled(cycle));
    EXPECT_LT(distance(box.min, {50 - 35, 45, -5}), 1e-9);
    EXPECT_LT(distance(box.max, {45, 95, -5}), 1e-9);
}

TEST(HeidenhainPockets, of_circles_are_circles) {
    const std::string text =
        "CYCL DEF 252 CIRCULAR POCKET Q215=0 Q223=30 Q368=0 Q207=500 Q351=+1 Q201=-5 Q202=5 Q369=0 Q206=150 "
        "Q200=2 Q203=0 Q204=2 Q370=1";
    // Circles of 5 and 10 mm.
    EXPECT_NEAR(at_bottom_mm(milled(text)), 2 * kPi * 15 + 5 + 5 + 10, 1e-9);
    const std::string old =
        "CYCL DEF 5.0 KREISTASCHE\nCYCL DEF 5.1 ABST 2\nCYCL DEF 5.2 TIEFE -5\nCYCL DEF 5.3 ZUSTLG 5 F80\n"
        "CYCL DEF 5.4 RADIUS 15\nCYCL DEF 5.5 F100 DR+";
    // Steps of 8 mm: circles of 2 and 10 mm.
    EXPECT_NEAR(at_bottom_mm(milled(old, "L X+0 Y+0 Z+2 R0 FMAX M99\n")), 2 * kPi * 12 + 2 + 8 + 10, 1e-9);
}

TEST(HeidenhainPockets, of_old_controls_have_sides_and_a_radius) {
    const std::string old =
        "CYCL DEF 4.0 TASCHENFRAESEN\nCYCL DEF 4.1 ABST2\nCYCL DEF 4.2 TIEFE-10\nCYCL DEF 4.3 ZUSTLG5 F80\n"
        "CYCL DEF 4.4 X60\nCYCL DEF 4.5 Y40\nCYCL DEF 4.6 F100 DR- RADIUS 8";
    const motion::Program program = milled(old, "L X+50 Y+40 Z+2 R0 FMAX M99\n");
    const Box3 box = reached(program);
    EXPECT_LT(distance(box.min, {25, 25, -10}), 1e-9);
    EXPECT_LT(distance(box.max, {75, 55, -5}), 1e-9);
    // The outer ring has corners of 3 mm.
    const auto arc = std::find_if(program.moves.begin(), program.moves.end(), [](const motion::Move& move) {
        return move.arc && std::abs(distance(move.arc->centre_mm, move.start.tip_mm) - 3) < 1e-9;
    });
    ASSERT_NE(arc, program.moves.end());
    EXPECT_LT(arc->arc->normal.z, 0);
}

TEST(HeidenhainPockets, of_old_slots_begin_at_an_end) {
    // 50 by 14 along -Y with a tool of 10: its centre runs 40 mm on, and 2 mm to both sides.
    const std::string slot =
        "CYCL DEF 3.0 NUTENFRAESEN\nCYCL DEF 3.1 ABST 2\nCYCL DEF 3.2 TIEFE -5\nCYCL DEF 3.3 ZUSTLG 5 F80\n"
        "CYCL DEF 3.4 Y-50\nCYCL DEF 3.5 X14\nCYCL DEF 3.6 F100";
    const Box3 box = reached(milled(slot, "L X+50 Y+40 Z+2 R0 FMAX M99\n"));
    EXPECT_LT(distance(box.min, {48, 0, -5}), 1e-9);
    EXPECT_LT(distance(box.max, {52, 40, -5}), 1e-9);
}

TEST(HeidenhainPockets, go_round_studs_from_outside) {
    const motion::Program program = milled(
        "CYCL DEF 257 CIRCULAR STUD Q223=20 Q222=28 Q368=0 Q207=500 Q351=+1 Q201=-5 Q202=5 Q206=150 Q200=2 "
        "Q203=0 Q204=2 Q370=1");
    // One ring of 15 mm, clockwise, from 24 mm below the middle and back.
    EXPECT_NEAR(at_bottom_mm(program), 2 * kPi * 15 + 2 * 9, 1e-9);
    for (const motion::Move& move : program.moves) {
        if (!move.arc) continue;
        EXPECT_LT(move.arc->normal.z, 0);
    }
}

TEST(HeidenhainPockets, refuse_a_tool_that_does_not_fit) {
    GcodeOptions options;
    options.source_name = "p.h";
    options.tools = {{1, 50}};
    const auto program = read_heidenhain(
        after_start(
            "3 CYCL DEF 252 Q223=30 Q207=500 Q201=-5 Q202=5 Q206=150 Q200=2 Q203=0 Q204=2 Q370=1 M99\n"
            "4 CYCL CALL\n"),
        options);
    ASSERT_FALSE(program.has_value());
    EXPECT_NE(program.error().text().find("the tool does not fit"), std::string::npos)
        << program.error().text();
}

}  // namespace
}  // namespace tribo::readers
