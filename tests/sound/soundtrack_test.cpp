// SPDX-License-Identifier: MIT
#include "sound/play/soundtrack.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "sound/cut/published_voice.hpp"
#include "sound/cuts.hpp"
#include "sound/play/limiter.hpp"

namespace tribo::sound {
namespace {

using test::cut_at;
using test::falling_spectrum;
using test::track_of;

struct Story {
    std::vector<contact::ForceSpectrum> spectra;
    std::vector<contact::ContactSample> samples;
    double duration_s = 0;
};

// Contact that comes and goes, tools, speeds and places that change, moments that coincide or lie back.
Story any_story() {
    Story story;
    const int count = *rc::gen::inRange(1, 12);
    story.spectra.reserve(static_cast<std::size_t>(count));
    double t = *rc::gen::inRange(0, 50) / 1000.0;
    for (int i = 0; i < count; ++i) {
        story.spectra.push_back(
            falling_spectrum(*rc::gen::inRange(1, 5), *rc::gen::inRange(0, 20), *rc::gen::inRange(0, 300)));
        contact::ContactSample s =
            cut_at(t, &story.spectra.back(), *rc::gen::inRange(0, 40000), *rc::gen::inRange(0, 3) * 1000.0);
        s.phase_rad = *rc::gen::inRange(0, 1000) / 10.0;
        s.position_mm.x = *rc::gen::inRange(-5000, 5000);
        story.samples.push_back(s);
        t += *rc::gen::inRange(-5, 60) / 1000.0;
    }
    story.duration_s = std::max(t, 0.0) + 0.05;
    return story;
}

RC_GTEST_PROP(Soundtrack, gives_the_same_bits_in_any_blocks_and_stays_within_one, ()) {
    const Story story = any_story();
    SoundtrackOptions options;
    options.gain_db = *rc::gen::inRange(-20, 60);
    const std::vector<float> whole = track_of(story.samples, story.duration_s, options);
    for (const float v : whole) RC_ASSERT(std::abs(v) <= 1);
    for (const int block : {64, 256, 1000, *rc::gen::inRange(1, 300)}) {
        Soundtrack track(options);
        std::vector<float> wave;
        std::vector<float> buffer(static_cast<std::size_t>(2 * block));
        const auto play = [&](std::int64_t frames) {
            while (frames > 0) {
                const auto n = static_cast<std::size_t>(std::min<std::int64_t>(frames, block));
                track.render(std::span(buffer).first(2 * n));
                for (std::size_t i = 0; i < n; ++i) wave.push_back(buffer[2 * i]);
                frames -= static_cast<std::int64_t>(n);
            }
        };
        for (const contact::ContactSample& s : story.samples) {
            track.excite(s);
            play(track.frames_left());
        }
        play(track.frame_at(story.duration_s) - track.frames_rendered());
        track.release();
        play(track.frame_at(story.duration_s + kTailSeconds) - track.frames_rendered());
        RC_ASSERT(wave.size() == whole.size());
        for (std::size_t n = 0; n < wave.size(); ++n) {
            RC_ASSERT(std::bit_cast<std::uint32_t>(wave[n]) == std::bit_cast<std::uint32_t>(whole[n]));
        }
    }
}

TEST(Soundtrack, is_digital_silence_without_contact) {
    const contact::ForceSpectrum none;
    for (const bool as_published : {false, true}) {
        SoundtrackOptions options;
        options.as_published = as_published;
        std::vector<contact::ContactSample> samples = {cut_at(0, nullptr, 6000), cut_at(0.3, &none, 6000),
                                                       cut_at(0.6, nullptr, 9000)};
        for (contact::ContactSample& s : samples) s.force_n = {};
        const std::vector<float> wave = track_of(samples, 0.6, options);
        EXPECT_EQ(wave.size(), 29760u);
        for (const float v : wave) ASSERT_EQ(v, 0);
    }
}

TEST(Soundtrack, lasts_as_long_as_its_time_and_the_tail) {
    Soundtrack track{SoundtrackOptions{}};
    std::int64_t frames = 0;
    const auto count = [&](std::span<const float> block) {
        frames += static_cast<std::int64_t>(block.size()) / 2;
    };
    track.play_to(cut_at(1.2345, nullptr, 6000), count);
    EXPECT_NEAR(static_cast<double>(frames), 1.2345 * 48000, 32);  // the nearest quantum
    track.play_out(2.5, count);
    EXPECT_EQ(frames, 121'000 - 40);  // 2.52 s
    EXPECT_EQ(track.frames_rendered(), frames);
}

TEST(Soundtrack, plays_the_same_in_both_channels) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 8);
    Soundtrack track{SoundtrackOptions{}};
    track.excite(cut_at(0, &spectrum, 6000, 500));
    std::vector<float> stereo(4000);
    track.render(stereo);
    EXPECT_GT(test::rms(stereo), 0);
    for (std::size_t i = 0; i < stereo.size(); i += 2) ASSERT_EQ(stereo[i], stereo[i + 1]);
}

TEST(Soundtrack, refuses_what_is_not_a_number_and_goes_on_as_before) {
    contact::ForceSpectrum spectrum = falling_spectrum(2, 8), broken = spectrum;
    broken.harmonics[3].y = {0, std::numeric_limits<double>::infinity()};
    const contact::ContactSample good = cut_at(0, &spectrum, 6000, 100);
    contact::ContactSample bad_rate = good, bad_spectrum = good, bad_place = good;
    bad_rate.phase_rate_rad_per_s = std::numeric_limits<double>::quiet_NaN();
    bad_spectrum.spectrum = &broken;
    bad_place.position_mm.z = -std::numeric_limits<double>::infinity();
    Soundtrack a{SoundtrackOptions{}}, b{SoundtrackOptions{}};
    EXPECT_TRUE(a.excite(good));
    EXPECT_TRUE(b.excite(good));
    for (const contact::ContactSample& bad : {bad_rate, bad_spectrum, bad_place}) EXPECT_FALSE(b.excite(bad));
    std::vector<float> x(2000), y(2000);
    a.render(x);
    b.render(y);
    EXPECT_EQ(x, y);
}

TEST(Soundtrack, survives_absurd_numbers_and_plays_on_after_them) {
    const contact::ForceSpectrum absurd = falling_spectrum(2, 8, 1e200), spectrum = falling_spectrum(2, 1);
    contact::ContactSample samples[] = {cut_at(0, &absurd, 1e300, 1e300), cut_at(0.1, &absurd, 6000, 1e300),
                                        cut_at(0.1, nullptr, 6000),       cut_at(0.2, nullptr, 6000),
                                        cut_at(0.2, &spectrum, 6000),     cut_at(0.5, &spectrum, 6000)};
    samples[0].position_mm.x = samples[1].position_mm.y = 1e300;
    const std::vector<float> wave = track_of(samples, 0.5);
    for (const float v : wave) ASSERT_LE(std::abs(v), 1);
    EXPECT_NEAR(test::tone_amplitude(std::span(wave).subspan(16800, 4800), 200, 48000), 0.04, 1e-4);
}

TEST(Soundtrack, dies_away_when_nothing_new_is_told) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 8);
    Soundtrack track{SoundtrackOptions{}};
    track.excite(cut_at(0, &spectrum, 6000, 100));
    std::vector<float> held(2 * 4800), after(2 * 4800);
    track.render(held);
    EXPECT_GT(test::rms(std::span(held).last(2000)), 1e-3);
    track.render(std::span(after).first(2 * 1440));
    track.render(after);  // from 0.13 s on
    for (const float v : after) ASSERT_EQ(v, 0);
}

