// SPDX-License-Identifier: MIT
// base/math.hpp against the system's long double functions (64 bits of mantissa on x86), and its special
// values.
#include "base/math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace tribo {
namespace {

using LongDouble = long double;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr bool kWideReference = std::numeric_limits<LongDouble>::digits >= 64;

// Distance of `value` from `exact` in units in the last place of a double of the size of `exact`.
double ulps(double value, LongDouble exact) {
    const double nearest = static_cast<double>(exact);
    if (std::isnan(nearest)) return std::isnan(value) ? 0 : kInfinity;
    if (std::isinf(nearest) || std::isinf(value)) return value == nearest ? 0 : kInfinity;
    int exponent = 0;
    std::frexp(exact, &exponent);
    const LongDouble ulp = std::ldexp(1.0L, std::max(exponent - 53, -1074));
    return static_cast<double>(std::abs(static_cast<LongDouble>(value) - exact) / ulp);
}

// A linear congruential stream; the tests choose arguments with it and nothing else.
struct Arguments {
    std::uint64_t state = 0x9e3779b97f4a7c15;
    std::uint64_t bits() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return state ^ (state >> 29);
    }
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }
    // Any sign, exponent between the two powers of two, any mantissa.
    double scattered(int low_exponent, int high_exponent) {
        const double size = std::ldexp(
            uniform(1, 2),
            low_exponent +
                static_cast<int>((bits() >> 20) % static_cast<unsigned>(high_exponent - low_exponent)));
        return bits() & 0x10000 ? size : -size;
    }
};

struct Worst {
    double error = 0, at = 0, and_at = 0;
    void note(double e, double x, double y = 0) {
        if (!(e <= error)) {
            error = e;
            at = x;
            and_at = y;
        }
    }
};

#define EXPECT_WITHIN(worst, bound) \
    EXPECT_LE((worst).error, bound) << std::hexfloat << "at " << (worst).at << ", " << (worst).and_at

constexpr int kMany = 300'000;

template <class Function, class Reference>
Worst sweep(Function f, Reference reference, double low, double high) {
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double x =
            i < kMany / 2 ? low + (high - low) * i / (kMany / 2 - 1) : arguments.uniform(low, high);
        worst.note(ulps(f(x), reference(static_cast<LongDouble>(x))), x);
    }
    return worst;
}

template <class Function, class Reference>
Worst scatter(Function f, Reference reference, int low_exponent, int high_exponent) {
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double x = arguments.scattered(low_exponent, high_exponent);
        worst.note(ulps(f(x), reference(static_cast<LongDouble>(x))), x);
    }
    return worst;
}

const auto kSin = [](LongDouble x) { return std::sin(x); };
const auto kCos = [](LongDouble x) { return std::cos(x); };
const auto kTan = [](LongDouble x) { return std::tan(x); };

class Math : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!kWideReference) GTEST_SKIP() << "long double is no wider than double here";
    }
};

TEST_F(Math, sine_and_cosine_are_within_an_ulp_around_zero_and_over_many_turns) {
    EXPECT_WITHIN(sweep(math::sin, kSin, -7, 7), 1.0);
    EXPECT_WITHIN(sweep(math::cos, kCos, -7, 7), 1.0);
    EXPECT_WITHIN(sweep(math::sin, kSin, -1.1e5, 1.1e5), 1.0);
    EXPECT_WITHIN(sweep(math::cos, kCos, -1.1e5, 1.1e5), 1.0);
}

TEST_F(Math, sine_cosine_and_tangent_hold_for_arguments_of_any_size) {
    EXPECT_WITHIN(scatter(math::sin, kSin, -1070, 1023), 1.0);
    EXPECT_WITHIN(scatter(math::cos, kCos, -1070, 1023), 1.0);
    EXPECT_WITHIN(scatter(math::tan, kTan, -1070, 1023), 1.5);
    EXPECT_WITHIN(scatter(math::sin, kSin, 15, 64), 1.0);
    EXPECT_WITHIN(sweep(math::tan, kTan, -7, 7), 1.5);
}

