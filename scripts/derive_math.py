#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Derives every number in src/base/math_tables.hpp and prints that file. Needs only Python's decimal module.

Polynomials interpolate at Chebyshev nodes, in 60 digits; the largest error, weighted as the function that uses
the polynomial sees it, stands beside each as a power of two (double rounding is 2^-53).
"""
from decimal import Decimal as D, getcontext
from fractions import Fraction
import math

getcontext().prec = 60


def arctan_inverse(n, digits):
    """atan(1/n) by its series."""
    total, power, k = D(0), D(1) / n, 0
    while power > D(10) ** -digits:
        total += (power if k % 2 == 0 else -power) / (2 * k + 1)
        power /= n * n
        k += 1
    return total


def pi(digits):
    before = getcontext().prec
    getcontext().prec = digits + 10
    value = 16 * arctan_inverse(5, digits + 8) - 4 * arctan_inverse(239, digits + 8)  # Machin 1706
    getcontext().prec = before
    return value


PI = +pi(60)
LN2 = D(2).ln()


def series(term):
    """Sum of term(0), term(1), ... until it no longer changes."""
    total, k = D(0), 0
    while True:
        t = term(k)
        if k > 4 and abs(t) <= abs(total) * D(10) ** -58:
            return total + t
        total += t
        k += 1


def factorial(n):
    return D(math.factorial(n))


def sin_tail(z):  # (sin r / r - 1) / z, z = r^2
    return series(lambda k: (-1) ** (k + 1) * z**k / factorial(2 * k + 3))


def cos_tail(z):  # (cos r - 1 + z / 2) / z^2
    return series(lambda k: (-1) ** k * z**k / factorial(2 * k + 4))


def atan_tail(z):  # (atan t / t - 1) / z
    return series(lambda k: (-1) ** (k + 1) * z**k / (2 * k + 3))


def asin_tail(z):  # (asin x / x - 1) / z
    return series(lambda k: z**k * math.comb(2 * k + 2, k + 1) / (D(4) ** (k + 1) * (2 * k + 3)))


def exp_tail(r):  # (e^r - 1 - r) / r^2
    return series(lambda k: r**k / factorial(k + 2))


def log_tail(z):  # (log((1 + s) / (1 - s)) / s - 2) / z, z = s^2
    return series(lambda k: 2 * z**k / (2 * k + 3))


def log_cubic(r):  # (log(1 + r) - r + r^2 / 2) / r^3
    return series(lambda k: (-1) ** k * r**k / (k + 3))


def interpolate(f, low, high, count):
    """Coefficients, lowest first, of the polynomial through f at `count` Chebyshev nodes of [low, high]."""
    nodes = [(low + high) / 2 + (high - low) / 2 * D(math.cos(math.pi * (i + 0.5) / count)) for i in range(count)]
    rows = [[x**j for j in range(count)] + [f(x)] for x in nodes]
    for i in range(count):
        pivot = max(range(i, count), key=lambda j: abs(rows[j][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [v / rows[i][i] for v in rows[i]]
        for j in range(count):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i])]
    return [row[count] for row in rows]


def polynomial(name, what, f, low, high, count, weight):
    exact = interpolate(f, low, high, count)
    rounded = [float(c) for c in exact]
    worst = D(0)
    for i in range(2001):
        x = low + (high - low) * i / 2000
        if x == 0:
            continue
        value = D(0)
        for c in reversed(rounded):
            value = value * x + D(c)
        worst = max(worst, abs((value - f(x)) * weight(x)))
    print(f"// {what}; error 2^{math.log2(worst):.1f}.")
    print(f"inline constexpr double {name}[{count}] = {{")
    print(",\n".join("    " + ", ".join(c.hex() for c in rounded[i:i + 4]) for i in range(0, count, 4)) + "};\n")


def leading_bits(value, bits):
    """value rounded down in size to a multiple of its leading bit times 2^(1 - bits)."""
    exponent = math.floor(math.log2(abs(value))) + 1 - bits
    return float(math.trunc(Fraction(value) / Fraction(2) ** exponent) * Fraction(2) ** exponent)


def on_grid(value, exponent):
    return float(round(Fraction(value) / Fraction(2) ** exponent) * Fraction(2) ** exponent)


def constant(name, value):
    print(f"inline constexpr double {name} = {float(value).hex()};")


def high_low(name, value):
    high = float(value)
    print(f"inline constexpr double {name}Hi = {high.hex()}, {name}Lo = {float(value - D(high)).hex()};")


def main():
    print("""// SPDX-License-Identifier: MIT