TEST(Soundtrack, goes_on_unchanged_for_as_long_as_it_is_told_to) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 8);
    Soundtrack held{SoundtrackOptions{}}, told{SoundtrackOptions{}};
    std::vector<float> x, y;
    const auto into = [](std::vector<float>& wave) {
        return [&wave](std::span<const float> block) { wave.insert(wave.end(), block.begin(), block.end()); };
    };
    held.play_to(cut_at(0, &spectrum, 6000, 100), into(x));
    held.play_on(0.7, into(x));
    held.play_out(1, into(x));
    told.play_to(cut_at(0, &spectrum, 6000, 100), into(y));
    told.play_to(cut_at(0.7, &spectrum, 6000, 100), into(y));
    told.release();
    told.play_out(1, into(y));
    ASSERT_EQ(x.size(), y.size());
    // Up to the end, where the one without an end dies away 0.1 s later.
    for (std::size_t i = 0; i < 2 * 33600; ++i) ASSERT_NEAR(x[i], y[i], 1e-6f) << i;
    for (std::size_t i = 2 * 39400; i < x.size(); ++i) ASSERT_EQ(x[i], 0);
}

TEST(Soundtrack, takes_a_sample_that_comes_late_at_once) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 1);
    Soundtrack track{SoundtrackOptions{}};
    std::vector<float> before(2 * 4800), after(2 * 4800);
    track.render(before);
    EXPECT_TRUE(track.excite(cut_at(0.01, &spectrum, 6000)));
    EXPECT_EQ(track.frames_left(), 0);
    track.render(after);
    EXPECT_EQ(test::rms(before), 0);
    EXPECT_NEAR(test::rms(std::span(after).subspan(2400, 4800)), 40 / std::sqrt(2) * test::kSamplePerNewton,
                0.01 * 40 * test::kSamplePerNewton);
}

