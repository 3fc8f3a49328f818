// SPDX-License-Identifier: MIT
#include "noise/model/voice_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "noise/voices.hpp"

namespace tribo::noise {
namespace {

using test::db;

VoiceModel at(double speed, double force, double level_db) {
    return {speed, force, level_db, {48000, {0.5}}};
}

TEST(LevelLaw, is_the_power_law_that_the_levels_obey) {
    std::vector<VoiceModel> models;
    for (const double force : {0.5, 2.0})
        for (const double speed : {20.0, 90.0, 400.0})
            models.push_back(at(speed, force, -30 + 14 * std::log10(speed / 100) + 8 * std::log10(force)));
    const LevelLaw law = fit_level_law(models);
    EXPECT_NEAR(law.level_db, -30, 1e-9);
    EXPECT_NEAR(law.db_per_decade_speed, 14, 1e-9);
    EXPECT_NEAR(law.db_per_decade_force, 8, 1e-9);
}

TEST(LevelLaw, takes_friction_power_where_the_recordings_tell_nothing) {
    const LevelLaw one = fit_level_law({at(50, 2, -20)});
    EXPECT_EQ(one.db_per_decade_speed, 10);
    EXPECT_EQ(one.db_per_decade_force, 10);
    EXPECT_NEAR(one.level_db, -20 + 10 * std::log10(2) - 10 * std::log10(2), 1e-9);
    const LevelLaw speeds = fit_level_law({at(10, 1, -40), at(100, 1, -20)});
    EXPECT_NEAR(speeds.db_per_decade_speed, 20, 1e-9);
    EXPECT_EQ(speeds.db_per_decade_force, 10);
    // Speed and force that rise together cannot be told apart.
    const LevelLaw both = fit_level_law({at(10, 0.1, -40), at(100, 1, -20)});
    EXPECT_NEAR(both.db_per_decade_speed, 10, 1e-9);
    EXPECT_EQ(both.db_per_decade_force, 10);
}

TEST(VoiceMap, meets_each_recording_at_its_own_speed) {
    MaterialVoices voices;
    voices.models = {at(20, 1, -41), at(90, 1, -23), at(400, 1, -24)};  // no power law
    voices.law = fit_level_law(voices.models);
    const VoiceMap map(voices);
    for (int n = 0; n < 3; ++n) {
        const VoiceModel& m = voices.models[static_cast<std::size_t>(n)];
        const VoicePlace place = map.at(m.speed_mm_per_s, 1);
        ASSERT_EQ(place.count, 1);
        EXPECT_EQ(place.model[0], n);
        EXPECT_EQ(place.share[0], 1);
        EXPECT_NEAR(db(place.gain), m.level_db, 1e-9);
    }
    // Half way in the logarithm: both halves, the mean of the levels in dB.
    const VoicePlace between = map.at(std::sqrt(20.0 * 90), 1);
    ASSERT_EQ(between.count, 2);
    EXPECT_NEAR(between.share[0], 0.5, 1e-9);
    EXPECT_NEAR(db(between.gain), -32, 1e-9);
}

TEST(VoiceMap, goes_on_by_the_law_beyond_the_recordings_but_not_far) {
    const MaterialVoices voices = test::three_speeds();
    const VoiceMap map(voices);
    const double top = voices.models[2].level_db;
    EXPECT_NEAR(db(map.at(300 * std::pow(10, 3.0 / 14), 1).gain), top + 3, 1e-9);
    EXPECT_NEAR(db(map.at(1e6, 1).gain), top + 6, 1e-9);
    EXPECT_NEAR(db(map.at(300, 1e6).gain), top + 6, 1e-9);
    EXPECT_NEAR(db(map.at(3, 1).gain), voices.models[0].level_db - 14, 1e-9);
    EXPECT_NEAR(db(map.at(30, 0.1).gain), voices.models[0].level_db - 10, 1e-9);
    EXPECT_EQ(map.at(0, 1).gain, 0);
    EXPECT_EQ(map.at(100, 0).gain, 0);
    EXPECT_EQ(map.at(-5, 1).count, 0);
}

TEST(VoiceMap, falls_to_silence_even_where_recordings_got_louder_as_they_slowed_down) {
    MaterialVoices voices;
    voices.models = {at(20, 1, -20), at(200, 1, -30)};
    voices.law = fit_level_law(voices.models);
    const VoiceMap map(voices);
    EXPECT_NEAR(db(map.at(2, 1).gain), -30, 1e-9);
    EXPECT_NEAR(db(map.at(2000, 1).gain), -30, 1e-9);
}

RC_GTEST_PROP(VoiceMap, is_continuous_in_speed_and_force_and_its_shares_sum_to_1, ()) {
    MaterialVoices voices;
    for (const double force : {0.3, 1.0, 4.0})
        for (const double speed : {10.0, 60.0, 250.0})
            if (force != 1.0 || speed != 60.0)  // no full grid
                voices.models.push_back(at(
                    speed, force, *rc::gen::map(rc::gen::inRange(-600, -50), [](int x) { return 0.1 * x; })));
    voices.law = fit_level_law(voices.models);
    const VoiceMap map(voices);
    const double speed = std::pow(10, 0.001 * *rc::gen::inRange(-1000, 4000));
    const double force = std::pow(10, 0.001 * *rc::gen::inRange(-2000, 2000));
    const VoicePlace place = map.at(speed, force), near = map.at(speed * 1.0001, force * 0.9999);
    double sum = 0;
    for (int n = 0; n < place.count; ++n) sum += place.share[static_cast<std::size_t>(n)];
    RC_ASSERT(std::abs(sum - 1) < 1e-9);
    RC_ASSERT(std::abs(db(near.gain / place.gain)) < 0.05);
    for (int model = 0; model < 8; ++model) {
        const auto share = [&](const VoicePlace& p) {
            for (int n = 0; n < p.count; ++n)
                if (p.model[static_cast<std::size_t>(n)] == model)
                    return p.share[static_cast<std::size_t>(n)];
            return 0.0;
        };
        RC_ASSERT(std::abs(share(place) - share(near)) < 1e-3);
    }
}

// u0 with weights (v_b - v) / (v_b - v_a), beta likewise of the mean powers.
TEST(VoiceMap, as_published_is_linear_in_speed_and_takes_power_for_gain) {
    MaterialVoices voices;
    voices.models = {at(50, 1, -40), at(150, 1, -20)};
    const VoiceMap map(voices);
    const VoicePlace place = map.as_published(75);
    ASSERT_EQ(place.count, 2);
    EXPECT_NEAR(place.share[0], 0.75, 1e-12);
    EXPECT_NEAR(place.share[1], 0.25, 1e-12);
    EXPECT_NEAR(place.gain, 0.75 * 1e-4 + 0.25 * 1e-2, 1e-12);
    EXPECT_NEAR(map.as_published(0).gain, 1e-4, 1e-12);
    EXPECT_NEAR(map.as_published(1e9).gain, 1e-2, 1e-12);
    EXPECT_EQ(map.as_published(1e9).model[0], 1);
    EXPECT_EQ(map.as_published(150).count, 1);
}

}  // namespace
}  // namespace tribo::noise
