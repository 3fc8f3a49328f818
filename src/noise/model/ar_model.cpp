// SPDX-License-Identifier: MIT
#include "noise/model/ar_model.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "noise/model/levinson.hpp"

namespace tribo::noise {
namespace {

// |A(e^-jw)|^2 by Horner's rule.
double squared_size(std::span<const double> predictor, double angle) {
    double cosine = 0, sine = 0;
    math::sincos(angle, sine, cosine);
    double re = 0, im = 0;
    for (std::size_t k = predictor.size(); k-- > 0;) {
        const double x = re + predictor[k];
        re = x * cosine + im * sine;
        im = im * cosine - x * sine;
    }
    re += 1;
    return re * re + im * im;
}

// Phase lag of the all-pass z^-1 A~(z) / A(z) of the lattice at an angle. Each section changes the lag of the
// section before by less than half a turn, so the arctangent is never ambiguous.
double lag(std::span<const double> reflection, double angle) {
    double theta = angle;
    for (const double k : reflection) {
        double cosine = 0, sine = 0;
        math::sincos(theta, sine, cosine);
        theta += angle - 2 * math::atan2(k * sine, 1 + k * cosine);
    }
    return theta;
}

// Multiplies a polynomial of `degree`, with zeros behind it, by 1 + b z^-1 + c z^-2, in place.
void multiply(std::span<double> polynomial, std::size_t& degree, double b, double c) {
    degree += c != 0 ? 2 : 1;
    for (std::size_t n = degree; n > 1; --n) polynomial[n] += b * polynomial[n - 1] + c * polynomial[n - 2];
    polynomial[1] += b * polynomial[0];
}

}  // namespace

void predictor_of(std::span<const double> reflection, std::span<double> predictor) {
    assert(predictor.size() == reflection.size());
    for (std::size_t m = 0; m < reflection.size(); ++m) {
        const double k = reflection[m];
        predictor[m] = k;
        for (std::size_t i = 0, j = m; i < j; ++i) {
            --j;
            const double low = predictor[i], high = predictor[j];
            predictor[i] = low + k * high;
            if (i != j) predictor[j] = high + k * low;
        }
    }
}

std::vector<double> predictor_of(std::span<const double> reflection) {
    std::vector<double> predictor(reflection.size());
    predictor_of(reflection, predictor);
    return predictor;
}

void reflection_of(std::span<double> predictor, std::span<double> reflection) {
    assert(predictor.size() == reflection.size());
    for (std::size_t m = predictor.size(); m-- > 0;) {
        const double k = predictor[m];
        reflection[m] = k;
        const double scale = 1 / (1 - k * k);
        for (std::size_t i = 0, j = m; i < j; ++i) {
            --j;
            const double low = predictor[i], high = predictor[j];
            predictor[i] = scale * (low - k * high);
            if (i != j) predictor[j] = scale * (high - k * low);
        }
    }
}

double innovation_power(std::span<const double> reflection) {
    double power = 1;
    for (const double k : reflection) power *= 1 - k * k;
    return power;
}

double power_at(const ArModel& model, double hz) {
    return innovation_power(model.reflection) /
           squared_size(predictor_of(model.reflection), math::kTwoPi * hz / model.sample_rate_hz);
}

std::vector<double> autocorrelation_of(std::span<const double> reflection, int lags) {
    // Levinson's recursion in reverse: the predictor of order m and r_0 ... r_(m-1) give r_m.
    std::vector<double> r(static_cast<std::size_t>(lags) + 1), a;
    r[0] = 1;
    double error = 1;
    for (std::size_t m = 1; m < r.size(); ++m) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum -= a[i] * r[m - 1 - i];
        if (m <= reflection.size()) {
            const double k = reflection[m - 1];
            sum -= k * error;
            error *= 1 - k * k;
            a = predictor_of(reflection.first(m));
        }
        r[m] = sum;
    }
    return r;
}

std::vector<double> line_spectrum_of(std::span<const double> reflection) {
    std::vector<double> angles(reflection.size());
    double below = 0;
    for (std::size_t n = 0; n < angles.size(); ++n) {
        const double wanted = math::kPi * static_cast<double>(n + 1);
        double low = below, high = math::kPi;
        while (true) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) break;
            (lag(reflection, middle) < wanted ? low : high) = middle;
        }
        below = angles[n] = high;
    }
    return angles;
}

