// SPDX-License-Identifier: MIT
// From a finger's report to the sound of it, as an audio callback goes: blocks of frames, targets between
// them.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "noise/play/finger_motion.hpp"
#include "noise/play/friction_voice.hpp"
#include "noise/voices.hpp"

namespace tribo::noise {
namespace {

constexpr double kRate = 48000;

// Reports at 60 Hz of a finger that has been down, and moves from 0.5 s on; blocks are rendered just in time,
// and each takes the state of the moment at which it is asked for. Mean power in steps of a quarter of a
// millisecond from the first report that shows the movement, over many starts.
std::vector<double> power_after_the_report(std::size_t block, int starts) {
    constexpr std::size_t kStep = 12, kSteps = 80;
    std::vector<double> power(kSteps);
    for (int start = 0; start < starts; ++start) {
        FrictionVoice voice(test::three_speeds(), {.seed = static_cast<std::uint64_t>(start) + 1});
        FingerMotion finger;
        std::vector<float> out(block), sound;
        // The first report that shows it comes anywhere within a block.
        const double shift = 0.0003 * start, told_s = 0.5 + shift;
        double next_report = shift;
        std::size_t frame = 0;
        while (frame < static_cast<std::size_t>((told_s + 0.04) * kRate)) {
            const double now = static_cast<double>(frame) / kRate;
            for (; next_report <= now; next_report += 1.0 / 60) {
                finger.touch(next_report, next_report < told_s - 1e-9 ? 0 : 2 + 120 * (next_report - told_s),
                             0, 1);
            }
            const FingerMotion::State state = finger.at(now);
            voice.set_target(state.speed_mm_per_s, state.force_n);
            voice.render(out);
            sound.insert(sound.end(), out.begin(), out.end());
            frame += block;
        }
        const auto first = static_cast<std::size_t>(told_s * kRate);
        for (std::size_t n = 0; n < first; ++n) EXPECT_EQ(sound[n], 0);
        for (std::size_t n = 0; n < kSteps * kStep; ++n) {
            const double v = static_cast<double>(sound[first + n]);
            power[n / kStep] += v * v / (static_cast<double>(kStep) * starts);
        }
    }
    return power;
}

TEST(TouchToSound, takes_3_ms_and_a_buffer_at_most_and_never_leads) {
    for (const std::size_t block : {128u, 256u}) {
        const std::vector<double> power = power_after_the_report(block, 300);
        double steady = 0;
        for (std::size_t n = 48; n < 64; ++n) steady += power[n] / 16;
        ASSERT_GT(steady, 0);
        // Half of the power that it comes to, in the mean over three quarters of a millisecond.
        std::size_t heard = 0;
        while (power[heard] + power[heard + 1] + power[heard + 2] < 1.5 * steady) ++heard;
        const double ms = 0.25 * (static_cast<double>(heard) + 1.5);
        EXPECT_LT(ms, 3 + 1000 * static_cast<double>(block) / kRate) << block;
    }
}

}  // namespace
}  // namespace tribo::noise
