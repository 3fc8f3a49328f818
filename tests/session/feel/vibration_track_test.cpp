// SPDX-License-Identifier: MIT
// The vibration that a servo carries: what lies in its band passes unchanged, what it would alias is gone.
#include "session/feel/vibration_track.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace tribo::session {
namespace {

constexpr double kPi = std::numbers::pi;

// A force along the feed, in rows of different lengths.
VibrationTrack track_of(double hz, double rate_hz, const milling::ToolFrame& frame = {}) {
    VibrationTrack track(rate_hz, 1);
    std::int64_t first = 4800;
    for (const int samples : {7000, 1, 12'000, 333, 20'000}) {
        std::vector<std::array<float, 2>> row;
        for (int n = 0; n < samples; ++n) {
            const double t_s = static_cast<double>(first + n) / 48'000;
            row.push_back({static_cast<float>(50 * std::cos(2 * kPi * hz * t_s)), 0});
        }
        track.add({48'000, first, row}, frame);
        first += samples;
    }
    return track;
}

TEST(VibrationTrack, keeps_what_the_servo_can_carry) {
    for (const double rate : {1000.0, 1733.0, 4000.0}) {
        for (const double hz : {0.0, 0.03 * rate, 0.24 * rate}) {
            const VibrationTrack track = track_of(hz, rate);
            for (int n = static_cast<int>(0.3 * rate); n < 0.7 * rate; ++n)
                EXPECT_NEAR(track.force_n(n / rate).x, 50 * std::cos(2 * kPi * hz * n / rate), 0.5) << hz;
        }
    }
}

TEST(VibrationTrack, lets_nothing_alias) {
    for (const double rate : {1000.0, 4000.0}) {
        for (const double hz : {0.41 * rate, 0.5 * rate, 0.93 * rate, 3.2 * rate}) {
            const VibrationTrack track = track_of(hz, rate);
            for (int n = static_cast<int>(0.3 * rate); n < 0.7 * rate; ++n)
                EXPECT_NEAR(track.force_n(n / rate).x, 0, 0.5) << hz;
        }
    }
}

TEST(VibrationTrack, is_a_force_in_the_stock_and_silent_outside_of_the_cut) {
    const milling::ToolFrame frame = milling::tool_frame({0, 1, 0}, {0, 0, 1}, {0, 0, 1});
    const VibrationTrack track = track_of(0, 1000, frame);
    EXPECT_NEAR(track.force_n(0.5).z, 50, 0.5);
    EXPECT_NEAR(track.force_n(0.5).x, 0, 1e-9);
    EXPECT_EQ(track.force_n(0.05), Vec3{});
    EXPECT_EQ(track.force_n(-1), Vec3{});
    EXPECT_EQ(track.force_n(2), Vec3{});
    EXPECT_EQ(track.force_n(NAN), Vec3{});
}

TEST(VibratingForce, adds_it_to_the_force_of_the_table) {
    class Steady final : public haptics::CuttingForce {
      public:
        Vec3 force_n(double) noexcept override { return {0, 1, 0}; }
    } table;
    const VibrationTrack track = track_of(0, 1000);
    VibratingForce force(table, track, {.gain = 0.01});
    EXPECT_NEAR(force.force_n(0.5).x, 0.5, 0.005);
    EXPECT_NEAR(force.force_n(0.5).y, 1, 1e-12);
}

}  // namespace
}  // namespace tribo::session
