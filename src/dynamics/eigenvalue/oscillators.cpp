// SPDX-License-Identifier: MIT
#include "dynamics/eigenvalue/oscillators.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

// (q, q' / w) after a time of free vibration, over (q, q' / w): 2 x 2.
std::array<double, 4> free_vibration(double w, double damping, double t_s) {
    const double damped = std::sqrt(1 - damping * damping);
    double sine, cosine;
    math::sincos(w * damped * t_s, sine, cosine);
    const double left = math::exp(-damping * w * t_s), s = left * sine / damped, c = left * cosine;
    return {c + damping * s, s, -s, c - damping * s};
}

}  // namespace

Oscillators::Oscillators(std::span<const Mode> modes) {
    constexpr double kApart = 1e-9;
    for (const Mode& mode : modes) {
        const Vec3 direction = normalized(mode.direction);
        Vec3 rest = direction;
        for (const Vec3& b : basis_) rest = rest - dot(b, rest) * b;
        if (length(rest) > kApart) basis_.push_back(normalized(rest));
        oscillators_.push_back(
            {math::kTwoPi * mode.frequency_hz, mode.damping_ratio, mode.stiffness_n_per_mm});
    }
    for (std::size_t i = 0; i < modes.size(); ++i)
        for (std::size_t a = 0; a < basis_.size(); ++a)
            oscillators_[i].along[a] = dot(basis_[a], normalized(modes[i].direction));
}

std::array<double, 9> Oscillators::reduced(const Matrix3& stiffness) const {
    std::array<double, 9> s{};
    std::size_t n = 0;
    for (const Vec3& a : basis_) {
        const Vec3 row = a.x * stiffness[0] + a.y * stiffness[1] + a.z * stiffness[2];
        for (const Vec3& b : basis_) s[n++] = dot(row, b);
    }
    return s;
}

double Oscillators::fastest(double spring_n_per_mm) const {
    double most = 0;
    for (const Oscillator& o : oscillators_)
        most = std::max(most, o.w * std::sqrt(1 + spring_n_per_mm / o.stiffness));
    return most;
}

std::array<std::complex<double>, 9> Oscillators::compliance(std::complex<double> s_per_s) const {
    std::array<std::complex<double>, 9> sum{};
    const std::size_t d = dimensions();
    for (const Oscillator& o : oscillators_) {
        const std::complex<double> r = s_per_s / o.w, yields = 1.0 + 2 * o.damping * r + r * r;
        // Not 1 / yields: a division of complex numbers differs between systems.
        const double size2 = yields.real() * yields.real() + yields.imag() * yields.imag();
        const std::complex<double> own = std::conj(yields) / (o.stiffness * size2);
        for (std::size_t a = 0; a < d; ++a)
            for (std::size_t b = 0; b < d; ++b) sum[a * d + b] += own * (o.along[a] * o.along[b]);
    }
    return sum;
}

Oscillators::Answer Oscillators::without_force(double lasts_s) const {
    Answer a;
    for (const Oscillator& o : oscillators_) {
        const auto free = free_vibration(o.w, o.damping, lasts_s);
        a.decay.insert(a.decay.end(), free.begin(), free.end());
    }
    return a;
}

Oscillators::Answer Oscillators::answer(double lasts_s, const GaussPoints& points) const {
    const std::size_t p = points.x.size(), d = dimensions(), n = p * d, s = states();
    Answer a = without_force(lasts_s);
    a.free.resize(n * s);
    a.moved.resize(n * n);
    a.end.resize(s * n);
    std::vector<double> system(p * 2 * p);
    for (std::size_t i = 0; i < oscillators_.size(); ++i) {
        const Oscillator& o = oscillators_[i];
        // q'' + 2 zeta w q' + w^2 q = w^2 F / k at the points, where q' and q are integrals of q''.
        const double turn = o.w * lasts_s;
        for (std::size_t k = 0; k < p; ++k) {
            double* row = &system[k * 2 * p];
            for (std::size_t l = 0; l < p; ++l) {
                row[l] = turn * (2 * o.damping * points.once[k * p + l] + turn * points.twice[k * p + l]);
                row[p + l] = 0;
            }
            row[k] += 1;
            row[p + k] = turn / o.stiffness;
        }
        eliminate(p, 2 * p, system.data());
        // Into the displacements at the points, and at the end (k = p) into the state.
        for (std::size_t k = 0; k <= p; ++k) {
            for (std::size_t l = 0; l < p; ++l) {
                double q = 0, speed = 0;
                for (std::size_t j = 0; j < p; ++j) {
                    q += turn * points.twice[k * p + j] * system[j * 2 * p + p + l];
                    if (k == p) speed += points.once[k * p + j] * system[j * 2 * p + p + l];
                }
                for (std::size_t c = 0; c < d; ++c) {
                    if (k == p) {
                        a.end[2 * i * n + l * d + c] = q * o.along[c];
                        a.end[(2 * i + 1) * n + l * d + c] = speed * o.along[c];
                        continue;
                    }
                    for (std::size_t r = 0; r < d; ++r)
                        a.moved[(k * d + r) * n + l * d + c] += q * o.along[r] * o.along[c];
                }
            }
        }
        for (std::size_t k = 0; k < p; ++k) {
            const auto free = free_vibration(o.w, o.damping, points.x[k] * lasts_s);
            for (std::size_t r = 0; r < d; ++r) {
                a.free[(k * d + r) * s + 2 * i] = free[0] * o.along[r];
                a.free[(k * d + r) * s + 2 * i + 1] = free[1] * o.along[r];
            }
        }
    }
    return a;
}

}  // namespace tribo::dynamics
