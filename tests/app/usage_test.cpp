// SPDX-License-Identifier: MIT
// What the program says to a wrong call, and how it ends then.
#include <gtest/gtest.h>

#include "app/run/program.hpp"

namespace tribo::test {
namespace {

TEST(Usage, version_and_help_are_no_errors) {
    const Outcome version = run_tribo({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(version.out.starts_with("tribo ")) << version.out;
    EXPECT_EQ(version.err, "");
    for (const std::vector<std::string>& call :
         {std::vector<std::string>{"--help"}, {"-h"}, {"inspect", "--help"}, {"render", "--help"}}) {
        const Outcome help = run_tribo(call);
        EXPECT_EQ(help.code, 0);
        EXPECT_NE(help.out.find("Usage: tribo"), std::string::npos) << help.out;
        EXPECT_EQ(help.err, "");
    }
    const Outcome help = run_tribo({"render", "--help"});
    for (const char* flag :
         {"--out", "--resolution", "--until", "--sample-rate", "--only", "--memory", "--as-published"}) {
        EXPECT_NE(help.out.find(flag), std::string::npos) << flag;
    }
}

struct WrongCall {
    std::vector<std::string> arguments;
    const char* fragment;
};

class WrongCalls : public testing::TestWithParam<WrongCall> {};

TEST_P(WrongCalls, end_with_2_and_one_line_that_helps) {
    const Outcome outcome = run_tribo(GetParam().arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(GetParam().fragment), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, WrongCalls,
    testing::Values(
        WrongCall{{}, "error: no verb; see 'tribo --help'"},
        WrongCall{{"rendr", "a"}, "unknown verb 'rendr'; try 'render'"},
        WrongCall{{"--verson"}, "unknown option '--verson'; try '--version'"},
        WrongCall{{"inspect"}, "FILE is required"},
        WrongCall{{"inspect", "a", "b"}, "'b' is one argument too many"},
        WrongCall{{"inspect", "--jsn", "a"}, "unknown option '--jsn'; try '--json'"},
        WrongCall{{"inspect", "none.stl"}, "none.stl: error: cannot read: No such file"},
        WrongCall{{"inspect", "/"}, "/: error: is a folder"}, WrongCall{{"render"}, "JOB is required"},
        WrongCall{{"render", "a.toml"}, "--out is required"},
        WrongCall{{"render", "a.toml", "--out", "o", "--resolutin=1"},
                  "unknown option '--resolutin'; try '--resolution'"},
        WrongCall{{"render", "a.toml", "--out", "o", "--resolution", "0"}, "--resolution"},
        WrongCall{{"render", "a.toml", "--out", "o", "--resolution", "nan"}, "'nan' is not a number"},
        WrongCall{{"render", "a.toml", "--out", "o", "--resolution", "0.1mm"}, "'0.1mm' is not a number"},
        WrongCall{{"render", "a.toml", "--out", "o", "--memory", "-5"}, "--memory"},
        WrongCall{{"render", "a.toml", "--out", "o", "--threads", "0"}, "--threads"},
        WrongCall{{"render", "a.toml", "--out", "o", "--until", "-1"}, "--until"},
        WrongCall{{"render", "a.toml", "--out", "o", "--sample-rate", "10"}, "--sample-rate"},
        WrongCall{{"render", "a.toml", "--out", "o", "--only", "forces,sond"},
                  "'sond' is unknown; try 'sound'"},
        WrongCall{{"render", "none.toml", "--out", "o"}, "none.toml: error: cannot read: No such file"}));

}  // namespace
}  // namespace tribo::test
