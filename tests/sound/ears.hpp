// SPDX-License-Identifier: MIT
// What tests of 3D sound share: a signal through a source, and what comes out of it.
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "sound/place/spatial_source.hpp"

namespace tribo::sound::test {

inline constexpr double kEarRate = 48000;

struct Heard {
    std::vector<float> left, right;
};

// `quanta` quanta of signal(frame) from where place(t) says, heard where listener(t) says; t in s.
inline Heard hear(
    SpatialSource& source, int quanta, const std::function<double(double)>& signal,
    const std::function<Vec3(double)>& place,
    const std::function<Listener(double)>& listener = [](double) { return Listener{}; }) {
    Heard heard;
    for (int q = 0; q < quanta; ++q) {
        Quantum pressure;
        for (int n = 0; n < kQuantumFrames; ++n) {
            pressure[static_cast<std::size_t>(n)] = signal(q * kQuantumFrames + n);
        }
        const double t = (q + 1) * kQuantumFrames / kEarRate;
        Ears ears;
        source.add(pressure, place(t), listener(t), ears);
        heard.left.insert(heard.left.end(), ears.left.begin(), ears.left.end());
        heard.right.insert(heard.right.end(), ears.right.begin(), ears.right.end());
    }
    return heard;
}

inline std::function<double(double)> tone(double hz) {
    return [hz](double frame) { return std::sin(2 * std::numbers::pi * hz / kEarRate * frame); };
}

// Complex amplitude of the tone, by a Hann window over a stretch that is long against its period.
inline std::complex<double> phasor(std::span<const float> x, double hz) {
    std::complex<double> sum = 0;
    double weight = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double w = 1 - std::cos(2 * std::numbers::pi * (static_cast<double>(n) + 0.5) /
                                      static_cast<double>(x.size()));
        sum += w * static_cast<double>(x[n]) *
               std::polar(1.0, -2 * std::numbers::pi * hz / kEarRate * static_cast<double>(n));
        weight += w;
    }
    return 2.0 * sum / weight;
}

// Energy further than 150 Hz from the tone over that near it, in dB, under a Blackman-Harris window; of
// 2^17 samples.
inline double stray_db(std::span<const float> x, double hz) {
    const FourierTransform fourier(17);
    std::vector<std::complex<double>> spectrum(fourier.size());
    for (std::size_t n = 0; n < spectrum.size(); ++n) {
        const double a =
            2 * std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(spectrum.size());
        const double w =
            0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) - 0.01168 * std::cos(3 * a);
        spectrum[n] = w * static_cast<double>(x[n]);
    }
    fourier.forward(spectrum);
    double near = 0, far = 0;
    for (std::size_t k = 1; k < spectrum.size() / 2; ++k) {
        const double at = static_cast<double>(k) * kEarRate / static_cast<double>(spectrum.size());
        (std::abs(at - hz) < 150 ? near : far) += std::norm(spectrum[k]);
    }
    return 10 * std::log10(far / near);
}

// A circle around the origin, `turn_s` a turn, from the front over the right.
inline std::function<Vec3(double)> circling(double radius_m, double turn_s) {
    return [=](double t) {
        const double a = 2 * std::numbers::pi * t / turn_s;
        return Vec3{radius_m * std::sin(a), radius_m * std::cos(a), 0};
    };
}

inline std::function<Vec3(double)> standing(Vec3 at) {
    return [at](double) { return at; };
}

inline const std::shared_ptr<const Head>& sphere() {
    static const std::shared_ptr<const Head> head = Head::sphere(kEarRate);
    return head;
}

}  // namespace tribo::sound::test
