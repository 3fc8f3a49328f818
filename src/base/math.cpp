// SPDX-License-Identifier: MIT
#include "base/math.hpp"

#include <cstdint>

#include "base/math_parts.hpp"
#include "base/math_tables.hpp"

namespace tribo::math {
namespace {

using namespace parts;
using namespace tables;

// e^x overflows above the first and rounds to 0 below the second.
constexpr double kExpOverflow = 0x1.62e42fefa39efp9;
constexpr double kExpUnderflow = -0x1.74910d52d3051p9;

// y 2^k for 1/2 < y < 2, rounded once if the result is subnormal.
double scaled(double y, int k) {
    if (k > 1023) return y * 2 * power_of_two(k - 1);
    if (k > -1022) return y * power_of_two(k);
    return y * power_of_two(k + 200) * 0x1p-200;
}

// e^(hi + lo), between the two limits.
double exp_of(double hi, double lo) {
    const double k = (hi * kInverseLn2 + kRoundShift) - kRoundShift;
    const double high = hi - k * kLn2Hi;  // exact
    const double low = lo - k * kLn2Lo;
    const Pair r = fast_two_sum(high, low);
    const double y = 1 + (r.hi + (r.hi * r.hi * horner(kExp, r.hi) + r.lo * (1 + r.hi)));
    return scaled(y, static_cast<int>(k));
}

struct Logarithm {
    double mantissa;  // in [sqrt(1/2), sqrt(2))
    int exponent;
};

// x = mantissa 2^exponent for 0 < x < infinity.
Logarithm parts_of(double x) {
    int exponent = 0;
    if (x < 0x1p-1022) {
        x *= 0x1p54;
        exponent = -54;
    }
    constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;
    const std::uint64_t offset = std::bit_cast<std::uint64_t>(x) - kRootHalf;
    exponent += static_cast<int>(static_cast<std::int64_t>(offset) >> 52);
    return {std::bit_cast<double>((offset & 0x000fffffffffffff) + kRootHalf), exponent};
}

// log x with a relative error below 2^-65, for 0 < x < infinity.
// r = m c - 1 with c from a table; log x = k ln 2 - log c + r - r^2/2 + r^3 (...).
Pair log_pair(double x) {
    const auto [m, exponent] = parts_of(x);
    const double k = exponent;
    const LogRow& row = kLogTable[static_cast<int>(m * 128 + 0.5) - kLogFirst];
    const Pair m_parts = split(m);
    const Pair r = two_sum(m_parts.hi * row.inverse - 1, m_parts.lo * row.inverse);
    const Pair square = two_product(r.hi, r.hi);
    const Pair a = two_sum(k * kLn2Hi + row.minus_log_hi, r.hi);
    const Pair b = two_sum(a.hi, -0.5 * square.hi);
    const double small = r.hi * square.hi * horner(kLogCubic, r.hi) + (r.lo - r.hi * r.lo - 0.5 * square.lo);
    return fast_two_sum(b.hi, (a.lo + b.lo) + (small + (k * kLn2Lo + row.minus_log_lo)));
}

// Returns the logarithm for an x that is not positive and finite.
double log_special(double x) {
    return x == 0 ? -kInfinity : x > 0 ? x : kNan;
}

bool is_integer(double y) {
    return std::floor(y) == y;
}
bool is_odd(double y) {
    return std::abs(y) < 0x1p53 && is_integer(y) && !is_integer(0.5 * y);
}

}  // namespace

double exp(double x) {
    if (x != x) return kNan;
    if (x > kExpOverflow) return kInfinity;
    if (x < kExpUnderflow) return 0;
    if (std::abs(x) < 0x1p-54) return 1;
    return exp_of(x, 0);
}

double log(double x) {
    if (!(x > 0 && x < kInfinity)) return log_special(x);
    const auto [m, exponent] = parts_of(x);
    // s = f / (2 + f): log(1 + f) = 2 s + s R(s^2), and 2 s = f - s f, so that only small terms are rounded.
    const double k = exponent, f = m - 1, s = f / (2 + f), z = s * s;
    const double half_square = 0.5 * f * f;
    const double bend = s * (half_square + z * horner(kLog, z));
    return k * kLn2Hi - ((half_square - (bend + k * kLn2Lo)) - f);
}

double log10(double x) {
    if (!(x > 0 && x < kInfinity)) return log_special(x);
    if (x == 1) return 0;
    const Pair l = log_pair(x);
    const Pair product = two_product(l.hi, kInverseLn10Hi);
    return product.hi + (product.lo + (l.hi * kInverseLn10Lo + l.lo * kInverseLn10Hi));
}

double pow(double base, double exponent) {
    if (exponent == 0 || base == 1) return 1;
    if (base != base || exponent != exponent) return kNan;
    const double size = std::abs(base);
    if (std::abs(exponent) == kInfinity) {
        if (size == 1) return 1;
        return (size > 1) == (exponent > 0) ? kInfinity : 0;
    }
    const double sign = std::signbit(base) && is_odd(exponent) ? -1 : 1;
    if (size == 0 || size == kInfinity) return sign * ((size == 0) == (exponent > 0) ? 0 : kInfinity);
    if (base < 0 && !is_integer(exponent)) return kNan;
    if (size == 1) return sign;

    const Pair l = log_pair(size);
    const double product = exponent * l.hi;
    if (product > 710) return sign * kInfinity;
    if (product < -746) return sign * 0;
    if (std::abs(product) < 0x1p-60) return sign;
    const Pair exact = two_product(exponent, l.hi);
    const double low = exact.lo + exponent * l.lo;
    if (exact.hi + low > kExpOverflow + 0x1p-43) return sign * kInfinity;
    return sign * exp_of(exact.hi, low);
}

double cbrt(double x) {
    if (x == 0 || !(std::abs(x) < kInfinity)) return x != x ? kNan : x;
    double size = std::abs(x);
    int exponent = 0;
    if (size < 0x1p-1022) {
        size *= 0x1p54;
        exponent = -54;
    }
    const auto bits = std::bit_cast<std::uint64_t>(size);
    exponent += static_cast<int>(bits >> 52) - 1023;
    const int third = (exponent + 1200) / 3 - 400;  // rounded down
    // a in [1, 8)
    const double a = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000) *
                     power_of_two(exponent - 3 * third);

