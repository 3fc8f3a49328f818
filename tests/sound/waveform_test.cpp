// SPDX-License-Identifier: MIT
#include "sound/cut/waveform.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tribo::sound {
namespace {

RC_GTEST_PROP(Waveform, keeps_the_extremes_of_every_column, ()) {
    const auto left = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1000));
    const int wanted = *rc::gen::inRange(1, 20);
    const int first = *rc::gen::inRange(0, 50), length = *rc::gen::inRange(0, 30);
    Waveform waveform(wanted, {{first, length}});
    std::vector<float> x, block;
    for (std::size_t n = 0; n < left.size(); ++n) {
        x.push_back(static_cast<float>(left[n]) / 1000);
        block.insert(block.end(), {x.back(), 2.0f});  // the right channel is not looked at
        if (n % 7 == 6 || n + 1 == left.size()) {
            waveform.add(block);
            block.clear();
        }
    }
    const auto width = static_cast<std::size_t>(waveform.column_frames());
    RC_ASSERT(waveform.frames() == static_cast<std::int64_t>(x.size()));
    RC_ASSERT(waveform.columns().size() == (x.size() + width - 1) / width);
    RC_ASSERT(waveform.columns().size() <= 2 * static_cast<std::size_t>(wanted));
    RC_ASSERT(width == 1 || waveform.columns().size() > static_cast<std::size_t>(wanted));
    float peak = 0;
    for (std::size_t c = 0; c < waveform.columns().size(); ++c) {
        const auto begin = x.begin() + static_cast<std::ptrdiff_t>(c * width);
        const auto end = x.begin() + static_cast<std::ptrdiff_t>(std::min((c + 1) * width, x.size()));
        const auto [low, high] = std::minmax_element(begin, end);
        RC_ASSERT(waveform.columns()[c].min == *low);
        RC_ASSERT(waveform.columns()[c].max == *high);
        peak = std::max({peak, -*low, *high});
    }
    RC_ASSERT(waveform.peak() == peak);
    const std::size_t from = std::min(static_cast<std::size_t>(first), x.size());
    const std::size_t to = std::min(static_cast<std::size_t>(first + length), x.size());
    RC_ASSERT(waveform.zooms()[0].samples == std::vector<float>(x.begin() + static_cast<std::ptrdiff_t>(from),
                                                                x.begin() + static_cast<std::ptrdiff_t>(to)));
}

TEST(Waveform, knows_the_rms_of_a_sine) {
    Waveform waveform(100);
    std::vector<float> stereo;
    for (int n = 0; n < 48000; ++n) {
        const auto v = static_cast<float>(0.5 * std::sin(n * 0.1308996938995747));
        stereo.insert(stereo.end(), {v, v});
    }
    waveform.add(stereo);
    EXPECT_NEAR(waveform.peak(), 0.5, 1e-6);
}

}  // namespace
}  // namespace tribo::sound
