// SPDX-License-Identifier: MIT
// Threads that are milled, faces, slots along arcs and polygons: lengths in closed form.
#include "readers/heidenhain/heidenhain_text.hpp"

namespace tribo::readers {
namespace {

// With a tool of 10 mm, called at X+50 Y+40.
motion::Program thread_milled(const std::string& cycle,
                              const std::string& call = "L X+50 Y+40 R0 FMAX M99\n") {
    GcodeOptions options;
    options.tools = {{1, 10}};
    return conversational(after_start("3 " + cycle + "\n" + call), options);
}

// What lies at one height at the feed.
double thread_fed_at(const motion::Program& program, double z) {
    double sum = 0;
    for (const motion::Move& move : program.moves) {
        const bool lies = std::abs(move.start.tip_mm.z - z) < 1e-9 && std::abs(move.end.tip_mm.z - z) < 1e-9;
        if (lies && move.kind == motion::MoveKind::feed) sum += motion::path_length_mm(move);
    }
    return sum;
}

const motion::Move* steepest(const motion::Program& program) {
    const motion::Move* found = nullptr;
    for (const motion::Move& move : program.moves) {
        if (move.arc && move.start.tip_mm.z != move.end.tip_mm.z) found = &move;
    }
    return found;
}

constexpr const char* kThread = "Q335=20 Q239=+2 Q201=-10 Q253=750 Q200=2 Q203=0 Q204=20 Q207=300 ";

TEST(HeidenhainThreads, turn_about_their_hole) {
    // The orbit has a radius of 5 mm; 12 mm down at Q253; half circles of 2.5 mm; right-hand, climbing: up.
    const motion::Program whole = thread_milled(std::string("CYCL DEF 262 ") + kThread + "Q355=1 Q351=+1");
    EXPECT_TRUE(warns_of(whole, 4, "half circles are taken"));
    EXPECT_NEAR(feed_mm(whole), 12 + 2 * kPi * 2.5 + 5 * std::hypot(2 * kPi * 5, 2), 1e-9);
    ASSERT_NE(steepest(whole), nullptr);
    EXPECT_GT(steepest(whole)->arc->normal.z, 0);
    EXPECT_NEAR(steepest(whole)->start.tip_mm.z, -10, 1e-12);
    EXPECT_NEAR(steepest(whole)->end.tip_mm.z, 0, 1e-12);
    expect_near(whole.moves.back().end.tip_mm, {50, 40, 20}, 1e-9);
    // One turn at the bottom.
    const motion::Program one = thread_milled(std::string("CYCL DEF 262 ") + kThread + "Q355=0 Q351=+1");
    EXPECT_NEAR(feed_mm(one), 12 + 2 * kPi * 2.5 + std::hypot(2 * kPi * 5, 2), 1e-9);
    // Turns after each two pitches: from -10, -6 and -2; in the middle of the hole between them.
    const motion::Program steps = thread_milled(std::string("CYCL DEF 262 ") + kThread + "Q355=2 Q351=+1");
    EXPECT_NEAR(feed_mm(steps), 12 + 2 + 2 + 3 * (2 * kPi * 2.5 + std::hypot(2 * kPi * 5, 2)), 1e-9);
}

TEST(HeidenhainThreads, go_the_way_of_their_hand) {
    const struct {
        const char* words;
        bool left, up;
    } cases[] = {
        {"CYCL DEF 262 Q239=+2 Q351=+1", true, true},   {"CYCL DEF 262 Q239=+2 Q351=-1", false, false},
        {"CYCL DEF 262 Q239=-2 Q351=+1", true, false},  {"CYCL DEF 262 Q239=-2 Q351=-1", false, true},
        {"CYCL DEF 267 Q239=+2 Q351=+1", false, false}, {"CYCL DEF 267 Q239=+2 Q351=-1", true, true},
        {"CYCL DEF 265 Q239=+2", false, false},         {"CYCL DEF 265 Q239=-2", true, false}};
    for (const auto& c : cases) {
        const motion::Program program = thread_milled(
            std::string(c.words) +
            " Q335=20 Q201=-10 Q355=1 Q253=750 Q200=2 Q203=0 Q204=2 Q207=300 Q358=0 Q359=0 Q254=100");
        const motion::Move* turn = steepest(program);
        ASSERT_NE(turn, nullptr) << c.words;
        EXPECT_EQ(turn->arc->normal.z > 0, c.left) << c.words;
        EXPECT_EQ(turn->end.tip_mm.z > turn->start.tip_mm.z, c.up) << c.words;
        EXPECT_NEAR(turn->arc->turn_rad, 2 * kPi * 5, 1e-9) << c.words;
    }
}

TEST(HeidenhainThreads, lie_beside_bolts) {
    const motion::Program program = thread_milled(
        "CYCL DEF 267 Q335=20 Q239=+2 Q201=-10 Q355=1 Q253=750 Q351=-1 Q200=2 Q358=0 Q359=0 Q203=0 Q204=2 "
        "Q254=100 Q207=300");
    for (const motion::Move& move : program.moves) {
        if (move.end.tip_mm.z > -1e-9) continue;
        EXPECT_GE(math::hypot(move.end.tip_mm.x - 50, move.end.tip_mm.y - 40), 15 - 1e-9);
    }
}

TEST(HeidenhainThreads, are_drilled_and_countersunk_before) {
    // 264: drilled to -15 at Q206; the front at -1 with an offset of 3 mm; one turn at the bottom.
    const motion::Program program = thread_milled(
        "CYCL DEF 264 Q335=20 Q239=+2 Q201=-10 Q356=-15 Q253=750 Q351=+1 Q202=20 Q258=0.2 Q257=0 Q256=0 "
        "Q358=-1 Q359=3 Q200=2 Q203=0 Q204=20 Q206=100 Q254=150 Q207=300");
    const double sunk = 3 + 2 * kPi * 1.5 + 2 * kPi * 3;  // down from 2 to -1
    const double thread = 9 + 2 * kPi * 2.5 + std::hypot(2 * kPi * 5, 2);
    EXPECT_NEAR(feed_mm(program), 17 + sunk + thread, 1e-9);
    EXPECT_NEAR(thread_fed_at(program, -1), 2 * kPi * 1.5 + 2 * kPi * 3, 1e-9);
    // 263: countersunk to -5 with the shank at Q254, from the clearance above it.
    const motion::Program sink = thread_milled(
        "CYCL DEF 263 Q335=20 Q239=+2 Q201=-10 Q356=-5 Q253=750 Q351=+1 Q200=2 Q357=0 Q358=0 Q359=0 Q203=0 "
        "Q204=2 Q254=150 Q207=300");
    EXPECT_NEAR(feed_mm(sink), 7 + 5 + thread - 9, 1e-9);
}

TEST(HeidenhainThreads, refuse_what_has_no_thread) {
    EXPECT_NE(fault(after_start("3 CYCL DEF 262 Q335=20 Q201=-10 Q200=2 Q203=0 Q207=300\n4 M99\n"))
                  .find("lacks Q239"),
              std::string::npos);
}

TEST(HeidenhainFaces, have_lines_that_cover_them) {
    // 100 by 50, steps of 5 mm: ten lines of 100 + 2 (5 + 2), nine steps at Q253.
    const std::string sides =
        "Q218=100 Q219=50 Q227=2 Q386=0 Q369=0 Q202=5 Q370=1 Q207=400 Q385=300 Q253=800 "
        "Q357=2 Q200=2 Q204=20 ";
    const motion::Program there = thread_milled("CYCL DEF 233 Q215=0 Q389=0 Q350=1 " + sides);
    EXPECT_TRUE(warns_of(there, 4, "where the lines of cycle 233 lie"));
    EXPECT_NEAR(feed_mm(there), 10 * 114 + 9 * 5, 1e-9);
    EXPECT_NEAR(thread_fed_at(there, 0), 10 * 114 + 9 * 5, 1e-9);
    // At the edge: only the way in is longer.
    EXPECT_NEAR(thread_fed_at(thread_milled("CYCL DEF 233 Q215=0 Q389=1 Q350=1 " + sides), 0),
                10 * 100 + 7 + 9 * 5, 1e-9);
    // Line by line: back above the face.
    EXPECT_NEAR(thread_fed_at(thread_milled("CYCL DEF 233 Q215=0 Q389=2 Q350=1 " + sides), 0), 10 * 114,
                1e-9);
    // Along the other side: twenty lines of 50 + 14.
    EXPECT_NEAR(thread_fed_at(thread_milled("CYCL DEF 233 Q215=0 Q389=0 Q350=2 " + sides), 0),
                20 * 64 + 19 * 5, 1e-9);
    // A spiral: five rings 5 mm apart; the first side begins 7 mm outside.
    double spiral = 0;
    for (int ring = 0; ring < 5; ++ring) spiral += 2 * (100 + 50 - 4 * (2.5 + 5 * ring));
    EXPECT_NEAR(thread_fed_at(thread_milled("CYCL DEF 233 Q215=0 Q389=4 Q350=1 " + sides), 0),
                spiral + 7 + 2.5, 1e-9);
    // The older cycle 232 starts at a corner that it states.
    const motion::Program old = thread_milled("CYCL DEF 232 Q389=0 Q225=50 Q226=40 " + sides);
    EXPECT_LT(apart_mm(there, old), 1e-9);
}

TEST(HeidenhainFaces, stand_where_q367_says_and_keep_what_is_to_finish) {
    const motion::Program program = thread_milled(
        "CYCL DEF 233 Q215=0 Q389=0 Q350=1 Q367=3 Q218=40 Q219=20 Q227=3 Q386=0 Q369=0.5 Q202=2 Q370=1 "
        "Q207=400 "
        "Q385=300 Q253=800 Q357=0 Q200=2 Q204=20");
    // Roughing at 1.75 and 0.5, finishing at 0; the middle lies 20 and 10 off the corner.
    for (const double z : {1.75, 0.5, 0.0}) EXPECT_NEAR(thread_fed_at(program, z), 4 * 50 + 3 * 5, 1e-9) << z;
    Box3 box;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) box.include(motion::tip_bounds(move));
    }
    expect_near(box.min, {5, 22.5, 0}, 1e-9);
    expect_near(box.max, {55, 37.5, 1.75}, 1e-9);
    EXPECT_NE(fault("0 BEGIN PGM A MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S9 F9\n3 L X+0 Y+0 Z+9 FMAX M3\n"
                    "4 CYCL DEF 233 Q347=+1 Q218=40 Q219=20 Q227=3 Q386=0 Q207=400\n5 CYCL CALL\n")
                  .find("between walls"),
              std::string::npos);
}

