// SPDX-License-Identifier: MIT
// Programs without a job: what is assumed, what is said of it, and the job that stands for all of it.
#include <gtest/gtest.h>

#include "job/loader.hpp"
#include "job/memory_source.hpp"
#include "job/toml/job_writer.hpp"
#include "job/words/stock_words.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

const std::string kToolless =
    "p.nc: warning: the tool is not described: a flat end mill of 6 mm with 2 flutes is assumed; write "
    "--tool \"flat 6 flutes 2\", or a [[cutter]] into a job";
const std::string kMaterialless =
    "p.nc: warning: no material is given: al7075-t6 is assumed; write --material NAME, or [material] into a "
    "job";

std::string stockless(const std::string& words) {
    return "p.nc: warning: no stock is described: a block around the path is assumed; write --stock \"" +
           words + "\" (two corners, mm), or [stock] into a job";
}

std::string speedless(int line) {
    return "p.nc:" + std::to_string(line) +
           ": warning: no spindle speed so far: 10000 rpm are assumed; write an S word, --spindle-rpm, or "
           "spindle_rpm into [process] of a job";
}

struct Loaded {
    FileResult<LoadedJob> result;
    std::vector<std::string> assumptions;

    const Job& job() const { return result->job; }
};

Loaded load(const std::string& program, const ProgramInputs& inputs = {}, const std::string& name = "p.nc") {
    MemorySource files;
    files.put(name, program);
    files.put("tool.tbl", "T1 P1 D8 Z50 ;\nT2 P2 D4 Z50 ;\n");
    Loaded loaded{load_job(files, name, {.program = inputs}), {}};
    if (!loaded.result) {
        ADD_FAILURE() << loaded.result.error().text();
        return loaded;
    }
    for (const Warning& w : loaded.result->assumptions) loaded.assumptions.push_back(w.message());
    return loaded;
}

using Lines = std::vector<std::string>;

TEST(Assumption, of_all_that_a_program_does_not_say_is_said) {
    const Loaded loaded = load("G21 G90\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X50\n");
    EXPECT_EQ(loaded.assumptions,
              (Lines{kToolless, stockless("-3 2 -5 53 8 0"), speedless(3), kMaterialless}));
    EXPECT_TRUE(loaded.result->is_program);
    EXPECT_EQ(loaded.job().stock.box_mm.min, (Vec3{-3, 2, -5}));
    EXPECT_EQ(loaded.job().stock.box_mm.max, (Vec3{53, 8, 0}));
    EXPECT_EQ(loaded.job().cutters.at(0).diameter_mm, 6);
    EXPECT_EQ(loaded.job().process.spindle_rpm, 10000);
    // They stand before all other warnings.
    for (std::size_t n = 0; n < loaded.assumptions.size(); ++n)
        EXPECT_EQ(loaded.result->warnings[n].message(), loaded.assumptions[n]);
}

TEST(Assumption, is_not_made_of_what_the_program_says) {
    const std::string program =
        "(T1 D=10. CR=0. - flat end mill)\nG21 G90 M3 S8000\nT1 M6\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X50\n";
    const Loaded loaded = load(program);
    ASSERT_EQ(loaded.assumptions.size(), 3u);
    EXPECT_EQ(
        loaded.assumptions[0],
        "p.nc:1: warning: tool T1 is taken from the program: flat D10; 2 flutes, helix 30 deg and 40 mm of "
        "edge are assumed; write --tool \"T1 flat 10 flutes 2\", or a [[cutter]] into a job, to say "
        "otherwise");
    EXPECT_EQ(loaded.assumptions[1], stockless("-5 0 -5 55 10 0"));
    EXPECT_EQ(loaded.assumptions[2], kMaterialless);
    const Loaded heidenhain = load(
        "0 BEGIN PGM A MM\n1 BLK FORM 0.1 Z X-10 Y-10 Z-20\n2 BLK FORM 0.2 X+60 Y+20 "
        "Z+0\n3 TOOL DEF 1 L+0 R+4\n4 TOOL CALL 1 Z S5000\n5 L X+0 Y+0 Z+5 FMAX M3\n"
        "6 L Z-2 F300\n7 L X+50\n8 END PGM A MM\n",
        {}, "p.nc");
    ASSERT_EQ(heidenhain.assumptions.size(), 3u);
    EXPECT_EQ(heidenhain.assumptions[1], "p.nc:3: warning: the stock is taken from the program (BLK FORM)");
    EXPECT_EQ(heidenhain.job().stock.box_mm.min, (Vec3{-10, -10, -20}));
    EXPECT_EQ(heidenhain.job().cutters.at(0).diameter_mm, 8);
}