void predictor_from_line_spectrum(std::span<const double> angles, std::span<double> predictor,
                                  std::span<double> work) {
    const std::size_t order = angles.size();
    assert(predictor.size() == order && work.size() >= 2 * (order + 2));
    // A = (P + Q) / 2. The roots of P are the angles 1, 3, ..., the roots of Q the others. The angles 0 and
    // pi belong to the polynomial that they complete to degree p + 1.
    const std::span<double> p = work.first(order + 2), q = work.subspan(order + 2, order + 2);
    std::size_t p_degree = 0, q_degree = 0;
    std::ranges::fill(work, 0.0);
    p[0] = q[0] = 1;
    if (order % 2 == 0) multiply(p, p_degree, 1, 0);
    multiply(q, q_degree, -1, 0);
    if (order % 2 == 1) multiply(q, q_degree, 1, 0);
    // Neighbouring angles one after the other would make huge coefficients that cancel in the end. At steps
    // of the golden section (two Fibonacci numbers) they are spread evenly at any time.
    constexpr std::size_t kTurn = 987, kStep = 610;
    static_assert(kTurn > kLargestPlayedOrder);
    for (std::size_t n = 0; n < kTurn; ++n) {
        const std::size_t at = n * kStep % kTurn;
        if (at >= order) continue;
        const bool is_of_p = at % 2 == 0;
        multiply(is_of_p ? p : q, is_of_p ? p_degree : q_degree, -2 * math::cos(angles[at]), 1);
    }
    assert(p_degree == order + 1 && q_degree == order + 1);
    for (std::size_t n = 0; n < order; ++n) predictor[n] = 0.5 * (p[n + 1] + q[n + 1]);
}

ArModel at_rate(const ArModel& model, double sample_rate_hz, double* power) {
    if (power) *power = 1;
    if (sample_rate_hz == model.sample_rate_hz) return model;
    // Autocorrelation of the spectrum on a grid of the new band, by the trapezoid rule. It is exact, except
    // for responses longer than the grid.
    constexpr int kGrid = 4096;
    // Beyond the old band the spectrum falls by 60 dB per octave, down to 60 dB below the mean.
    constexpr double kFloor = 1e-6;
    // A few poles give the spectrum at their own rate exactly, but no edge at the old half rate.
    constexpr double kFewPoles = 32;
    const double wider = std::max(sample_rate_hz / model.sample_rate_hz, 1.0);
    const double poles = std::max(static_cast<double>(model.reflection.size()), kFewPoles) * wider;
    const auto order = static_cast<std::size_t>(std::min(std::ceil(poles), 1.0 * kLargestPlayedOrder));
    const std::vector<double> predictor = predictor_of(model.reflection);
    const double innovation = innovation_power(model.reflection);
    const double half_old = 0.5 * model.sample_rate_hz;
    std::vector<double> r(order + 1);
    double inside = 0;
    for (int n = 0; n <= kGrid; ++n) {
        const double angle = math::kPi * n / kGrid;
        const double hz = sample_rate_hz * n / (2.0 * kGrid);
        const double weight = (n % kGrid == 0 ? 0.5 : 1.0) / kGrid;
        double s = innovation /
                   squared_size(predictor, math::kTwoPi * std::min(hz, half_old) / model.sample_rate_hz);
        if (hz <= half_old) {
            inside += weight * s;
        } else {
            s = std::max(s * math::pow(half_old / hz, 20), kFloor);
        }
        double cosine = 0, sine = 0;
        math::sincos(angle, sine, cosine);
        double re = 1, im = 0;
        for (double& lag : r) {
            lag += weight * s * re;
            const double turned = re * cosine - im * sine;
            im = re * sine + im * cosine;
            re = turned;
        }
    }
    if (power) *power = inside * sample_rate_hz / model.sample_rate_hz;
    return {sample_rate_hz, levinson(r, 1e-9)};
}

}  // namespace tribo::noise
