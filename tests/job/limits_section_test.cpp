// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "job/memory_source.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::job {
namespace {

FileResult<Job> limits_job(const std::string& limits) {
    return parse_job(
        "[stock]\nbox_mm = [[0,0,0],[1,1,1]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 1\n[material]\nname = "
        "\"al7075-t6\"\n[path]\nkeyframes = \"a.csv\"\n[limits]\n" +
            limits,
        "job.toml", MemorySource());
}

TEST(LimitsSection, reads_what_it_states_and_leaves_the_rest_open) {
    const auto job =
        limits_job("force_n = 200\ndeflection_mm = 0.02\nspindle = [[1000, 50, 0.5], [20000, 800, 0.4]]\n");
    ASSERT_TRUE(job) << job.error().text();
    const JobLimits& limits = job->limits;
    EXPECT_EQ(limits.force_n, 200);
    EXPECT_EQ(limits.deflection_mm, 0.02);
    ASSERT_EQ(limits.spindle.size(), 2u);
    EXPECT_EQ(limits.spindle[1].rpm, 20'000);
    EXPECT_EQ(limits.spindle[1].power_w, 800);
    EXPECT_EQ(limits.spindle[1].torque_nm, 0.4);
    EXPECT_FALSE(limits.stress_n_per_mm2);
    EXPECT_FALSE(limits.tolerance_mm);
}

TEST(LimitsSection, refuses_what_is_no_limit) {
    struct Case {
        const char* text;
        const char* says;
    };
    for (const auto& [text, says] : {
             Case{"force_n = -5\n", "keep the force limit within"},
             Case{"force_n = \"200\"\n", "must be a number"},
             Case{"chip_min_mm = 0.1\nchip_max_mm = 0.05\n", "'chip_min_mm' is not below 'chip_max_mm'"},
             Case{"spindle = []\n", "must be a curve"},
             Case{"spindle = [1000, 50, 0.5]\n", "must be a curve"},
             Case{"spindle = [[1000, 50]]\n", "must be a curve"},
             Case{"spindle = [[1000, 50, 1], [1000, 60, 1]]\n", "do not rise"},
             Case{"spindle = [[2000, 50, 1], [1000, 60, 1]]\n", "do not rise"},
             Case{"spindle = [[1000, -50, 1]]\n", "keep the power limit within"},
             Case{"spindle = [[1000, 50, 1]]\npower_w = 50\n", "stands beside 'spindle'"},
             Case{"stress = 700\n", "try 'stress_n_per_mm2'"},
         }) {
        const auto job = limits_job(text);
        ASSERT_FALSE(job) << text;
        EXPECT_NE(job.error().text().find(says), std::string::npos) << job.error().text();
    }
}

}  // namespace
}  // namespace tribo::job