TEST(Assumption, is_not_made_of_what_the_call_says) {
    ProgramInputs inputs;
    inputs.cutters = {*parse_tool_words("ball 8 flutes 3")};
    inputs.stock = *parse_stock_words("-10 -10 -20 60 20 0");
    inputs.material = "al6082-t6";
    inputs.process = {12000, 0};
    const Loaded loaded = load("G21 G90\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X50\n", inputs);
    EXPECT_EQ(loaded.assumptions, Lines{});
    EXPECT_EQ(loaded.job().cutters.at(0).kind, milling::CutterKind::ball);
    EXPECT_EQ(loaded.job().process.spindle_rpm, 12000);
    EXPECT_EQ(loaded.job().material.name, "al6082-t6");
    EXPECT_EQ(loaded.result->blank.volume_mm3, 70 * 30 * 20);
}

TEST(Assumption, of_several_tools_is_one_line) {
    const std::string program =
        "G21 G90\nT1 M6\nS9000 M3\nG0 X0 Y5 Z5\nG1 Z-2 F300\nT2 M6\nG1 X50\nT7 M6\nG1 Y10\nT2 M6\nG1 X0\n";
    const Loaded none = load(program);
    EXPECT_EQ(
        none.assumptions.at(0),
        "p.nc: warning: the tools T1, T2, T7 are not described: a flat end mill of 6 mm with 2 flutes is "
        "assumed for each; write --tool \"T1 flat 6 flutes 2\" and so on, or a [[cutter]] into a job");
    ProgramInputs inputs;
    inputs.cutters = {*parse_tool_words("T2 ball 4")};
    inputs.tool_table = "tool.tbl";
    const Loaded some = load(program, inputs);
    ASSERT_EQ(some.job().cutters.size(), 3u);
    EXPECT_EQ(some.job().cutters[0].diameter_mm, 4);
    EXPECT_EQ(some.job().cutters[1].diameter_mm, 8);
    EXPECT_TRUE(
        some.assumptions.at(0).starts_with("tool.tbl:1: warning: tool T1 is taken from the tool table"));
    EXPECT_TRUE(some.assumptions.at(1).starts_with("p.nc: warning: tool T7 is not described"));
    // One without a number stands for all.
    inputs = {};
    inputs.cutters = {*parse_tool_words("ball 4")};
    EXPECT_EQ(load(program, inputs).job().cutters.size(), 1u);
}

