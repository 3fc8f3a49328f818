// SPDX-License-Identifier: MIT
// Noise of a model with a detailed bass. The poles of a model are spread evenly over the whole band, so a
// hundred of them cannot separate 100 Hz from 300 Hz.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/play/model_noise.hpp"

namespace tribo::noise {

// Below kBassHz: a separate model at a sample rate of about kBassRateHz. `share`: of the whole power.
struct BassModel {
    ArModel spectrum;
    double share = 0;

    friend bool operator==(const BassModel&, const BassModel&) = default;
};
inline constexpr double kBassHz = 1400, kBassRateHz = 6000;

// Share of the power at `hz` that stays below the crossover: a fourth-order Butterworth low-pass. The rest is
// above.
double bass_share(double hz);

// Bass and rest are independent, so their powers add. Mean square 1. Construction may allocate; everything
// else is real-time safe, about 10 ns a sample. One thread at a time.
class DetailedNoise {
  public:
    // `model` and `bass` at any sample rate.
    DetailedNoise(const ArModel& model, const BassModel& bass, double sample_rate_hz, std::uint64_t seed);

    // Returns block `index`. Blocks should follow each other; after a gap the filter continues from its last
    // state. The span is valid until the next call.
    std::span<const double, kNoiseBlock> block(std::uint64_t index);

  private:
    static constexpr std::size_t kTaps = 16;  // of the interpolation, at the rate of the bass
    struct Section {                          // high-pass: b (1 - z^-1)^2 / (1 + a1 z^-1 + a2 z^-2)
        double b = 0, a1 = 0, a2 = 0, s1 = 0, s2 = 0;
        double step(double x);
    };
    double next_bass();

    ModelNoise rest_, bass_;
    std::array<Section, 2> high_pass_{};
    double rest_gain_ = 1, bass_gain_ = 0;
    std::size_t divisor_;       // samples per sample of the bass
    std::vector<double> taps_;  // by phase
    std::size_t phase_ = 0;
    std::array<double, kTaps> past_{};  // of the bass, newest first
    std::uint64_t bass_at_ = 0;
    std::array<double, kNoiseBlock> samples_{};
};

}  // namespace tribo::noise
