// SPDX-License-Identifier: MIT
// Noise of a model whose bass is drawn in detail: the poles of a model are spread evenly over the whole band,
// so that a hundred of them do not tell 100 from 300 Hz.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "noise/model/ar_model.hpp"
#include "noise/play/model_noise.hpp"

namespace tribo::noise {

// Below kBassHz: a model of its own, at a sample rate of about kBassRateHz. `share`: of the whole power.
struct BassModel {
    ArModel spectrum;
    double share = 0;

    friend bool operator==(const BassModel&, const BassModel&) = default;
};
inline constexpr double kBassHz = 1400, kBassRateHz = 6000;

// What of power stays below the crossover, at `hz`: a Butterworth low-pass of fourth order. The rest is
// above.
double bass_share(double hz);

// Bass and the rest know nothing of each other: their powers add up. Mean square 1. Construction may
// allocate; everything else is real-time safe, about 10 ns a sample. One thread at a time.
class DetailedNoise {
  public:
    // `model` and `bass` at any rate.
    DetailedNoise(const ArModel& model, const BassModel& bass, double sample_rate_hz, std::uint64_t seed);

    // Block `index`; blocks are meant to follow each other, after a gap it goes on from where it was. Valid
    // until the next call.
    std::span<const double, kNoiseBlock> block(std::uint64_t index);

  private:
    static constexpr std::size_t kTaps = 16;  // of the interpolation, at the bass's rate
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