TEST_F(Math, sine_and_cosine_hold_next_to_multiples_of_a_quarter_turn) {
    Worst worst;
    for (int n = 1; n < 80'000; ++n) {
        double x = static_cast<double>(n * (std::numbers::pi_v<LongDouble> / 2));
        for (int side = -1; side <= 1; ++side) {
            const double near = side == 0 ? x : std::nextafter(x, side * kInfinity);
            worst.note(ulps(math::sin(near), kSin(near)), near);
            worst.note(ulps(math::cos(near), kCos(near)), near);
            worst.note(ulps(math::tan(near), kTan(near)), near);
        }
    }
    // The nearest that any double comes to a multiple of pi/2 (Kahan 1983; Muller 2006, table 11.1).
    worst.note(ulps(math::cos(0x1.6ac5b262ca1ffp+849), kCos(0x1.6ac5b262ca1ffp+849L)),
               0x1.6ac5b262ca1ffp+849);
    EXPECT_WITHIN(worst, 1.0);
    EXPECT_DOUBLE_EQ(math::cos(0x1.6ac5b262ca1ffp+849), -4.6871659242546276e-19);
}

TEST_F(Math, sincos_gives_the_bits_of_sin_and_cos) {
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double x = arguments.scattered(-40, 300);
        double s = 0, c = 0;
        math::sincos(x, s, c);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(s), std::bit_cast<std::uint64_t>(math::sin(x)));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(c), std::bit_cast<std::uint64_t>(math::cos(x)));
    }
}

TEST_F(Math, inverse_sine_and_cosine_are_within_an_ulp) {
    const auto asin_l = [](LongDouble x) { return std::asin(x); };
    const auto acos_l = [](LongDouble x) { return std::acos(x); };
    EXPECT_WITHIN(sweep(math::asin, asin_l, -1, 1), 1.0);
    EXPECT_WITHIN(sweep(math::acos, acos_l, -1, 1), 1.0);
    EXPECT_WITHIN(scatter(math::asin, asin_l, -1070, 0), 1.0);
    EXPECT_WITHIN(scatter(math::acos, acos_l, -1070, 0), 1.0);
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double x = 1 - std::abs(arguments.scattered(-53, -1));
        worst.note(ulps(math::acos(x), acos_l(x)), x);
        worst.note(ulps(math::acos(-x), acos_l(-x)), -x);
        worst.note(ulps(math::asin(x), asin_l(x)), x);
    }
    EXPECT_WITHIN(worst, 1.0);
}

TEST_F(Math, inverse_tangent_is_within_an_ulp_and_a_half) {
    const auto atan_l = [](LongDouble x) { return std::atan(x); };
    EXPECT_WITHIN(sweep(math::atan, atan_l, -5, 5), 1.5);
    EXPECT_WITHIN(scatter(math::atan, atan_l, -1070, 1023), 1.5);
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const bool far = i % 2 == 0;
        const double x = far ? arguments.scattered(-1070, 1023) : arguments.uniform(-2, 2);
        const double y = far ? arguments.scattered(-1070, 1023) : arguments.uniform(-2, 2);
        worst.note(ulps(math::atan2(y, x), std::atan2(LongDouble{y}, LongDouble{x})), y, x);
    }
    EXPECT_WITHIN(worst, 1.5);
}

TEST_F(Math, exponential_and_logarithms_are_within_an_ulp) {
    const auto exp_l = [](LongDouble x) { return std::exp(x); };
    const auto log_l = [](LongDouble x) { return std::log(x); };
    const auto log10_l = [](LongDouble x) { return std::log10(x); };
    EXPECT_WITHIN(sweep(math::exp, exp_l, -1, 1), 1.0);
    EXPECT_WITHIN(sweep(math::exp, exp_l, -750, 711), 1.0);
    EXPECT_WITHIN(scatter(math::exp, exp_l, -80, 11), 1.0);
    EXPECT_WITHIN(sweep(math::log, log_l, 0.4, 2.5), 1.0);
    EXPECT_WITHIN(sweep(math::log, log_l, 1 - 1e-6, 1 + 1e-6), 1.0);
    EXPECT_WITHIN(sweep(math::log10, log10_l, 0.4, 2.5), 1.0);
    EXPECT_WITHIN(sweep(math::log10, log10_l, 1 - 1e-6, 1 + 1e-6), 1.0);
    EXPECT_WITHIN(scatter([](double x) { return math::log(std::abs(x)); },
                          [&](LongDouble x) { return log_l(std::abs(x)); }, -1070, 1023),
                  1.0);
    EXPECT_WITHIN(scatter([](double x) { return math::log10(std::abs(x)); },
                          [&](LongDouble x) { return log10_l(std::abs(x)); }, -1070, 1023),
                  1.0);
}

