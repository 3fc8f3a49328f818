// SPDX-License-Identifier: MIT
#include "readers/tables/stroke_csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/refusals.hpp"

namespace tribo::readers {
namespace {

TEST(StrokeCsv, ReadsAProbeStroke) {
    const auto read = read_probe_stroke(
        "\xEF\xBB\xBF# a tap\r\n"
        "t_s, x_mm,y_mm ,Z_MM\r\n"
        "\r\n"
        "0,1,2.5,-3\r\n"
        "# half way\r\n"
        " 0.5 , 4 ,5, 6e-1\r\n");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(*read, (std::vector<ProbePoint>{{0, {1, 2.5, -3}}, {0.5, {4, 5, 0.6}}}));
}

TEST(StrokeCsv, ReadsAFingerStrokeInAnyOrderOfColumnsAndLeavesOthersAlone) {
    const auto read = read_finger_stroke("force_n,note,t_s,y_mm,x_mm\n1.5,press,0,2,1\n0,,0.25,4,3\n");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(*read, (std::vector<FingerPoint>{{0, 1, 2, 1.5}, {0.25, 3, 4, 0}}));
}

TEST(StrokeCsv, ReadsATraceAsAStroke) {
    const auto read = read_probe_stroke(
        "t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n,contact\n0,0,0,1,0,0,0,0\n"
        "0.001,0,0,-0.1,0,0,0.05,1\n");
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(read->back(), (ProbePoint{0.001, {0, 0, -0.1}}));
}

TEST(StrokeCsv, RefusesWhatIsNoStrokeWithItsPlace) {
    const std::string header = "t_s,x_mm,y_mm,z_mm\n", row = "0,0,0,0\n";
    const Refusal refusals[] = {
        {"", 1, 0, "no stroke"},
        {"\n#\n  \n", 3, 0, "no stroke"},
        {"t_s;x_mm;y_mm;z_mm\n", 1, 1, "semicolons"},
        {"t_s\tx_mm\ty_mm\tz_mm\n", 1, 1, "blanks or tabs"},
        {"t_s x_mm y_mm z_mm\n", 1, 1, "blanks or tabs"},
        {"0,0,0,0\n", 1, 1, "no column t_s"},
        {"t_s,x_mm,y_mm,force_n\n", 1, 1, "no column z_mm"},
        {"t_s,x_mm,y_mm,z_mm,x_mm\n", 1, 20, "x_mm stands there twice"},
        {header, 1, 0, "two points, this file has 0"},
        {header + row, 2, 0, "two points, this file has 1"},
        {header + row + row, 3, 1, "not after"},
        {header + "1,0,0,0\n0.5,0,0,0\n", 3, 1, "not after"},
        {header + "-1,0,0,0\n", 2, 1, "out of range"},
        {header + "2e6,0,0,0\n", 2, 1, "out of range"},
        {header + row + "1,2,3\n", 3, 5, "3 fields, the header 4"},
        {header + row + "1,2,3,4,5\n", 3, 9, "5 fields"},
        {header + row + "1,,3,4\n", 3, 3, "missing"},
        {header + row + "1,2,x3,4\n", 3, 5, "not a number"},
        {header + row + "1,2,nan,4\n", 3, 5, "not a number"},
        {header + row + "inf,2,3,4\n", 3, 1, "not a number"},
        {header + row + "1,1e9,3,4\n", 3, 3, "out of range"},
        {header + row + "1,1e999,3,4\n", 3, 3, "not a number"},
        {header + row + "1,2,3,4\xE4\n", 3, 7, "not a number"},
    };
    expect_refused(refusals,
                   [](const std::string& text, const char* name) { return read_probe_stroke(text, {name}); });
    const Refusal finger_refusals[] = {
        {"t_s,x_mm,y_mm,z_mm\n", 1, 1, "no column force_n"},
        {"t_s,x_mm,y_mm,force_n\n0,0,0,2e6\n", 2, 7, "out of range"},
    };
    expect_refused(finger_refusals, [](const std::string& text, const char* name) {
        return read_finger_stroke(text, {name});
    });
}

TEST(StrokeCsv, RefusesMoreThanItMayHold) {
    const auto read = read_probe_stroke("t_s,x_mm,y_mm,z_mm\n0,0,0,0\n1,0,0,0\n2,0,0,0\n", {"s.csv", 2});
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().line, 4);
    EXPECT_NE(read.error().cause.find("more than 2 points"), std::string::npos);
}

RC_GTEST_PROP(StrokeCsv, WritesWhatItReadsBackToTheSameBits, ()) {
    const auto number = rc::gen::map(rc::gen::inRange(-1'000'000'000, 1'000'000'000),
                                     [](int n) { return static_cast<double>(n) / 7e3; });
    std::vector<ProbePoint> probe;
    std::vector<FingerPoint> finger;
    double t_s = 0;
    for (int n = 2 + *rc::gen::inRange(0, 20); n > 0; --n) {
        t_s += static_cast<double>(1 + *rc::gen::inRange(0, 1000)) / 3e3;
        probe.push_back({t_s, {*number, *number, *number}});
        finger.push_back({t_s, *number, *number, *number});
    }
    const auto probe_again = read_probe_stroke(write_probe_stroke(probe));
    const auto finger_again = read_finger_stroke(write_finger_stroke(finger));
    RC_ASSERT(probe_again.has_value() && finger_again.has_value());
    RC_ASSERT(*probe_again == probe);
    RC_ASSERT(*finger_again == finger);
}

}  // namespace
}  // namespace tribo::readers
