// SPDX-License-Identifier: MIT
// Contours in subprograms that cycles 22 to 25 mill.
#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

constexpr const char* kRectangle =
    "L X+0 Y+0 RL\nL X+60\nL Y+40\nL X+0\nL Y+0\n";  // counter-clockwise, the tool within
constexpr const char* kData =
    "CYCL DEF 20 CONTOUR DATA Q1=-4 Q2=1 Q3=+0 Q4=+0 Q5=+0 Q6=2 Q7=+20 Q8=0 Q9=+1\n";

std::string with_contours(const std::string& cycles, const std::vector<std::string>& contours) {
    std::string labels, text;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        labels += (i == 0 ? " " : " /") + std::to_string(i + 1);
        text += "LBL " + std::to_string(i + 1) + "\n" + contours[i] + "LBL 0\n";
    }
    return after_start("CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL" + labels + "\n" + cycles +
                       "M2\n" + text);
}

motion::Program milled(const std::string& cycles, const std::vector<std::string>& contours) {
    GcodeOptions options;
    options.tools = {{1, 10}};
    return conversational(with_contours(cycles, contours), options);
}

double fed_at(const motion::Program& program, double z) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        const bool lies = move.start.tip_mm.z == z && move.end.tip_mm.z == z;
        if (lies && move.kind == motion::MoveKind::feed) sum += motion::path_length_mm(move);
    }
    return sum;
}

TEST(HeidenhainContourCycles, rough_pockets_from_the_inside_outwards) {
    const motion::Program program =
        milled(std::string(kData) + "CYCL DEF 22 ROUGH-OUT Q10=-2 Q11=100 Q12=300 Q18=0 Q19=100\nCYCL CALL\n",
               {kRectangle});
    EXPECT_TRUE(warns_of(program, 7, "the way of the tool within cycle 22 is the control's own"));
    // A line there and back and three rectangles, 5 mm apart, at each of two depths.
    for (const double z : {-2.0, -4.0})
        EXPECT_NEAR(fed_at(program, z), 40 + 80 + 120 + 160 + 3 * std::hypot(5, 5), 1e-4) << z;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::rapid) {
            EXPECT_GE(std::min(move.start.tip_mm.z, move.end.tip_mm.z), -4);
        }
    }
    EXPECT_EQ(program.moves.back().end.tip_mm.z, 20);
}

TEST(HeidenhainContourCycles, keep_islands_and_allowances) {
    // A round island of 10 in the middle, milled from outside: RR, counter-clockwise.
    const std::string island = "CC X+30 Y+20\nL X+35 Y+20 RR\nC X+25 Y+20 DR+\nC X+35 Y+20 DR+\n";
    const std::string words =
        "CYCL DEF 20 DATA Q1=-4 Q2=1 Q3=+1 Q4=+0.5 Q5=+0 Q6=2 Q7=+20 Q8=0 Q9=+1\n"
        "CYCL DEF 22 ROUGH Q10=-5 Q11=100 Q12=300\nCYCL CALL\n";
    const motion::Program program = milled(words, {kRectangle, island});
    double nearest = 1e9, lowest = 0;
    for (const motion::Move& move : program.moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        lowest = std::min(lowest, move.end.tip_mm.z);
        nearest = std::min(nearest, math::hypot(move.end.tip_mm.x - 30, move.end.tip_mm.y - 20));
    }
    EXPECT_NEAR(nearest, 5 + 5 + 1, 1e-6);
    EXPECT_NEAR(lowest, -3.5, 1e-12);
    // The edges alone, to their finished size: 50 by 30, and a circle of 10.
    const motion::Program edges =
        milled(std::string(kData) + "CYCL DEF 24 SIDE Q9=+1 Q10=-4 Q11=100 Q12=300 Q14=0\nCYCL CALL\n",
               {kRectangle, island});
    double arcs = 0;
    for (const motion::Move& move : edges.moves) {
        if (move.arc) arcs += motion::path_length_mm(move);
    }
    EXPECT_NEAR(arcs, 2 * kPi * 10, 1e-6);
    EXPECT_GE(fed_at(edges, -4), 160 + 2 * kPi * 10 - 1e-4);
}

TEST(HeidenhainContourCycles, follow_open_contours) {
    // RL along a U with a round corner, in other words: the same offset path.
    const std::string open = "L X+0 Y+0 RL\nL Y+30\nRND R10\nL X+40\nL Y+0\n";
    const motion::Program train =
        milled(std::string(kData) +
                   "CYCL DEF 25 TRAIN Q1=-4 Q3=+0 Q5=+0 Q7=+20 Q10=-4 Q11=100 Q12=300 Q15=+1\nCYCL CALL\n",
               {open});
    GcodeOptions options;
    options.tools = {{1, 10}};
    const motion::Program plain =
        conversational(after_start("3 L X-5 Y+0 Z+20 R0 FMAX\n4 L Z-4 F100\n5 L X-5 Y+35 F300\nRND R15\n6 L "
                                   "X+45\nRND R5\n7 L Y+0\n"),
                       options);
    // Outside of the sharp corner the tool rolls about it.
    EXPECT_NEAR(fed_at(train, -4), 20 + 15 * kPi / 2 + 30 + 5 * kPi / 2 + 30, 1e-9);
    EXPECT_LT(apart_mm(train, plain), 1e-9);
    // Up-cut: from its end on.
    const motion::Program back =
        milled(std::string(kData) +
                   "CYCL DEF 25 TRAIN Q1=-4 Q3=+0 Q5=+0 Q7=+20 Q10=-4 Q11=100 Q12=300 Q15=-1\nCYCL CALL\n",
               {open});
    EXPECT_NEAR(fed_at(back, -4), fed_at(train, -4), 1e-9);
    expect_near(fed_to(back, 24), {45, 0, -4}, 1e-9);
    expect_near(fed_to(train, 24), {-5, 0, -4}, 1e-9);
    // There and back, depth by depth.
    const motion::Program both =
        milled(std::string(kData) +
                   "CYCL DEF 25 TRAIN Q1=-4 Q3=+0 Q5=+0 Q7=+20 Q10=-2 Q11=100 Q12=300 Q15=0\nCYCL CALL\n",
               {open});
    EXPECT_NEAR(fed_at(both, -2), fed_at(both, -4), 1e-9);
}

TEST(HeidenhainContourCycles, refuse_what_is_no_pocket) {
    const auto fault_of = [](const std::string& cycles, const std::string& contour) {
        GcodeOptions options;
        options.source_name = "p.h";
        options.tools = {{1, 10}};
        const auto program = read_heidenhain(with_contours(cycles, {contour}), options);
        return program ? std::string() : program.error().text();
    };
    const std::string rough = std::string(kData) + "CYCL DEF 22 Q10=-2 Q11=100 Q12=300\nCYCL CALL\n";
    EXPECT_NE(fault_of(rough, "L X+0 Y+0 RL\nL X+60\nL Y+40\n").find("is not closed"), std::string::npos);
    EXPECT_NE(fault_of(rough, "L X+0 Y+0 RL\nL X+8\nL Y+8\nL X+0\nL Y+0\n").find("does not fit"),
              std::string::npos);
    EXPECT_NE(fault_of("CYCL DEF 22 Q10=-2 Q11=100 Q12=300\nCYCL CALL\n", kRectangle).find("depth Q1"),
              std::string::npos);
    EXPECT_NE(
        fault(after_start("CYCL DEF 22 Q10=-2 Q11=100 Q12=300\nCYCL CALL\n")).find("no contour is chosen"),
        std::string::npos);
}

}  // namespace
}  // namespace tribo::readers
