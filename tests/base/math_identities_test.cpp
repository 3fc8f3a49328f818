// SPDX-License-Identifier: MIT
// Identities that base/math.hpp keeps, on arguments that RapidCheck chooses and shrinks.
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"

namespace tribo {
namespace {

constexpr double kUlp = 0x1p-52;

double between(double low, double high) {
    return low + (high - low) *
                     static_cast<double>(*rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53)) * 0x1p-53;
}

RC_GTEST_PROP(MathIdentities, sine_and_cosine_lie_on_the_unit_circle, (double x)) {
    double s = 0, c = 0;
    math::sincos(x, s, c);
    RC_ASSERT(std::abs(s * s + c * c - 1) <= 3 * kUlp);
}

RC_GTEST_PROP(MathIdentities, odd_functions_are_odd_and_even_ones_even_to_the_bit, (double x)) {
    RC_ASSERT(math::sin(-x) == -math::sin(x));
    RC_ASSERT(math::cos(-x) == math::cos(x));
    RC_ASSERT(math::tan(-x) == -math::tan(x));
    RC_ASSERT(math::atan(-x) == -math::atan(x));
    RC_ASSERT(math::cbrt(-x) == -math::cbrt(x));
    RC_ASSERT(math::hypot(-x, 3.0) == math::hypot(3.0, x));
}

RC_GTEST_PROP(MathIdentities, atan2_gives_back_the_angle_of_a_point_on_a_circle, ()) {
    const double angle = between(-3.14159, 3.14159), radius = between(1e-3, 1e3);
    const double found = math::atan2(radius * math::sin(angle), radius * math::cos(angle));
    RC_ASSERT(std::abs(found - angle) <= 3 * kUlp * std::abs(angle));
}

RC_GTEST_PROP(MathIdentities, inverse_sine_and_cosine_add_up_to_a_quarter_turn, ()) {
    const double x = between(-1, 1);
    RC_ASSERT(std::abs(math::asin(x) + math::acos(x) - math::kHalfPi) <= 2 * kUlp);
}

RC_GTEST_PROP(MathIdentities, logarithm_undoes_the_exponential, ()) {
    const double x = between(-700, 700);
    RC_ASSERT(std::abs(math::log(math::exp(x)) - x) <= kUlp * (1 + std::abs(x)));
}

RC_GTEST_PROP(MathIdentities, powers_multiply_where_exponents_add, ()) {
    const double base = between(0.1, 10), a = between(-20, 20), b = between(-20, 20);
    const double product = math::pow(base, a) * math::pow(base, b), power = math::pow(base, a + b);
    // a + b is itself rounded, which the exponential magnifies by |a + b| |log base|.
    RC_ASSERT(std::abs(product - power) <= (4 + 40 * 2.4) * kUlp * power);
}

RC_GTEST_PROP(MathIdentities, cube_of_the_cube_root_is_the_number, ()) {
    const double x = between(-1e6, 1e6), root = math::cbrt(x);
    RC_ASSERT(std::abs(root * root * root - x) <= 4 * kUlp * std::abs(x));
}

RC_GTEST_PROP(MathIdentities, functions_that_rise_never_step_back, ()) {
    const double x = between(-5, 5), next = x + between(1e-12, 1e-3);
    RC_ASSERT(math::exp(x) <= math::exp(next));
    RC_ASSERT(math::atan(x) <= math::atan(next));
    RC_ASSERT(math::cbrt(x) <= math::cbrt(next));
    RC_ASSERT(math::log(x + 6) <= math::log(next + 6));
}

}  // namespace
}  // namespace tribo
