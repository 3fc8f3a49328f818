// SPDX-License-Identifier: MIT
#include "session/cut/cutter_modes.hpp"

#include <gtest/gtest.h>

#include "dynamics/tool_estimate.hpp"

namespace tribo::session {
namespace {

job::Job job_of(double second_stickout_mm) {
    job::Job job;
    job.file = "job.toml";
    job.estimate = job::JobEstimate{12, 8};
    job.cutters = {{.number = 1, .diameter_mm = 10, .length_mm = 20},
                   {.number = 2, .diameter_mm = 6, .length_mm = 12}};
    job.cutters[0].stickout_mm = 50;
    job.cutters[1].stickout_mm = second_stickout_mm;
    return job;
}

TEST(CutterModes, are_estimated_for_each_cutter_beside_those_of_the_part) {
    job::Job job = job_of(30);
    job.modes = {{{0, 0, 1}, 400, 0.01, 900, dynamics::ModeOn::part}};
    MillSetup setup;
    setup.cutters = job.cutters;
    Warnings warnings;
    ASSERT_TRUE(add_modes(job, setup, warnings));
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_EQ(warnings[1].line, 12);
    EXPECT_NE(warnings[1].text.find("tool T2 are estimated, not measured"), std::string::npos);
    EXPECT_NE(warnings[1].text.find("no [holder]"), std::string::npos);
    for (std::size_t n = 0; n < 2; ++n) {
        const auto expected = dynamics::estimated_modes(job.cutters[n]);
        ASSERT_EQ(setup.modes(n).size(), 1 + expected.size());
        EXPECT_EQ(setup.modes(n)[0].on, dynamics::ModeOn::part);
        EXPECT_FALSE(setup.modes(n)[0].estimated);
        EXPECT_EQ(setup.modes(n)[1].frequency_hz, expected[0].frequency_hz);
    }
    EXPECT_NE(setup.modes(0)[1].frequency_hz, setup.modes(1)[1].frequency_hz);
}

TEST(CutterModes, of_a_tool_that_the_program_brings_are_refused_at_the_estimate) {
    const job::Job job = job_of(0);
    MillSetup setup;
    setup.cutters = job.cutters;
    Warnings warnings;
    const auto refused = add_modes(job, setup, warnings);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().line, 12);
    EXPECT_NE(refused.error().cause.find("tool T2 cannot be estimated"), std::string::npos);
}

}  // namespace
}  // namespace tribo::session
