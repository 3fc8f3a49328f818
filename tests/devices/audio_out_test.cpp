// SPDX-License-Identifier: MIT
#include "devices/sound/audio_out.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace tribo::devices {
namespace {

// With a card: frames are asked for and the figures make sense. Without: an error with a remedy. Either way
// nothing is printed.
TEST(AudioOut, plays_or_says_why_not_and_prints_nothing) {
    testing::internal::CaptureStderr();
    std::atomic<long> frames{0};
    {
        auto out = AudioOut::open({48000, 256}, [&](std::span<float> block) {
            for (float& v : block) v = 0;
            frames += static_cast<long>(block.size() / 2);
        });
        if (out) {
            for (int n = 0; n < 100 && frames == 0; ++n) {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            }
            EXPECT_GT(frames, 0);
            EXPECT_GE((*out)->latency_s(), 2.0 * (*out)->buffer_frames() / 48000);
            EXPECT_LT((*out)->latency_s(), 2);
            EXPECT_FALSE((*out)->device().empty());
        } else {
            EXPECT_TRUE(out.error().cause.starts_with("no sound: ")) << out.error().text();
            EXPECT_FALSE(out.error().remedy.empty());
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(AudioOut, refuses_rates_and_buffers_that_no_device_has) {
    const auto cause = [](AudioOutOptions options) {
        const auto out = AudioOut::open(options, [](std::span<float>) {});
        return out ? std::string() : out.error().cause;
    };
    EXPECT_NE(cause({48000, 0}).find("buffer length"), std::string::npos);
    EXPECT_NE(cause({-1, 256}).find("sample rate"), std::string::npos);
    EXPECT_NE(cause({48000, 1 << 30}).find("buffer length"), std::string::npos);
}

}  // namespace
}  // namespace tribo::devices
