// SPDX-License-Identifier: MIT
// Gaussian noise between two frequencies: the plain colour for what has no pitch, until a voice is learned
// from recordings.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/noise_hash.hpp"

namespace tribo::noise {

struct Band {
    double low_hz = 1000;   // > 0
    double high_hz = 8000;  // > low_hz, < half the sample rate
};

// White counter noise through a high-pass and a low-pass of second order (Butterworth, bilinear transform
// with the corner frequencies kept): -3 dB at both ends, 12 dB per octave beyond. Scaled to a mean square of
// 1. Real-time safe after construction, about 9 ns a sample; one thread at a time.
class BandNoise {
  public:
    BandNoise(std::uint64_t seed, double sample_rate_hz, Band band = {});

    // Forgets the past: the next sample is as after silence.
    void clear();
    // Samples `first` ... of the stream. Filters remember, so blocks are meant to follow each other; after a
    // leap, clear() first.
    void render(std::uint64_t first, std::span<double> out);

  private:
    // b0 (1 + b1 z^-1 + z^-2) / (1 + a1 z^-1 + a2 z^-2), transposed form; b0 is in gain_.
    struct Section {
        double b1 = 0, a1 = 0, a2 = 0;
        double s1 = 0, s2 = 0;
        double step(double x);
    };
    // k = tan(pi corner / rate)
    static Section section(double k, double b1);

    CounterNoise white_;
    std::array<Section, 2> sections_;
    double gain_ = 1;
};

}  // namespace tribo::noise
