// SPDX-License-Identifier: MIT
#include "job/completion.hpp"

#include <gtest/gtest.h>

namespace tribo::job {
namespace {

motion::Program program_with_tools(std::initializer_list<int> numbers) {
    motion::Program program;
    program.source = "p.h";
    for (const int number : numbers) {
        motion::Move move;
        move.tool = number;
        program.moves.push_back(move);
    }
    return program;
}

milling::Cutter cutter(int number, double diameter_mm) {
    milling::Cutter c;
    c.number = number;
    c.diameter_mm = diameter_mm;
    return c;
}

job::Job job_with_stock() {
    job::Job job;
    job.file = "j.toml";
    job.stock.box_mm = {{0, 0, 0}, {1, 1, 1}};
    return job;
}

TEST(JobCompletion, takes_stick_out_shank_and_holder_of_a_library) {
    motion::Program program = program_with_tools({1, 2});
    motion::DeclaredTool tool{.number = 1, .diameter_mm = 10, .line = 1, .table = "t.json"};
    tool.stickout_mm = 30;
    tool.shank_mm = 8;
    tool.holder = {{20, 15}, {40, 50}};
    program.tools.push_back(tool);
    tool.number = 2;
    tool.edge_mm = 22;
    program.tools.push_back(tool);
    job::Job job = job_with_stock();
    Warnings warnings;
    ASSERT_TRUE(complete_job(job, program, warnings));
    ASSERT_EQ(job.cutters.size(), 2u);
    EXPECT_EQ(job.cutters[0].length_mm, 30);  // 40 mm of edge would reach into the holder
    EXPECT_EQ(job.cutters[1].length_mm, 22);
    for (const milling::Cutter& made : job.cutters) {
        EXPECT_EQ(made.stickout_mm, 30);
        EXPECT_EQ(made.shank_mm, 8);
        ASSERT_EQ(made.holder.size(), 2u);
        EXPECT_EQ(made.holder[1].diameter_mm, 40);
        EXPECT_EQ(made.holder[1].length_mm, 50);
    }
    EXPECT_NE(warnings[0].text.find("stick-out 30 in a holder of 2 steps"), std::string::npos)
        << warnings[0].text;
}

TEST(JobCompletion, takes_tools_from_the_job_then_the_table_then_the_program) {
    motion::Program program = program_with_tools({1, 2, 3, 2});
    // The table stands before what the program says.
    for (const int n : {1, 2})
        program.tools.push_back(
            {.number = n, .diameter_mm = 20.0 + n, .line = n, .flutes = 4, .table = "t.tbl"});
    for (const int n : {1, 2, 3})
        program.tools.push_back(
            {.number = n, .diameter_mm = 30.0 + n, .corner_mm = n == 3 ? 16.5 : 0, .line = 10 + n});
    job::Job job = job_with_stock();
    job.cutters.push_back(cutter(1, 11));
    Warnings warnings;
    ASSERT_TRUE(complete_job(job, program, warnings));
    ASSERT_EQ(job.cutters.size(), 3u);
    EXPECT_EQ(job.cutters[0].diameter_mm, 11);
    EXPECT_EQ(job.cutters[1].diameter_mm, 22);
    EXPECT_EQ(job.cutters[1].flutes, 4);
    EXPECT_EQ(job.cutters[2].diameter_mm, 33);
    EXPECT_EQ(job.cutters[2].kind, milling::CutterKind::ball);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[0].message().substr(0, 54), "t.tbl:2: warning: tool T2 is taken from the tool table");
    EXPECT_EQ(warnings[1].file, "p.h");
    EXPECT_EQ(warnings[1].line, 13);
    EXPECT_NE(warnings[1].text.find("ball D33; 2 flutes, helix 30 deg and 40 mm of edge are assumed"),
              std::string::npos);
}

TEST(JobCompletion, leaves_the_one_cutter_for_all_tools_alone) {
    motion::Program program = program_with_tools({1, 2});
    program.tools.push_back({.number = 1, .diameter_mm = 5});
    job::Job job = job_with_stock();
    job.cutters.push_back(cutter(0, 11));
    Warnings warnings;
    ASSERT_TRUE(complete_job(job, program, warnings));
    EXPECT_EQ(job.cutters.size(), 1u);
    EXPECT_TRUE(warnings.empty());
}

TEST(JobCompletion, takes_the_stock_of_the_program_only_where_the_job_has_none) {
    motion::Program program = program_with_tools({1});
    program.stock = motion::DeclaredStock{{{-5, -5, -5}, {5, 5, 0}}, 3};
    job::Job job = job_with_stock();
    job.cutters.push_back(cutter(1, 11));
    Warnings warnings;
    ASSERT_TRUE(complete_job(job, program, warnings));
    EXPECT_EQ(job.stock.box_mm.max.z, 1);
    EXPECT_TRUE(warnings.empty());
    job.stock = {};
    ASSERT_TRUE(complete_job(job, program, warnings));
    EXPECT_EQ(job.stock.box_mm.min.z, -5);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].line, 3);
}

TEST(JobCompletion, refuses_what_nobody_describes) {
    job::Job job;
    job.file = "j.toml";
    Warnings warnings;
    EXPECT_EQ(complete_job(job, program_with_tools({1}), warnings).error().text(),
              "j.toml: error: the job has no [stock], and the program declares none; add [stock] with box_mm "
              "or mesh");
    job = job_with_stock();
    EXPECT_NE(complete_job(job, program_with_tools({1}), warnings).error().text().find("has no [cutter]"),
              std::string::npos);
}

}  // namespace
}  // namespace tribo::job