TEST(Assumption, takes_a_smaller_tool_where_the_usual_one_has_no_place) {
    // The way into the contour is 2 mm long; a radius of 1.5 mm is shorter.
    const std::string path = "G1 Z-2 F300\nG41 D2 X2\nG1 Y20\nX40\nG40 Y25\n";
    const Loaded small = load("G21 G90\nS9000 M3\nT2 M6\nG0 X0 Y0 Z5\n" + path);
    EXPECT_EQ(
        small.assumptions.at(0),
        "p.nc: warning: tool T2 is not described: a flat end mill of 3 mm with 2 flutes is assumed, since a "
        "larger one is refused at line 6 (the entry into compensation is 2 mm long, not longer than the "
        "cutter's radius of 3 mm); write --tool \"T2 flat 3 flutes 2\", or a [[cutter]] into a job");
    EXPECT_EQ(small.job().cutters.at(0).diameter_mm, 3);
    EXPECT_NEAR(small.result->program.moves.back().start.tip_mm.y, 20 + 1.5, 1e-12);
    // The tools that fit keep their size.
    const Loaded two =
        load("G21 G90\nS9000 M3\nT1 M6\nG0 X0 Y0 Z5\nG1 Z-1 F300\nX50\nG0 Z5\nT2 M6\nX0 Y0\n" + path);
    ASSERT_EQ(two.job().cutters.size(), 2u);
    EXPECT_EQ(two.job().cutters[0].diameter_mm, 6);
    EXPECT_EQ(two.job().cutters[1].diameter_mm, 3);
    EXPECT_TRUE(two.assumptions.at(0).starts_with(
        "p.nc: warning: tool T1 is not described: a flat end mill of 6 mm"));
    EXPECT_TRUE(two.assumptions.at(1).starts_with(
        "p.nc: warning: tool T2 is not described: a flat end mill of 3 mm"));
    // A tool that the program describes is not made smaller, and there is an end.
    for (const char* start : {"(T2 D=6. CR=0. - flat end mill)\nG21 G90\nT2 M6\nG0 X0 Y0 Z5\n",
                              "G21 G90\nT2 M6\nG0 X1.95 Y0 Z5\n"}) {
        MemorySource files;
        files.put("p.nc", start + path);
        const auto refused = load_job(files, "p.nc", {});
        ASSERT_FALSE(refused.has_value()) << start;
        EXPECT_NE(refused.error().text().find("the entry into compensation"), std::string::npos);
    }
}

TEST(Assumption, places_a_block_of_a_given_size_on_the_path) {
    ProgramInputs inputs;
    inputs.stock = *parse_stock_words("80 60 20");
    const Loaded loaded = load("G21 G90 M3 S9000\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X50\n", inputs);
    EXPECT_EQ(loaded.job().stock.box_mm.min, (Vec3{-15, -25, -20}));
    EXPECT_EQ(loaded.job().stock.box_mm.max, (Vec3{65, 35, 0}));
    EXPECT_EQ(
        loaded.assumptions.at(1),
        "p.nc: warning: the place of the stock is not given: its middle is assumed on that of the path; "
        "write --stock \"-15 -25 -20 65 35 0\" (two corners, mm), or [stock] into a job");
    // Also where the program declares another.
    const Loaded heidenhain = load(
        "0 BEGIN PGM A MM\n1 BLK FORM 0.1 Z X-10 Y-10 Z-20\n2 BLK FORM 0.2 X+60 Y+20 "
        "Z+0\n3 TOOL CALL 1 Z S5000\n4 L X+0 Y+0 Z+5 FMAX M3\n"
        "5 L Z-2 F300\n6 L X+50\n7 END PGM A MM\n",
        inputs);
    EXPECT_EQ(heidenhain.job().stock.box_mm.size(), (Vec3{80, 60, 20}));
}

TEST(Assumption, reads_inches_as_the_program_has_them) {
    const Loaded loaded =
        load("(T1 D=0.25 CR=0)\nG20 G90 M3 S9000\nT1 M6\nG0 X0 Y0 Z0.2\nG1 Z-0.1 F20\nG1 X2\n");
    EXPECT_NEAR(loaded.job().cutters.at(0).diameter_mm, 6.35, 1e-12);
    // x: 0 - 3.175 to 50.8 + 3.175, rounded outwards; z: -2.54 - 3, rounded down.
    EXPECT_EQ(loaded.job().stock.box_mm.min, (Vec3{-4, -4, -6}));
    EXPECT_EQ(loaded.job().stock.box_mm.max, (Vec3{54, 4, 0}));
}

