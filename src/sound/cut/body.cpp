// SPDX-License-Identifier: MIT
#include "sound/cut/body.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "noise/play/pink_noise.hpp"

namespace tribo::sound {

Body tool_body(double diameter_mm, double length_mm, double material_damping) {
    constexpr double kFirst = 3.516, kSecond = 22.03;  // roots of the clamped bar, squared
    constexpr double kBarSpeed = 6325e3;               // sqrt(E / rho) of carbide, mm/s
    constexpr double kToolDamping = 0.015, kCore = 0.8;
    if (!(diameter_mm > 0 && length_mm > 0)) return {};
    // sqrt(E I / (rho A)) = c d / 4 for a round bar.
    const double base = kBarSpeed * kCore * diameter_mm / 4 / (math::kTwoPi * length_mm * length_mm);
    const double damping = kToolDamping + material_damping;
    Body body;
    body.modes[0] = {kFirst * base, damping};
    body.modes[1] = {kSecond * base, damping};
    return body;
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

Body with_modes(const Body& body, const Body& more, double gain) {
    Body both = body;
    std::size_t n = 0;
    while (n < both.modes.size() && both.modes[n].hz > 0) ++n;
    for (const BodyMode& mode : more.modes) {
        if (mode.hz <= 0 || n == both.modes.size()) break;
        both.modes[n++] = {mode.hz, mode.damping, gain * mode.gain};
    }
    return both;
}

double ring_seconds(const Body& body) {
    constexpr double kSixtyDb = 6.907755278982137;  // ln 1000
    double longest = 0;
    for (const BodyMode& mode : body.modes) {
        if (mode.hz <= 0) break;
        longest = std::max(longest, kSixtyDb / (math::kTwoPi * mode.hz * mode.damping));
    }
    return std::min(longest, kLongestRingSeconds);
}

void BodyFilter::set(const Body& body, double sample_rate_hz) {
    constexpr double kHighest = 0.45;
    *this = {};
    direct_ = body.direct;
    sample_rate_hz_ = sample_rate_hz;
    for (const BodyMode& mode : body.modes) {
        if (!(mode.hz > 0)) break;
        if (mode.hz >= kHighest * sample_rate_hz) continue;
        // Bilinear transform of 2 z w s / (s^2 + 2 z w s + w^2), the middle kept.
        const double k = math::tan(math::kPi * mode.hz / sample_rate_hz), d = 2 * mode.damping * k;
        const double a0 = 1 + d + k * k;
        const auto n = static_cast<std::size_t>(modes_++);
        gain_[n] = mode.gain;
        b_[n] = d / a0;
        a1_[n] = 2 * (k * k - 1) / a0;
        a2_[n] = (1 - d + k * k) / a0;
    }
    ring_quanta_ = 1 + static_cast<int>(std::ceil(ring_seconds(body) * sample_rate_hz / kQuantumFrames));
}

void BodyFilter::apply(Quantum& x) {
    if (modes_ == 0) {
        for (double& v : x) v *= direct_;
        return;
    }
    Lanes s1 = s1_, s2 = s2_;
    for (double& v : x) {
        Lanes y;
        for (std::size_t n = 0; n < y.size(); ++n) {
            const double in = b_[n] * v;
            y[n] = in + s1[n];
            s1[n] = s2[n] - a1_[n] * y[n];
            s2[n] = -in - a2_[n] * y[n];
            y[n] *= gain_[n];
        }
        v = direct_ * v + (((y[0] + y[1]) + (y[2] + y[3])) + ((y[4] + y[5]) + (y[6] + y[7])));
    }
    s1_ = s1;
    s2_ = s2;
}

void BodyFilter::forget() {
    s1_ = s2_ = {};
}

double BodyFilter::gain_at(double hz) const {
    double sine, cosine;
    math::sincos(math::kTwoPi * hz / sample_rate_hz_, sine, cosine);
    const double cosine2 = 2 * cosine * cosine - 1, sine2 = 2 * sine * cosine;
    double re = direct_, im = 0;
    for (std::size_t n = 0; n < gain_.size(); ++n) {
        const double top_re = 1 - cosine2, top_im = sine2;
        const double low_re = 1 + a1_[n] * cosine + a2_[n] * cosine2,
                     low_im = -a1_[n] * sine - a2_[n] * sine2;
        const double scale = gain_[n] * b_[n] / (low_re * low_re + low_im * low_im);
        re += scale * (top_re * low_re + top_im * low_im);
        im += scale * (top_im * low_re - top_re * low_im);
    }
    return std::sqrt(re * re + im * im);
}

double BodyFilter::gain_of_pink() const {
    const noise::PinkNoise pink(0, sample_rate_hz_);
    constexpr int kSteps = 1000;
    constexpr double kLeastHz = 1;
    const double ratio = math::log(0.5 * sample_rate_hz_ / kLeastHz) / kSteps;
    double power = 0;
    for (int n = 0; n < kSteps; ++n) {
        const double hz = kLeastHz * math::exp(ratio * (n + 0.5)), gain = gain_at(hz);
        power += ratio * hz * pink.power_at(hz) * gain * gain;
    }
    return std::sqrt(power / (0.5 * sample_rate_hz_));
}

}  // namespace tribo::sound
