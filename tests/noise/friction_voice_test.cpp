// SPDX-License-Identifier: MIT
#include "noise/play/friction_voice.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "base/counted_allocations.hpp"
#include "base/noise_hash.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/voices.hpp"

namespace tribo::noise {
namespace {

using test::db;
using test::rms;
using test::three_speeds;

std::vector<float> rendered(FrictionVoice& voice, std::size_t frames) {
    std::vector<float> out(frames);
    voice.render(out);
    return out;
}

// Ten seconds of noise of this bandwidth tell a level to 0.05 dB.
TEST(FrictionVoice, level_follows_the_law_at_101_speeds) {
    FrictionVoice voice(three_speeds());
    for (int n = 0; n <= 100; ++n) {
        const double speed = 30 * std::pow(10.0, 0.01 * n);
        voice.set_target(speed, 1);
        rendered(voice, 4800);
        const double law = db(0.05) + 14 * std::log10(speed / 100);
        EXPECT_NEAR(db(rms(rendered(voice, 96000))), law, 0.25) << speed;
    }
}

TEST(FrictionVoice, as_published_dips_3_dB_half_way_and_squares_the_level) {
    MaterialVoices voices = three_speeds();
    for (VoiceModel& m : voices.models) m.level_db = -20;  // A = 0.01
    FrictionVoice voice(voices, {.as_published = true});
    voice.set_target(100, 1);
    rendered(voice, 4800);
    EXPECT_NEAR(db(rms(rendered(voice, 480000))), -40, 0.1);
    voice.set_target(200, 1);
    rendered(voice, 4800);
    EXPECT_NEAR(db(rms(rendered(voice, 480000))), -43.01, 0.1);
    voice.set_target(0, 1);  // a finger at rest is heard
    EXPECT_NEAR(db(rms(rendered(voice, 480000))), -40, 0.1);
}

TEST(FrictionVoice, standing_still_or_off_the_surface_is_exact_silence) {
    FrictionVoice voice(three_speeds());
    EXPECT_EQ(rms(rendered(voice, 4800)), 0);
    voice.set_target(100, 1);
    rendered(voice, 9600);
    voice.set_target(0, 1);
    rendered(voice, 4800);
    EXPECT_EQ(rms(rendered(voice, 4800)), 0);
    voice.set_target(100, 1);
    rendered(voice, 9600);
    voice.set_target(100, 0);
    rendered(voice, 4800);
    EXPECT_EQ(rms(rendered(voice, 4800)), 0);
    for (const double odd : {std::nan(""), -1.0, HUGE_VAL}) {
        voice.set_target(odd, 1);
        voice.set_target(1, odd);
        const std::vector<float> x = rendered(voice, 4800);
        EXPECT_TRUE(std::ranges::all_of(x, [](float v) { return std::abs(v) <= 1; }));
    }
}

TEST(FrictionVoice, starts_and_stops_within_3_ms) {
    FrictionVoice voice(three_speeds());
    // The mean over many starts, each at another place of the noise and of the quantum.
    double early = 0, late = 0, after = 0;
    for (std::size_t n = 0; n < 400; ++n) {
        voice.set_target(0, 0);
        rendered(voice, 2400 + n % 64);
        voice.set_target(100, 1);
        rendered(voice, 120);
        early += std::pow(rms(rendered(voice, 48)), 2);  // around 3 ms
        rendered(voice, 480);
        late += std::pow(rms(rendered(voice, 480)), 2);
        voice.set_target(100, 0);
        rendered(voice, 480);
        after += std::pow(rms(rendered(voice, 48)), 2);  // around 10 ms
    }
    EXPECT_GT(10 * std::log10(early / (late / 1)), -3);
    EXPECT_LT(10 * std::log10(after / late), -30);
}

TEST(FrictionVoice, gives_the_same_samples_in_any_blocks) {
    FrictionVoice whole(three_speeds()), parts(three_speeds());
    whole.set_target(80, 1);
    parts.set_target(80, 1);
    const std::vector<float> x = rendered(whole, 5000);
    std::vector<float> y;
    for (std::size_t block = 1; y.size() < x.size(); block = block * 3 % 257 + 1) {
        const std::vector<float> part = rendered(parts, std::min(block, x.size() - y.size()));
        y.insert(y.end(), part.begin(), part.end());
    }
    EXPECT_EQ(x, y);
}

TEST(FrictionVoice, gives_the_same_samples_after_it_was_led_back) {
    FrictionVoice voice(three_speeds());
    voice.seek(64 * 1000);
    voice.set_target(80, 1);
    const std::vector<float> x = rendered(voice, 5000);
    voice.set_target(250, 3);
    rendered(voice, 12345);
    voice.seek(64 * 1000);
    voice.set_target(80, 1);
    EXPECT_EQ(rendered(voice, 5000), x);
    FrictionVoice other(three_speeds(), {.seed = 2});
    other.seek(64 * 1000);
    other.set_target(80, 1);
    EXPECT_NE(rendered(other, 5000), x);
}

// Steps of speed and force: the second difference, which hears clicks, has no more energy than that of the
// steady noise at the louder of the two.
TEST(FrictionVoice, steps_of_speed_and_force_do_not_click) {
    MaterialVoices voices = three_speeds();
    // Low-pass noise, so that a click would stand out: -60 dB at high frequencies.
    for (VoiceModel& m : voices.models) m.spectrum.reflection = {-0.995, 0.98};
    FrictionVoice voice(voices);
    const auto roughness = [](const std::vector<float>& x) {
        double worst = 0;
        for (std::size_t n = 2; n < x.size(); ++n)
            worst = std::max(worst, std::abs(static_cast<double>(x[n]) - 2.0 * x[n - 1] + x[n - 2]));
        return worst;
    };
    voice.set_target(300, 1);
    rendered(voice, 4800);
    const double steady = roughness(rendered(voice, 480000));
    double stepped = 0;
    for (int n = 0; n < 400; ++n) {
        voice.set_target(n % 2 == 0 ? 300 : 30, n % 3 == 0 ? 0 : 1);
        stepped = std::max(stepped, roughness(rendered(voice, 1000 + static_cast<std::size_t>(n))));
    }
    EXPECT_LT(db(stepped / steady), 1);
}

TEST(FrictionVoice, runs_at_the_rate_of_a_servo_with_the_level_of_its_band) {
    const MaterialVoices voices = three_speeds();
    FrictionVoice servo(voices, {.sample_rate_hz = 4000});
    servo.set_target(100, 1);
    rendered(servo, 4000);
    const double level = rms(rendered(servo, 400000));
    double power = 0;
    for (int n = 0; n < 2000; ++n) power += power_at(voices.models[1].spectrum, n + 0.5) / 24000;
    EXPECT_NEAR(db(level), db(0.05) + 10 * std::log10(power), 0.2);
}

// Recorded at 8 kHz: 4 poles there, 192 at 48 kHz, 512 at 192 kHz.
TEST(FrictionVoice, sounds_the_same_at_a_higher_rate) {
    MaterialVoices voices = three_speeds(8000);
    voices.models = {voices.models[1]};
    const ArModel& model = voices.models[0].spectrum;
    for (const double rate : {48000.0, 96000.0, 192000.0}) {
        FrictionVoice voice(voices, {.sample_rate_hz = rate});
        voice.set_target(100, 1);
        const std::vector<float> sound = rendered(voice, static_cast<std::size_t>(20 * rate));
        EXPECT_NEAR(db(rms(sound)), db(0.05), 0.2) << rate;
        const std::size_t frame = 65536;
        const std::vector<double> heard =
            power_spectrum(std::vector<double>(sound.begin(), sound.end()), frame);
        const double step = rate / static_cast<double>(frame);
        for (double low = 200; 1.26 * low < 3600; low *= 1.26) {
            double was = 0, is = 0;
            for (auto k = static_cast<std::size_t>(low / step); static_cast<double>(k) * step < 1.26 * low;
                 ++k) {
                was += 0.05 * 0.05 * power_at(model, (static_cast<double>(k) + 0.5) * step) / 8000;
                is += heard[k] / rate;
            }
            // 20 s of 52 Hz and more tell a level to 0.13 dB.
            EXPECT_NEAR(10 * std::log10(is / was), 0, 0.6) << rate << ' ' << low;
        }
    }
}

TEST(FrictionVoice, never_allocates_once_it_stands) {
    FrictionVoice voice(three_speeds()), published(three_speeds(), {.as_published = true});
    std::vector<float> out(1000);
    const long before = tribo::test::allocations;
    for (int n = 0; n < 300; ++n) {
        voice.set_target(2.0 * n, 0.01 * n);
        published.set_target(2.0 * n, 0.01 * n);
        voice.render(out);
        published.render(out);
    }
    voice.seek(123456);
    EXPECT_EQ(tribo::test::allocations - before, 0);
    out = std::vector<float>(10);
    EXPECT_GT(tribo::test::allocations - before, 0);  // the counter counts
}

// Any speeds and forces for ten minutes of sound: numbers within full scale throughout.
TEST(FrictionVoice, stays_within_full_scale_whatever_the_finger_does) {
    MaterialVoices voices = three_speeds();
    for (VoiceModel& m : voices.models) m.level_db = -6;
    FrictionVoice voice(voices, {.sample_rate_hz = 8000});
    const CounterNoise random(4);
    std::vector<float> out(800);
    for (std::uint64_t n = 0; n < 6000; ++n) {
        voice.set_target(1000 * random.uniform(2 * n), 10 * random.uniform(2 * n + 1) - 1);
        voice.render(out);
        for (const float x : out) ASSERT_TRUE(x >= -1 && x <= 1);
    }
}

}  // namespace
}  // namespace tribo::noise
