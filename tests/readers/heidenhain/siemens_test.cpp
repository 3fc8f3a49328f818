// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "readers/program_checks.hpp"
#include "readers/siemens/siemens_text.hpp"

namespace tribo::readers {
namespace {

motion::Program siemens(std::string_view text, const GcodeOptions& options = {}) {
    const auto program = read_siemens(text, options);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << text;
        return {};
    }
    return *program;
}

std::string fault(std::string_view text) {
    GcodeOptions options;
    options.source_name = "p.mpf";
    const auto program = read_siemens(text, options);
    return program ? "" : program.error().text();
}

constexpr std::string_view kStart = "N10 G71 G90 G17 G54 G64\nN20 T1 D1 M6\nN30 G0 X0 Y0 Z10 S3000 M3\n";

TEST(Siemens, ReadsWordsWithEqualSigns) {
    const motion::Program program = siemens(
        std::string("%_N_PART_MPF\n;$PATH=/_N_WKS_DIR\n") + std::string(kStart) +
        "N40 MSG(\"roughing (1)\")\nN50 R1=5\nN55 R2=R1*2\nN60 G1 X=R2 Y=(R1+1)*2 F=500 ; comment\nN70 "
        "STOPRE\n"
        "N80 G2 X20 Y22 CR=10\nN90 G3 X=30 Y=12 I=10 J=0\nN100 G4 F2\nN110 G0 SUPA Z300 D0\nN120 M30\n");
    EXPECT_EQ(program.dialect, "Siemens");
    ASSERT_EQ(program.moves.size(), 4u);
    expect_near(program.moves[0].end.tip_mm, {10, 12, 10});
    EXPECT_EQ(program.moves[0].feed_mm_per_min, 500);
    EXPECT_EQ(program.moves[0].line, 9);
    EXPECT_NEAR(path_length_mm(program.moves[1]), 10 * std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(path_length_mm(program.moves[2]), 10 * std::numbers::pi / 2, 1e-9);
    EXPECT_EQ(program.moves[3].duration_s, 2);
}

TEST(Siemens, LeadsTheToolAlongVectorsWithAndWithoutAMachine) {
    const std::string text =
        std::string(kStart) +
        "N40 TRAORI(1)\nN50 G1 X5 A3=0 B3=0.6 C3=0.8 F500\nN60 X10\nN70 X15 A3=0 B3=0 C3=1\n"
        "N80 TRAFOOF\nN90 X20\n";
    const motion::Program plain = siemens(text);
    EXPECT_FALSE(plain.has_rotary_words);
    ASSERT_EQ(plain.moves.size(), 4u);
    expect_near(plain.moves[0].start.axis, {0, 0, 1});
    expect_near(plain.moves[0].end.axis, {0, 0.6, 0.8}, 1e-15);
    expect_near(plain.moves[1].end.axis, {0, 0.6, 0.8}, 1e-15);
    expect_near(plain.moves[3].end.axis, {0, 0, 1});
    const motion::Machine machine = *motion::named_machine("head-table");
    GcodeOptions options;
    options.machine = &machine;
    const motion::Program on_machine = siemens(text, options);
    double length = 0;
    for (const motion::Move& m : on_machine.moves) {
        if (m.line < 9) length += path_length_mm(m);
        if (std::abs(m.end.tip_mm.x - 10) < 1e-9) expect_near(m.end.axis, {0, 0.6, 0.8}, 1e-6);
    }
    EXPECT_NEAR(length, 15, 1e-9);
}

TEST(Siemens, ShiftsTheZeroWithTransAndCountsTurns) {
    const motion::Program program = siemens(
        std::string(kStart) + "TRANS X10 Y=20\nG1 X0 Y0 F100\nG2 X0 Y0 I5 J0 TURN=2\nTRANS\nG1 X0 Y0\n");
    expect_near(program.moves[0].end.tip_mm, {10, 20, 10});
    EXPECT_NEAR(path_length_mm(program.moves[1]), 3 * 10 * std::numbers::pi, 1e-9);
    expect_near(program.moves[2].end.tip_mm, {0, 0, 10});
}

TEST(Siemens, RefusesWithPlaceCauseAndRemedy) {
    const struct {
        std::string text;
        const char* message;
    } cases[] = {
        {"N40 CYCLE800(1,\"TC\",0,57,0,0,0,30,0,0,0,0,0,1)\n",
         "p.mpf:4:5: error: CYCLE800 (swivelled planes)"},
        {"N40 CYCLE800()\n", ""},
        {"N40 MCALL CYCLE81(10,0,2,-5)\n", "p.mpf:4:5: error: MCALL (cycles) is not read yet"},
        {"N40 POCKET3(1)\n", "POCKET3 (cycles)"},
        {"N40 G1 X=IC(5) F100\n", "p.mpf:4:10: error: IC() is not read yet"},
        {"N40 IF R1==5 GOTOF END\n", "p.mpf:4:5: error: IF (branches)"},
        {"N40 T=\"MILL\" M6\n", "T with a name instead of a number"},
        {"N40 G1 X=$AA_IW[X]\n", "'$' does not belong into a value"},
        {"N40 FOO\n", "p.mpf:4:5: error: the word FOO is not known"},
        {"N40 G1 Q9=5\n", "Q9= is not known"},
        {"N40 MSG(\"open\n", "the parenthesis does not close"},
        {"N40 L100\n", "subprograms of other files"},
        {"N40 G1 X=\n", "a value is missing"},
        {"N40 R1=5 R2=R1\n", "p.mpf:4:13: error: R1 is used in the block that sets it"},
        {"N40 ROT Z30\n", "ROT (turned frames)"},
        {"N40 R1=" + std::string(5000, '1') + "\n", "p.mpf:4:4097: error: the block has 5007 characters"},
    };
    for (const auto& c : cases) {
        const std::string message = fault(std::string(kStart) + c.text);
        if (*c.message == '\0') {
            EXPECT_EQ(message, "") << c.text;
            continue;
        }
        EXPECT_NE(message.find(c.message), std::string::npos) << c.text << "gave: " << message;
        EXPECT_NE(message.find("; "), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace tribo::readers
