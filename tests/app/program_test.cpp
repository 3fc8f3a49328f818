// SPDX-License-Identifier: MIT
// A program in place of a job, from outside: the flags, what is assumed and said, and the job that --job-out
// writes.
#include "app/run/program.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>

#include "app/run/live_viewer.hpp"

namespace tribo::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kSlotText = "G21 G90\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X12\n";

Outcome render(const Scratch& folder, const std::string& input, std::vector<std::string> more,
               const std::string& out = "out") {
    std::vector<std::string> arguments{"render", input, "--out", out, "--resolution", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tribo(arguments, folder.path());
}

Json summary(const Scratch& folder, const std::string& out = "out") {
    return Json::parse(folder.get(out + "/summary.json"));
}

TEST(Program, alone_is_milled_and_every_assumption_is_said) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    const Outcome outcome = render(folder, "p.nc", {"--only", "summary,report"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string lines[] = {
        "p.nc: warning: the tool is not described: a flat end mill of 6 mm with 2 flutes is assumed; write "
        "--tool \"flat 6 flutes 2\", or a [[cutter]] into a job",
        "p.nc: warning: no stock is described: a block around the path is assumed; write --stock "
        "\"-3 2 -5 15 8 0\" (two corners, mm), or [stock] into a job",
        "p.nc:3: warning: no spindle speed so far: 10000 rpm are assumed; write an S word, --spindle-rpm, or "
        "spindle_rpm into [process] of a job",
        "p.nc: warning: no material is given: al7075-t6 is assumed; write --material NAME, or [material] "
        "into a "
        "job",
    };
    const Json said = summary(folder)["warnings"];
    const std::string report = folder.get("out/report.html");
    for (const std::string& line : lines) {
        EXPECT_NE(outcome.err.find(line + "\n"), std::string::npos) << line << "\n" << outcome.err;
        EXPECT_NE(std::find(said.begin(), said.end(), line), said.end()) << line;
        // The report holds the text of each line, as HTML.
        EXPECT_NE(report.find(line.substr(0, line.find('"'))), std::string::npos) << line;
    }
    // A slot of 6 mm from x = 0 to 12, 2 mm deep, within y = 2 to 8: a rectangle and both half circles.
    EXPECT_NEAR(summary(folder)["removed_mm3"], 2 * (12 * 6 + 3.14159265 * 9), 1.5);
    EXPECT_EQ(summary(folder)["job"], "p.nc");
    EXPECT_FALSE(summary(folder).contains("stock_record"));
}

TEST(Program, and_the_job_that_stands_for_it_give_the_same_forces) {
    const Scratch folder;
    fs::create_directories(folder / "jobs");
    const std::string two_tools =
        "G21 G90 M3 S9000\nT1 M6\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X12\nG0 Z5\n"
        "T2 M6\nG0 X0 Y5\nG1 Z-3 F200\nG1 X12\n";
    const std::string inch = "(T3 D=0.25 CR=0.03)\nG20 G90 T3 M6\nG0 X0 Y0 Z0.2\nG1 Z-0.1 F20\nG1 X0.5\n";
    const std::string compensated =
        "G21 G90 M3 S9000 T1 M6\nG0 X-20 Y-20 Z-1\nG41 D1 G1 X-10 Y0 F600\nG1 X12\nG1 Y12\nG40 X20 Y20\n";
    const struct {
        std::string name, program;
        std::vector<std::string> flags;
    } cases[] = {
        {"p.nc", kSlotText, {}},
        {"p.nc",
         kSlotText,
         {"--tool", "ball 4", "--stock", "20 12 6", "--material", "steel", "--spindle-rpm", "7000"}},
        {"p.nc", two_tools, {"--tool", "T2 bull 4 corner 0.5", "--tool", "T1 flat 1/4in 3 flutes"}},
        {"p.nc", inch, {}},
        {"p.nc", compensated, {"--tool", "flat 5", "--stock", "-6 -6 -3 20 20 0"}},
        {"k.csv", "x,y,z,i,j,k\n0,0,-1,0,0,1\n9,0,-1,0,0,1\n9,5,-1,0,0,1\n", {}},
        {"p.h",
         "0 BEGIN PGM A MM\n1 BLK FORM 0.1 Z X-5 Y-5 Z-5\n2 BLK FORM 0.2 X+20 Y+15 Z+0\n"
         "3 TOOL CALL 1 Z S5000\n4 L X+0 Y+5 Z+5 FMAX M3\n5 L Z-2 F300\n6 L X+12\n7 END PGM A MM\n",
         {}},
        {"p.apt", "UNITS/MM\nCUTTER/8,1\nFEDRAT/600,MMPM\nGOTO/0,0,5\nGOTO/0,0,-2\nGOTO/10,0,-2\n", {}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name + "\n" + c.program);
        folder.put(c.name, c.program);
        fs::remove(folder / "jobs/j.toml");
        std::vector<std::string> flags = c.flags;
        flags.insert(flags.end(), {"--only", "forces", "--job-out", "jobs/j.toml"});
        const Outcome direct = render(folder, c.name, flags);
        ASSERT_EQ(direct.code, 0) << direct.err;
        const Outcome job = render(folder, "jobs/j.toml", {"--only", "forces"}, "again");
        ASSERT_EQ(job.code, 0) << job.err << folder.get("jobs/j.toml");
        const std::string forces = folder.get("out/forces.csv");
        EXPECT_GT(std::count(forces.begin(), forces.end(), '\n'), 5);
        EXPECT_EQ(forces, folder.get("again/forces.csv")) << folder.get("jobs/j.toml");
        EXPECT_EQ(summary(folder)["stock_record"]["job"], "../jobs/j.toml");
        for (const auto& line : summary(folder, "again")["warnings"])
            EXPECT_EQ(line.get<std::string>().find("is assumed"), std::string::npos) << line;
    }
}

TEST(Program, of_two_tools_with_one_in_the_call_says_that_it_stands_in) {
    const Scratch folder;
    const std::string one = "G21 G90 M3 S9000\nT4 M6\nG0 X0 Y5 Z5\nG1 Z-2 F300\nG1 X12\n";
    folder.put("one.nc", one);
    folder.put("two.nc", one + "G0 Z5\nT2 M6\nG1 X0 Z-3\n");
    const Outcome alone = render(folder, "one.nc", {"--tool", "flat 6", "--only", "summary"});
    ASSERT_EQ(alone.code, 0) << alone.err;
    EXPECT_NE(
        alone.err.find("one.nc:4: warning: tool T4 is not described; the only cutter stands in for it\n"),
        std::string::npos)
        << alone.err;
    const Outcome both = render(folder, "two.nc", {"--tool", "flat 6", "--only", "summary"});
    ASSERT_EQ(both.code, 0) << both.err;
    EXPECT_NE(
        both.err.find("two.nc:8: warning: tool T2 is not described; the only cutter stands in for it as for "
                      "T4\n"),
        std::string::npos)
        << both.err;
}

TEST(Program, leaves_a_stock_to_another_job_only_with_a_job_of_its_own) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("next.toml",
               "[stock]\nfrom = \"out\"\n[cutter]\nkind = \"flat\"\ndiameter_mm = 3\n[material]\nname = "
               "\"steel\"\n[process]\nspindle_rpm = 5000\n[path]\ngcode = \"p.nc\"\n");
    ASSERT_EQ(render(folder, "p.nc", {"--only", "summary"}).code, 0);
    const Outcome refused = render(folder, "next.toml", {"--only", "summary"}, "second");
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("was rendered from a program without a job"), std::string::npos)
        << refused.err;
    ASSERT_EQ(render(folder, "p.nc", {"--only", "summary", "--job-out", "first.toml"}).code, 0);
    const Outcome next = render(folder, "next.toml", {"--only", "summary"}, "second");
    EXPECT_EQ(next.code, 0) << next.err;
}