TEST(Assumption, of_a_feed_is_said_with_its_line) {
    const Loaded gcode = load("G21 G90 M3 S9000\nG0 X0 Y0 Z5\nG1 Z-2\nG1 X50\n");
    EXPECT_EQ(gcode.result->program.moves.back().feed_mm_per_min, 600);
    EXPECT_NE(gcode.result->program.warnings.at(0).message().find(
                  "p.nc:3: warning: no feed rate so far: 600 mm/min is taken; write F before it, or another "
                  "feed_mm_per_min"),
              std::string::npos);
    const Loaded keyframes = load("x,y,z,i,j,k\n0,0,-1,0,0,1\n50,0,-1,0,0,1\n", {}, "k.csv");
    bool said = false;
    for (const std::string& line : keyframes.assumptions)
        said = said || line.find("keyframes without a feed run at 600 mm/min") != std::string::npos;
    EXPECT_TRUE(said);
    ProgramInputs inputs;
    inputs.process.feed_mm_per_min = 250;
    const Loaded given = load("x,y,z,i,j,k\n0,0,-1,0,0,1\n50,0,-1,0,0,1\n", inputs, "k.csv");
    EXPECT_EQ(given.result->program.moves.back().feed_mm_per_min, 250);
    for (const std::string& line : given.assumptions) EXPECT_EQ(line.find("feed"), std::string::npos) << line;
}

TEST(Assumption, refuses_a_program_that_cuts_nothing) {
    MemorySource files;
    files.put("p.nc", "G21 G90\nG0 X0 Y5 Z5\nG0 X50\n");
    EXPECT_EQ(
        load_job(files, "p.nc").error().text(),
        "p.nc: error: the program has no feed move: there is nothing to mill; check that it is the right "
        "program; tribo inspect says what it holds");
}

TEST(Assumption, refuses_a_block_that_no_job_could_hold) {
    MemorySource files;
    files.put("p.nc", "G21 G90\nG0 X0 Y5 Z5\nG1 X200000 Z-2 F300\n");
    EXPECT_EQ(
        load_job(files, "p.nc").error().text(),
        "p.nc: error: in the assumed block the edge of a box of 200006 mm is out of range; check the unit of "
        "the program; write --stock, or [stock] into a job");
    ProgramInputs inputs;
    inputs.stock = *parse_stock_words("0 0 -10 100 10 0");
    EXPECT_TRUE(load_job(files, "p.nc", {.program = inputs}));
}

TEST(Assumption, refuses_inputs_that_do_not_belong_to_the_kind_of_program) {
    MemorySource files;
    files.put("k.csv", "x,y,z,i,j,k\n0,0,-1,0,0,1\n50,0,-1,0,0,1\n");
    files.put("p.nc", "G21 G90\nG0 X0 Y5 Z5\nG1 X50 A5 F100\n");
    ProgramInputs machine, dialect, table;
    machine.machine = "xyzac-trt";
    dialect.dialect = readers::Dialect::fanuc;
    table.tool_table = "tool.tbl";
    EXPECT_EQ(
        load_job(files, "k.csv", {.program = machine}).error().text(),
        "k.csv: error: a machine belongs to G-code: other paths hold the tool's axis already; leave the "
        "machine out");
    EXPECT_EQ(load_job(files, "k.csv", {.program = dialect}).error().text(),
              "k.csv: error: a dialect belongs to G-code; leave the dialect out");
    EXPECT_EQ(load_job(files, "k.csv", {.program = table}).error().text(),
              "k.csv: error: a tool table belongs to a program: keyframes call no tool; describe the tool in "
              "words, as in 'flat 6'");
    machine.machine = "xyzac-trd";
    EXPECT_NE(load_job(files, "p.nc", {.program = machine}).error().text().find("try 'xyzac-trt'"),
              std::string::npos);
}

