// SPDX-License-Identifier: MIT
// Pieces shared by the sources of base/math.hpp: error-free sums and products, powers of two, polynomials.
// Legend: a Pair is the unevaluated sum hi + lo with |lo| <= ulp(hi)/2.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tribo::math::parts {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Adding and subtracting this rounds a double below 2^51 to an integer. The lowest bits of the sum are the
// lowest bits of this integer.
inline constexpr double kRoundShift = 0x1.8p52;

struct Pair {
    double hi, lo;
};

// The exact sum (Knuth 1969).
inline Pair two_sum(double a, double b) {
    const double sum = a + b, b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

// The exact sum if |a| >= |b| or a is 0 (Dekker 1971).
inline Pair fast_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

// x = hi + lo with 26 significant bits in each (Veltkamp 1968); |x| < 2^996.
inline Pair split(double x) {
    const double c = 0x1.0000002p27 * x, hi = c - (c - x);
    return {hi, x - hi};
}

// The exact product (Dekker 1971). No part may overflow or fall below the normal range.
inline Pair two_product(double a, double b) {
    const double product = a * b;
    const Pair x = split(a), y = split(b);
    return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

// 2^k for -1022 <= k <= 1023.
inline double power_of_two(int k) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

// Coefficients in ascending order, from the constant on.
template <int N>
inline double horner(const double (&coefficients)[N], double x) {
    double value = coefficients[N - 1];
    for (int i = N - 2; i >= 0; --i) value = value * x + coefficients[i];
    return value;
}

}  // namespace tribo::math::parts