TEST(Soundtrack, gets_quieter_by_6_dB_per_doubling_of_the_distance_beyond_1_m) {
    EXPECT_EQ(rolloff(0, 1), 1);
    EXPECT_EQ(rolloff(1000, 1), 1);
    EXPECT_EQ(rolloff(2000, 1), 0.5);
    EXPECT_EQ(rolloff(100, 40), 0.25);
    EXPECT_EQ(rolloff(200, 1, 0.2), 5);
    EXPECT_EQ(rolloff(10, 1, 0.2), 5);
    EXPECT_EQ(rolloff(2000, 1, 0.2), 0.5);
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 1);
    const auto level = [&](double distance_mm, double factor) {
        contact::ContactSample samples[] = {cut_at(0, &spectrum, 6000), cut_at(0.3, &spectrum, 6000)};
        SoundtrackOptions options;
        options.distance_factor = factor;
        options.listener_mm = {10, 20, 30};
        for (contact::ContactSample& s : samples) s.position_mm = {10, 20 + distance_mm, 30};
        return test::rms(std::span<const float>(track_of(samples, 0.3, options)).subspan(4800, 9600));
    };
    EXPECT_NEAR(test::decibel(level(2000, 1) / level(50, 1)), -6.02, 0.01);
    EXPECT_NEAR(test::decibel(level(4000, 1) / level(2000, 1)), -6.02, 0.01);
    EXPECT_NEAR(test::decibel(level(50, 100) / level(50, 1)), -13.98, 0.01);
}

TEST(Soundtrack, does_not_click_when_the_source_leaps) {
    const contact::ForceSpectrum spectrum = falling_spectrum(4, 1);
    contact::ContactSample samples[] = {cut_at(0, &spectrum, 6000), cut_at(0.2, &spectrum, 6000),
                                        cut_at(0.201, &spectrum, 6000), cut_at(0.5, &spectrum, 6000)};
    samples[0].position_mm.x = samples[1].position_mm.x = 20000;
    const std::vector<float> wave = track_of(samples, 0.5);
    EXPECT_LT(test::roughest(wave), 1.1 * test::roughest(std::span(wave).subspan(20000, 2400)));
}

TEST(Soundtrack, gain_is_in_decibel) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 4, 1);
    const std::vector<contact::ContactSample> samples = {cut_at(0, &spectrum, 6000),
                                                         cut_at(0.2, &spectrum, 6000)};
    SoundtrackOptions louder;
    louder.gain_db = 20;
    const std::vector<float> a = track_of(samples, 0.2), b = track_of(samples, 0.2, louder);
    EXPECT_NEAR(test::rms(b) / test::rms(a), 10, 1e-5);
}

