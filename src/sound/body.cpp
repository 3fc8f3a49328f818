// SPDX-License-Identifier: MIT
#include "sound/body.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::sound {

Body tool_body(double diameter_mm, double length_mm, double material_damping) {
    constexpr double kFirst = 3.516, kSecond = 22.03;  // roots of the clamped bar, squared
    constexpr double kBarSpeed = 6325e3;               // sqrt(E / rho) of carbide, mm/s
    constexpr double kToolDamping = 0.015, kCore = 0.8;
    if (!(diameter_mm > 0 && length_mm > 0)) return {};
    // sqrt(E I / (rho A)) = c d / 4 for a round bar.
    const double base = kBarSpeed * kCore * diameter_mm / 4 / (math::kTwoPi * length_mm * length_mm);
    const double damping = kToolDamping + material_damping;
    return {{{{kFirst * base, damping}, {kSecond * base, damping}}}};
}

double material_damping(std::string_view material) {
    const struct {
        std::string_view begins;
        double damping;
    } known[] = {{"al", 0.03}, {"ti", 0.015}, {"steel", 0.01}};
    for (const auto& k : known) {
        if (material.starts_with(k.begins)) return k.damping;
    }
    return 0.02;
}

void BodyFilter::set(const Body& body, double sample_rate_hz) {
    constexpr double kHighest = 0.45;
    rings_ = false;
    for (std::size_t n = 0; n < bands_.size(); ++n) {
        bands_[n] = {};
        const BodyMode& mode = body.modes[n];
        if (!(mode.hz > 0 && mode.hz < kHighest * sample_rate_hz)) continue;
        // Bilinear transform of 2 z w s / (s^2 + 2 z w s + w^2), the middle kept.
        const double k = math::tan(math::kPi * mode.hz / sample_rate_hz), d = 2 * mode.damping * k;
        const double a0 = 1 + d + k * k;
        bands_[n].b = d / a0;
        bands_[n].a1 = 2 * (k * k - 1) / a0;
        bands_[n].a2 = (1 - d + k * k) / a0;
        rings_ = true;
    }
}

void BodyFilter::apply(Quantum& x) {
    if (!rings_) return;
    for (double& v : x) {
        double sum = v;
        for (Band& f : bands_) {
            const double in = f.b * v, y = in + f.s1;
            f.s1 = f.s2 - f.a1 * y;
            f.s2 = -in - f.a2 * y;
            sum += kGain * y;
        }
        v = sum;
    }
}

void BodyFilter::forget() {
    for (Band& f : bands_) f.s1 = f.s2 = 0;
}

}  // namespace tribo::sound