TEST(Program, with_wrong_flags_is_refused_with_the_remedy) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("slot.toml",
               "[stock]\nbox_mm = [[0, 0, -10], [30, 20, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 6\n"
               "[material]\nname = \"steel\"\n[process]\nspindle_rpm = 5000\n[path]\ngcode = \"p.nc\"\n");
    const std::pair<std::vector<std::string>, std::string> cases[] = {
        {{"--tool", "flta 6"}, "error: --tool 'flta 6': 'flta' is no word of a tool; try 'flat'\n"},
        {{"--tool", "flat 6", "--tool", "ball 4"},
         "error: --tool 'ball 4': one of several tools has no number; write T and the number by which the "
         "program calls it, as in 'T1 flat 6 flutes 2'\n"},
        {{"--tool", "T1 flat 6", "--tool", "T1 ball 4"},
         "error: --tool 'T1 ball 4': two tools have the same number; give each its own\n"},
        {{"--stock", "80 60"},
         "error: --stock '80 60': a block has 3 numbers (its size) or 6 (two corners), and these are 2; "
         "write a "
         "size, as in '80 60 20', two corners, or the name of a model\n"},
        {{"--stock", "gone.stl"}, "gone.stl: error: cannot read: No such file or directory"},
        {{"--stock", ""}, "error: --stock: is empty; leave it out, or write a value"},
        {{"--material", "stel"}, "error: --material 'stel': "},
        {{"--machine", "xyzac-trd"}, "there is no machine 'xyzac-trd'; try 'xyzac-trt'"},
        {{"--dialect", "fanuk"}, "try 'fanuc'"},
        {{"--tols", "flat 6"}, "error: unknown option '--tols'; try '--tool'\n"},
        {{"--job-out", "job.txt"}, "error: --job-out 'job.txt': a job is named .toml; try job.txt.toml\n"},
        {{"--job-out", "slot.toml"},
         "error: --job-out 'slot.toml': is there already, and says something else; remove it, or name "
         "another "
         "file\n"},
    };
    for (const auto& [flags, error] : cases) {
        const Outcome outcome = render(folder, "p.nc", flags);
        EXPECT_EQ(outcome.code, 2) << flags[1];
        EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(folder / "out")) << flags[1];
    }
    const Outcome job = render(folder, "slot.toml", {"--tool", "flat 6"});
    EXPECT_EQ(job.code, 2);
    EXPECT_EQ(job.err,
              "slot.toml: error: --tool belongs to a program, and this is a job; change the job, or "
              "name its program: p.nc\n");
    const Outcome live = run_tribo({"live", "--tool", "flat 6"}, folder.path());
    EXPECT_EQ(live.code, 2);
    EXPECT_EQ(live.err, "error: --tool belongs to a program, and none is named; name the program\n");
    folder.put("note.txt", "buy milk\n");
    const Outcome note = render(folder, "note.txt", {});
    EXPECT_EQ(note.code, 2);
    EXPECT_TRUE(note.err.starts_with("note.txt: error: is neither a job nor a program: it looks like a text"))
        << note.err;
    folder.put("turned.nc", "G21 G90 M3 S1000\nG0 X0 Y0 Z0 A0\nG1 X5 A5 F100\n");
    const Outcome rotary = render(folder, "turned.nc", {});
    EXPECT_EQ(rotary.code, 2);
    EXPECT_NE(rotary.err.find("--machine NAME"), std::string::npos) << rotary.err;
    EXPECT_EQ(render(folder, "turned.nc", {"--machine", "xyza", "--only", "summary"}).code, 0);
}

