// SPDX-License-Identifier: MIT
#include "job/program_file.hpp"

#include <gtest/gtest.h>

#include "job/memory_source.hpp"

namespace tribo::job {
namespace {

TEST(ProgramFormat, is_told_by_the_extension_and_else_by_the_content) {
    const struct {
        const char* path;
        const char* text;
        std::optional<PathKind> kind;
    } cases[] = {
        {"a.ngc", "", PathKind::gcode},
        {"a.NC", "", PathKind::gcode},
        {"b.cldata", "", PathKind::apt},
        {"c.csv", "", PathKind::keyframes},
        {"a.txt", "%\n(comment)\nN10 G21 G90\n", PathKind::gcode},
        {"a.txt", "; made by\r\ng0x1y2\r\n", PathKind::gcode},
        {"p.h", "", PathKind::gcode},
        {"p", "0 BEGIN PGM X MM\n", PathKind::gcode},
        {"O1234", "O1234\nM3 S100\n", PathKind::gcode},
        {"b", "PARTNO / BLADE\nGOTO/1,2,3\n", PathKind::apt},
        {"b.ncl", "", PathKind::apt},
        {"b.ncl.1", "$$*          Pro/CLfile\n", PathKind::apt},
        {"b.txt", "TOOL PATH/A,TOOL,B\n", PathKind::apt},
        {"b", "$$ comment\nGOTO  / 1,2,3\n", PathKind::apt},
        {"b.nci", "", PathKind::apt},
        {"b", "1050\n9 3 PART\n1013\n0 10. 0.\n", PathKind::apt},
        {"c.txt", "X,Y,Z,I,J,K\n0,0,0,0,0,1\n", PathKind::keyframes},
        {"d", "dear diary\n", std::nullopt},
        {"d", "", std::nullopt},
        {"d", "good morning\nmidday\n", std::nullopt},
    };
    for (const auto& c : cases) EXPECT_EQ(detect_program(c.text, c.path), c.kind) << c.path << ": " << c.text;
}

TEST(ProgramFile, is_read_as_its_control_has_it) {
    const auto dialect_of = [](const char* text, const ProgramFileOptions& options = {}) {
        const auto program = parse_program(text, "p", PathKind::gcode, options);
        return program ? program->dialect : program.error().text();
    };
    EXPECT_EQ(dialect_of("G21 G0 X0 Y0 Z0\n"), "LinuxCNC");
    EXPECT_EQ(dialect_of("%\nO1000 (PART)\nG21 G0 X0 Y0 Z0\n%\n"), "Fanuc");
    EXPECT_EQ(dialect_of("0 BEGIN PGM A MM\n1 L X+1 Y+0 Z+0 FMAX\n2 END PGM A MM\n"), "Heidenhain");
    EXPECT_EQ(dialect_of("G21 G0 X0 Y0 Z0\n", {.dialect = readers::Dialect::fanuc}), "Fanuc");
    EXPECT_NE(dialect_of("G21 G0 X0 Y0 Z0\n", {.dialect = readers::Dialect::heidenhain}).find("is not known"),
              std::string::npos);
}

TEST(ProgramFile, of_every_format_gives_the_same_moves) {
    const std::pair<PathKind, const char*> same[] = {
        {PathKind::gcode, "G21 G90\nG0 X0 Y0 Z5\nM3 S100\nG1 X10 F600\nG1 Y20\n"},
        {PathKind::apt, "UNITS/MM\nFEDRAT/600,MMPM\nGOTO/0,0,5\nGOTO/10,0,5\nGOTO/10,20,5\n"},
        {PathKind::keyframes,
         "x,y,z,i,j,k,feed_mm_per_min\n0,0,5,0,0,1,\n10,0,5,0,0,1,600\n10,20,5,0,0,1,600\n"},
    };
    for (const auto& [kind, text] : same) {
        const auto program = parse_program(text, "p", kind, {.interpolation = motion::Interpolation::linear});
        ASSERT_TRUE(program) << program.error().text();
        ASSERT_EQ(program->moves.size(), 2u) << text;
        EXPECT_EQ(program->moves[0].end.tip_mm, (Vec3{10, 0, 5}));
        EXPECT_EQ(program->moves[1].end.tip_mm, (Vec3{10, 20, 5}));
        EXPECT_EQ(program->moves[1].feed_mm_per_min, 600);
        EXPECT_EQ(program->source, "p");
    }
}

TEST(ProgramFile, sends_the_same_moves_to_a_sink) {
    class Collected final : public readers::MoveSink {
      public:
        void take(const motion::Move& move) override { moves.push_back(move); }
        std::vector<motion::Move> moves;
    };
    const std::pair<PathKind, const char*> programs[] = {
        {PathKind::gcode, "G21 G90\nG0 X0 Y0 Z5\nM3 S100\nG1 X10 F600\nG2 X20 R5\n"},
        {PathKind::gcode, "0 BEGIN PGM A MM\n1 L X+1 Y+0 Z+0 FMAX\n2 L X+9 F500\n3 END PGM A MM\n"},
        {PathKind::gcode, "; SINUMERIK 840D\nG90 G71\nG0 X=0 Y0 Z5\nG1 X=3 F500\nG2 X5 Y0 CR=1\n"},
        {PathKind::apt, "UNITS/MM\nFEDRAT/600,MMPM\nGOTO/0,0,5\nGOTO/10,0,5\n"},
        {PathKind::keyframes,
         "x,y,z,i,j,k,feed_mm_per_min\n0,0,5,0,0,1,\n10,0,5,0,0,1,600\n10,20,9,0,0,1,600\n"},
    };
    for (const auto& [kind, text] : programs) {
        const auto held = parse_program(text, "p", kind);
        ASSERT_TRUE(held) << held.error().text();
        Collected sink;
        const auto streamed = parse_program(text, "p", kind, {}, sink);
        ASSERT_TRUE(streamed) << streamed.error().text();
        EXPECT_TRUE(streamed->moves.empty());
        EXPECT_EQ(streamed->dialect, held->dialect);
        ASSERT_EQ(sink.moves.size(), held->moves.size());
        ASSERT_GT(sink.moves.size(), 0u);
        for (std::size_t n = 0; n < sink.moves.size(); ++n) {
            EXPECT_EQ(sink.moves[n].end, held->moves[n].end);
            EXPECT_EQ(sink.moves[n].line, held->moves[n].line);
            EXPECT_EQ(sink.moves[n].arc.has_value(), held->moves[n].arc.has_value());
        }
    }
}

TEST(ProgramFile, takes_the_jobs_feed_where_it_has_none) {
    MemorySource files;
    files.put("p.csv", "x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,1\n");
    files.put("p.ngc", "G21\nM3 S100\nG0 X0 Y0 Z0\nG1 X10\n");
    files.put("p.apt", "UNITS/MM\nGOTO/0,0,0\nGOTO/10,0,0\n");
    for (const auto& [kind, file] :
         {std::pair{PathKind::keyframes, "p.csv"}, std::pair{PathKind::gcode, "p.ngc"},
          std::pair{PathKind::apt, "p.apt"}}) {
        job::Job job;
        job.path.kind = kind;
        job.path.file = file;
        job.path.unit_mm = 10;
        job.process.feed_mm_per_min = 750;
        const auto program = read_program(files, job);
        ASSERT_TRUE(program) << program.error().text();
        EXPECT_EQ(program->moves.back().feed_mm_per_min, 750) << file;
        EXPECT_EQ(program->moves.back().end.tip_mm.x, 10) << file;
    }
}

TEST(ProgramFile, that_is_wrong_is_refused_with_its_name) {
    MemorySource files;
    files.put("p.csv", "x,y,z,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,up\n");
    job::Job job;
    job.path.file = "p.csv";
    job.process.feed_mm_per_min = 100;
    const auto wrong = read_program(files, job);
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().file, "p.csv");
    EXPECT_EQ(wrong.error().line, 3);
    EXPECT_EQ(wrong.error().fault, FileFault::input);
    job.path.file = "none.csv";
    EXPECT_EQ(read_program(files, job).error().file, "none.csv");
}

}  // namespace
}  // namespace tribo::job
