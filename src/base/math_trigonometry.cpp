// SPDX-License-Identifier: MIT
#include <cstdint>

#include "base/math.hpp"
#include "base/math_parts.hpp"
#include "base/math_tables.hpp"

namespace tribo::math {
namespace {

using namespace parts;
using namespace tables;

// Below it sin x, tan x, asin x and atan x are x to the last bit.
constexpr double kTiny = 0x1p-27;

struct Angle {
    Pair rest;          // in [-pi/4, pi/4] up to rounding
    unsigned quadrant;  // x = rest + quadrant pi/2, modulo 2 pi
};

// Above this, n times a 33-bit part of pi/2 would no longer be exact (n < 2^20).
constexpr double kLargestForParts = 1e5;

// Payne and Hanek 1983: the relevant bits of 2/pi times the 53-bit integer m of x = m 2^e, modulo 4.
Angle reduce_large(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t m = (bits & 0x000fffffffffffff) | 0x0010000000000000;
    const int e = static_cast<int>((bits >> 52) & 0x7ff) - 1075;

    // Three words of 2/pi from the bit of weight 2^(1 - e) on. The bits before them only add multiples of 4.
    // Weights above 2^-1 (e < 2) are zero bits.
    const int first = e - 2 + 64;
    const auto word = [](int i) { return i == 0 ? std::uint64_t{0} : kTwoOverPiBits[i - 1]; };
    const int index = first / 64, shift = first % 64;
    std::uint64_t window[3];
    for (int i = 0; i < 3; ++i) {
        window[i] = word(index + i) << shift;
        if (shift > 0) window[i] |= word(index + i + 1) >> (64 - shift);
    }

    using Wide = unsigned __int128;
    const Wide low = Wide{m} * window[2];
    const Wide middle = Wide{m} * window[1] + (low >> 64);
    const std::uint64_t high = m * window[0] + static_cast<std::uint64_t>(middle >> 64);

    // high : middle : low in units of 2^-190 turns of a quadrant. 128 bits of fraction are enough, because no
    // double comes nearer than 2^-62 to a multiple of pi/2.
    unsigned quadrant = static_cast<unsigned>(high >> 62);
    Wide fraction = (Wide{high} << 66) | (Wide{static_cast<std::uint64_t>(middle)} << 2) |
                    (static_cast<std::uint64_t>(low) >> 62);
    const bool above_half = (fraction >> 127) != 0;
    if (above_half) {
        fraction = -fraction;
        ++quadrant;
    }
    const int leading = fraction >> 64 ? std::countl_zero(static_cast<std::uint64_t>(fraction >> 64))
                                       : 64 + std::countl_zero(static_cast<std::uint64_t>(fraction) | 1);
    fraction <<= leading;
    const double scale = power_of_two(-53 - leading);
    const double hi = static_cast<double>(static_cast<std::int64_t>(fraction >> 75)) * scale;
    const double lo = static_cast<double>(static_cast<std::int64_t>((fraction >> 22) & 0x1fffffffffffff)) *
                      (scale * 0x1p-53);

    const Pair product = two_product(hi, kHalfPiHi);
    const Pair rest = fast_two_sum(product.hi, product.lo + (hi * kHalfPiLo + lo * kHalfPiHi));
    const bool negative = (x < 0) != above_half;
    if (x < 0) quadrant = 0 - quadrant;
    return {negative ? Pair{-rest.hi, -rest.lo} : rest, quadrant & 3};
}

Angle reduce(double x) {
    const double size = std::abs(x);
    if (size <= 0x1.921fb54442d18p-1) return {{x, 0}, 0};
    if (size > kLargestForParts) {
        if (!(size < kInfinity)) return {{kNan, kNan}, 0};
        return reduce_large(x);
    }
    // Cody and Waite 1980 with three exact parts of pi/2 and a tail: accurate to 2^-138 for |x| <= 1e5.
    const double shifted = x * kTwoOverPi + kRoundShift;
    const double n = shifted - kRoundShift;
    const Pair a = two_sum(x - n * kHalfPiPart1, -(n * kHalfPiPart2));
    const Pair b = two_sum(a.hi, -(n * kHalfPiPart3));
    const Pair rest = two_sum(b.hi, (a.lo + b.lo) - n * kHalfPiPart4);
    return {rest, static_cast<unsigned>(std::bit_cast<std::uint64_t>(shifted) & 3)};
}

// Returns sin r - r.hi, |r| <= pi/4.
inline double sin_correction(Pair r) {
    const double z = r.hi * r.hi;
    return r.hi * z * horner(kSin, z) + (r.lo - 0.5 * z * r.lo);
}

// cos r as a Pair, |r| <= pi/4.
inline Pair cos_pair(Pair r) {
    const double z = r.hi * r.hi, half = 0.5 * z, near = 1 - half;
    return fast_two_sum(near, ((1 - near) - half) + (z * z * horner(kCos, z) - r.hi * r.lo));
}

inline double cos_reduced(Pair r) {
    const Pair c = cos_pair(r);
    return c.hi + c.lo;
}

inline double sin_reduced(Pair r) {
    return std::abs(r.hi) < kTiny ? r.hi : r.hi + sin_correction(r);
}

// asin(x) - x for |x| <= 1/2, z = x^2.
inline double asin_correction(double x, double z) {
    return x * (z * horner(kAsin, z));
}

// asin of sqrt(z) for 0 < z <= 1/4.
inline Pair asin_root(double z) {
    const double s = std::sqrt(z);
    const Pair square = two_product(s, s);
    const double rest = ((z - square.hi) - square.lo) / (2 * s);
    return {s, rest + asin_correction(s, z)};
}

// atan(num / den) for 0 <= num <= den, both finite, den > 0: about the nearest eighth c,
// atan(u) = atan(c) + atan((u - c) / (1 + c u)).
Pair atan_ratio(double num, double den) {
    const double ratio = num / den;
    const int i = static_cast<int>(ratio * 8 + 0.5);
    if (i == 0) {
        const double z = ratio * ratio;
        return {ratio, ratio * (z * horner(kAtan, z))};
    }
    const double scale = den > 0x1p900 ? 0x1p-200 : den < 0x1p-900 ? 0x1p200 : 1;
    num *= scale;
    den *= scale;
    const double c = 0.125 * i;
    const Pair parts_of_den = split(den);
    const double t = ((num - c * parts_of_den.hi) - c * parts_of_den.lo) / (den + c * num);
    const double z = t * t;
    return fast_two_sum(kAtanEighths[i][0], t + (t * (z * horner(kAtan, z)) + kAtanEighths[i][1]));
}

}  // namespace

double sin(double x) {
    const Angle a = reduce(x);
    const double value = a.quadrant & 1 ? cos_reduced(a.rest) : sin_reduced(a.rest);
    return value != value ? kNan : a.quadrant & 2 ? -value : value;
}

double cos(double x) {
    const Angle a = reduce(x);
    const double value = a.quadrant & 1 ? sin_reduced(a.rest) : cos_reduced(a.rest);
    return value != value ? kNan : (a.quadrant + 1) & 2 ? -value : value;
}

void sincos(double x, double& sine, double& cosine) {
    const Angle a = reduce(x);
    const double s = sin_reduced(a.rest), c = cos_reduced(a.rest);
    if (s != s) {
        sine = cosine = kNan;
        return;
    }
    const double first = a.quadrant & 1 ? c : s, second = a.quadrant & 1 ? s : c;
    sine = a.quadrant & 2 ? -first : first;
    cosine = (a.quadrant + 1) & 2 ? -second : second;
}

double tan(double x) {
    if (std::abs(x) < kTiny) return x;
    const Angle a = reduce(x);
    if (a.rest.hi != a.rest.hi) return kNan;
    Pair num = fast_two_sum(a.rest.hi, sin_correction(a.rest)), den = cos_pair(a.rest);
    if (a.quadrant & 1) {
        const Pair sine = num;
        num = {-den.hi, -den.lo};
        den = sine;
    }
    const double q = num.hi / den.hi;
    return q + (num.lo - q * den.lo) / den.hi;
}

double asin(double x) {
    const double size = std::abs(x);
    if (!(size <= 1)) return kNan;
    if (size < kTiny) return x;
    if (size <= 0.5) return x + asin_correction(x, x * x);
    if (size == 1) return std::copysign(kHalfPiHi, x);
    const Pair rest = asin_root(0.5 * (1 - size));
    const Pair sum = two_sum(kHalfPiHi, -2 * rest.hi);
    return std::copysign(sum.hi + (sum.lo + (kHalfPiLo - 2 * rest.lo)), x);
}

double acos(double x) {
    const double size = std::abs(x);
    if (!(size <= 1)) return kNan;
    if (size <= 0.5) {
        const Pair sum = two_sum(kHalfPiHi, -x);
        return sum.hi + (sum.lo + (kHalfPiLo - asin_correction(x, x * x)));
    }
    if (size == 1) return x > 0 ? 0 : kPiHi;
    const Pair half = asin_root(0.5 * (1 - size));
    if (x > 0) return 2 * half.hi + 2 * half.lo;
    const Pair sum = two_sum(kPiHi, -2 * half.hi);
    return sum.hi + (sum.lo + (kPiLo - 2 * half.lo));
}

double atan2(double y, double x) {
    if (x != x || y != y) return kNan;
    double num = std::abs(y), den = std::abs(x);
    const bool steep = num > den;
    if (steep) {
        const double swap = num;
        num = den;
        den = swap;
    }
    if (den == kInfinity) {
        num = num == kInfinity ? 1 : 0;
        den = 1;
    }
    if (den == 0) den = 1;
    const Pair a = atan_ratio(num, den);
    double angle;
    if (steep) {
        const double sign = std::signbit(x) ? 1 : -1;
        const Pair sum = fast_two_sum(kHalfPiHi, sign * a.hi);
        angle = sum.hi + (sum.lo + (kHalfPiLo + sign * a.lo));
    } else if (std::signbit(x)) {
        const Pair sum = fast_two_sum(kPiHi, -a.hi);
        angle = sum.hi + (sum.lo + (kPiLo - a.lo));
    } else {
        angle = a.hi + a.lo;
    }
    return std::copysign(angle, y);
}

double atan(double x) {
    return atan2(x, 1.0);
}

}  // namespace tribo::math
