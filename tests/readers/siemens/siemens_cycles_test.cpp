// SPDX-License-Identifier: MIT
// Cycles: drilling, patterns, pockets and slots.
#include <cmath>
#include <gtest/gtest.h>

#include "readers/refusals.hpp"
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
        // a first stroke that is shorter than what the others lose: they are as long as that, to 1, 5, 9, 13;
        // the last two are alike
        {"CYCLE83(5,0,1,-20,,,1,4,0,0,1,0)", 1 + 20 + 5 * 2, 9 + 25, 0},
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
    // Nothing states the tool: a radius of 3 mm, or half of a pocket of 4 mm.
    const motion::Program assumed = siemens("POCKET4(5,0,1,-4,20,100,50,4,0,0,300,100,0,2)\n");
    EXPECT_TRUE(warns_of(assumed, 4, "nothing states the radius of tool 1: 3 mm are taken"));
    EXPECT_NEAR(arc_mm(assumed), 2 * kPi * 17, 1e-9);
    EXPECT_NEAR(arc_mm(siemens("POCKET4(5,0,1,-4,4,100,50,4,0,0,300,100,0,2)\n")), 2 * kPi * 2, 1e-9);
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

TEST(SiemensCycles, SlotsOnACircleStayWithinTheirWalls) {
    // Two slots as wide as the tool, a quarter of a circle of 20 mm each.
    const motion::Program narrow = milled("SLOT2(5,0,1,-2,,2,90,10,100,50,20,10,180,100,300,0,3,0,0)\n");
    EXPECT_NEAR(arc_mm(narrow), 2 * 20 * kPi / 2, 1e-9);
    for (const int direction : {2, 3}) {
        // 14 wide: one ring 2 mm beside the middle, at each of two depths.
        const motion::Program wide = milled("SLOT2(5,0,1,-2,,2,90,14,100,50,20,10,180,100,300,1," +
                                            std::to_string(direction) + ",0,0)\n");
        const double ring = (22 + 18) * kPi / 2 + 2 * kPi * 2;
        EXPECT_NEAR(arc_mm(wide), 2 * 2 * (20 * kPi / 2 + ring), 1e-9);
        Box3 box;
        for (const motion::Move& move : wide.moves) {
            if (move.kind != motion::MoveKind::feed || move.end.tip_mm.z > 0) continue;
            for (const double t : {0.2, 0.5, 0.8}) {
                const Vec3 p = pose_at(move, t).tip_mm;
                const double r = math::hypot(p.x - 100, p.y - 50);
                EXPECT_LE(r, 22 + 1e-9);
                EXPECT_GE(r, 18 - 1e-9);
            }
            box.include(motion::tip_bounds(move));
        }
        // The first slot ends at 100 degrees, where its round end of 2 mm reaches farthest to the left above.
        EXPECT_NEAR(box.max.y, 50 + 22, 1e-9);
        EXPECT_NEAR(box.min.y, 50 - 22, 1e-9);
    }
}

// Outside of a square of 50 mm, climbing, with a tool of 10 mm: a quarter circle of 3 mm to it, four sides,
// three round corners, a line of 4 mm from it; twice, with the ways down from Z1.
TEST(SiemensCycles, FollowsContours) {
    const std::string contour = "G1 X0 Y0\nY50\nX50\nY0\nX0\n";
    const std::string cycle = ",5,0,1,-4,2,0.5,0,300,100,";
    const struct {
        std::string text;
        double radius;
    } cases[] = {
        {"CYCLE72(\"SQUARE\"" + cycle + "2,41,2,3,,1,4)\nM30\n%_N_SQUARE_SPF\n" + contour + "M17\n", 5},
        {"CYCLE62(\"SQUARE\",0)\nCYCLE72(\"\"" + cycle + "1,41,2,3,,1,4)\nM30\n%_N_SQUARE_SPF\n" + contour +
             "M17\n",
         5.5},
        {"CYCLE72(\"A:B\"" + cycle + "2,41,2,3,,1,4)\nM30\nA:\n" + contour + "B:\n", 5},
        {"CYCLE62(,2,\"A\",\"B\")\nCYCLE72(\"\"" + cycle + "2,41,2,3,,1,4)\nM30\nA:\n" + contour + "B:\n", 5},
        {"CYCLE62(\"SQUARE\",1)\nCYCLE72(\"\"" + cycle + "2,41,2,3,,1,4)\nM30\nE_LAB_A_SQUARE: ;#SM Z:2\n" +
             contour + "E_LAB_E_SQUARE:\n",
         5},
    };
    for (const auto& one : cases) {
        const motion::Program program = milled(one.text);
        const double around = 4 * 50 + 3 * one.radius * kPi / 2;
        EXPECT_NEAR(feed_mm(program), 2 * (around + 1.5 * kPi + 4) + 3 + 5, 1e-9) << one.text;
        expect_near(end_of(program), {-4, -one.radius, 5}, 1e-9);
        for (const motion::Move& move : program.moves) {
            if (move.kind != motion::MoveKind::feed) continue;
            const bool is_inside = move.end.tip_mm.x > 1e-9 && move.end.tip_mm.x < 50 - 1e-9 &&
                                   move.end.tip_mm.y > 1e-9 && move.end.tip_mm.y < 50 - 1e-9;
            EXPECT_FALSE(is_inside);
        }
    }
    // The same contour with its own corners, by blocks with G41 and by the cycle without ways to it.
    const std::string round = "Y50 RND=6\nX50 CHR=2\nY0\n";
    const motion::Program cycled = milled(
        "CYCLE72(\"R\",5,0,1,-4,0,0,0,300,100,2,41,1,7,,1,4)\nM30\n%_N_R_SPF\nG1 X0 Y0\n" + round + "M17\n");
    const motion::Program plain = milled("G0 X-5 Y-7 Z-4\nG1 G41 X0 Y0\n" + round + "G40\n");
    const auto outline = [](const motion::Program& program) {
        double sum = 0;
        for (const motion::Move& move : program.moves) {
            if (move.kind == motion::MoveKind::feed && move.start.tip_mm.z == -4 && move.end.tip_mm.z == -4)
                sum += motion::path_length_mm(move);
        }
        return sum;
    };
    EXPECT_NEAR(outline(cycled) - 4, outline(plain), 1e-9);  // both come along a line of 7 mm
}

