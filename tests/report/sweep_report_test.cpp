// SPDX-License-Identifier: MIT
#include "report/sweep/sweep_report.hpp"

#include <gtest/gtest.h>

namespace tribo::report {
namespace {

SweepReport report_of(double least, double most) {
    SweepOutput output{"peak_force_n", 4, 100, {least, 100, most}, least, most, 2, 3, {1, 3}, {}};
    output.shares = {{0.1, 0.2}, {0.7, 0.8}};
    return {"a<b>.toml",         "1.0", 8, 7, {{"first", "1, 2"}, {"second", "3, 4"}}, {output},
            {{"no & way", 1, 5}}};
}

TEST(SweepReport, names_the_input_first_that_matters_most) {
    const std::string page = sweep_report(report_of(90, 110));
    const std::size_t shares = page.find("<h3>peak_force_n</h3>");
    ASSERT_NE(shares, std::string::npos);
    EXPECT_LT(page.find("second", shares), page.find("first", shares));
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(page.find("7 of 8 cases finished"), std::string::npos);
}

TEST(SweepReport, takes_what_differs_by_rounding_for_constant) {
    const std::string page = sweep_report(report_of(100, 100 + 1e-9));
    EXPECT_NE(page.find("always the same"), std::string::npos);
    EXPECT_EQ(page.find("<h3>peak_force_n</h3>"), std::string::npos);
}

TEST(SweepReport, escapes_names_and_reasons) {
    const std::string page = sweep_report(report_of(90, 110));
    EXPECT_EQ(page.find("a<b>"), std::string::npos);
    EXPECT_NE(page.find("no &amp; way"), std::string::npos);
}

}  // namespace
}  // namespace tribo::report
