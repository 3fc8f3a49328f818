// SPDX-License-Identifier: MIT
// Noise with the same power in every octave, as from breaking chips, fans and bearings.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "noise/play/model_noise.hpp"

namespace tribo::noise {

// White counter noise through alternating real poles and zeros, with a pole every two octaves from 20 Hz: -3
// dB per octave, within 0.5 dB from 30 Hz to 10 kHz at 48 kHz (Keshner 1982; Smith, Spectral Audio Signal
// Processing 2011, "Synthesis of 1/F noise"). Mean square 1. No allocation; real-time safe, about 5 ns a
// sample; one thread at a time.
class PinkNoise {
  public:
    PinkNoise(std::uint64_t seed, double sample_rate_hz);

    // Returns block `index` of the stream. After a gap the filter continues from its last state, which is
    // statistically equivalent. The span is valid until the next call.
    std::span<const double, kNoiseBlock> block(std::uint64_t index);

    // Power density at `hz`, 0 ... half the sample rate. Its mean is 1.
    double power_at(double hz) const;

  private:
    struct Section {  // (1 - zero z^-1) / (1 - pole z^-1)
        double pole = 0, zero = 0, in = 0, out = 0;
    };
    static constexpr int kSections = 6;

    double raw_power_at(double hz) const;

    const NoiseKernels* kernels_;
    std::uint64_t key_;
    double sample_rate_hz_, gain_ = 1;
    std::array<Section, kSections> sections_{};
    std::array<double, kNoiseBlock> samples_{};
};

}  // namespace tribo::noise
