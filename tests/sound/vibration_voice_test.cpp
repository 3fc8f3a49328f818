// SPDX-License-Identifier: MIT
// The sound of a vibration: its tones, its phase beside the partials, its ends.
#include "sound/cut/vibration_voice.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "sound/cut/in_plane.hpp"
#include "sound/cuts.hpp"

namespace tribo::sound {
namespace {

using Values = std::vector<std::array<float, 2>>;
using test::cut_at;
using test::kSamplePerNewton;
using test::tone_amplitude;

constexpr double kTwoPi = 2 * std::numbers::pi, kTraceHz = 48000;

// A force along `x`, `y` that swings at a frequency from 0 s on.
Values swing(double hz, std::complex<double> x, std::complex<double> y, double seconds) {
    Values values;
    for (int n = 0; n < seconds * kTraceHz; ++n) {
        const std::complex<double> turn = std::polar(1.0, kTwoPi * hz / kTraceHz * n);
        values.push_back({static_cast<float>((x * turn).real()), static_cast<float>((y * turn).real())});
    }
    return values;
}

// The left channel of a track that is told of the cut every 10 ms, each time of the vibration until the next.
std::vector<float> heard(const Values& values, double seconds, int rate_hz = 48000,
                         const contact::ForceSpectrum* spectrum = nullptr, double first_s = 0,
                         double rpm = 6000) {
    SoundtrackOptions options;
    options.sample_rate_hz = rate_hz;
    Soundtrack track(options);
    std::vector<float> wave;
    const auto keep = [&](std::span<const float> block) {
        for (std::size_t i = 0; i < block.size(); i += 2) wave.push_back(block[i]);
    };
    const auto first = static_cast<std::int64_t>(first_s * kTraceHz);
    std::int64_t told = 0;
    for (int n = 0; n <= 100 * seconds; ++n) {
        contact::ContactSample s = cut_at(0.01 * n, spectrum, rpm);
        s.position_mm = {};
        const std::int64_t until =
            std::clamp<std::int64_t>(static_cast<std::int64_t>((0.01 * n + 0.01) * kTraceHz) - first, told,
                                     static_cast<std::int64_t>(values.size()));
        const contact::ForceTrace trace{kTraceHz, first + told,
                                        std::span(values).subspan(static_cast<std::size_t>(told),
                                                                  static_cast<std::size_t>(until - told))};
        s.vibration = &trace;
        told = until;
        track.play_to(s, keep);
    }
    track.play_out(seconds, keep);
    return wave;
}

std::span<const float> part(const std::vector<float>& wave, double from_s, double to_s, int rate_hz = 48000) {
    const auto first = static_cast<std::size_t>(from_s * rate_hz),
               last = static_cast<std::size_t>(to_s * rate_hz);
    return std::span(wave).subspan(first, last - first);
}

TEST(InPlane, turns_y_by_a_quarter_and_delays_both_by_its_response) {
    for (const double hz : {60.0, 266.7, 922.0, 5000.0, 20000.0}) {
        InPlane of_x, of_y;
        std::complex<double> x_sum = 0, y_sum = 0;
        constexpr int kSettle = 20'000, kCount = 48'000;
        for (int n = 0; n < kSettle + kCount; ++n) {
            const std::complex<double> turn = std::polar(1.0, kTwoPi * hz / kTraceHz * n);
            const double x = of_x.next(turn.real(), 0), y = of_y.next(0, turn.real());
            if (n < kSettle) continue;
            x_sum += 2 * x * std::conj(turn) / double{kCount};
            y_sum += 2 * y * std::conj(turn) / double{kCount};
        }
        const std::complex<double> response = InPlane::response(hz, kTraceHz);
        EXPECT_NEAR(std::abs(response), 1, 1e-12);
        EXPECT_NEAR(std::abs(x_sum - response), 0, 2e-3) << hz;
        EXPECT_NEAR(std::abs(y_sum - response * std::complex<double>(0, -1)), 0, 0.015) << hz;
    }
}

TEST(VibrationVoice, is_as_loud_as_the_force_along_any_line) {
    for (const double angle : {0.0, 0.7, 1.5, 2.9}) {
        const Values values = swing(922, 40 * std::cos(angle), 40 * std::sin(angle), 0.5);
        for (const int rate_hz : {48000, 44100, 96000, 32000}) {
            const std::vector<float> wave = heard(values, 0.5, rate_hz);
            const double loud = tone_amplitude(part(wave, 0.1, 0.45, rate_hz), 922, rate_hz);
            EXPECT_NEAR(loud / (40 * kSamplePerNewton), 1, 0.01) << angle << " " << rate_hz;
        }
    }
}

// What a vibration takes from the force of the spectrum is not heard: both have the same phase.
TEST(VibrationVoice, cancels_the_partials_of_the_opposite_force) {
    constexpr double kRpm = 8000;
    for (const int n : {1, 3, 7}) {
        contact::ForceSpectrum spectrum;
        spectrum.order_step = 2;
        spectrum.harmonics.resize(static_cast<std::size_t>(n) + 1);
        const std::complex<double> c = std::polar(15.0, 0.4 * n);
        spectrum.harmonics.back() = {0.6 * c, -0.8 * c, 0, 0};
        const double hz = n * 2 * kRpm / 60;
        const Values opposite = swing(hz, -2 * 0.6 * c, 2 * 0.8 * c, 0.5);
        const std::vector<float> alone = heard(Values(24'000), 0.5, 48000, &spectrum, 0, kRpm);
        const std::vector<float> both = heard(opposite, 0.5, 48000, &spectrum, 0, kRpm);
        const double loud = tone_amplitude(part(alone, 0.1, 0.45), hz, 48000);
        EXPECT_NEAR(loud / (30 * kSamplePerNewton), 1, 0.01);
        EXPECT_LT(tone_amplitude(part(both, 0.1, 0.45), hz, 48000), 0.02 * loud) << n;
    }
}

TEST(VibrationVoice, begins_and_ends_without_a_click) {
    // A tone that is at its highest where it begins and where it ends.
    const Values values = swing(500, 0, 50, 0.2);
    const std::vector<float> wave = heard(values, 0.4, 48000, nullptr, 0.1);
    const double within = test::roughest(part(wave, 0.15, 0.25));
    EXPECT_LT(test::roughest(wave), 3 * within);
    // The cut-out of the same wave does click.
    std::vector<float> cut(wave.begin() + 7000, wave.begin() + 9000);
    cut.insert(cut.begin(), 100, 0.0f);
    EXPECT_GT(test::roughest(cut), 10 * within);
    for (const float v : part(wave, 0, 0.1)) ASSERT_EQ(v, 0);
    for (const float v : part(wave, 0.305, 0.4)) ASSERT_EQ(v, 0);
}

TEST(VibrationVoice, fades_where_its_contact_ends_at_once_and_forgets_the_rest) {
    VibrationVoice voice;
    const Values values = swing(700, 30, 10, 0.05);
    const contact::ForceTrace trace{kTraceHz, 0, values};
    contact::ContactSample s;
    s.vibration = &trace;
    voice.excite(s, 0);
    std::vector<float> wave;
    for (int quantum = 0; quantum < 60; ++quantum) {
        if (quantum == 12) voice.release();
        Quantum pressure{};
        voice.add(pressure);
        for (const double v : pressure) wave.push_back(static_cast<float>(v));
    }
    EXPECT_LT(test::roughest(wave), 3 * test::roughest(std::span(wave).subspan(200, 500)));
    for (std::size_t n = 16 * kQuantumFrames; n < wave.size(); ++n) ASSERT_EQ(wave[n], 0);
}

TEST(VibrationVoice, stays_finite_for_any_traces) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> size(0, 9000), gap(-5000, 5000);
    std::normal_distribution<float> force(0, 100);
    VibrationVoice voice({44100, 1, {}});
    std::int64_t first = 0;
    for (int n = 0; n < 200; ++n) {
        Values values(static_cast<std::size_t>(size(random)));
        for (auto& v : values) v = {force(random), force(random)};
        const contact::ForceTrace trace{n % 3 == 0 ? 44100.0 : 48000.0, first, values};
        contact::ContactSample s;
        s.vibration = &trace;
        voice.excite(s, 1);
        for (int k = 0; k < size(random) / 100; ++k) {
            Quantum pressure{};
            voice.add(pressure);
            for (const double v : pressure) ASSERT_LT(std::abs(v), 100);
        }
        if (n % 7 == 0) voice.release();
        first += gap(random);
    }
}

}  // namespace
}  // namespace tribo::sound
