// SPDX-License-Identifier: MIT
// Programs that call others in files beside them.
#include "job/program/called_programs.hpp"

#include <gtest/gtest.h>

#include "job/memory_source.hpp"
#include "motion/path/path.hpp"

namespace tribo::job {
namespace {

double feed_mm(const motion::Program& program) {
    double total = 0;
    for (const motion::Move& move : program.moves) {
        if (move.kind == motion::MoveKind::feed) total += motion::path_length_mm(move);
    }
    return total;
}

// The program of `path` with what its folder has, read as a job reads it.
motion::Program read(const MemorySource& files, const std::string& path) {
    const std::string text = *files.read(path, 1 << 20);
    Warnings warnings;
    const std::string whole = with_called_programs(files, text, path, {}, warnings);
    auto program = parse_program(whole, path, PathKind::gcode);
    if (!program) {
        ADD_FAILURE() << program.error().text() << "\nin:\n" << whole;
        return {};
    }
    program->warnings.insert(program->warnings.end(), warnings.begin(), warnings.end());
    return *program;
}

bool says(const motion::Program& program, std::string_view text) {
    for (const Warning& warning : program.warnings) {
        if (warning.text.find(text) != std::string::npos) return true;
    }
    return false;
}

TEST(CalledPrograms, of_fanuc_controls_lie_beside_by_their_number) {
    MemorySource files;
    files.put("part/O0001.nc",
              "%\nO0001\nG21 G90 M3 S1000 F100\nG0 X0 Y0 Z0\nM98 P1000 L2\nG65 P2000 A5.\nG1 X0\n%\n");
    files.put("part/O1000.nc", "%\nO1000\nG91 G1 X10.\nG90\nM98 P3000\nM99\n%\n");
    files.put("part/2000", "G91 G1 Y#1\nG90\n");
    files.put("part/O3000.NC", "O3000\nG91 G1 Z-1.\nG90\nM99\n");
    files.put("O9.nc", "G21 F100\nG1 X1\nM98 P7\n");
    const motion::Program program = read(files, "part/O0001.nc");
    EXPECT_NEAR(feed_mm(program), 2 * (10 + 1) + 5 + 20, 1e-9);
    EXPECT_TRUE(says(program, "the program 1000 is read from O1000.nc, with lines that count on from 9"));
    EXPECT_FALSE(says(program, "what follows the end"));
    // One that is nowhere is refused by the reader.
    Warnings none;
    const std::string alone = with_called_programs(files, *files.read("O9.nc", 100), "O9.nc", {}, none);
    const auto refused = parse_program(alone, "O9.nc", PathKind::gcode);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().text().find("calls O7"), std::string::npos) << refused.error().text();
    EXPECT_NE(refused.error().remedy.find("lay its file beside"), std::string::npos);
}

TEST(CalledPrograms, of_fanuc_controls_have_names) {
    MemorySource files;
    files.put("MAIN.NC",
              "%\n<MAIN>\nG21 G90 M3 S1000 F100\nG0 X0 Y0 Z0\nM98<SLOT> L2\nG65 <deep> Z3.\nG1 X0\nM30\n"
              "<SLOT>\nG91 G1 X10.\nG90\nM99\n%\n");
    files.put("deep.nc", "%\n<DEEP>(MACRO)\nG1 Z-#26\nM99\n%\n");
    EXPECT_NEAR(feed_mm(read(files, "MAIN.NC")), 20 + 3 + 20, 1e-9);
    files.put("bare.nc", "G1 Y7\n");
    files.put("TWO.NC", "<TWO>\nG21 F100 M3\nG0 X0 Y0 Z0\nM98 <BARE>\nM30\n");
    EXPECT_NEAR(feed_mm(read(files, "TWO.NC")), 7, 1e-9);
    const auto refused = parse_program("<A>\nG21 G0 X0 Y0 Z0\nM98<B.NC>\n", "A.NC", PathKind::gcode);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().text().find("A.NC:3:1: error: M98 calls <b.nc>"), std::string::npos)
        << refused.error().text();
}

TEST(CalledPrograms, of_linuxcnc_lie_beside_by_the_name_of_their_sub) {
    MemorySource files;
    files.put("main.ngc", "G21 G90 M3 F100\nG0 X0 Y0 Z0\no<drill> call [20] [-10]\nM2\n");
    files.put("drill.ngc", "o<drill> sub\nG1 X#1 Y#2\no<drill> endsub\nM2\n");
    EXPECT_NEAR(feed_mm(read(files, "main.ngc")), std::hypot(20, 10), 1e-9);
}

TEST(CalledPrograms, of_siemens_controls_lie_beside_by_their_name) {
    MemorySource files;
    files.put("MAIN.MPF", "G71 G90 M3 S100 F100\nG0 X0 Y0 Z0\nHOLE(5)\nL10\nM30\n");
    files.put("HOLE.SPF", "PROC HOLE(REAL DEPTH)\nG1 Z=-DEPTH\nZ0\nM17\n");
    files.put("L10.SPF", "G1 X7\nM17\n");
    EXPECT_NEAR(feed_mm(read(files, "MAIN.MPF")), 17, 1e-9);
}

TEST(CalledPrograms, of_heidenhain_controls_have_labels_of_their_own) {
    MemorySource files;
    files.put("MAIN.H",
              "0 BEGIN PGM MAIN MM\n1 TOOL CALL 1 Z S100 F100\n2 L X+0 Y+0 Z+0 R0 FMAX M3\n"
              "3 CALL PGM TNC:\\PART\\SUB.H\n4 CALL LBL 1\n5 L Z+0\n6 M30\n7 LBL 1\n8 L IZ-3\n9 LBL 0\n"
              "10 END PGM MAIN MM\n");
    files.put("SUB.H", "0 BEGIN PGM SUB MM\n1 LBL 1\n2 L IX+2\n3 CALL LBL 1 REP 3\n4 END PGM SUB MM\n");
    EXPECT_NEAR(feed_mm(read(files, "MAIN.H")), 4 * 2 + 2 * 3, 1e-9);
    // The file may have the letters of the call.
    MemorySource mixed;
    mixed.put("Main.h",
              "0 BEGIN PGM Main MM\n1 TOOL CALL 1 Z S100 F100\n2 L X+0 Y+0 Z+0 R0 FMAX M3\n"
              "3 CALL PGM TNC:\\Sub.h\n4 END PGM Main MM\n");
    mixed.put("Sub.h", "0 BEGIN PGM Sub MM\n1 L X+7\n2 END PGM Sub MM\n");
    EXPECT_NEAR(feed_mm(read(mixed, "Main.h")), 7, 1e-9);
    // Without the file its moves are left out.
    MemorySource alone;
    alone.put("MAIN.H", *files.read("MAIN.H", 1 << 20));
    EXPECT_TRUE(says(read(alone, "MAIN.H"), "lay its file beside this one"));
}

TEST(CalledPrograms, that_call_each_other_end) {
    MemorySource files;
    files.put("O1.nc", "O0001\nG21 G90 F100\nG1 X1\nM98 P2\nM30\n");
    files.put("O2.nc", "O0002\nG1 X2\nM98 P1\nM99\n");
    Warnings warnings;
    const std::string whole = with_called_programs(files, *files.read("O1.nc", 100), "O1.nc", {}, warnings);
    EXPECT_FALSE(parse_program(whole, "O1.nc", PathKind::gcode).has_value());
}

}  // namespace
}  // namespace tribo::job
