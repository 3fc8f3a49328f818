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

// Noise is made in blocks of 64, numbered from the start of the stream.
inline constexpr int kNoiseBlock = 64;

// Construction may allocate; everything else is real-time safe. One thread at a time. Costs about 4 ns a
// sample at order 50. The filter never runs dry (its input does not stop), so it never meets subnormals.
class ModelNoise {
  public:
    // `model` at the rate at which it shall play (at_rate). Streams of different seeds are independent.
    ModelNoise(const ArModel& model, std::uint64_t seed) : ModelNoise(model, nullptr, seed) {}
    // With a texture (null: Gaussian), which costs 10 ns a sample more.
    ModelNoise(const ArModel& model, const TextureModel* texture, std::uint64_t seed);

    // Block `index`. Blocks in a row make one continuous stream; after a gap the filter goes on from where it
    // was, which is as good a past as any, so noise may be left out where nobody hears it. Valid until the
    // next call. `travel_mm`: how far the finger moves meanwhile, for the texture.
    std::span<const float, kNoiseBlock> block(std::uint64_t index, double travel_mm = 0);

    // The next block is preceded by the blocks before it, not by what was played last: the same samples come
    // whatever was played before.
    void seek(std::uint64_t index);

    // From the next block on, another filter of the same order: its predictor, and the gain that makes its
    // mean square 1. Small steps from block to block do not click, as the past samples stay.
    void retune(std::span<const double> predictor, double gain);

    // Samples `first` ... of the stream; follows on or starts anew.
    void render(std::uint64_t first, std::span<double> out);

  private:
    void make(std::uint64_t index, double travel_mm);

    const NoiseKernels* kernels_;
    std::uint64_t key_ = 0;
    std::optional<TextureExcitation> texture_;
    int order_ = 0;
    float gain_ = 1;
    std::uint64_t made_ = ~std::uint64_t{0};                   // the block that stands in y_
    std::array<float, kLargestOrder> predictor_{};             // a_1 ...
    std::array<float, 31> response_{};                         // 15 zeros, 1 / A
    std::array<float, kLargestOrder + kNoiseBlock + 16> y_{};  // past, block
};

}  // namespace tribo::noise