TEST(SiemensCycles, KeepsAnOffsetFromTheContour) {
    const std::string square = "G0 X-20 Y-20 Z-4\nG1 G41 X0 Y0\nY50\nX50\nY0\nX0\nG40 X-20 Y-20\n";
    GcodeOptions wider;
    wider.tools = {{1, 12}};
    const motion::Program expected = siemens("F100\n" + square, wider);
    const motion::Program program = milled("OFFN=1\n" + square + "OFFN=0\n" + square);
    ASSERT_EQ(program.moves.size(), 2 * expected.moves.size() - 1);
    for (std::size_t k = 0; k < expected.moves.size(); ++k)
        expect_near(program.moves[k].end.tip_mm, expected.moves[k].end.tip_mm, 1e-12);
    expect_near(program.moves.back().end.tip_mm, {-20, -20, -4}, 1e-12);
}

TEST(SiemensCycles, MillsThreadsWithOneTooth) {
    for (const char* kind : {"2", "22", "112", "122"}) {
        const motion::Program thread =
            milled("CYCLE70(5,0,1,-6,26,1.3,0,2,1,0,500,0,50,60,0," + std::string(kind) + ")\n");
        double helix = 0, rise = 0, turn = 0;
        for (const motion::Move& move : thread.moves) {
            if (!move.arc || move.end.tip_mm.z == move.start.tip_mm.z) continue;
            helix += motion::path_length_mm(move);
            rise = move.end.tip_mm.z - move.start.tip_mm.z;
            turn = move.arc->normal.z;
        }
        EXPECT_NEAR(helix, 3 * std::hypot(2 * kPi * 8, 2), 1e-9);
        // A right-hand helix turns to the left on its way up.
        EXPECT_EQ(rise * turn > 0, kind[0] != '1') << kind;
    }
    // Roughing in three cuts of 0.4 mm to 0.1 mm, at radii of 7.1, 7.5 and 7.9.
    const motion::Program rough = milled("CYCLE70(5,0,1,-6,26,1.3,0.1,2,1,0.4,500,0,50,60,0,1)\n");
    double helix = 0;
    for (const motion::Move& move : rough.moves) {
        if (move.arc && move.end.tip_mm.z != move.start.tip_mm.z) helix += motion::path_length_mm(move);
    }
    double expected = 0;
    for (const double r : {7.1, 7.5, 7.9}) expected += 3 * std::hypot(2 * kPi * r, 2);
    EXPECT_NEAR(helix, expected, 1e-9);
    const motion::Program bolt = milled("CYCLE70(5,0,1,-6,26,1.3,0,2,1,0,500,1,50,60,0,2)\n");
    EXPECT_NEAR(math::hypot(bolt.moves[4].end.tip_mm.x - 50, bolt.moves[4].end.tip_mm.y - 60), 13 - 1.3 + 5,
                1e-9);
}

TEST(SiemensCycles, RefusesContoursThatDoNotFit) {
    const std::string start = "G71 G90 G17\nT1 D1 M6\nG0 X0 Y0 Z5 M3 F100\n";
    const std::string contour = "M30\n%_N_C_SPF\nG1 X0 Y0\nY5\n";
    const Refusal refusals[] = {
        {start + "CYCLE72(\"C\",5,0,1,0,2,0,0,300,100,2,41,2,3,,1,4)\n" + contour, 4, 1,
         "the depth is not below"},
        {start + "CYCLE72(\"C\",5,0,1,-4,2,0,0,300,100,2,41,7,3,,1,4)\n" + contour, 4, 1,
         "without a known way"},
        {start + "CYCLE72(\"C\",5,0,1,-4,2,0,0,300,100,2,40,2,3,,1,4)\n" + contour, 4, 1,
         "without a known way"},
        {start + "CYCLE72(\"A:B\",5,0,1,-4,2,0,0,300,100,2,40,1,3,,1,4)\n" + contour, 4, 1,
         "the labels of the"},
        {start + "CYCLE72(\"D\",5,0,1,-4,2,0,0,300,100,2,40,1,3,,1,4)\nM30\n%_N_D_SPF\nG1 X0\nM17\n", 4, 1,
         "no elements"},
        {start + "CYCLE72(\"D\",5,0,1,-4,2,0,0,300,100,2,40,1,3,,1,4)\nM30\n%_N_D_SPF\nPOCKET4(5,0,1,-4,20)"
                 "\nM17\n",
         7, 1, "within a contour"},
        {start + "SCALE X2\nCYCLE72(\"C\",5,0,1,-4,2,0,0,300,100,2,41,2,3,,1,4)\n" + contour, 5, 1,
         "unevenly scaled"},
        {start + "SLOT2(5,0,1,-2,,2,400,10,0,0,20,0,0,100,300,1,3,0,0)\n", 4, 1, "the slot is no arc"},
        {start + "CYCLE70(5,0,1,-6,26,1.3,0,0,1,0,500,0,50,60,0,2)\n", 4, 1, "the pitch is none"},
    };
    expect_refused(refusals, [](const std::string& text, const std::string& name) {
        GcodeOptions options;
        options.source_name = name;
        return read_siemens(text, options);
    });
}

}  // namespace
}  // namespace tribo::readers