TEST_F(Math, powers_are_within_an_ulp) {
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double base = i % 3 == 0   ? std::abs(arguments.scattered(-1070, 1023))
                            : i % 3 == 1 ? arguments.uniform(0.9, 1.1)
                                         : arguments.uniform(0, 100);
        const double size = 740 / std::max(1e-3, std::abs(std::log(base)));
        const double exponent = i % 5 == 0 ? arguments.scattered(-60, 4) : arguments.uniform(-size, size);
        worst.note(ulps(math::pow(base, exponent), std::pow(LongDouble{base}, LongDouble{exponent})), base,
                   exponent);
    }
    EXPECT_WITHIN(worst, 1.0);
}

TEST_F(Math, cube_roots_are_within_an_ulp_and_lengths_within_a_quarter_more) {
    EXPECT_WITHIN(scatter(math::cbrt, [](LongDouble x) { return std::cbrt(x); }, -1070, 1023), 1.0);
    EXPECT_WITHIN(sweep(math::cbrt, [](LongDouble x) { return std::cbrt(x); }, -9, 9), 1.0);
    Worst worst;
    Arguments arguments;
    for (int i = 0; i < kMany; ++i) {
        const double x = arguments.scattered(-1070, 1023);
        const double y = i % 2 == 0 ? x * arguments.uniform(-2, 2) : arguments.scattered(-1070, 1023);
        worst.note(ulps(math::hypot(x, y), std::hypot(LongDouble{x}, LongDouble{y})), x, y);
    }
    EXPECT_WITHIN(worst, 1.25);
}

// --- special values, exact on every system

void expect_same(double value, double expected) {
    if (std::isnan(expected)) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(kNan));
    } else {
        EXPECT_EQ(value, expected);
        EXPECT_EQ(std::signbit(value), std::signbit(expected));
    }
}

TEST(MathSpecialValues, zeros_keep_their_sign_and_tiny_arguments_their_value) {
    for (double x : {0.0, -0.0, 5e-324, -5e-324, 1e-310, -3e-300, 1e-20}) {
        for (auto f : {math::sin, math::tan, math::asin, math::atan}) expect_same(f(x), x);
        expect_same(math::cos(x), 1);
        expect_same(math::exp(x), 1);
    }
    expect_same(math::cbrt(-0.0), -0.0);
    expect_same(math::log(1), 0);
    expect_same(math::log10(1), 0);
    expect_same(math::acos(1), 0);
    expect_same(math::acos(-1), math::kPi);
    expect_same(math::asin(-1), -math::kHalfPi);
    expect_same(math::cbrt(5e-324), static_cast<double>(std::cbrt(LongDouble{5e-324})));
}

TEST(MathSpecialValues, what_has_no_value_is_the_one_quiet_nan) {
    for (auto f : {math::sin, math::cos, math::tan, math::asin, math::acos}) {
        expect_same(f(kInfinity), kNan);
        expect_same(f(-kInfinity), kNan);
    }
    for (auto f : {math::sin, math::cos, math::tan, math::asin, math::acos, math::atan, math::exp, math::log,
                   math::log10, math::cbrt}) {
        expect_same(f(-kNan), kNan);
    }
    double s = 0, c = 0;
    math::sincos(kInfinity, s, c);
    expect_same(s, kNan);
    expect_same(c, kNan);
    for (double x : {std::nextafter(1, 2), -2.0}) {
        expect_same(math::asin(x), kNan);
        expect_same(math::acos(x), kNan);
    }
    expect_same(math::log(-1), kNan);
    expect_same(math::log10(-kInfinity), kNan);
    expect_same(math::atan2(kNan, 1), kNan);
    expect_same(math::hypot(kNan, 1), kNan);
    expect_same(math::pow(-2, 0.5), kNan);
    expect_same(math::pow(kNan, 1), kNan);
    expect_same(math::pow(2, kNan), kNan);
}