TEST(Program, is_read_from_a_pipe_and_under_any_name) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("odd.ending", kSlotText);
    ASSERT_EQ(render(folder, "p.nc", {"--only", "forces"}).code, 0);
    ASSERT_EQ(render(folder, "odd.ending", {"--only", "forces"}, "odd").code, 0);
    EXPECT_EQ(folder.get("out/forces.csv"), folder.get("odd/forces.csv"));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const auto into_the_pipe = [&] { return std::jthread([&] { folder.put("pipe", kSlotText); }); };
    {
        const auto writer = into_the_pipe();
        const Outcome outcome = render(folder, "pipe", {"--only", "forces"}, "piped");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    EXPECT_EQ(folder.get("out/forces.csv"), folder.get("piped/forces.csv"));
    // Standard input, which is a device here.
    EXPECT_EQ(render(folder, "-", {}, "none").err,
              "/dev/stdin: error: is a device, not a file; name a file\n");
    {
        const auto writer = into_the_pipe();
        const Outcome outcome = render(folder, "pipe", {"--only", "forces", "--job-out", "j.toml"}, "more");
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.err,
                  "error: --job-out 'j.toml': a job cannot name pipe, which is no file; save the "
                  "program to a file first\n");
    }
}

TEST(Program, can_be_felt) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,6,5,1\n0.2,6,5,-2.2\n0.4,6,5,1\n");
    const Outcome felt = run_tribo({"feel", "p.nc", "--tool", "flat 6", "--stroke", "stroke.csv", "--out",
                                    "trace.csv", "--device", "playback", "--resolution", "0.5"},
                                   folder.path());
    ASSERT_EQ(felt.code, 0) << felt.err;
    EXPECT_NE(felt.err.find("no stock is described"), std::string::npos) << felt.err;
    EXPECT_NE(felt.out.find("in contact"), std::string::npos) << felt.out;
    folder.put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome model = run_tribo(
        {"feel", "a.obj", "--tool", "flat 6", "--stroke", "stroke.csv", "--out", "t.csv"}, folder.path());
    EXPECT_EQ(model.code, 2);
    EXPECT_EQ(model.err,
              "a.obj: error: --tool belongs to a program, and this is a model; leave the flag out\n");
}

