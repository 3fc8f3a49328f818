// SPDX-License-Identifier: MIT
#include "sound/place/ear_kernels.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>
#include <vector>

namespace tribo::sound {
namespace {

std::vector<float> noise(std::size_t count) {
    return *rc::gen::container<std::vector<float>>(
        count,
        rc::gen::map(rc::gen::inRange(-1000, 1001), [](int v) { return static_cast<float>(v) / 997; }));
}

RC_GTEST_PROP(EarKernels, give_the_same_bits_on_every_processor, ()) {
    const EarKernels *a = ear_kernels_sse2(), *b = ear_kernels_v3();
    if (b == nullptr) return;
    const std::vector<float> line = noise(1024), from = noise(kHeadTaps), to = noise(kHeadTaps);
    const auto share = [] { return static_cast<float>(*rc::gen::inRange(0, 1000)) / 1000; };
    const Course delay{share(), 80 * (share() - 0.5f), 40 * (share() - 0.5f)},
        gain{share(), share(), -share()};
    alignas(32) float x[64], y[64];
    a->read(line.data() + 400, interpolator_table(), delay, gain, x);
    b->read(line.data() + 400, interpolator_table(), delay, gain, y);
    RC_ASSERT(std::memcmp(x, y, sizeof x) == 0);
    for (const int taps : {16, 64, kHeadTaps}) {
        a->convolve(line.data() + 400, from.data(), to.data(), taps, x);
        b->convolve(line.data() + 400, from.data(), to.data(), taps, y);
        RC_ASSERT(std::memcmp(x, y, sizeof x) == 0);
        a->convolve_still(line.data() + 400, from.data(), taps, x);
        b->convolve_still(line.data() + 400, from.data(), taps, y);
        RC_ASSERT(std::memcmp(x, y, sizeof x) == 0);
    }
    const float* five[] = {from.data(), to.data(), from.data(), to.data(), from.data()};
    const float weight[] = {share(), share(), share(), share(), share()};
    alignas(32) float p[kHeadTaps], q[kHeadTaps];
    a->blend(five, weight, kHeadTaps, p);
    b->blend(five, weight, kHeadTaps, q);
    RC_ASSERT(std::memcmp(p, q, sizeof p) == 0);
}

RC_GTEST_PROP(EarKernels, convolve_like_the_sum_that_they_stand_for, ()) {
    const std::vector<float> x = noise(128 + 64), from = noise(kHeadTaps), to = noise(kHeadTaps);
    alignas(32) float out[64]{};
    ear_kernels().convolve(x.data() + 128, from.data(), to.data(), kHeadTaps, out);
    for (std::size_t n = 0; n < 64; ++n) {
        double sum = 0;
        for (std::size_t k = 0; k < kHeadTaps; ++k) {
            // The later taps stand still for half a quantum.
            const double t = k < kGlidingTaps ? static_cast<double>(n) / 64 : n < 32 ? 0.25 : 0.75;
            sum += ((1 - t) * static_cast<double>(from[k]) + t * static_cast<double>(to[k])) *
                   static_cast<double>(x[128 + n - k]);
        }
        RC_ASSERT(std::abs(sum - static_cast<double>(out[n])) < 1e-4);
    }
}

// A sine read along a delay that changes is the sine at the times in between.
TEST(EarKernels, read_a_tone_between_its_samples) {
    constexpr int kZero = 200;
    for (const double hz : {100.0, 1000.0, 5000.0, 12000.0, 15000.0}) {
        const double w = 2 * std::numbers::pi * hz / 48000;
        std::vector<float> line(600);
        for (int n = 0; n < 600; ++n)
            line[static_cast<std::size_t>(n)] = static_cast<float>(std::sin(w * (n - kZero)));
        const Course delay{0.37f, 5.3f, -1.7f}, gain{1, 0.5f, 0};
        alignas(32) float out[64];
        ear_kernels().read(line.data() + kZero, interpolator_table(), delay, gain, out);
        double worst = 0;
        for (int n = 0; n < 64; ++n) {
            const double t = n / 64.0;
            const double at = n - (0.37 + t * (5.3 - 1.7 * t));
            worst = std::max(worst, std::abs(static_cast<double>(out[n]) - (1 + 0.5 * t) * std::sin(w * at)));
        }
        // The nearest row of the table is off by up to 1/4096 of a sample.
        EXPECT_LT(worst, 1.5 * (w / 4096) + 3e-4) << hz;
    }
}

}  // namespace
}  // namespace tribo::sound
