// SPDX-License-Identifier: MIT
// Endless noise of one learned model: white counter noise through its all-pole filter, mean square 1.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "noise/model/ar_model.hpp"
#include "noise/play/texture_excitation.hpp"

namespace tribo::noise {

struct NoiseKernels;

// Noise is made in blocks of 64 samples, numbered from the start of the stream.
inline constexpr int kNoiseBlock = 64;

// Construction may allocate; everything else is real-time safe. One thread at a time. Costs about 4 ns a
// sample at order 50, in proportion to the order. The input of the filter never stops, so there are no
// subnormal numbers.
class ModelNoise {
  public:
    // `model` at the sample rate of the output (at_rate). Streams of different seeds are independent.
    ModelNoise(const ArModel& model, std::uint64_t seed) : ModelNoise(model, nullptr, seed) {}
    // With a texture (null: Gaussian). A texture costs another 10 ns a sample.
    ModelNoise(const ArModel& model, const TextureModel* texture, std::uint64_t seed);

    // Returns block `index`. Consecutive blocks make one continuous stream. After a gap the filter continues
    // from its last state, which is statistically equivalent, so inaudible blocks may be skipped. The span is
    // valid until the next call. `travel_mm`: distance of the finger during the block, for the texture.
    std::span<const float, kNoiseBlock> block(std::uint64_t index, double travel_mm = 0);

    // The state before the next block is computed from the blocks before it, not from the last played one:
    // the samples do not depend on the history.
    void seek(std::uint64_t index);

    // From the next block on, uses another filter of the same order: its predictor, and the gain for a mean
    // square of 1. Small steps from block to block do not click, because the past samples stay.
    void retune(std::span<const double> predictor, double gain);

    // Renders the samples from `first` on. Continues the last call or starts anew.
    void render(std::uint64_t first, std::span<double> out);

  private:
    void make(std::uint64_t index, double travel_mm);

    const NoiseKernels* kernels_;
    std::uint64_t key_ = 0;
    std::optional<TextureExcitation> texture_;
    int order_ = 0;
    float gain_ = 1;
    std::uint64_t made_ = ~std::uint64_t{0};                         // number of the block in y_
    std::array<float, kLargestPlayedOrder> predictor_{};             // a_1 ...
    std::array<float, 31> response_{};                               // 15 zeros, 1 / A
    std::array<float, kLargestPlayedOrder + kNoiseBlock + 16> y_{};  // past, block
};

}  // namespace tribo::noise