TEST(MathSpecialValues, infinities_and_ends_of_the_range) {
    expect_same(math::exp(kInfinity), kInfinity);
    expect_same(math::exp(-kInfinity), 0);
    expect_same(math::exp(710), kInfinity);
    expect_same(math::exp(-746), 0);
    expect_same(math::exp(-745), 5e-324);
    EXPECT_LT(math::exp(0x1.62e42fefa39efp9), kInfinity);
    expect_same(math::log(0), -kInfinity);
    expect_same(math::log10(-0.0), -kInfinity);
    expect_same(math::log(kInfinity), kInfinity);
    expect_same(math::atan(-kInfinity), -math::kHalfPi);
    expect_same(math::cbrt(-kInfinity), -kInfinity);
    expect_same(math::hypot(kInfinity, kNan), kInfinity);
    expect_same(math::hypot(-3, 4), 5);
    expect_same(math::hypot(3e300, -4e300), 5e300);
    expect_same(math::hypot(1.5e308, 1.5e308), kInfinity);
}

TEST(MathSpecialValues, angles_of_points_on_the_axes_and_at_infinity) {
    constexpr double kPi = math::kPi;
    const double cases[][3] = {{0, 1, 0},
                               {-0.0, 1, -0.0},
                               {0, -1, kPi},
                               {-0.0, -1, -kPi},
                               {0, 0, 0},
                               {-0.0, 0, -0.0},
                               {0, -0.0, kPi},
                               {-0.0, -0.0, -kPi},
                               {1, 0, kPi / 2},
                               {-1, -0.0, -kPi / 2},
                               {kInfinity, 1, kPi / 2},
                               {-kInfinity, 1, -kPi / 2},
                               {1, kInfinity, 0},
                               {-1, kInfinity, -0.0},
                               {1, -kInfinity, kPi},
                               {kInfinity, kInfinity, kPi / 4},
                               {kInfinity, -kInfinity, 0x1.2d97c7f3321d2p+1},
                               {-kInfinity, kInfinity, -kPi / 4},
                               {1, 1, kPi / 4},
                               {5e-324, 1e300, 0},
                               {5e-324, -1e300, kPi},
                               {1e308, 1e308, kPi / 4},
                               {5e-324, 5e-324, kPi / 4}};
    for (const auto& [y, x, angle] : cases) expect_same(math::atan2(y, x), angle);
}

TEST(MathSpecialValues, powers_follow_annex_f) {
    const double cases[][3] = {{0, 3, 0},
                               {-0.0, 3, -0.0},
                               {-0.0, 2, 0},
                               {-0.0, -3, -kInfinity},
                               {0, -2, kInfinity},
                               {-0.0, -0.5, kInfinity},
                               {-1, kInfinity, 1},
                               {-1, -kInfinity, 1},
                               {1, kNan, 1},
                               {kNan, 0, 1},
                               {0.5, -kInfinity, kInfinity},
                               {0.5, kInfinity, 0},
                               {-2, kInfinity, kInfinity},
                               {2, -kInfinity, 0},
                               {-kInfinity, 3, -kInfinity},
                               {-kInfinity, 2, kInfinity},
                               {-kInfinity, -3, -0.0},
                               {-kInfinity, -2, 0},
                               {kInfinity, 0.5, kInfinity},
                               {kInfinity, -0.5, 0},
                               {-1, 1e300, 1},
                               {-1, 9007199254740991, -1},
                               {-2, 1024, kInfinity},
                               {-2, 1023, -0x1p1023},
                               {-2, -1074, 5e-324},
                               {-2, -1077, -0.0},
                               {1 + 0x1p-52, 1e300, kInfinity},
                               {1 - 0x1p-53, 1e300, 0},
                               {2, 1e-300, 1},
                               {5e-324, 0.5, 0x1p-537},
                               {4, 0.5, 2}};
    for (const auto& [base, exponent, value] : cases) expect_same(math::pow(base, exponent), value);
}

TEST(MathSpecialValues, powers_and_roots_that_are_doubles_come_out_exact) {
    for (int n = -1074; n < 1024; ++n) expect_same(math::pow(2, n), std::ldexp(1.0, n));
    for (int base = 2; base <= 100; ++base) {
        double power = 1;
        for (int n = 1; power * base < 0x1p53; ++n) {
            power *= base;
            expect_same(math::pow(base, n), power);
            expect_same(math::pow(-base, n), n % 2 == 1 ? -power : power);
        }
        expect_same(math::cbrt(static_cast<double>(base * base * base)), base);
    }
    for (int n = 0; n <= 22; ++n) expect_same(math::log10(math::pow(10, n)), n);
}

}  // namespace
}  // namespace tribo
