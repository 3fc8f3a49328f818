// SPDX-License-Identifier: MIT
#include "readers/text/decimal_text.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "base/text/decimal.hpp"

namespace tribo::readers {
namespace {

std::string fixed(double value, int decimals) {
    std::string text;
    append_fixed(text, value, decimals);
    return text;
}

TEST(DecimalText, RoundsToTheDecimalsAskedFor) {
    EXPECT_EQ(fixed(0, 3), "0.000");
    EXPECT_EQ(fixed(1.0005, 2), "1.00");
    EXPECT_EQ(fixed(-0.25, 1), "-0.3");
    EXPECT_EQ(fixed(0.9996, 3), "1.000");
    EXPECT_EQ(fixed(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed(12345678.875, 3), "12345678.875");
    EXPECT_EQ(fixed(7.5, 0), "8");
    EXPECT_EQ(fixed(1e15, 2), "1.00e+15");
    EXPECT_EQ(fixed(-2.5e200, 1), "-2.5e+200");
    EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "inf");
    EXPECT_EQ(fixed(-std::numeric_limits<double>::infinity(), 2), "-inf");
    EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 2), "nan");
}

TEST(DecimalText, LeavesOutZerosAtTheEnd) {
    EXPECT_EQ(short_decimal(12), "12");
    EXPECT_EQ(short_decimal(0.5), "0.5");
    EXPECT_EQ(short_decimal(-3.14159265), "-3.1416");
    EXPECT_EQ(short_decimal(100), "100");
    EXPECT_EQ(short_decimal(2.0001, 3), "2");
    EXPECT_EQ(short_decimal(0), "0");
}

RC_GTEST_PROP(DecimalText, LiesWithinHalfAUnitOfTheLastDecimal, ()) {
    const double value =
        static_cast<double>(*rc::gen::inRange<long long>(-1000000000000, 1000000000000)) / 8192;
    const int decimals = *rc::gen::inRange(0, 10);
    const std::string text = fixed(value, decimals);
    double back = 0;
    RC_ASSERT(parse_decimal(text, back) == text.size());
    RC_ASSERT(std::abs(back - value) <= 0.5 * std::pow(10.0, -decimals) + 2e-15 * std::abs(value));
}

}  // namespace
}  // namespace tribo::readers
