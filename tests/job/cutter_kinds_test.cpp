// SPDX-License-Identifier: MIT
// Every kind of cutter in words, in job files and as a program declares it.
#include <gtest/gtest.h>

#include "job/completion.hpp"
#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"
#include "job/toml/job_writer.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

using milling::Cutter;
using milling::CutterKind;

const std::pair<const char*, const char*> kCutters[] = {
    {"taper 6 tip 1 corner 0.5 angle 5 length 30",
     "kind = \"taper\"\ndiameter_mm = 6\ntip_mm = 1\ncorner_mm = 0.5\ntaper_deg = 5\nlength_mm = 30\n"},
    {"v 6 point 60", "kind = \"v\"\ndiameter_mm = 6\npoint_deg = 60\n"},
    {"T3 drill 8 point 140 core 1",
     "number = 3\nkind = \"drill\"\ndiameter_mm = 8\npoint_deg = 140\ncore_mm = 1\n"},
    {"chamfer 10 tip 2", "kind = \"chamfer\"\ndiameter_mm = 10\ntip_mm = 2\n"},
    {"countersink 10", "kind = \"countersink\"\ndiameter_mm = 10\n"},
    {"dovetail 12 angle 30 height 4 corner 0.2",
     "kind = \"dovetail\"\ndiameter_mm = 12\ntaper_deg = 30\nheight_mm = 4\ncorner_mm = 0.2\n"},
    {"lens 10 side 20 corner 1", "kind = \"lens\"\ndiameter_mm = 10\nside_mm = 20\ncorner_mm = 1\n"},
    {"barrel 10 side 80 corner 2 length 20",
     "kind = \"barrel\"\ndiameter_mm = 10\nside_mm = 80\ncorner_mm = 2\nlength_mm = 20\n"},
    {"lollipop 8 neck 4 flutes 4", "kind = \"lollipop\"\ndiameter_mm = 8\nneck_mm = 4\nflutes = 4\n"},
    {"thread 8 neck 6 point 55", "kind = \"thread\"\ndiameter_mm = 8\nneck_mm = 6\npoint_deg = 55\n"},
    {"engraver 3.175 tip 0.2 point 30 helix 10",
     "kind = \"engraver\"\ndiameter_mm = 3.175\ntip_mm = 0.2\npoint_deg = 30\nhelix_deg = 10\n"},
};

std::string job_with(const std::string& cutter) {
    return "[stock]\nbox_mm = [[0, 0, -10], [20, 20, 0]]\n[cutter]\n" + cutter +
           "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 6000\nfeed_mm_per_min = 600\n[path]\n"
           "gcode = \"p.nc\"\n";
}

FileResult<Cutter> read_toml(const std::string& cutter) {
    const auto job = parse_job(job_with(cutter), "job.toml", MemorySource());
    if (!job) return std::unexpected(job.error());
    return job->cutters.at(0);
}

void expect_same(const Cutter& a, const Cutter& b, const std::string& words) {
    EXPECT_EQ(a.kind, b.kind) << words;
    EXPECT_EQ(a.number, b.number) << words;
    EXPECT_EQ(a.flutes, b.flutes) << words;
    EXPECT_EQ(a.helix_deg, b.helix_deg) << words;
    EXPECT_EQ(a.length_mm, b.length_mm) << words;
    EXPECT_EQ(a.core_mm, b.core_mm) << words;
    EXPECT_EQ(a.profile, b.profile) << words;
}

TEST(CutterKinds, are_the_same_in_words_and_in_a_job_and_are_written_back) {
    for (const auto& [words, toml] : kCutters) {
        const auto by_words = parse_tool_words(words);
        ASSERT_TRUE(by_words) << words << ": " << by_words.error().text();
        const auto by_job = read_toml(toml);
        ASSERT_TRUE(by_job) << by_job.error().text();
        expect_same(*by_words, *by_job, words);
        const auto again = parse_tool_words(tool_words(*by_words));
        ASSERT_TRUE(again) << tool_words(*by_words) << again.error().text();
        expect_same(*by_words, *again, words);
        LoadedJob loaded;
        loaded.job = *parse_job(job_with(toml), "job.toml", MemorySource());
        const auto written = parse_job(job_text(loaded, [](const std::string& path) { return path; }),
                                       "job.toml", MemorySource());
        ASSERT_TRUE(written) << written.error().text();
        expect_same(*by_words, written->cutters.at(0), words);
    }
}

