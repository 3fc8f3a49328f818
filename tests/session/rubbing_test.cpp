// SPDX-License-Identifier: MIT
#include "session/touch/rubbing.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace tribo::session {
namespace {

using readers::FingerPoint;

noise::MaterialVoices plain_voices() {
    noise::MaterialVoices voices;
    for (const double speed : {50.0, 200.0}) {
        noise::VoiceModel m;
        m.speed_mm_per_s = speed;
        m.level_db = -30 + 20 * std::log10(speed / 50);
        m.spectrum = {44100, {-0.5, 0.2}};
        voices.models.push_back(m);
    }
    voices.law = fit_level_law(voices.models);
    return voices;
}

double rms_db(const std::vector<float>& x, double rate, double from_s, double to_s) {
    double sum = 0;
    const auto first = static_cast<std::size_t>(from_s * rate), last = static_cast<std::size_t>(to_s * rate);
    for (std::size_t n = first; n < last; ++n) sum += static_cast<double>(x[n]) * x[n];
    return 10 * std::log10(sum / static_cast<double>(last - first));
}

TEST(StrokeMotion, moves_evenly_between_points_and_changes_speed_around_them) {
    const std::vector<FingerPoint> points{{1, 0, 0, 1}, {2, 60, 80, 2}, {3, 60, 80, 2}, {4, 60, 380, 0}};
    StrokeMotion motion(points);
    EXPECT_EQ(motion.at(0.5).force_n, 0);
    EXPECT_NEAR(motion.at(1.5).speed_mm_per_s, 100, 1e-9);
    EXPECT_NEAR(motion.at(1.5).force_n, 1.5, 1e-9);
    EXPECT_NEAR(motion.at(1.98).speed_mm_per_s, 100, 1e-9);
    EXPECT_NEAR(motion.at(1.995).speed_mm_per_s, 75, 1e-9);
    EXPECT_NEAR(motion.at(2.0).speed_mm_per_s, 50, 1e-9);
    EXPECT_NEAR(motion.at(2.005).speed_mm_per_s, 25, 1e-9);
    EXPECT_EQ(motion.at(2.5).speed_mm_per_s, 0);
    EXPECT_NEAR(motion.at(3.5).speed_mm_per_s, 300, 1e-9);
    EXPECT_NEAR(motion.at(3.5).force_n, 1, 1e-9);
    EXPECT_EQ(motion.at(4.1).speed_mm_per_s, 0);
}

TEST(StrokeMotion, does_not_take_a_lifted_fingers_way_for_rubbing) {
    const std::vector<FingerPoint> points{
        {0, 0, 0, 1}, {1, 100, 0, 1}, {1.02, 100, 0, 0}, {1.2, 0, 0, 0}, {1.3, 0, 0, 1}};
    StrokeMotion motion(points);
    EXPECT_NEAR(motion.at(0.5).speed_mm_per_s, 100, 1e-9);
    EXPECT_EQ(motion.at(1.015).speed_mm_per_s, 0);
    EXPECT_EQ(motion.at(1.1).force_n, 0);
    EXPECT_EQ(motion.at(1.21).speed_mm_per_s, 0);
}

TEST(Rubbing, has_the_level_of_each_stretch_and_is_silent_where_nothing_moves) {
    // 50 mm/s for 3 s, a rest of 1 s, 200 mm/s for 3 s, lifted.
    const std::vector<FingerPoint> points{{0, 0, 0, 1}, {3, 150, 0, 1}, {4, 150, 0, 1}, {7, 750, 0, 1}};
    Rubbing rubbing(plain_voices(), points, {.sample_rate_hz = 44100});
    EXPECT_EQ(rubbing.frames(), static_cast<std::int64_t>(std::ceil(7.05 * 44100)));
    std::vector<float> x(static_cast<std::size_t>(rubbing.frames()));
    rubbing.render(x);
    EXPECT_NEAR(rms_db(x, 44100, 0.1, 2.9), -30, 0.3);
    EXPECT_NEAR(rms_db(x, 44100, 4.1, 6.9), -30 + 20 * std::log10(4), 0.3);
    for (std::size_t n = 3 * 44100 + 4410; n < 4 * 44100 - 1000; ++n) ASSERT_EQ(x[n], 0);
    EXPECT_EQ(x.back(), 0);
}

TEST(Rubbing, gives_the_same_samples_in_any_blocks) {
    const std::vector<FingerPoint> points{{0, 0, 0, 1}, {0.3, 20, 0, 1.5}, {0.5, 70, 10, 0.2}};
    Rubbing whole(plain_voices(), points, {}), parts(plain_voices(), points, {});
    std::vector<float> x(20000), y(20000);
    whole.render(x);
    std::size_t at = 0;
    for (std::size_t block = 1; at < y.size(); block = block * 3 % 257 + 1) {
        const std::size_t count = std::min(block, y.size() - at);
        parts.render(std::span(y).subspan(at, count));
        at += count;
    }
    EXPECT_EQ(x, y);
}

}  // namespace
}  // namespace tribo::session