TEST(HeidenhainFaces, may_be_ruled) {
    // Five lines from the edge at x 0 to that at x 40, which rises by 30.
    const motion::Program program = thread_milled(
        "CYCL DEF 231 Q225=0 Q226=0 Q227=0 Q228=40 Q229=0 Q230=0 Q231=40 Q232=20 Q233=30 Q234=0 Q235=20 "
        "Q236=0 "
        "Q240=5 Q207=400");
    double lines = 0, sides = 0;
    for (int i = 0; i < 5; ++i) lines += std::hypot(40, 7.5 * i);
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed && move.start.tip_mm.x != move.end.tip_mm.x)
            sides += motion::path_length_mm(move);
    }
    EXPECT_NEAR(sides, lines, 1e-9);
    // 230: eight lines of 100 + 2 * 5, steps of 50 / 8.
    const motion::Program flat = thread_milled(
        "CYCL DEF 230 Q225=0 Q226=0 Q227=0 Q218=100 Q219=50 Q240=8 Q206=150 Q207=400 Q209=200 Q200=2");
    EXPECT_NEAR(thread_fed_at(flat, 0), 8 * 110 + 7 * 50.0 / 8, 1e-9);
}

TEST(HeidenhainSlots, run_along_arcs) {
    // About X+50 Y+40, 60 wide, from 30 to 90 degrees; as wide as tool and 2 mm: its middle and one ring.
    const std::string slot =
        "Q219=12 Q368=0 Q375=60 Q248=60 Q377=1 Q378=0 Q207=300 Q351=+1 Q201=-5 Q202=5 "
        "Q369=0 Q206=100 Q200=2 Q203=0 Q204=20 ";
    const motion::Program program =
        thread_milled("CYCL DEF 254 Q215=0 Q367=0 Q216=50 Q217=40 Q376=30 " + slot);
    const double arcs = (30 + 31 + 29) * kPi / 3 + 2 * kPi;
    EXPECT_NEAR(thread_fed_at(program, -5), arcs + 1 + 1, 1e-9);
    // The same slot, with the tool at its left end, at its middle, at its right end.
    const auto called_at = [&](double deg, const char* words) {
        const double rad = deg * kPi / 180;
        return thread_milled(std::string("CYCL DEF 254 Q215=0 ") + words + slot,
                             "L X+" + std::to_string(50 + 30 * std::cos(rad)) + " Y+" +
                                 std::to_string(40 + 30 * std::sin(rad)) + " FMAX M99\n");
    };
    EXPECT_LT(apart_mm(program, called_at(30, "Q367=1 Q376=30 ")), 1e-5);
    EXPECT_LT(apart_mm(program, called_at(60, "Q367=2 Q376=60 ")), 1e-5);
    EXPECT_LT(apart_mm(program, called_at(90, "Q367=3 Q376=90 ")), 1e-5);
    // Cycle 211 of older controls.
    const motion::Program old = thread_milled(
        "CYCL DEF 211 Q200=2 Q201=-5 Q207=300 Q202=5 Q215=0 Q203=0 Q204=20 Q216=50 Q217=40 Q244=60 Q219=12 "
        "Q245=30 Q248=60 Q206=100");
    EXPECT_LT(apart_mm(program, old), 1e-9);
}