TEST(CutterKinds, of_a_drawn_profile_are_read_and_written) {
    const std::string toml = "profile = [[2, 0], [2, 3, -0.25], [4, 5], [5, 5], [5, 12]]\n";
    const auto cutter = read_toml(toml);
    ASSERT_TRUE(cutter) << cutter.error().text();
    EXPECT_EQ(cutter->kind, CutterKind::profile);
    EXPECT_EQ(cutter->diameter_mm, 10);
    EXPECT_EQ(cutter->length_mm, 12);
    ASSERT_EQ(cutter->profile.size(), 5U);
    EXPECT_EQ(cutter->profile[1], (milling::ProfileVertex{2, 3, -0.25}));
    LoadedJob loaded;
    loaded.job = *parse_job(job_with(toml), "job.toml", MemorySource());
    const auto written =
        parse_job(job_text(loaded, [](const std::string& path) { return path; }), "job.toml", MemorySource());
    ASSERT_TRUE(written) << written.error().text();
    expect_same(*cutter, written->cutters.at(0), toml);
}

TEST(CutterKinds, that_cannot_be_are_refused_at_their_key) {
    const std::pair<const char*, const char*> cases[] = {
        {"kind = \"v\"\ndiameter_mm = 6\n",
         "job.toml:3:1: error: cutter point_deg of a v is missing; add point_deg"},
        {"kind = \"v\"\ndiameter_mm = 6\npoint_deg = 60\nside_mm = 3\n",
         "job.toml:7:11: error: a v cutter has no 'side_mm'; remove it"},
        {"kind = \"lollipop\"\ndiameter_mm = 6\nneck_mm = 3\nlength_mm = 20\n", "leave length_mm out"},
        {"kind = \"dovetail\"\ndiameter_mm = 6\ntaper_deg = 60\nheight_mm = 4\n",
         "job.toml:7:13: error: cutter height_mm"},
        {"kind = \"flat\"\ndiameter_mm = 6\nprofile = [[1, 0], [1, 2]]\n", "a flat cutter has no 'profile'"},
        {"kind = \"profile\"\n", "cutter profile is missing"},
        {"profile = [[1, 0], [2]]\n", "'profile' must be at most 200 vertices"},
        {"profile = 3\n", "'profile' must be at most 200 vertices"},
        {"profile = [[1, 0], [nan, 2]]\n", "profile"},
        {"profile = [[1, 0], [-1, 2]]\n", "0 to 1000"},
        {"diameter_mm = 4\nprofile = [[1, 0], [1, 2]]\n", "a profile says its diameter itself"},
        {"profile = [[1, 0], [3, 2], [2, 1]]\n", "job.toml:4:11: error: cutter profile has a vertex 3 below"},
    };
    for (const auto& [toml, text] : cases) {
        const auto cutter = read_toml(toml);
        ASSERT_FALSE(cutter) << toml;
        EXPECT_NE(cutter.error().text().find(text), std::string::npos) << cutter.error().text();
    }
    std::string many = "profile = [[1, 0]";
    for (int n = 1; n < 10'000; ++n) many += ", [1, " + std::to_string(0.01 * n) + "]";
    EXPECT_FALSE(read_toml(many + "]\n"));
}

TEST(CutterKinds, of_a_declared_tool_are_made_into_a_cutter) {
    motion::Program program;
    program.source = "p.nc";
    motion::Move move;
    move.end.tip_mm = {1, 0, 0};
    move.tool = 4;
    program.moves = {move};
    program.tools = {
        {.number = 4, .diameter_mm = 8, .line = 2, .flutes = 2, .kind = "drill", .point_deg = 118}};
    Job job;
    job.stock.box_mm = {{0, 0, -5}, {5, 5, 0}};
    Warnings warnings;
    const auto done = take_declared_tools(job, program, warnings);
    ASSERT_TRUE(done) << done.error().text();
    ASSERT_EQ(job.cutters.size(), 1U);
    EXPECT_EQ(job.cutters[0].kind, CutterKind::drill);
    EXPECT_EQ(job.cutters[0].profile.size(), 2U);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].text.find("drill D8 point 118"), std::string::npos) << warnings[0].text;
    program.tools[0].kind = "reamer";
    job.cutters.clear();
    EXPECT_FALSE(take_declared_tools(job, program, warnings));
}

}  // namespace
}  // namespace tribo::job
