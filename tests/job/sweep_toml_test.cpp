// SPDX-License-Identifier: MIT
#include "job/toml/sweep_toml.hpp"

#include <gtest/gtest.h>

namespace tribo::job {
namespace {

using sweep::Value;

std::string error_of(const std::string& text) {
    const auto sweep = parse_sweep(text, "dir/sweep.toml");
    return sweep ? "" : sweep.error().text();
}

TEST(SweepToml, reads_axes_in_the_order_of_the_file) {
    const auto sweep = parse_sweep(R"(base = "bowl.toml"
compute = ["summary", "stability"]
resolution_mm = 0.5
[axes]
process.spindle_rpm = [8000, 9000]
"cutter.helix_deg" = {from = 20, to = 40, step = 10}
cutter.kind = ["flat", "ball"]
dynamics.estimate = true
material.ktc_n_per_mm2 = {from = 500, to = 700, count = 5}
)",
                                   "dir/sweep.toml");
    ASSERT_TRUE(sweep) << sweep.error().text();
    EXPECT_EQ(sweep->base, "dir/bowl.toml");
    EXPECT_EQ(sweep->resolution_mm, 0.5);
    EXPECT_EQ(sweep->compute, (std::vector{SweepResult::summary, SweepResult::stability}));
    const auto& axes = sweep->plan.axes;
    ASSERT_EQ(axes.size(), 5u);
    EXPECT_EQ(axes[0].key, "process.spindle_rpm");
    EXPECT_EQ(axes[0].values, (std::vector<Value>{8000.0, 9000.0}));
    EXPECT_EQ(axes[1].values, (std::vector<Value>{20.0, 30.0, 40.0}));
    EXPECT_EQ(axes[2].values, (std::vector<Value>{std::string("flat"), std::string("ball")}));
    EXPECT_EQ(axes[3].values, (std::vector<Value>{true}));
    EXPECT_EQ(axes[4].values, (std::vector<Value>{500.0, 550.0, 600.0, 650.0, 700.0}));
    EXPECT_EQ(sweep->plan.cases(), 2u * 3 * 2 * 1 * 5);
}

TEST(SweepToml, reads_distributions) {
    const auto sweep = parse_sweep(R"(base = "bowl.toml"
[axes]
process.spindle_rpm = {uniform = [8000, 9000]}
material.ktc_n_per_mm2 = {lognormal = [800, 0.3]}
cutter.runout_mm = {normal = [0.01, 0.002]}
[sample]
design = "sobol"
n = 64
)",
                                   "sweep.toml");
    ASSERT_TRUE(sweep) << sweep.error().text();
    EXPECT_EQ(sweep->plan.axes[0].distribution,
              (sweep::Distribution{sweep::DistributionKind::uniform, 8000, 9000}));
    EXPECT_EQ(sweep->plan.axes[1].distribution,
              (sweep::Distribution{sweep::DistributionKind::lognormal, 800, 0.3}));
    EXPECT_EQ(sweep->plan.cases(), 64u * 5);
    EXPECT_EQ(sweep->compute, std::vector{SweepResult::summary});
}

TEST(SweepToml, refuses_what_is_no_sweep) {
    const auto axes = [](const std::string& line) { return error_of("base = \"b.toml\"\n[axes]\n" + line); };
    const auto sampled = [](const std::string& line) {
        return error_of("base = \"b.toml\"\n[axes]\n" + line + "\n[sample]\ndesign = \"sobol\"\nn = 8\n");
    };
    const struct {
        std::string error, says;
    } cases[] = {
        {error_of(""), "no job"},
        {error_of("bse = \"b.toml\""), "unknown key 'bse'"},
        {error_of("base = \"b.toml\"\ncompute = [\"sumary\"]"), "sweep.toml:2"},
        {error_of("base = \"b.toml\"\ncompute = []"), "nothing is computed"},
        {error_of("programs = \"p\"\n[axes]\na.b = [1]"), "no keys to change"},
        {axes("a.b = []"), "no values"},
        {axes("a.b = [nan]"), "without end"},
        {axes("a.b = [1979-05-27]"), "no number"},
        {axes("a.b = {from = 1, to = 2}"), "either a step or a count"},
        {axes("a.b = {from = 1, to = 2, step = -1}"), "no values, or too many"},
        {axes("a.b = {from = 1, to = 2, step = 0}"), "no values, or too many"},
        {axes("a.b = {from = 0, to = 1, count = 1.5}"), "no values, or too many"},
        {axes("a.b = {from = 0, to = 1e9, step = 1}"), "no values, or too many"},
        {axes("a.b = {from = 0, too = 1, step = 1}"), "'too'"},
        {axes("a.b = {uniform = [0, 1]}"), "sweep.toml:3"},
        {axes("program = [\"a.nc\"]"), "`programs`"},
        {axes("a.a = {from=1,to=9999,step=1}\na.b = {from=1,to=9999,step=1}\na.c = [1,2]"), "cases"},
        {sampled("a.b = {uniform = [2, 1]}"), "no distribution"},
        {sampled("a.b = {normal = [0, 0]}"), "no distribution"},
        {sampled("a.b = {lognormal = [0, 1]}"), "no distribution"},
        {sampled("a.b = {lognormal = [1, 1, 1]}"), "two numbers"},
        {sampled(""), "no axes"},
        {error_of("base = \"b.toml\"\n[axes]\na.b = [1]\n[sample]\nn = 8"), "every combination"},
        {error_of("base = \"b.toml\"\n[axes]\na.b = [1]\n[sample]\ndesign = \"sobol\""), "'n' is missing"},
        {error_of("base = \"b.toml\"\n[axes]\na.b = [1]\n[sample]\ndesign = \"sobol\"\nn = 2.5"), "whole"},
    };
    for (const auto& c : cases)
        EXPECT_NE(c.error.find(c.says), std::string::npos) << c.says << ": " << c.error;
}

}  // namespace
}  // namespace tribo::job
