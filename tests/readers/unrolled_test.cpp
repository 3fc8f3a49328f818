// SPDX-License-Identifier: MIT
#include "readers/rewrite/unrolled.hpp"

#include <gtest/gtest.h>

#include "motion/path/path.hpp"
#include "readers/heidenhain/reader.hpp"
#include "readers/siemens/reader.hpp"

namespace tribo::readers {
namespace {

motion::Program program_of(std::string_view text) {
    auto program = read_gcode(text);
    EXPECT_TRUE(program) << program.error().text();
    return program ? *std::move(program) : motion::Program{};
}

void expect_same(const motion::Program& a, const motion::Program& b) {
    ASSERT_EQ(a.moves.size(), b.moves.size());
    for (std::size_t n = 0; n < a.moves.size(); ++n) {
        const motion::Move &x = a.moves[n], &y = b.moves[n];
        EXPECT_EQ(x.kind, y.kind) << n;
        EXPECT_EQ(x.tool, y.tool) << n;
        EXPECT_EQ(x.spindle_rpm, y.spindle_rpm) << n;
        EXPECT_NEAR(x.feed_mm_per_min, y.feed_mm_per_min, 1e-9) << n;
        for (const double t : {0.0, 0.37, 1.0})
            EXPECT_LT(distance(motion::pose_at(x, t).tip_mm, motion::pose_at(y, t).tip_mm), 1e-9) << n;
    }
}

// Written out in a language it has no word of loops, and is read again as the same moves.
template <class Read>
void expect_same_written_out(const motion::Program& program, FeedLanguage language, Read read,
                             const char* loop_word) {
    const auto text = unrolled_program(program, {.language = language});
    ASSERT_TRUE(text) << text.error().text();
    EXPECT_EQ(text->find(loop_word), std::string::npos) << *text;
    const auto again = read(*text);
    ASSERT_TRUE(again) << again.error().text() << *text;
    expect_same(program, *again);
}

constexpr std::string_view kLoops =
    "G21 G90 T2 M6 S9000 M3\nG0 X0 Y0 Z5\n#1=0\no1 while [#1 LT 3]\nG1 Z[-1-#1] F200\nG2 X10 Y0 I5 J0 "
    "F600\nG3 X0 Y0 I-5 J0 Z[-1.5-#1]\n"
    "G18 G2 X4 Z[-1.5-#1] I2 K0\nG17\nG1 X0\n#1=[#1+1]\no1 endwhile\nG4 P0.5\nG20 G1 X1 F10\nG93 G1 X2 "
    "F2\nM30\n";

TEST(UnrolledProgram, is_the_same_path_block_by_block) {
    const motion::Program program = program_of(kLoops);
    const auto text = unrolled_program(program, {});
    ASSERT_TRUE(text) << text.error().text();
    for (const char* gone : {"#", "while", "G20", "G93"})
        EXPECT_EQ(text->find(gone), std::string::npos) << *text;
    motion::Program again = program_of(*text), same = program;
    // The time of the last move is a feed now.
    for (motion::Move& move : same.moves)
        if (move.kind == motion::MoveKind::feed && move.duration_s > 0)
            move.feed_mm_per_min = 60 * motion::path_length_mm(move) / move.duration_s;
    expect_same(same, again);
    // Each line once, in order.
    for (std::size_t n = 1; n < again.moves.size(); ++n)
        EXPECT_GT(again.moves[n].line, again.moves[n - 1].line);
}

// Inches may be 0.0127 mm off, millimetres 0.005 mm.
TEST(UnrolledProgram, refuses_an_arc_that_only_inches_allow) {
    const std::string inches = "G20 G90 S9000 M3\nG0 X0 Y0 Z0\nG2 X.5004 Y0 I.25 J0 F10\n";
    const auto text = unrolled_program(program_of(inches), {});
    ASSERT_FALSE(text) << *text;
    EXPECT_EQ(text.error().line, 3);
    EXPECT_NE(text.error().cause.find("misses its end"), std::string::npos) << text.error().cause;
}

TEST(UnrolledProgram, leaves_out_no_way_over_a_place_of_the_machine) {
    const motion::Program program =
        program_of("G21 G90 S9000 M3\nG0 X0 Y0 Z1\nG1 X20 F500\nG28 Z0\nG0 X10 Y3\nZ1\nG1 X5\n");
    const auto text = unrolled_program(program, {});
    ASSERT_FALSE(text) << *text;
    EXPECT_EQ(text.error().line, 7);
    EXPECT_NE(text.error().cause.find("only the machine knows"), std::string::npos) << text.error().cause;
}

TEST(UnrolledProgram, has_no_exponents) {
    // Half an inch up and half an inch back leaves a rest of 1e-15 mm; 1e-7 mm is a place.
    const motion::Program program = program_of(
        "G20 G90 S9000 M3\nG0 X0 Y0 Z.1\nG1 Z-.05 F12\nG2 X.5 Y.5 R.5\nX0 Y0 I-.25 J-.25\nG21\nG1 "
        "X0.0000001\nX-0.000025\n");
    const auto text = unrolled_program(program, {});
    ASSERT_TRUE(text) << text.error().text();
    EXPECT_EQ(text->find('e'), std::string::npos) << *text;
    EXPECT_NE(text->find("X0.0000001"), std::string::npos) << *text;
    EXPECT_NE(text->find("X-0.000025"), std::string::npos) << *text;
    expect_same(program, program_of(*text));
}

TEST(UnrolledProgram, divides_long_lines_without_leaving_them) {
    const motion::Program program = program_of("G21 G90 G0 X0 Y0 Z0\nG1 X10 Y7 Z-3 F300\nX11\n");
    const auto text = unrolled_program(program, {.longest_mm = 2});
    ASSERT_TRUE(text);
    const motion::Program again = program_of(*text);
    double length = 0;
    for (const motion::Move& move : again.moves) {
        EXPECT_LE(motion::path_length_mm(move), 2 + 1e-9);
        length += motion::path_length_mm(move);
    }
    EXPECT_NEAR(length, motion::path_length_mm(program.moves[0]) + 1, 1e-9);
}

// A hole circle in a loop, a helix of two and a half turns, an arc, a dwell, two tools.
TEST(UnrolledProgram, is_the_same_path_in_siemens_words) {
    const auto program = read_siemens(
        "DEF INT N\nG71 G90 G17\nT2 M6\nS9000 M3\nG0 X0 Y0 Z5\nFOR N=0 TO 2\nG1 X=10*N Z-1 F300\nZ2 "
        "F900\nENDFOR\nG2 X30 Y10 I5 J5\nG3 X20 Y10 Z-4 I=AC(25) J=AC(10) TURN=2\nG4 F0.5\nT3 M6\nS4000 "
        "M3\nG18 G2 X24 Z-4 I2 K0\nG0 Z9\nM30\n");
    ASSERT_TRUE(program) << program.error().text();
    expect_same_written_out(
        *program, FeedLanguage::siemens, [](const std::string& text) { return read_siemens(text); }, "FOR");
}

TEST(UnrolledProgram, is_the_same_path_in_klartext) {
    const auto program = read_heidenhain(
        "BEGIN PGM HOLES MM\nTOOL CALL 2 Z S9000\nL X+0 Y+0 Z+5 R0 FMAX M3\nLBL 1\nL IX+7 Z-1 R0 F300\nL Z+2 "
        "R0 "
        "F900\nCALL LBL 1 REP 3\nL X+28 Y+5\nCC X+30 Y+5\nC X+32 Y+5 DR-\nCP IPA-900 IZ-4 DR- F200\nCYCL DEF "
        "9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 0.5\nTOOL CALL 3 Z S4000\nL X-3 R0 FMAX\nM30\nEND PGM HOLES "
        "MM\n");
    ASSERT_TRUE(program) << program.error().text();
    expect_same_written_out(
        *program, FeedLanguage::heidenhain, [](const std::string& text) { return read_heidenhain(text); },
        "LBL");
    const auto upright = unrolled_program(program_of("G21 G90 G18 G0 X0 Y0 Z0\nG2 X4 Z0 I2 K0 F100\n"),
                                          {.language = FeedLanguage::heidenhain});
    ASSERT_FALSE(upright);
    EXPECT_NE(upright.error().cause.find("plane of x and y"), std::string::npos);
}

TEST(UnrolledProgram, is_refused_for_what_plain_words_cannot_say) {
    motion::Program program = program_of("G21 G90 G0 X0 Y0 Z0\nG1 X10 F300\n");
    program.source = "p.nc";
    program.moves[0].end.axis = {0, 0.6, 0.8};
    const auto tilted = unrolled_program(program, {});
    ASSERT_FALSE(tilted);
    EXPECT_EQ(tilted.error().line, 2);
    EXPECT_NE(tilted.error().cause.find("tilted"), std::string::npos);
    program = program_of("G21 G90 G0 X0 Y0 Z0\nG2 X0 Y0 Z-3 I5 P3 F300\n");
    EXPECT_TRUE(unrolled_program(program, {}));
    EXPECT_FALSE(unrolled_program(program, {.dialect = GcodeDialect::fanuc}));
}

}  // namespace
}  // namespace tribo::readers
