// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/math.hpp"
#include "sound/place/ear_kernels.hpp"

namespace tribo::sound {
namespace {

// Of the Kaiser window: side lobes 80 dB down, a transition band of 0.31 of the sample rate about half of it.
constexpr double kBeta = 7.9;

// Modified Bessel function of the first kind, order 0, by its power series.
double bessel_i0(double x) {
    double sum = 1, term = 1;
    for (int k = 1; k < 40; ++k) {
        term *= (x / (2 * k)) * (x / (2 * k));
        sum += term;
    }
    return sum;
}

double kaiser_sinc(double x) {
    const double share = x / kInterpolatorAhead;
    if (share * share >= 1) return 0;
    const double angle = math::kPi * x;
    const double sinc = angle == 0 ? 1 : math::sin(angle) / angle;
    return sinc * bessel_i0(kBeta * std::sqrt(1 - share * share)) / bessel_i0(kBeta);
}

InterpolatorTable made() {
    InterpolatorTable table{};
    for (int row = 0; row <= kInterpolatorRows; ++row) {
        const double place = kInterpolatorAhead - 1 + static_cast<double>(row) / kInterpolatorRows;
        double c[kInterpolatorTaps], sum = 0;
        for (int k = 0; k < kInterpolatorTaps; ++k) sum += c[k] = kaiser_sinc(k - place);
        for (int k = 0; k < kInterpolatorTaps; ++k) {
            table[static_cast<std::size_t>(row * kInterpolatorTaps + k)] = static_cast<float>(c[k] / sum);
        }
    }
    return table;
}

}  // namespace

const InterpolatorTable& interpolator_table() {
    static const InterpolatorTable table = made();
    return table;
}

}  // namespace tribo::sound
