// SPDX-License-Identifier: MIT
#include "sound/cut/recorded_voice.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "sound/cuts.hpp"

namespace tribo::sound {
namespace {

// A machine at 6000 rpm, 100 turns a second: lines at the orders 4 and 8, and noise 30 dB under them.
const std::shared_ptr<const Recording>& machine() {
    constexpr double rate_hz = 44100, seconds = 1.3;
    static std::shared_ptr<const Recording> made;
    if (made) return made;
    Recording r;
    r.sample_rate_hz = rate_hz;
    r.spindle_rpm = 6000;
    const CounterNoise noise(3);
    for (std::size_t n = 0; n < static_cast<std::size_t>(seconds * rate_hz); ++n) {
        const double t = static_cast<double>(n) / rate_hz;
        r.samples.push_back(static_cast<float>(0.2 * std::sin(2 * math::kPi * 400 * t) +
                                               0.1 * std::sin(2 * math::kPi * 800 * t + 1) +
                                               0.005 * noise.gaussian(n)));
    }
    return made = std::make_shared<const Recording>(std::move(r));
}

SoundtrackOptions only_recorded(std::shared_ptr<const Recording> recording) {
    SoundtrackOptions options;
    options.recording = std::move(recording);
    options.recording_share = 1;
    return options;
}

TEST(RecordedVoice, follows_the_spindle_and_is_as_loud_as_the_synthesis) {
    const contact::ForceSpectrum spectrum = test::falling_spectrum(4, 2);
    for (const double rpm : {3000.0, 7321.0, 20000.0}) {
        const std::vector samples = {test::cut_at(0, &spectrum, rpm), test::cut_at(3, &spectrum, rpm)};
        const std::vector<float> recorded = test::track_of(samples, 3, only_recorded(machine()));
        const std::vector<float> synthetic = test::track_of(samples, 3);
        const auto steady = std::span(recorded).subspan(24000, 96000);
        EXPECT_NEAR(test::decibel(test::rms(steady) / test::rms(std::span(synthetic).subspan(24000, 96000))),
                    0, rpm > 6000 ? 1.5 : 0.5)
            << rpm;
        const double turns = rpm / 60;
        const double line = test::tone_amplitude(steady, 4 * turns, 48000);
        EXPECT_NEAR(test::decibel(test::tone_amplitude(steady, 8 * turns, 48000) / line), -6.02, 1.5) << rpm;
        for (const double order : {3.7, 5.5, 7.3, 11.0}) {
            EXPECT_LT(test::decibel(test::tone_amplitude(steady, order * turns, 48000) / line), -35) << order;
        }
    }
}

TEST(RecordedVoice, loops_whole_turns_without_a_seam) {
    const RecordedVoice voice(*machine(), {});
    const double turns = voice.loop_frames() / voice.frames_per_turn();
    EXPECT_NEAR(turns, std::round(turns), 0.5 / voice.frames_per_turn());
    // 4 s of a loop of 1 s: nowhere rougher or louder than at its smoothest place.
    const contact::ForceSpectrum spectrum = test::falling_spectrum(4, 2);
    const std::vector samples = {test::cut_at(0, &spectrum, 6000), test::cut_at(4, &spectrum, 6000)};
    const std::vector<float> wave = test::track_of(samples, 4, only_recorded(machine()));
    double least = 1e9, most = 0, level_least = 1e9, level_most = 0;
    for (std::size_t n = 9600; n + 4800 < 4 * 48000; n += 2400) {
        const auto part = std::span(wave).subspan(n, 4800);
        least = std::min(least, test::roughest(part));
        most = std::max(most, test::roughest(part));
        level_least = std::min(level_least, test::rms(part));
        level_most = std::max(level_most, test::rms(part));
    }
    EXPECT_LT(most, 1.5 * least) << most / least;
    EXPECT_LT(test::decibel(level_most / level_least), 0.5);
}

TEST(RecordedVoice, shares_power_with_the_synthesis) {
    // Lines of the recording at orders 4 and 8, of the force at 5: apart, so powers add.
    const contact::ForceSpectrum spectrum = test::falling_spectrum(5, 1);
    const std::vector samples = {test::cut_at(0, &spectrum, 6000), test::cut_at(2, &spectrum, 6000)};
    double level[5];
    for (int n = 0; n < 5; ++n) {
        SoundtrackOptions options = only_recorded(machine());
        options.recording_share = n / 4.0;
        const std::vector<float> wave = test::track_of(samples, 2, options);
        level[n] = test::rms(std::span(wave).subspan(24000, 48000));
    }
    for (const double l : level) EXPECT_NEAR(test::decibel(l / level[0]), 0, 0.2);
}

TEST(RecordedVoice, of_an_idle_spindle_is_heard_while_it_turns) {
    SoundtrackOptions options;
    options.idle = machine();
    options.idle_pa = 0.1;
    const std::vector<float> wave =
        test::track_of(std::vector{test::cut_at(0, nullptr, 6000), test::cut_at(1, nullptr, 6000),
                                   test::cut_at(1.001, nullptr, 0), test::cut_at(2, nullptr, 0)},
                       2, options);
    EXPECT_NEAR(test::rms(std::span(wave).subspan(12000, 24000)), 0.1 / kFullScalePascal, 1e-3);
    for (std::size_t n = 72000; n < wave.size(); ++n) ASSERT_EQ(wave[n], 0);
}

TEST(RecordedVoice, refuses_what_cannot_be_looped) {
    const auto cause = [](auto change) {
        Recording r = *machine();
        change(r);
        const auto ok = check_recording(r);
        return ok ? std::string() : ok.error().text();
    };
    EXPECT_EQ(cause([](auto&) {}), "");
    EXPECT_NE(cause([](auto& r) { r.samples.resize(1000); }).find("four turns"), std::string::npos);
    EXPECT_NE(cause([](auto& r) { r.spindle_rpm = 0; }).find("speed"), std::string::npos);
    EXPECT_NE(cause([](auto& r) { r.sample_rate_hz = 1; }).find("rate"), std::string::npos);
    EXPECT_NE(cause([](auto& r) { r.samples.assign(22050, 0.0f); }).find("silent"), std::string::npos);
    EXPECT_NE(cause([](auto& r) { r.samples[5] = std::numeric_limits<float>::quiet_NaN(); }).find("number"),
              std::string::npos);
}

TEST(Body, has_the_modes_of_a_clamped_bar_and_leaves_low_sound_alone) {
    // 12 mm carbide, 60 mm out: 0.5595 / L^2 sqrt(E I / (rho A)) with a core of 9.6 mm (Blevins 1979, table
    // 8-1).
    const Body body = tool_body(12, 60, 0.03);
    const double d = 0.8 * 0.012, l = 0.060, speed = std::sqrt(580e9 / 14500);
    EXPECT_NEAR(body.modes[0].hz / (0.5596 / (l * l) * d / 4 * speed), 1, 2e-3);
    EXPECT_NEAR(body.modes[1].hz / body.modes[0].hz, 6.267, 2e-3);
    EXPECT_LT(tool_body(12, 60, 0.03).modes[0].hz, tool_body(12, 40, 0.03).modes[0].hz);
    BodyFilter filter;
    filter.set(body, 48000);
    const auto gain = [&](double hz) {
        filter.forget();
        std::vector<float> out;
        for (int q = 0; q < 400; ++q) {
            Quantum x;
            for (int n = 0; n < 64; ++n) {
                x[static_cast<std::size_t>(n)] = std::sin(2 * math::kPi * hz / 48000 * (64 * q + n));
            }
            filter.apply(x);
            for (const double v : x) out.push_back(static_cast<float>(v));
        }
        return test::decibel(test::tone_amplitude(std::span(out).subspan(9600, 12000), hz, 48000));
    };
    EXPECT_NEAR(gain(100), 0, 0.01);
    EXPECT_NEAR(gain(400), 0, 0.1);
    EXPECT_NEAR(gain(body.modes[0].hz), 6.02, 0.1);
}

}  // namespace
}  // namespace tribo::sound