TEST(Program, is_shown_live) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("web/index.html", "<!doctype html>");
    RunningTribo live({"live", "p.nc", "--port", "0", "--device", "simulated", "--web-root", folder / "web",
                       "--job-out", "j.toml"},
                      folder.path());
    EXPECT_NE(live.out_with("http://").find("http://"), std::string::npos) << live.err();
    EXPECT_NE(live.err().find("no stock is described"), std::string::npos) << live.err();
    EXPECT_NE(folder.get("j.toml").find("# The job that stands for p.nc.\n"), std::string::npos);
    EXPECT_EQ(live.stop().code, 130);
}

TEST(Program, of_a_live_cut_may_be_wrong_for_a_while) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("index.html", "<p>page");
    RunningTribo live(
        {"live", "p.nc", "--resolution", "0.5", "--port", "0", "--web-root", ".", "--job-out", "j.toml"},
        folder.path());
    Viewer viewer(address_in(live.out_with("Ctrl-C")).port);
    ASSERT_TRUE(viewer.step_back());
    const std::string job = folder.get("j.toml");
    for (const auto& [text, says] :
         {std::pair{"G21 G90\nG0 X0 Y5 Z5\nG1 Zx-2\n", R"("line":3)"},
          std::pair{"G21 G90\nG0 X0 Y5 Z5\n", "no feed move"}, std::pair{"[stock]\nbox_mm = 5\n", "p.nc"}}) {
        SCOPED_TRACE(text);
        folder.put("p.nc", text);
        ASSERT_TRUE(viewer.step_back());
        // Who comes now is told.
        Viewer latecomer(address_in(live.out_with("Ctrl-C")).port);
        const std::string said = latecomer.text_with(R"("files")");
        EXPECT_NE(said.find(says), std::string::npos) << said;
        folder.put("p.nc", kSlotText);
        ASSERT_TRUE(viewer.step_back());
        EXPECT_NE(latecomer.text_with(R"("files")").find(R"("wrong":null)"), std::string::npos);
    }
    // A longer program is milled in a longer block; the job of the first stays.
    folder.put("p.nc", std::string(kSlotText) + "G1 X40\n");
    ASSERT_TRUE(viewer.step_back());
    EXPECT_TRUE(viewer.say(R"({"op":"seek","t_s":6})") && viewer.state(true, 6));
    EXPECT_EQ(folder.get("j.toml"), job);
    const Outcome end = live.stop();
    EXPECT_EQ(end.code, 130);
    EXPECT_NE(end.err.find("the cut before goes on"), std::string::npos) << end.err;
}

TEST(Program, is_not_replaced_by_its_job_or_a_result) {
    const Scratch folder;
    folder.put("p.nc", kSlotText);
    folder.put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,6,5,1\n0.2,6,5,1\n");
    fs::create_hard_link(folder / "p.nc", folder / "p.toml");
    const Outcome over = render(folder, "p.nc", {"--job-out", "p.toml"});
    EXPECT_EQ(over.code, 2);
    EXPECT_EQ(
        over.err.substr(over.err.rfind("p.toml")),
        "p.toml: error: is an input of this run and would be replaced; name another file for the output\n");
    EXPECT_EQ(folder.get("p.nc"), kSlotText);
    // Nor is a job written that could not name it.
    const std::string odd = "p\xff\x1b.nc";
    folder.put(odd, kSlotText);
    const Outcome unnamed = render(folder, odd, {"--job-out", "odd.toml"});
    EXPECT_EQ(unnamed.code, 2);
    EXPECT_NE(unnamed.err.find("a job cannot name p\\xff\\x1b.nc: not all of it is text; rename it first"),
              std::string::npos)
        << unnamed.err;
    const Outcome twice = run_tribo(
        {"feel", "p.nc", "--stroke", "stroke.csv", "--out", "a.toml", "--job-out", "a.toml"}, folder.path());
    EXPECT_EQ(twice.code, 2);
    EXPECT_NE(twice.err.find("a.toml: error: is named for two outputs"), std::string::npos) << twice.err;
    EXPECT_FALSE(fs::exists(folder / "a.toml"));
}

}  // namespace
}  // namespace tribo::test
