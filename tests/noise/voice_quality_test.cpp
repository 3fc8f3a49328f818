// SPDX-License-Identifier: MIT
// What the report's figures say of sounds whose truth is known.
#include "noise/learn/voice_quality.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace tribo::noise {
namespace {

constexpr double kRate = 44100, kPi = std::numbers::pi;

const ArModel& process() {
    static const ArModel model{kRate, {-0.9, 0.8, -0.3, 0.5}};
    return model;
}

// 12 s of the process at -20 dB; `swing` makes its level rise and fall 20 times a second.
PreparedRecording recording(double swing = 0) {
    PreparedRecording r;
    r.sample_rate_hz = kRate;
    std::mt19937_64 random(5);
    std::normal_distribution<double> gauss;
    const std::vector<double> a = predictor_of(process().reflection);
    std::vector<double> past(a.size());
    const double gain = std::sqrt(innovation_power(process().reflection));
    double power = 0;
    for (int n = 0; n < static_cast<int>(12 * kRate); ++n) {
        double y = gain * gauss(random);
        for (std::size_t k = 0; k < a.size(); ++k) y -= a[k] * past[k];
        for (std::size_t k = past.size(); k-- > 1;) past[k] = past[k - 1];
        past[0] = y;
        r.sound.push_back(0.1 * y * (1 + swing * std::sin(2 * kPi * 20 * n / kRate)));
        power += r.sound.back() * r.sound.back();
    }
    r.level_db = 10 * std::log10(power / static_cast<double>(r.sound.size()));
    return r;
}

VoiceModel truth(double level_db) {
    VoiceModel m;
    m.speed_mm_per_s = 100;
    m.level_db = level_db;
    m.spectrum = process();
    return m;
}

TEST(VoiceQuality, of_the_process_itself_leaves_nothing_to_wish_for) {
    const PreparedRecording r = recording();
    const VoiceQuality q = quality_of(truth(r.level_db), r, 0);
    // Four poles fit the other half as well as the halves themselves allow; so do fifty.
    EXPECT_LT(q.held_out_db, q.halves_db);
    EXPECT_LT(q.held_out_db, 1);
    EXPECT_NEAR(q.held_out_plain_db, q.held_out_db, 0.3);
    EXPECT_NEAR(q.level_error_db, 0, 0.2);
    EXPECT_NEAR(q.kurtosis.original, 3, 0.15);
    EXPECT_NEAR(q.kurtosis.gaussian, 3, 0.15);
    EXPECT_EQ(q.kurtosis.voice, q.kurtosis.gaussian);  // no texture
    EXPECT_NEAR(q.deviation_db.gaussian, q.deviation_db.original, 0.1);
    EXPECT_EQ(q.original.size(), static_cast<std::size_t>(kHeardS * kRate));
    ASSERT_EQ(q.hz.size(), q.model_db.size());
    for (std::size_t n = 0; n < q.hz.size(); ++n) {
        if (q.hz[n] < 100 || q.hz[n] > 20000) continue;
        EXPECT_NEAR(q.original_db[n], q.model_db[n], 2) << q.hz[n];
    }
}

TEST(VoiceQuality, tells_how_wrong_a_wrong_voice_is) {
    const PreparedRecording r = recording();
    VoiceModel dull = truth(r.level_db);
    dull.spectrum.reflection = {-0.2};
    const VoiceQuality q = quality_of(dull, r, 0);
    EXPECT_GT(q.held_out_db, q.held_out_plain_db + 3);
    double worst = 0;
    for (std::size_t n = 0; n < q.hz.size(); ++n) {
        if (q.hz[n] > 200 && q.hz[n] < 20000)
            worst = std::max(worst, std::abs(q.original_db[n] - q.model_db[n]));
    }
    EXPECT_GT(worst, 6);
}

TEST(VoiceQuality, sees_a_level_that_swings_where_it_swings) {
    const PreparedRecording plain = recording(), r = recording(0.8);
    const VoiceQuality q = quality_of(truth(r.level_db), r, 0),
                       q0 = quality_of(truth(plain.level_db), plain, 0);
    // (1 + m sin)^2: kurtosis rises by 3 (1 + 3 m^2 + 3/8 m^4) / (1 + m^2 / 2)^2 over 3.
    const double m2 = 0.64;
    EXPECT_NEAR(q.kurtosis.original, 3 * (1 + 3 * m2 + 0.375 * m2 * m2) / std::pow(1 + m2 / 2, 2), 0.3);
    EXPECT_NEAR(q.kurtosis.gaussian, 3, 0.15);
    EXPECT_GT(q.deviation_db.original, q.deviation_db.gaussian + 2);
    const auto loudest =
        std::ranges::max_element(q.modulation.original_db) - q.modulation.original_db.begin();
    EXPECT_NEAR(std::log2(q.modulation.hz[static_cast<std::size_t>(loudest)] / 20), 0, 0.5);
    const auto at = static_cast<std::size_t>(loudest);
    EXPECT_GT(q.modulation.original_db[at], q0.modulation.original_db[at] + 10);
    EXPECT_NEAR(q.modulation.gaussian_db[at], q0.modulation.gaussian_db[at], 3);
}

}  // namespace
}  // namespace tribo::noise
