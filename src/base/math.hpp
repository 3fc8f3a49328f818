// SPDX-License-Identifier: MIT
// Elementary functions with the same bits on every compiler and system (libm differs). They use only + - * /
// sqrt and integer operations. Never use std::sin and similar functions in anything that is hashed.
//
// Largest error in units in the last place (asserted in tests/base): 1; 1.25 for hypot; 1.5 for tan, atan and
// atan2; one subnormal step if the result is subnormal. Special values follow C99 Annex F. A NaN result is
// always the same quiet NaN. Floating-point flags and errno are not defined. Any thread; no allocation.
#pragma once

namespace tribo::math {

inline constexpr double kPi = 0x1.921fb54442d18p+1;
inline constexpr double kTwoPi = 0x1.921fb54442d18p+2;
inline constexpr double kHalfPi = 0x1.921fb54442d18p+0;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kDegPerRad = 180.0 / kPi;

// Angles in radians. Every finite argument is reduced exactly, even a large one.
double sin(double x);
double cos(double x);
void sincos(double x, double& sine, double& cosine);  // the bits of sin(x) and cos(x) for the cost of one
double tan(double x);

double asin(double x);             // in [-pi/2, pi/2]; NaN outside [-1, 1]
double acos(double x);             // in [0, pi]; NaN outside [-1, 1]
double atan(double x);             // in [-pi/2, pi/2]
double atan2(double y, double x);  // the angle of the point (x, y), in [-pi, pi]

double exp(double x);
double log(double x);  // NaN below 0, -infinity at 0
double log10(double x);
double pow(double base, double exponent);  // exact if the exact result is a double
double cbrt(double x);
double hypot(double x, double y);  // no overflow of intermediate values

}  // namespace tribo::math
