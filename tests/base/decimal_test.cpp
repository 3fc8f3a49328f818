// SPDX-License-Identifier: MIT
// base/text/decimal.hpp against the C library's strtod, which rounds correctly, and against halfway cases
// known by hand.
#include "base/text/decimal.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>
#include <string>

#include "base/noise_hash.hpp"

namespace tribo {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

double parsed(const std::string& text) {
    double value = -77;
    EXPECT_EQ(parse_decimal(text, value), text.size()) << text;
    return value;
}

void expect_as_strtod(const std::string& text) {
    const double value = parsed(text), expected = std::strtod(text.c_str(), nullptr);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << text;
}

TEST(ParseDecimal, reads_every_way_to_write_a_number) {
    EXPECT_EQ(parsed("1."), 1);
    EXPECT_EQ(parsed(".5"), 0.5);
    EXPECT_EQ(parsed("+3"), 3);
    EXPECT_EQ(parsed("-0.5e-3"), -0.5e-3);
    EXPECT_EQ(parsed("007.250"), 7.25);
    EXPECT_EQ(parsed("1E+2"), 100);
    EXPECT_EQ(parsed("0e999999999999999999999"), 0);
    EXPECT_EQ(parsed("1e-99999999999999999999999"), 0);
    EXPECT_EQ(parsed("1e99999999999999999999999"), kInf);
    EXPECT_TRUE(std::signbit(parsed("-0.0")));
}

TEST(ParseDecimal, stops_where_the_number_ends) {
    const struct {
        const char* text;
        std::size_t length;
        double value;
    } cases[] = {{"12.5 X3", 4, 12.5}, {"1.2.3", 3, 1.2}, {"3e", 1, 3},   {"3e+", 1, 3},   {"4ex", 1, 4},
                 {"5-3", 1, 5},        {"1,5", 1, 1},     {"0x10", 1, 0}, {"1.e1.", 4, 10}};
    for (const auto& c : cases) {
        double value = -77;
        EXPECT_EQ(parse_decimal(c.text, value), c.length) << c.text;
        EXPECT_EQ(value, c.value) << c.text;
    }
}

TEST(ParseDecimal, leaves_what_is_no_number_alone) {
    for (const char* text : {"", ".", "-", "+.", "e5", "inf", "nan", " 1", "--1", "-e1",
                             "\xef\xbb\xbf"
                             "1"}) {
        double value = -77;
        EXPECT_EQ(parse_decimal(text, value), 0u) << text;
        EXPECT_EQ(value, -77) << text;
    }
}

TEST(ParseDecimal, takes_no_exponent_where_the_language_has_none) {
    double value = 0;
    EXPECT_EQ(parse_decimal("10E5", value, DecimalExponent::none), 2u);
    EXPECT_EQ(value, 10);
}

TEST(ParseDecimal, rounds_halfway_cases_to_even_and_anything_more_up) {
    // 2^53 + 1 lies halfway between two doubles; the digit after any number of zeros decides.
    EXPECT_EQ(parsed("9007199254740993"), 9007199254740992);
    EXPECT_EQ(parsed("9007199254740993." + std::string(900, '0')), 9007199254740992);
    EXPECT_EQ(parsed("9007199254740993." + std::string(900, '0') + "1"), 9007199254740994);
    EXPECT_EQ(parsed("9007199254740995"), 9007199254740996);
    // Half of the smallest subnormal, and next to it.
    EXPECT_EQ(parsed("2.4703282292062327e-324"), 0);
    EXPECT_EQ(parsed("2.4703282292062328e-324"), 5e-324);
    // Halfway between the largest double and the next power of two.
    EXPECT_EQ(parsed("1.797693134862315807e308"), std::numeric_limits<double>::max());
    EXPECT_EQ(parsed("1.797693134862315808e308"), kInf);
    // The largest subnormal, and the smallest normal double from just below it.
    EXPECT_EQ(parsed("2.2250738585072011e-308"), 0x0.fffffffffffffp-1022);
    EXPECT_EQ(parsed("2.2250738585072012e-308"), 0x1p-1022);
}

TEST(ParseDecimal, agrees_with_the_library_on_the_exact_digits_of_doubles_and_of_their_midpoints) {
    const CounterNoise noise(1);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const double value = std::abs(std::bit_cast<double>(noise.bits(i)));
        if (!std::isfinite(value)) continue;
        char text[1200];
        std::snprintf(text, sizeof text, "%.800e", value);
        EXPECT_EQ(parsed(text), value);
        // long double holds the midpoint to the next double exactly.
        const long double middle =
            value + (static_cast<long double>(std::nextafter(value, kInf)) - value) / 2;
        std::snprintf(text, sizeof text, "%.1100Le", middle);
        expect_as_strtod(text);
    }
}

TEST(ParseDecimal, agrees_with_the_library_on_random_digits_of_any_length_and_exponent) {
    const CounterNoise noise(2);
    std::uint64_t counter = 0;
    const auto below = [&](std::uint64_t n) { return noise.bits(counter++) % n; };
    for (int i = 0; i < 200'000; ++i) {
        std::string text = below(2) ? "-" : "";
        const std::uint64_t count = 1 + below(i % 50 == 0 ? 900 : 24), point = below(count + 1);
        for (std::uint64_t j = 0; j < count; ++j) {
            if (j == point) text += '.';
            text += static_cast<char>('0' + below(10));
        }
        if (below(2))
            text += "e" +
                    std::to_string(static_cast<int>(below(i % 3 == 0 ? 700 : 60)) - (i % 3 == 0 ? 350 : 30));
        expect_as_strtod(text);
        if (HasFailure()) return;
    }
}

RC_GTEST_PROP(FormatDecimal, gives_text_that_reads_back_to_the_same_bits, (std::uint64_t bits)) {
    const double value = std::bit_cast<double>(bits);
    RC_PRE(std::isfinite(value));
    double back = 0;
    const std::string text = format_decimal(value);
    RC_ASSERT(parse_decimal(text, back) == text.size());
    RC_ASSERT(std::bit_cast<std::uint64_t>(back) == bits);
    RC_ASSERT(text.size() <= 24u);
}

RC_GTEST_PROP(FormatDecimal, gives_floats_no_more_digits_than_they_need, (std::uint32_t bits)) {
    const float value = std::bit_cast<float>(bits);
    RC_PRE(std::isfinite(value));
    double back = 0;
    const std::string text = format_decimal(value);
    RC_ASSERT(parse_decimal(text, back) == text.size());
    RC_ASSERT(static_cast<float>(back) == value);
    RC_ASSERT(text.size() <= 16u);
}

TEST(FormatDecimal, rounds_to_digits_without_an_exponent_for_sizes_of_a_workshop) {
    EXPECT_EQ(format_digits(229.82, 3), "230");
    EXPECT_EQ(format_digits(-0.0021244, 3), "-0.00212");
    EXPECT_EQ(format_digits(500'100, 3), "500000");
    EXPECT_EQ(format_digits(9'996'000, 2), "1e+07");
    EXPECT_EQ(format_digits(0, 3), "0");
}

TEST(FormatDecimal, writes_the_shortest_text) {
    EXPECT_EQ(format_decimal(0.1), "0.1");
    EXPECT_EQ(format_decimal(0.1f), "0.1");
    EXPECT_EQ(format_decimal(-3.0), "-3");
    EXPECT_EQ(format_decimal(1e23), "1e+23");
    EXPECT_EQ(format_decimal(-0.0), "-0");
    EXPECT_EQ(format_decimal(2.0 / 3), "0.6666666666666666");
}

}  // namespace
}  // namespace tribo
