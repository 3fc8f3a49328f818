// SPDX-License-Identifier: MIT
// Driving noise with the texture of a recording: bands of counter noise, whose levels vary with the travelled
// distance, and grains. White on average, mean square 1, as input of an all-pole filter.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "noise/model/texture_model.hpp"
#include "noise/play/noise_kernels.hpp"

namespace tribo::noise {

// Construction keeps no allocated memory; everything is real-time safe. One thread at a time. About 10 ns a
// sample.
class TextureExcitation {
  public:
    TextureExcitation(const TextureModel& texture, double sample_rate_hz, std::uint64_t seed);

    // Writes the 64 samples from `first` on, while the finger moves by `travel_mm`.
    void block(std::uint64_t first, double travel_mm, std::span<float, 64> out);
    // Resets the distance: the next block starts anew.
    void restart();

  private:
    void step_levels(double travel_mm);
    void add_grains(double travel_mm, std::span<float, 64> out);
    double level(int band, double g) const;
    double next_gap();
    double next_size();

    int bands_ = 1, lengths_ = 0, sizes_ = 0;
    std::array<std::array<float, kLevelSteps>, kMostBands> amplitude_{};  // tables, as amplitudes
    std::array<double, kMostLengths> length_mm_{}, weight_{};
    std::array<std::array<double, kMostLengths>, kMostBands + 1>
        state_{};                  // of each process; the last: common
    double common_ = 1, own_ = 0;  // amplitudes of both shares
    double per_mm_ = 0, share_ = 0, scatter_ = 1, mean_square_ = 1;
    std::array<double, kMostGrainSizes> size_{};
    std::array<std::uint8_t, kMostGrainSizes>
        order_{};  // places in size_: those left of this round come first
    int sizes_left_ = 0;
    std::array<float, kLongestGrain> shape_{};
    std::array<float, 64> tail_{};  // of grains that continue in the next block
    int taps_ = 1;
    double to_next_mm_ = 0;
    std::uint64_t key_ = 0, drawn_ = 0;
    std::array<BandSection, kMostBands - 1> sections_{};
    std::array<std::uint32_t, kMostBands> keys_{};
    std::array<float, kMostBands> gain_{};
};

}  // namespace tribo::noise
