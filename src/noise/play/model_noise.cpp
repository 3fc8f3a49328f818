// SPDX-License-Identifier: MIT
#include "noise/play/model_noise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/noise_hash.hpp"
#include "noise/play/noise_kernels.hpp"

namespace tribo::noise {
namespace {

// Blocks that run before the first audible one: 21 ms at 48 kHz, longer than the decay of friction sound.
constexpr std::uint64_t kRunUp = 16;

}  // namespace

ModelNoise::ModelNoise(const ArModel& model, const TextureModel* texture, std::uint64_t seed)
    : kernels_(&noise_kernels()),
      key_(CounterNoise(seed).bits(0)),
      order_(static_cast<int>(model.reflection.size())) {
    assert(order_ <= kLargestPlayedOrder);
    if (texture) texture_.emplace(*texture, model.sample_rate_hz, seed);
    retune(predictor_of(model.reflection), std::sqrt(innovation_power(model.reflection)));
    seek(0);
}

void ModelNoise::retune(std::span<const double> predictor, double gain) {
    assert(static_cast<int>(predictor.size()) == order_);
    gain_ = static_cast<float>(gain);
    std::transform(predictor.begin(), predictor.end(), predictor_.begin(),
                   [](double a) { return static_cast<float>(a); });
    std::array<double, kFilterBlock> h{1};
    for (std::size_t n = 1; n < h.size(); ++n) {
        for (std::size_t k = 1; k <= std::min(n, predictor.size()); ++k) h[n] -= predictor[k - 1] * h[n - k];
    }
    for (std::size_t n = 0; n < h.size(); ++n) {
        response_[kFilterBlock - 1 + n] = static_cast<float>(h[n]);
    }
}

void ModelNoise::make(std::uint64_t index, double travel_mm) {
    std::array<float, kNoiseBlock> white;
    // Samples are numbered by 32 bits in a separate stream for each 2^26 blocks (a day at 48 kHz).
    constexpr std::uint64_t kBlocksPerKey = std::uint64_t{1} << 26;
    const auto key = static_cast<std::uint32_t>(CounterNoise(key_).bits(index / kBlocksPerKey) >> 32);
    const auto first = static_cast<std::uint32_t>(index % kBlocksPerKey * kNoiseBlock);
    if (texture_) {
        texture_->block(index * kNoiseBlock, travel_mm, white);
    } else {
        kernels_->gaussian(key, first, white.data(), kNoiseBlock);
    }
    std::copy_n(y_.begin() + kNoiseBlock, kLargestPlayedOrder, y_.begin());
    kernels_->all_pole(predictor_.data(), order_, response_.data(), gain_, white.data(),
                       y_.data() + kLargestPlayedOrder, kNoiseBlock);
    made_ = index;
}

void ModelNoise::seek(std::uint64_t index) {
    y_.fill(0);
    if (texture_) texture_->restart();
    for (std::uint64_t n = index - std::min(index, kRunUp); n < index; ++n) make(n, 0);
    // Before the start, use the end of the stream.
    if (index < kRunUp) {
        for (std::uint64_t n = index; n < kRunUp; ++n) make(n - kRunUp, 0);
    }
    made_ = index - 1;
}

std::span<const float, kNoiseBlock> ModelNoise::block(std::uint64_t index, double travel_mm) {
    if (made_ != index) make(index, travel_mm);
    return std::span<const float, kNoiseBlock>(y_.data() + kLargestPlayedOrder, kNoiseBlock);
}

void ModelNoise::render(std::uint64_t first, std::span<double> out) {
    for (std::size_t done = 0; done < out.size();) {
        const std::uint64_t index = first / kNoiseBlock;
        const auto at = static_cast<std::size_t>(first % kNoiseBlock);
        const auto samples = block(index);
        const std::size_t count = std::min(out.size() - done, kNoiseBlock - at);
        for (std::size_t n = 0; n < count; ++n) out[done + n] = samples[at + n];
        done += count;
        first += count;
    }
}

}  // namespace tribo::noise