// The written job, read again, has the same inputs, and reads the program to the same moves.
TEST(Assumption, can_be_written_as_a_job_that_gives_the_same_run) {
    const std::string moves = "G0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X50\n";
    const std::string compensated =
        "G21 G90\nT1 M6\nG0 X-20 Y-20 Z5\nG1 Z-2 F300\nG41 D1 X-10 Y0\nG1 X50\nG1 Y30\nG40 X70 Y50\n";
    ProgramInputs all;
    all.cutters = {*parse_tool_words("T1 bull 10 corner 0.5 flutes 3 helix 35.5 length 33 core 1"),
                   *parse_tool_words("T2 ball 0.1")};
    all.stock = *parse_stock_words("-12.7 -10 -1/3 60 20 0");
    all.material = "steel";
    all.machine = "xyzac-trt";
    all.dialect = readers::Dialect::fanuc;
    all.process = {1234.5, 99.9};
    all.tool_table = "tool.tbl";
    ProgramInputs one;
    one.cutters = {*parse_tool_words("flat 8")};
    const std::tuple<std::string, std::string, ProgramInputs> cases[] = {
        {"p.nc", "G21 G90\n" + moves, {}},
        {"p.nc", "G20 G90\n(T1 D=0.25 CR=0.05)\nT1 M6\n" + moves, {}},
        {"a name \"with\" quotes.nc", "G21 G90\nT1 M6\n" + moves + "T2 M6\nG1 X0\nA5\n", all},
        {"p.nc", compensated, one},
        {"Fräse.nc", "(T1 D=0.25 CR=0.05)\nG20 G90 T1 M6\n" + moves, {}},
        {"k.csv", "x,y,z,i,j,k\n0,0,-1,0,0,1\n50,0,-1,0,0,1\n50,20,-1,0,0,1\n", {}},
        {"p.apt", "UNITS/MM\nCUTTER/8,1\nFEDRAT/600,MMPM\nGOTO/0,0,-5\nGOTO/10,0,-5\n", {}},
    };
    for (const auto& [name, program, inputs] : cases) {
        SCOPED_TRACE(name + "\n" + program);
        MemorySource files;
        files.put(name, program);
        files.put("tool.tbl", "T1 P1 D8 Z50 ;\nT2 P2 D4 Z50 ;\n");
        const auto direct = load_job(files, name, {.program = inputs});
        ASSERT_TRUE(direct) << direct.error().text();
        const std::string text = job_text(*direct, [](const std::string& file) { return file; });
        for (const Warning& w : direct->assumptions)
            EXPECT_NE(text.find("# - " + w.text + "\n"), std::string::npos) << w.text;
        files.put("job.toml", text);
        const auto again = load_job(files, "job.toml");
        ASSERT_TRUE(again) << again.error().text() << "\n" << text;
        EXPECT_FALSE(again->is_program);
        const Job &a = direct->job, &b = again->job;
        EXPECT_EQ(a.stock.box_mm.min, b.stock.box_mm.min);
        EXPECT_EQ(a.stock.box_mm.max, b.stock.box_mm.max);
        EXPECT_EQ(a.material.name, b.material.name);
        EXPECT_EQ(a.process.spindle_rpm, b.process.spindle_rpm);
        EXPECT_EQ(a.process.feed_mm_per_min, b.process.feed_mm_per_min);
        EXPECT_EQ(a.path.kind, b.path.kind);
        EXPECT_EQ(a.path.dialect, b.path.dialect);
        EXPECT_EQ(a.machine.kinematics.has_value(), b.machine.kinematics.has_value());
        EXPECT_EQ(a.machine.rapid_mm_per_min, b.machine.rapid_mm_per_min);
        ASSERT_EQ(a.cutters.size(), b.cutters.size());
        for (std::size_t n = 0; n < a.cutters.size(); ++n) {
            EXPECT_EQ(tool_words(a.cutters[n]), tool_words(b.cutters[n]));
            EXPECT_EQ(a.cutters[n].length_mm, b.cutters[n].length_mm);
        }
        ASSERT_EQ(direct->program.moves.size(), again->program.moves.size());
        for (std::size_t n = 0; n < direct->program.moves.size(); ++n) {
            EXPECT_EQ(direct->program.moves[n].end, again->program.moves[n].end);
            EXPECT_EQ(direct->program.moves[n].feed_mm_per_min, again->program.moves[n].feed_mm_per_min);
            EXPECT_EQ(direct->program.moves[n].tool, again->program.moves[n].tool);
        }
    }
}

}  // namespace
}  // namespace tribo::job
