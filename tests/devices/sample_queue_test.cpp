// SPDX-License-Identifier: MIT
#include "devices/sound/sample_queue.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <thread>
#include <vector>

namespace tribo::devices {
namespace {

TEST(SampleQueue, gives_what_it_was_given_in_order_and_silence_beyond) {
    SampleQueue queue;
    std::vector<float> given(14), taken(20, 9.0F);
    std::iota(given.begin(), given.end(), 1.0F);
    EXPECT_EQ(queue.put(given), 7u);
    EXPECT_EQ(queue.frames(), 7u);
    queue.take(taken);
    for (std::size_t n = 0; n < taken.size(); ++n) EXPECT_EQ(taken[n], n < 14 ? given[n] : 0.0F);
    EXPECT_EQ(queue.frames(), 0u);
}

TEST(SampleQueue, leaves_what_it_has_no_room_for) {
    SampleQueue queue;
    const std::vector<float> much(2 * SampleQueue::kFrames + 200);
    EXPECT_EQ(queue.put(much), SampleQueue::kFrames);
    EXPECT_EQ(queue.put(much), 0u);
}

TEST(SampleQueue, keeps_order_between_two_threads) {
    SampleQueue queue;
    constexpr int frames = 200'000;
    std::thread renderer([&] {
        for (int n = 0; n < frames;) {
            const float next[2] = {static_cast<float>(n + 1), static_cast<float>(-n - 1)};
            n += static_cast<int>(queue.put(next));
        }
    });
    int seen = 0;
    std::vector<float> block(64);
    while (seen < frames) {
        queue.take(block);
        for (std::size_t n = 0; n < block.size() && block[n] != 0; n += 2) {
            ++seen;
            ASSERT_EQ(block[n], static_cast<float>(seen));
            ASSERT_EQ(block[n + 1], static_cast<float>(-seen));
        }
    }
    renderer.join();
}

}  // namespace
}  // namespace tribo::devices
