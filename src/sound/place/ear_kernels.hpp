// SPDX-License-Identifier: MIT
// What an ear does to 64 frames: read a moving fractional delay, convolve with a moving head response. The
// same source is compiled for SSE2 and for x86-64-v3; ear_kernels() chooses once, by the processor. Both give
// the same bits.
#pragma once

#include <array>

namespace tribo::sound {

// A windowed sinc of this many taps between samples: passes up to 15 kHz (at 48 kHz) within 0.01 dB, images
// more than 80 dB down. It looks 8 samples ahead, so no delay may be shorter.
inline constexpr int kInterpolatorTaps = 16;
inline constexpr int kInterpolatorAhead = kInterpolatorTaps / 2;
// Rows of its table, of which the nearest is taken: a delay is right to 1/4096 of a sample (noise 95 dB under
// a tone of 1 kHz, 75 dB under one of 10 kHz).
inline constexpr int kInterpolatorRows = 2048;
using InterpolatorTable =
    std::array<float, static_cast<std::size_t>((kInterpolatorRows + 1) * kInterpolatorTaps)>;
// Row r: the value r / 2048 of a sample behind tap 7. Made once; the same bits everywhere.
const InterpolatorTable& interpolator_table();

// Taps of a head response, at any sample rate.
inline constexpr int kHeadTaps = 128;
// Of a response that moves the first taps glide, frame by frame; the later ones, which hold little of the
// sound, stand still for half a quantum at a time.
inline constexpr int kGlidingTaps = 48, kStandingFrames = 32;

// c0 + t (c1 + t c2), t = frame / 64.
struct Course {
    float c0 = 0, c1 = 0, c2 = 0;
};

struct EarKernels {
    // out[n] = gain(n) * the line at n - delay(n), n = 0 ... 63. line[0] is frame 0 of the quantum less the
    // whole part of the delay; delay's c0 is in [0, 1), and it changes by at most 3 per frame.
    void (*read)(const float* line, const InterpolatorTable& table, Course delay, Course gain, float* out);
    // out[n] += sum over k of h[k] x[n - k], k < taps (a multiple of 16, at most kHeadTaps); the first
    // kGlidingTaps run linearly from from[k] at frame 0 to to[k] at frame 64, the others are where that line
    // is at frame 16, and from frame 32 on at frame 48. x[-127] is readable.
    void (*convolve)(const float* x, const float* from, const float* to, int taps, float* out);
    // The same with a response that stands still.
    void (*convolve_still)(const float* x, const float* h, int taps, float* out);
    // out[k] = weight[0] a[k] + ... + weight[4] e[k], k < taps.
    void (*blend)(const float* const* five, const float* weight, int taps, float* out);
};

const EarKernels& ear_kernels();

// The two builds by name, for the test that compares them; v3 is null where the processor or target lacks it.
const EarKernels* ear_kernels_sse2();
const EarKernels* ear_kernels_v3();

}  // namespace tribo::sound