    // The parabola through (1, 1), (27/8, 3/2), (8, 2) is accurate to 3 %, two Halley steps to 1e-14. The
    // last step starts from 26 bits, whose square is exact.
    double t = 1 + (a - 1) * (4.0 / 19.0) - (a - 1) * (a - 3.375) * (4.0 / 19.0 - 4.0 / 37.0) / 7;
    for (int i = 0; i < 2; ++i) {
        const double cube = t * t * t;
        t = t * (cube + 2 * a) / (2 * cube + a);
    }
    t = split(t).hi;
    const double r = a / (t * t);
    t += t * ((r - t) / (2 * t + r));
    return std::copysign(t * power_of_two(third), x);
}

double hypot(double x, double y) {
    double a = std::abs(x), b = std::abs(y);
    if (a == kInfinity || b == kInfinity) return kInfinity;
    if (a != a || b != b) return kNan;
    if (a < b) {
        const double swap = a;
        a = b;
        b = swap;
    }
    if (b <= a * 0x1p-54) return a + b;
    if (a > 0x1p500)
        return std::sqrt((a * 0x1p-600) * (a * 0x1p-600) + (b * 0x1p-600) * (b * 0x1p-600)) * 0x1p600;
    if (b < 0x1p-400)
        return std::sqrt((a * 0x1p600) * (a * 0x1p600) + (b * 0x1p600) * (b * 0x1p600)) * 0x1p-600;
    return std::sqrt(a * a + b * b);
}

}  // namespace tribo::math