TEST(HeidenhainPolygons, have_equal_sides) {
    const std::string words =
        "Q222=0 Q224=0 Q220=0 Q368=0 Q207=300 Q351=+1 Q201=-5 Q202=5 Q206=100 Q200=2 "
        "Q203=0 Q204=20 Q370=1 Q215=0 ";
    const double side = 2 * 20 * std::tan(kPi / 6);
    const motion::Program within = thread_milled("CYCL DEF 258 Q573=0 Q571=40 Q572=6 " + words);
    EXPECT_NEAR(thread_fed_at(within, -5), 6 * side + 2 * kPi * 5 + 2 * 5, 1e-9);
    for (const motion::Move& move : within.moves) {
        if (move.arc) {
            EXPECT_LT(move.arc->normal.z, 0);  // climbing about a stud
        }
    }
    // The circle about its corners.
    const motion::Program about = thread_milled(
        "CYCL DEF 258 Q573=1 Q571=" + std::to_string(40 / std::cos(kPi / 6)) + " Q572=6 " + words);
    EXPECT_LT(apart_mm(within, about), 1e-5);
    EXPECT_NE(fault(after_start("3 CYCL DEF 258 Q571=40 Q572=2 Q200=2 Q201=-5 Q206=1 Q203=0\n4 M99\n"))
                  .find("number of corners"),
              std::string::npos);
}

