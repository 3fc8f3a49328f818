// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/chatter_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

using Complex = std::complex<double>;

double sum_of_squares(std::span<const Complex> v) {
    double sum = 0;
    for (const Complex& x : v) sum += x.real() * x.real() + x.imag() * x.imag();
    return sum;
}

struct Line {
    int waves;  // n
    double hz;
    std::array<Complex, 9> compliance;
    double most;  // displacement for a force of 1
};

}  // namespace

double chatter_line_hz(const PeriodStep& step, const Eigenpair& vibration, double period_s,
                       double fastest_hz) {
    const double multiplier2 = sum_of_squares({&vibration.value, 1});
    const double angle = math::atan2(vibration.value.imag(), vibration.value.real());
    const double growth = multiplier2 > 0 ? 0.5 * math::log(multiplier2) : 0;
    std::vector<Line> lines;
    const int most = static_cast<int>(std::ceil(2 * fastest_hz * period_s)) + 1;
    for (int n = -most; n <= most; ++n) {
        const Complex s = Complex{growth, angle + math::kTwoPi * n} / period_s;
        Line line{n, std::abs(angle / math::kTwoPi + n) / period_s, step.oscillators().compliance(s), 0};
        line.most = std::sqrt(sum_of_squares(line.compliance));
        lines.push_back(line);
    }
    std::ranges::sort(lines, {}, [](const Line& line) { return std::pair(-line.most, line.waves); });
    std::vector<PeriodStep::Impulse> impulses;
    if (multiplier2 > 0) impulses = step.impulses(vibration.vector, vibration.value);
    // e^(-s_0 t) of each; its size is a bound of the force of all lines.
    double force = 0;
    for (PeriodStep::Impulse& impulse : impulses) {
        double sine, cosine;
        math::sincos(-angle * impulse.t_s / period_s, sine, cosine);
        const double shrunk = math::exp(-growth * impulse.t_s / period_s);
        for (Complex& x : impulse.ns) x *= Complex{shrunk * cosine, shrunk * sine};
        force += std::sqrt(sum_of_squares(impulse.ns));
    }
    const std::size_t d = step.oscillators().dimensions();
    double best = lines.front().hz, largest = 0;
    for (const Line& line : lines) {
        const double bound = force * line.most;
        if (!(bound * bound > largest)) break;
        std::array<Complex, 3> harmonic{}, moved{};
        for (const PeriodStep::Impulse& impulse : impulses) {
            double sine, cosine;
            math::sincos(-math::kTwoPi * line.waves * impulse.t_s / period_s, sine, cosine);
            for (std::size_t a = 0; a < d; ++a) harmonic[a] += impulse.ns[a] * Complex{cosine, sine};
        }
        for (std::size_t a = 0; a < d; ++a)
            for (std::size_t b = 0; b < d; ++b) moved[a] += line.compliance[a * d + b] * harmonic[b];
        const double size = sum_of_squares(moved);
        if (!(size > largest)) continue;
        largest = size;
        best = line.hz;
    }
    return best;
}

}  // namespace tribo::dynamics
