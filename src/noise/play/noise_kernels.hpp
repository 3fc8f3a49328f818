// SPDX-License-Identifier: MIT
// The hot loops of a learned voice: white noise, the all-pole filter, the gain ramp. The same source is
// compiled for SSE2 and for x86-64-v3; noise_kernels() chooses once, by the processor. All builds, also
// WebAssembly, give the same bits. Real-time safe.
#pragma once

#include <cstdint>

namespace tribo::noise {

// Samples that the filter computes at once. All sample counts below are multiples of it.
inline constexpr int kFilterBlock = 16;

// One crossover of eight bands, one lane each: second-order sections in the transposed form.
struct alignas(32) BandSection {
    float b0[8], b1[8], b2[8], a1[8], a2[8];
    float s1[8], s2[8];
};

struct NoiseKernels {
    // Near-Gaussian samples `first` ... `first + count - 1` of the stream `key`: mean 0, variance 1, kurtosis
    // 3, at most 4.1. A sample depends only on its key and number.
    void (*gaussian)(std::uint32_t key, std::uint32_t first, float* out, int count);

    // y[n] = gain x[n] - a_1 y[n-1] - ... - a_p y[n-p], in blocks of 16, in two steps: first the response to
    // past blocks, then the recursion within the block as a product with the impulse response.
    //   predictor  a_1 ... a_order, order <= kLargestPlayedOrder
    //   response   31 numbers: 15 zeros, then the first 16 samples of 1 / A
    //   past       the `order` samples before y, oldest first, directly before `y` in memory; y has room for
    //              count + 16 and needs no initial content
    void (*all_pole)(const float* predictor, int order, const float* response, float gain, const float* x,
                     float* y, int count);

    // Noise in eight bands, each with its own stream (`keys`), through all sections, times a gain that starts
    // at `gain` and grows by `step` per sample. `out` gets the sum of the bands.
    void (*bands)(BandSection* sections, int section_count, const std::uint32_t* keys, std::uint32_t first,
                  const float* gain, const float* step, float* out, int count);

    // out += gain * y, with the gain in equal steps from `from` to `to` over the samples.
    void (*mix)(const float* y, float from, float to, float* out, int count);
};

const NoiseKernels& noise_kernels();

// The two builds by name, for tests and benchmarks. v3 is null if processor or target do not support it.
const NoiseKernels* noise_kernels_sse2();
const NoiseKernels* noise_kernels_v3();

}  // namespace tribo::noise