// Numbers of base/math.cpp, written by scripts/derive_math.py.
#pragma once

#include <cstdint>

namespace tribo::math::tables {
""")
    half_pi = PI / 2
    print("// pi/2 in parts of 33 bits, whose products with an integer below 2^20 are exact, and a tail.")
    rest = half_pi
    for i in (1, 2, 3):
        part = leading_bits(rest, 33)
        constant(f"kHalfPiPart{i}", part)
        rest -= D(part)
    constant("kHalfPiPart4", rest)
    constant("kTwoOverPi", 2 / PI)
    print("// Constants as the sum of two doubles.")
    high_low("kPi", PI)
    high_low("kHalfPi", half_pi)
    high_low("kInverseLn10", 1 / D(10).ln())
    print("// ln 2 with a first part of 42 bits: its products with an exponent are exact.")
    ln2_hi = leading_bits(LN2, 42)
    constant("kLn2Hi", ln2_hi)
    constant("kLn2Lo", LN2 - D(ln2_hi))
    constant("kInverseLn2", 1 / LN2)
    print()
    quarter = (PI / 4 + D("1e-6")) ** 2
    polynomial("kSin", "(sin r / r - 1) / z, z = r^2, |r| <= pi/4", sin_tail, D(0), quarter, 7, lambda z: z)
    polynomial("kCos", "(cos r - 1 + z/2) / z^2, z = r^2, |r| <= pi/4", cos_tail, D(0), quarter, 6,
               lambda z: z * z * D(1.42))
    polynomial("kAtan", "(atan t / t - 1) / z, z = t^2, |t| <= 1/16", atan_tail, D(0), D("0.0627") ** 2, 6,
               lambda z: z)
    polynomial("kAsin", "(asin x / x - 1) / z, z = x^2, |x| <= 1/2", asin_tail, D(0), D("0.25"), 13, lambda z: z)
    half_ln2 = LN2 / 2 + D("1e-6")
    polynomial("kExp", "(exp r - 1 - r) / r^2, |r| <= ln(2)/2", exp_tail, -half_ln2, half_ln2, 11,
               lambda r: r * r * D(1.42))
    polynomial("kLog", "(log((1 + s)/(1 - s)) / s - 2) / z, z = s^2, |s| <= 0.1716", log_tail, D(0),
               D("0.1717") ** 2, 7, lambda z: z / 2)
    polynomial("kLogCubic", "(log(1 + r) - r + r^2/2) / r^3, |r| <= 0.0075", log_cubic, D("-0.0075"), D("0.0075"),
               8, lambda r: r * r)

    print("""// For i = 90 ... 182: an inverse c of i/128 in 10 bits, and -log c as a multiple of 2^-42 plus a tail.
struct LogRow {
    double inverse, minus_log_hi, minus_log_lo;
};
inline constexpr int kLogFirst = 90;
inline constexpr LogRow kLogTable[] = {""")
    for i in range(90, 183):
        c = on_grid(Fraction(128, i), -9)
        minus_log = -D(c).ln()
        high = on_grid(minus_log, -42)
        print(f"    {{{c.hex()}, {high.hex()}, {float(minus_log - D(high)).hex()}}},")
    print("};\n")

    print("// atan(i/8), i = 0 ... 8, as the sum of two doubles.")
    print("inline constexpr double kAtanEighths[9][2] = {")
    for i in range(9):
        x = D(i) / 8
        # atan x = 2 atan(x / (1 + sqrt(1 + x^2))), three times, then the series.
        y = x
        for _ in range(3):
            y = y / (1 + (1 + y * y).sqrt())
        value = 8 * (y + y**3 * atan_tail(y * y)) if i else D(0)
        high = float(value)
        print(f"    {{{high.hex()}, {float(value - D(high)).hex()}}},")
    print("};\n")

    getcontext().prec = 420
    bits = 64 * 20
    fraction = int(D(2) / pi(410) * D(2) ** bits)
    print("// The first 1280 bits of 2/pi after the point, most significant first.")
    print("inline constexpr std::uint64_t kTwoOverPiBits[20] = {")
    words = [f"0x{(fraction >> (bits - 64 * (i + 1))) & (2**64 - 1):016x}" for i in range(20)]
    print(",\n".join("    " + ", ".join(words[i:i + 4]) for i in range(0, 20, 4)) + "};\n")
    print("}  // namespace tribo::math::tables")


main()