TEST(HeidenhainPockets, of_the_tnc_426_finish_edges) {
    const motion::Program pocket = thread_milled(
        "CYCL DEF 212 Q200=2 Q201=-5 Q206=100 Q202=5 Q207=300 Q203=0 Q204=20 Q216=50 Q217=40 Q218=60 Q219=40 "
        "Q220=0 Q221=0");
    EXPECT_NEAR(thread_fed_at(pocket, -5), 2 * (50 + 30) + 2 * std::hypot(10, 15), 1e-9);
    const motion::Program stud = thread_milled(
        "CYCL DEF 215 Q200=2 Q201=-5 Q206=100 Q202=5 Q207=300 Q203=0 Q204=20 Q216=50 Q217=40 Q222=28 "
        "Q223=20");
    EXPECT_NEAR(thread_fed_at(stud, -5), 2 * kPi * 15 + 2 * 9, 1e-9);
}

// The end of a line in a plane.
Vec3 end_in(const std::string& plane, const char* machine = nullptr) {
    const std::string text = after_start("3 " + plane + "\n4 L X+10 Y+20 Z+30 FMAX\n");
    const motion::Program program = machine == nullptr ? conversational(text) : on(machine, text);
    return program.moves.empty() ? Vec3{} : program.moves.back().end.tip_mm;
}

TEST(HeidenhainPlanes, may_be_given_in_several_ways) {
    const Vec3 tilted = end_in("PLANE SPATIAL SPA+30 SPB+0 SPC+0 MOVE FMAX");
    expect_near(end_in("PLANE PROJECTED PROPR+0 PROMIN+30 ROT+0 MOVE FMAX"), tilted, 1e-9);
    expect_near(end_in("PLANE POINTS P1X+0 P1Y+0 P1Z+5 P2X+9 P2Y+0 P2Z+5 P3X+0 P3Y+1 P3Z+" +
                       std::to_string(5 + std::tan(kPi / 6)) + " MOVE FMAX"),
                tilted, 1e-4);
    expect_near(end_in("PLANE PROJECTED PROPR+20 PROMIN+0 ROT+0 MOVE FMAX"),
                end_in("PLANE SPATIAL SPA+0 SPB+20 SPC+0 MOVE FMAX"), 1e-9);
    expect_near(end_in("PLANE AXIAL A+30 MOVE FMAX", "xyza"),
                end_in("PLANE SPATIAL SPA+30 SPB+0 SPC+0 MOVE FMAX", "xyza"), 1e-9);
    expect_near(end_in("PLANE AXIAL IA+30 MOVE FMAX", "xyza"), end_in("PLANE AXIAL A+30 MOVE FMAX", "xyza"),
                1e-12);
    EXPECT_NE(fault(after_start("3 PLANE AXIAL B+45 STAY\n")).find("none is named"), std::string::npos);
    EXPECT_NE(
        fault(after_start("3 PLANE POINTS P1X+0 P1Y+0 P1Z+0 P2X+1 P2Y+0 P2Z+0 P3X+2 P3Y+0 P3Z+0 STAY\n"))
            .find("do not span"),
        std::string::npos);
}

}  // namespace
}  // namespace tribo::readers
