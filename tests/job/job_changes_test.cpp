// SPDX-License-Identifier: MIT
// Jobs with other values than their files give.
#include <gtest/gtest.h>

#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::job {
namespace {

constexpr const char* kJob = R"([stock]
box_mm = [[0, 0, -10], [40, 30, 0]]
[[cutter]]
number = 1
kind = "flat"
diameter_mm = 10
flutes = 2
[[cutter]]
number = 2
kind = "ball"
diameter_mm = 6
[material]
ktc_n_per_mm2 = 800
krc_n_per_mm2 = 200
kac_n_per_mm2 = 100
kte_n_per_mm = 20
kre_n_per_mm = 15
kae_n_per_mm = 2
[path]
gcode = "p.nc"
)";

FileResult<Job> changed(std::vector<JobChange> changes, std::string text = kJob) {
    return parse_job(text, "job.toml", MemorySource(), changes);
}

std::string error_of(std::vector<JobChange> changes) {
    const auto job = changed(std::move(changes));
    return job ? "" : job.error().text();
}

TEST(JobChanges, set_numbers_words_and_elements) {
    const auto job = changed({{"process.spindle_rpm", 9000.0},
                              {"cutter.2.diameter_mm", 6.5},
                              {"cutter.1.flutes", 3.0},
                              {"cutter.2.kind", std::string("flat")},
                              {"stock.box_mm.2.3", 1.5},
                              {"material.ktc_n_per_mm2", 812.25},
                              {"path.gcode", std::string("q.nc")}});
    ASSERT_TRUE(job) << job.error().text();
    EXPECT_EQ(job->process.spindle_rpm, 9000);
    EXPECT_EQ(job->cutters[1].diameter_mm, 6.5);
    EXPECT_EQ(job->cutters[0].flutes, 3);
    EXPECT_EQ(job->cutters[1].kind, milling::CutterKind::flat);
    EXPECT_EQ(job->stock.box_mm.max.z, 1.5);
    EXPECT_EQ(job->material.coefficients->ktc, 812.25);
    EXPECT_EQ(job->path.file, "q.nc");
    EXPECT_EQ(job->cutters[0].diameter_mm, 10);
}

TEST(JobChanges, without_any_leave_the_job_as_it_is) {
    const auto job = changed({}), plain = parse_job(kJob, "job.toml", MemorySource());
    ASSERT_TRUE(job);
    EXPECT_EQ(job->cutters[1].diameter_mm, plain->cutters[1].diameter_mm);
}

TEST(JobChanges, of_a_single_table_need_no_number) {
    std::string one = kJob;
    const std::size_t second = one.rfind("[[cutter]]");
    one.erase(second, one.find("[material]") - second);
    for (const char* key : {"cutter.diameter_mm", "cutter.1.diameter_mm"}) {
        const auto job = changed({{key, 8.0}}, one);
        ASSERT_TRUE(job) << job.error().text();
        EXPECT_EQ(job->cutters[0].diameter_mm, 8);
    }
    one.replace(one.find("[[cutter]]"), 10, "[cutter]");
    for (const char* key : {"cutter.diameter_mm", "cutter.1.diameter_mm"})
        EXPECT_EQ(changed({{key, 8.0}}, one)->cutters[0].diameter_mm, 8);
}

TEST(JobChanges, are_checked_as_the_file_is) {
    EXPECT_NE(error_of({{"cutter.1.diameter_mm", -1.0}}).find("diameter_mm"), std::string::npos);
    EXPECT_NE(error_of({{"cutter.1.flutes", 2.5}}).find("flutes"), std::string::npos);
    EXPECT_NE(error_of({{"process.spindel_rpm", 1.0}}).find("spindle_rpm"), std::string::npos);
    EXPECT_NE(error_of({{"material.ktc_n_per_mm2", std::string("hard")}}).find("ktc_n_per_mm2"),
              std::string::npos);
}

TEST(JobChanges, refuse_a_key_that_leads_nowhere_or_to_several_places) {
    EXPECT_NE(error_of({{"cutter.diameter_mm", 8.0}}).find("there are 2 of them"), std::string::npos);
    EXPECT_NE(error_of({{"cutter.3.diameter_mm", 8.0}}).find("no element '3'"), std::string::npos);
    EXPECT_NE(error_of({{"stock.box_mm.1.4", 8.0}}).find("no element '4'"), std::string::npos);
    EXPECT_NE(error_of({{"path.gcode.x", 8.0}}).find("no key"), std::string::npos);
    EXPECT_NE(error_of({{"path.gcode.x.y", 8.0}}).find("'gcode' is no table"), std::string::npos);
    EXPECT_NE(error_of({{"", 8.0}}).find("no key"), std::string::npos);
    EXPECT_NE(error_of({{"process.", 8.0}}).find("no key"), std::string::npos);
}

}  // namespace
}  // namespace tribo::job
