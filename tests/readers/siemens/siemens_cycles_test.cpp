// SPDX-License-Identifier: MIT
// Cycles: drilling, patterns, pockets and slots.
#include <cmath>
#include <gtest/gtest.h>

#include "readers/siemens/siemens_text.hpp"

namespace tribo::readers {
namespace {

TEST(SiemensCycles, DrillingPathsHaveTheirLengths) {
    // From Z10 over X0 Y0; RTP 5, RFP 0, SDIS 1. Feed: what is drilled; rapid: 10 to 1, back to 5, and what
    // the cycle adds.
    const struct {
        const char* call;
        double feed, rapid, dwell_s;
    } cases[] = {
        {"CYCLE81(5,0,1,-20)", 21, 9 + 25, 0},
        {"CYCLE81(5,0,1,,20)", 21, 9 + 25, 0},
        {"CYCLE81(5,0,1,-7,20,0,0,2)", 8, 9 + 12, 0},
        {"CYCLE82(5,0,1,-20,,2)", 21, 9 + 25, 2},
        {"CYCLE82(5,0,1,-20,,-50)", 21, 9 + 25, 1},  // turns of the spindle at 3000 rpm
        // strokes to 8, 14, 18 and 20, each 2 mm less; 1 mm back at the feed between them
        {"CYCLE83(5,0,1,-20,,,8,2,0,0,1,0)", 1 + 20 + 3 * 2, 9 + 25, 0},
        {"CYCLE83(5,0,1,-20,,-5,,0,0,0,1,0)", 1 + 20 + 3 * 2, 9 + 25, 0},
        // the same with returns to 1 mm above, down again to 0.6 mm above the last depth
        {"CYCLE83(5,0,1,-20,,-10,,0,0,3,1,1)", 1 + 20 + 0.6, 9 + 25 + 11 + 10.4, 3},
        {"CYCLE84(5,0,1,-20,,,3,,1.5,0,500,1000)", 42, 9 + 4, 0},
        {"CYCLE84(5,0,1,-20,,1,3,10,,0,500)", 42, 9 + 4, 1},
        {"CYCLE840(5,0,1,-20,,,,,,,1.5)", 42, 9 + 4, 0},
        {"CYCLE85(5,0,1,-20,,,50,200)", 42, 9 + 4, 0},
        {"CYCLE86(5,0,1,-20,,,3,-1,0,0,0)", 21, 9 + 1 + 25 + 1, 0},
        {"CYCLE87(5,0,1,-20,,3)", 21, 9 + 25, 0},
        {"CYCLE88(5,0,1,-20,,1,3)", 21, 9 + 25, 1},
        {"CYCLE89(5,0,1,-20,,1)", 42, 9 + 4, 1},
    };
    for (const auto& c : cases) {
        const motion::Program program = siemens("F100\n" + std::string(c.call) + "\n");
        EXPECT_NEAR(feed_mm(program), c.feed, 1e-9) << c.call;
        EXPECT_NEAR(rapid_mm(program), c.rapid, 1e-9) << c.call;
        double dwell = 0;
        for (const motion::Move& move : program.moves) {
            if (move.kind == motion::MoveKind::dwell) dwell += move.duration_s;
        }
        EXPECT_NEAR(dwell, c.dwell_s, 1e-12) << c.call;
        expect_near(end_of(program), {0, 0, 5});
    }
}

TEST(SiemensCycles, TapsWithTheFeedOfTheirPitch) {
    const motion::Program program = siemens("CYCLE84(5,0,1,-20,,,3,,1.5,0,500,1000)\n");
    ASSERT_EQ(program.moves.size(), 4u);
    EXPECT_EQ(program.moves[1].feed_mm_per_min, 750);
    EXPECT_EQ(program.moves[1].spindle_rpm, 500);
    EXPECT_EQ(program.moves[2].feed_mm_per_min, 1500);
    EXPECT_EQ(siemens("CYCLE84(5,0,1,-20,,,3,10,,0,500)\n").moves[1].feed_mm_per_min, 750);  // M10
    EXPECT_EQ(siemens("G331 Z-5 K2 S100\n").moves[0].feed_mm_per_min, 200);
}

TEST(SiemensCycles, ModalCallsRunAtEachPlace) {
    const struct {
        const char* text;
        std::vector<Vec3> holes;
    } cases[] = {
        {"MCALL CYCLE81(5,0,1,-2)\nX10 Y10\nX20\nMCALL\nX30\n", {{10, 10, -2}, {20, 10, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nHOLES1(10,0,90,5,10,3)\nMCALL\n",
         {{10, 5, -2}, {10, 15, -2}, {10, 25, -2}}},
        {"X10 Y30\nMCALL CYCLE81(5,0,1,-2)\nHOLES1(10,0,90,5,10,3)\n",
         {{10, 25, -2}, {10, 15, -2}, {10, 5, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nHOLES2(50,50,10,0,0,4)\n",
         {{60, 50, -2}, {50, 60, -2}, {40, 50, -2}, {50, 40, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nHOLES2(0,0,10,90,-90,2)\n", {{0, 10, -2}, {10, 0, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nCYCLE801(1,2,0,10,20,2,2)\n",
         {{1, 2, -2}, {11, 2, -2}, {11, 22, -2}, {1, 22, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nCYCLE802(111111111,111111111,1,2,3,4)\n", {{1, 2, -2}, {3, 4, -2}}},
        {"MCALL CYCLE81(5,0,1,-2)\nTRANS X100\nX10 Y10\n", {{110, 10, -2}}},
    };
    for (const auto& c : cases) {
        const motion::Program program = siemens("F100\n" + std::string(c.text));
        std::vector<Vec3> holes;
        for (const motion::Move& move : program.moves) {
            if (move.kind == motion::MoveKind::feed) holes.push_back(move.end.tip_mm);
        }
        ASSERT_EQ(holes.size(), c.holes.size()) << c.text;
        for (std::size_t i = 0; i < holes.size(); ++i) expect_near(holes[i], c.holes[i], 1e-12);
    }
}

TEST(SiemensCycles, OldCyclesReadRParameters) {
    const motion::Program program = siemens("F100\nG81 X8 Y0 R2=3 R3=-4 R10=10\nX20\nG80\nX30\n");
    EXPECT_NEAR(feed_mm(program), 14, 1e-12);
    expect_near(end_of(program), {30, 0, 10});
}

// With a tool of 10 mm.
motion::Program milled(std::string_view text) {
    GcodeOptions options;
    options.tools = {{1, 10}};
    return siemens("F100\n" + std::string(text), options);
}

double arc_mm(const motion::Program& program) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        if (move.arc) sum += motion::path_length_mm(move);
    }
    return sum;
}

TEST(SiemensCycles, PocketsAndSlotsStayWithinTheirWalls) {
    // A ring at 15 mm and one at 10 (MIDA 5) at each of two depths, and one at 5.
    const motion::Program round = milled("POCKET4(5,0,1,-4,20,100,50,2,0,0,300,100,0,1,5)\n");
    EXPECT_NEAR(arc_mm(round), 2 * 2 * kPi * (15 + 10 + 5), 1e-9);
    for (const motion::Move& move : round.moves) {
        if (move.kind == motion::MoveKind::rapid) continue;
        EXPECT_LE(math::hypot(move.end.tip_mm.x - 100, move.end.tip_mm.y - 50), 15 + 1e-9);
        EXPECT_GE(move.end.tip_mm.z, -4);
        EXPECT_EQ(move.feed_mm_per_min, move.end.tip_mm.z < move.start.tip_mm.z ? 100 : 300);
    }
    // 60 x 30 with corners of 8, turned by 90 degrees: along its edge only.
    const motion::Program edge = milled("POCKET3(5,0,1,-4,60,30,8,0,0,90,0,0,0,300,100,0,2)\n");
    EXPECT_NEAR(arc_mm(edge), 2 * kPi * 3, 1e-9);
    Box3 box;
    for (const motion::Move& move : edge.moves) {
        if (move.kind == motion::MoveKind::feed) box.include(motion::tip_bounds(move));
    }
    expect_near(box.min, {-10, -25, -4}, 1e-9);
    expect_near(box.max, {10, 25, 1}, 1e-9);
    // Two slots as wide as the tool, 30 long, from 20 off the centre.
    const motion::Program slots = milled("SLOT1(5,0,0,-2,,2,30,10,0,0,20,0,180,100,300,0)\n");
    EXPECT_EQ(arc_mm(slots), 0);
    double most = 0, least = 1e9;
    for (const motion::Move& move : slots.moves) {
        if (move.kind != motion::MoveKind::feed) continue;
        most = std::max(most, std::abs(move.end.tip_mm.x));
        least = std::min(least, std::abs(move.end.tip_mm.x));
    }
    EXPECT_NEAR(most, 45, 1e-9);
    EXPECT_NEAR(least, 25, 1e-9);
}

TEST(SiemensCycles, MillsThreadsAndFaces) {
    // A helix of radius 13 - 5 from Z1 to Z-5 by 2 mm a turn, between two half circles of 4 mm.
    const motion::Program thread = milled("CYCLE90(5,0,1,-5,,26,24,2,500,2,0,50,60)\n");
    double helix = 0;
    for (const motion::Move& move : thread.moves) {
        if (move.arc && move.end.tip_mm.z != move.start.tip_mm.z) helix += motion::path_length_mm(move);
    }
    EXPECT_NEAR(helix, 3 * std::hypot(2 * kPi * 8, 2), 1e-9);
    EXPECT_NEAR(arc_mm(thread) - helix, 2 * kPi * 4, 1e-9);
    expect_near(end_of(thread), {50, 60, 5}, 1e-9);
    // Four lines of 100 mm and the tool on both sides, 10 mm apart.
    const motion::Program face = milled("CYCLE61(5,2,1,0,0,0,100,40,2,10,0,500,31)\n");
    EXPECT_NEAR(feed_mm(face), 4 * 110 + 3 * 10, 1e-9);
}

}  // namespace
}  // namespace tribo::readers