TEST(Soundtrack, repeats_with_the_same_seed_and_differs_with_another) {
    const std::vector<contact::ContactSample> samples = {cut_at(0, nullptr, 6000, 100),
                                                         cut_at(0.2, nullptr, 6000, 100)};
    SoundtrackOptions one, other;
    one.chips.material = other.chips.material = ChipMaterial::steel;
    other.seed = 2;
    EXPECT_EQ(track_of(samples, 0.2, one), track_of(samples, 0.2, one));
    EXPECT_NE(track_of(samples, 0.2, one), track_of(samples, 0.2, other));
}

TEST(SoundtrackOptions, are_refused_out_of_range_by_name) {
    EXPECT_TRUE(check({}));
    const auto cause = [](auto change) {
        SoundtrackOptions options;
        change(options);
        const Result<void> result = check(options);
        return result ? std::string() : result.error().text();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(cause([](auto& o) { o.sample_rate_hz = 8000; }).find("8000 Hz; try 48000"), std::string::npos);
    EXPECT_NE(cause([](auto& o) { o.sample_rate_hz = 1 << 30; }).find("sample rate"), std::string::npos);
    EXPECT_NE(cause([&](auto& o) { o.gain_db = nan; }).find("gain_db"), std::string::npos);
    EXPECT_NE(cause([](auto& o) { o.gain_db = 61; }).find("gain_db"), std::string::npos);
    EXPECT_NE(cause([&](auto& o) { o.listener_mm.y = nan; }).find("listener_mm"), std::string::npos);
    EXPECT_NE(cause([](auto& o) { o.distance_factor = 0; }).find("distance_factor"), std::string::npos);
    EXPECT_EQ(cause([](auto& o) { o.sample_rate_hz = 44100; }), "");
}

RC_GTEST_PROP(Limiter, changes_nothing_below_its_knee_never_passes_1_and_never_turns_back, ()) {
    const auto any = [] { return *rc::gen::inRange(-4000, 4001) / 1000.0; };
    const double a = any(), b = any();
    if (std::abs(a) <= kLimiterKnee) RC_ASSERT(soft_limit(a) == a);
    RC_ASSERT(std::abs(soft_limit(a)) < 1);
    RC_ASSERT(soft_limit(-a) == -soft_limit(a));
    RC_ASSERT((a < b) == (soft_limit(a) < soft_limit(b)));
}

TEST(Limiter, leaves_its_knee_with_the_same_slope_and_survives_anything) {
    const double h = 1e-6;
    EXPECT_NEAR((soft_limit(kLimiterKnee + h) - soft_limit(kLimiterKnee)) / h, 1, 1e-5);
    EXPECT_NEAR(soft_limit(2), 0.958, 5e-4);
    EXPECT_EQ(soft_limit(std::numeric_limits<double>::infinity()), 1);
    EXPECT_EQ(soft_limit(-1e300), -1);
    EXPECT_EQ(soft_limit(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(PublishedSound, is_the_first_sine_alone_whatever_the_second_is_given) {
    for (int n = 0; n < 1000; ++n) {
        const double t = n / 48000.0;
        EXPECT_EQ(published_sound(t, 0, 100, 1e9), 0);
        EXPECT_EQ(published_sound(t, 3, 100, 1e9), published_sound(t, 3, 100, 0));
        EXPECT_NEAR(published_sound(t, 3, 100, 0), 3 * std::sin(2 * std::numbers::pi * 100 * t), 1e-12);
    }
}

TEST(SteadyWave, is_the_promised_stretch_of_an_unchanging_cut) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 1);
    const contact::ContactSample cut = cut_at(17, &spectrum, 6000);
    for (const bool as_published : {false, true}) {
        SoundtrackOptions options;
        options.as_published = as_published;
        const std::vector<float> wave = steady_wave(cut, options, 0.1);
        ASSERT_EQ(wave.size(), 4800u);
        const double hz = as_published ? 100 : 200, amplitude = as_published ? 100 : 40;
        EXPECT_NEAR(test::tone_amplitude(wave, hz, 48000) / (amplitude * test::kSamplePerNewton), 1, 1e-3);
        const std::span<const float> all(wave);
        EXPECT_NEAR(test::rms(all.first(480)), test::rms(all.last(480)), 1e-6);
    }
}

}  // namespace
}  // namespace tribo::sound
