// SPDX-License-Identifier: MIT
// Kernels for one ear and 64 frames: a moving fractional delay, and convolution with a moving head response.
// The same source is compiled for SSE2 and for x86-64-v3; ear_kernels() selects by the processor. Both give
// the same bits.
#pragma once

#include <array>

namespace tribo::sound {

// Taps of the windowed sinc interpolator: flat within 0.01 dB up to 15 kHz (at 48 kHz), images more than 80
// dB down. It needs 8 samples of look-ahead, which is the shortest possible delay.
inline constexpr int kInterpolatorTaps = 16;
inline constexpr int kInterpolatorAhead = kInterpolatorTaps / 2;
// Rows of the interpolator table. The nearest row is used: delays are exact to 1/4096 of a sample (noise 95
// dB below a tone of 1 kHz, 75 dB below one of 10 kHz).
inline constexpr int kInterpolatorRows = 2048;
using InterpolatorTable =
    std::array<float, static_cast<std::size_t>((kInterpolatorRows + 1) * kInterpolatorTaps)>;
// Row r: the value r / 2048 of a sample behind tap 7. Made once; the same bits everywhere.
const InterpolatorTable& interpolator_table();

// Taps of a head response, at any sample rate.
inline constexpr int kHeadTaps = 128;
// While a response moves, its first taps change in every frame. The later taps contain little energy; they
// change twice per quantum.
inline constexpr int kGlidingTaps = 48, kStandingFrames = 32;

// c0 + t (c1 + t c2), t = frame / 64.
struct Course {
    float c0 = 0, c1 = 0, c2 = 0;
};

struct EarKernels {
    // out[n] = gain(n) * line at n - delay(n), n = 0 ... 63. line[0] is frame 0 of the quantum minus the
    // integer part of the delay. The c0 of `delay` is in [0, 1); the delay changes by at most 3 per frame.
    void (*read)(const float* line, const InterpolatorTable& table, Course delay, Course gain, float* out);
    // out[n] += sum over k of h[k] x[n - k], k < taps (a multiple of 16, at most kHeadTaps). The first
    // kGlidingTaps are linear from from[k] at frame 0 to to[k] at frame 64. The others take the value of this
    // line at frame 16, and from frame 32 on its value at frame 48. x[-127] must be readable.
    void (*convolve)(const float* x, const float* from, const float* to, int taps, float* out);
    // The same with a constant response.
    void (*convolve_still)(const float* x, const float* h, int taps, float* out);
    // out[k] = weight[0] a[k] + ... + weight[4] e[k], k < taps.
    void (*blend)(const float* const* five, const float* weight, int taps, float* out);
};

const EarKernels& ear_kernels();

// The two builds by name, for the test that compares them; v3 is null where the processor or target lacks it.
const EarKernels* ear_kernels_sse2();
const EarKernels* ear_kernels_v3();

}  // namespace tribo::sound
