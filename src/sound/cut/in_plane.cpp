// SPDX-License-Identifier: MIT
#include "sound/cut/in_plane.hpp"

#include "base/math.hpp"

namespace tribo::sound {
namespace {

constexpr double square(double a) {
    return a * a;
}
// Of the chain that leads, and of the one that, a sample later, lags by a quarter of a cycle.
constexpr std::array<double, 4> kLeading{square(0.4021921162426), square(0.8561710882420),
                                         square(0.9722909545651), square(0.9952884791278)};
constexpr std::array<double, 4> kLagging{square(0.6923878), square(0.9360654322959), square(0.9882295226860),
                                         square(0.9987488452737)};

}  // namespace

double InPlane::Chain::next(double value, const std::array<double, kSections>& squares) {
    for (std::size_t n = 0; n < kSections; ++n) {
        const double out = squares[n] * (value + out2[n]) - in2[n];
        in2[n] = in1[n];
        in1[n] = value;
        out2[n] = out1[n];
        out1[n] = out;
        value = out;
    }
    return value;
}

double InPlane::next(double x, double y) {
    const double lagging = y_before_;
    y_before_ = y_.next(y, kLagging);
    return x_.next(x, kLeading) + lagging;
}

void InPlane::forget() {
    *this = {};
}

std::complex<double> InPlane::response(double hz, double rate_hz) {
    double sine, cosine;
    math::sincos(2 * math::kTwoPi * hz / rate_hz, sine, cosine);
    const std::complex<double> two_ago(cosine, -sine);
    std::complex<double> product = 1;
    for (const double a : kLeading) product *= (a - two_ago) / (1.0 - a * two_ago);
    return product;
}

}  // namespace tribo::sound
