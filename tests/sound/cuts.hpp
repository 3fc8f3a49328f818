// SPDX-License-Identifier: MIT
// Cuts and measures that the tests of this room share.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "contact/contact_sample.hpp"
#include "sound/play/calibration.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::sound::test {

// Harmonics that fall as 1 / n, with the phases of a force that swings along one line.
inline contact::ForceSpectrum falling_spectrum(int step, int count, double first_n = 20) {
    contact::ForceSpectrum s;
    s.order_step = step;
    s.harmonics.resize(static_cast<std::size_t>(count) + 1);
    for (int n = 1; n <= count; ++n) {
        const std::complex<double> c = std::polar(first_n / n, 0.7 * n * n);
        s.harmonics[static_cast<std::size_t>(n)] = {0.6 * c, 0.8 * c, c, 6.0 * c};
    }
    return s;
}

inline contact::ContactSample cut_at(double t_s, const contact::ForceSpectrum* spectrum, double rpm,
                                     double removal_mm3_per_s = 0) {
    contact::ContactSample s;
    s.t_s = t_s;
    s.spectrum = spectrum;
    s.force_n = {100, 0, 0};
    s.removed_mm3_per_s = removal_mm3_per_s;
    s.phase_rate_rad_per_s = rpm / 60 * 2 * std::numbers::pi;
    s.phase_rad = s.phase_rate_rad_per_s * t_s;
    return s;
}

// The left channel of a track through these samples and its tail.
inline std::vector<float> track_of(std::span<const contact::ContactSample> samples, double duration_s,
                                   const SoundtrackOptions& options = {}) {
    Soundtrack track(options);
    std::vector<float> wave;
    const auto keep = [&](std::span<const float> block) {
        for (std::size_t i = 0; i < block.size(); i += 2) wave.push_back(block[i]);
    };
    for (const contact::ContactSample& s : samples) track.play_to(s, keep);
    track.play_out(duration_s, keep);
    return wave;
}

// What full scale makes of a force of 1 N.
inline constexpr double kSamplePerNewton = kPascalPerNewton / kFullScalePascal;

// Amplitude of the sine at `hz`, under a Blackman-Harris window (side lobes -92 dB; lines 4 bins apart do not
// disturb each other).
inline double tone_amplitude(std::span<const float> x, double hz, double rate_hz) {
    const double step = 2 * std::numbers::pi / static_cast<double>(x.size());
    std::complex<double> sum = 0;
    double weight = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double a = step * (static_cast<double>(n) + 0.5);
        const double w =
            0.35875 - 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) - 0.01168 * std::cos(3 * a);
        sum += w * static_cast<double>(x[n]) *
               std::polar(1.0, -2 * std::numbers::pi * hz / rate_hz * static_cast<double>(n));
        weight += w;
    }
    return 2 * std::abs(sum) / weight;
}

// The largest second difference: what a click raises.
inline double roughest(std::span<const float> x) {
    double worst = 0;
    for (std::size_t n = 2; n < x.size(); ++n) {
        worst = std::max(worst, std::abs(static_cast<double>(x[n]) - 2 * static_cast<double>(x[n - 1]) +
                                         static_cast<double>(x[n - 2])));
    }
    return worst;
}

inline double rms(std::span<const float> x) {
    double sum = 0;
    for (const float v : x) sum += static_cast<double>(v) * static_cast<double>(v);
    return std::sqrt(sum / static_cast<double>(x.size()));
}

inline double decibel(double ratio) {
    return 20 * std::log10(ratio);
}

}  // namespace tribo::sound::test
