// SPDX-License-Identifier: MIT
#include "noise/learn/learning.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "noise/learn/sound_statistics.hpp"
#include "noise/learn/voice_quality.hpp"
#include "noise/model/levinson.hpp"
#include "noise/voices.hpp"

namespace tribo::noise {
namespace {

using test::with_poles;

// RMS difference in dB between two power densities at 50 Hz steps from 200 Hz to `to_hz`. Both are scaled to
// the same mean logarithm, so only the shape counts.
double log_spectral_distance_db(const ArModel& a, const ArModel& b, double to_hz = 20000) {
    std::vector<double> difference;
    for (double hz = 200; hz <= to_hz; hz += 50) {
        difference.push_back(10 * std::log10(power_at(a, hz) / power_at(b, hz)));
    }
    const auto count = static_cast<double>(difference.size());
    double mean = 0, square = 0;
    for (const double d : difference) mean += d / count;
    for (const double d : difference) square += (d - mean) * (d - mean) / count;
    return std::sqrt(square);
}

// Poles of two resonances on a falling slope: the process of known spectrum that recordings are drawn from.
ArModel known_model(double rate_hz) {
    return with_poles(rate_hz, {{900, 0.97}, {3500, 0.95}, {200, 0.7}});
}

// Driven by the standard library's Gaussian numbers, sample by sample.
std::vector<double> drawn(const ArModel& model, std::size_t count, double rms, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss(0, rms * std::sqrt(innovation_power(model.reflection)));
    const std::vector<double> a = predictor_of(model.reflection);
    std::vector<double> x(count + 2000);
    for (std::size_t n = 0; n < x.size(); ++n) {
        x[n] = gauss(random);
        for (std::size_t k = 1; k <= std::min(n, a.size()); ++k) x[n] -= a[k - 1] * x[n - k];
    }
    x.erase(x.begin(), x.begin() + 2000);
    return x;
}

Recording recorded(double speed, std::vector<double> samples, double rate_hz = 44100, double force = 1) {
    return {"test.wav", speed, force, rate_hz, std::move(samples)};
}

double level_db(double rms) {
    return 20 * std::log10(rms);
}

// Rare clicks that ring: a few samples predict the next ones, but it takes many poles to draw their spectrum.
TEST(Learning, takes_as_many_poles_as_the_spectrum_of_held_out_clicks_asks_for) {
    constexpr double kHz = 44100;
    std::mt19937_64 random(4);
    std::vector<double> x(6 * 44100);
    std::normal_distribution<double> gauss;
    for (double& v : x) v = 1e-4 * gauss(random);
    constexpr double kTones[] = {900, 2200, 4100, 7300, 9800};
    for (int n = 0; n < 400; ++n) {
        const std::size_t at = random() % (x.size() - 2000);
        const double size = 0.05 * gauss(random), hz = kTones[random() % 5];
        for (std::size_t k = 0; k < 1500; ++k) {
            const auto t = static_cast<double>(k);
            x[at + k] += size * std::exp(-t / 120) * std::sin(2 * std::numbers::pi * hz * t / kHz);
        }
    }
    const Recording r = recorded(60, x, kHz);
    const auto learned = learn({&r, 1});
    ASSERT_TRUE(learned);
    const auto prepared = prepare(r, 50);
    ASSERT_TRUE(prepared);
    const VoiceQuality own = quality_of(learned->voices.models[0], *prepared, 50);
    EXPECT_LT(own.held_out_db, own.held_out_plain_db + 0.2);
    EXPECT_LT(own.held_out_db, own.halves_db + 0.2);
    const auto few = learn({&r, 1}, {.order = 9});
    EXPECT_GT(quality_of(few->voices.models[0], *prepared, 50).held_out_db, own.held_out_db + 1);
}

TEST(Learning, finds_the_spectrum_of_a_known_process_within_1_dB) {
    for (const double rate : {44100.0, 48000.0}) {
        for (const Method method : {Method::yule_walker, Method::burg}) {
            const ArModel truth = known_model(rate);
            const Recording r = recorded(100, drawn(truth, 200000, 0.05, 1), rate);
            const auto learned = learn({&r, 1}, {.method = method});
            ASSERT_TRUE(learned) << learned.error().text();
            const VoiceModel& m = learned->voices.models.at(0);
            // Burg sees the high-pass's hole, Yule-Walker does not.
            EXPECT_LT(log_spectral_distance_db(m.spectrum, truth), method == Method::burg ? 2 : 1);
            EXPECT_NEAR(m.level_db, level_db(0.05), 0.3);
            EXPECT_GE(learned->order, 6);
            EXPECT_LE(learned->order, 20);
            EXPECT_FALSE(m.texture) << "Gaussian noise has no texture";
        }
    }
}

// Where a quarter of a second, or a stroke between two rests, holds less than a frame of the spectrum.
TEST(Learning, finds_the_order_of_slow_recordings_and_of_short_strokes) {
    struct Case {
        double rate_hz, stroke_s;  // 0: without rests
    };
    for (const auto& [rate, stroke_s] : {Case{4000, 0},
                                         {5000, 0},
                                         {4000, 0.2},
                                         {8000, 0.2},
                                         {8000, 0.1},
                                         {11025, 0.1},
                                         {16000, 0.05},
                                         {44100, 0.05},
                                         {44100, 0.03}}) {
        const ArModel truth = with_poles(rate, {{0.2 * rate, 0.95}, {0.3 * rate, 0.9}});
        std::vector<double> x = drawn(truth, static_cast<std::size_t>(12 * rate), 0.05, 5);
        if (stroke_s > 0) {
            const auto on = static_cast<std::size_t>(stroke_s * rate),
                       off = static_cast<std::size_t>(0.1 * rate);
            for (std::size_t n = 0; n < x.size(); ++n)
                if (n % (on + off) >= on) x[n] = 0;
        }
        const Recording r = recorded(100, x, rate);
        const auto learned = learn({&r, 1});
        ASSERT_TRUE(learned) << learned.error().text();
        EXPECT_GE(learned->order, 4) << rate << ' ' << stroke_s;
        EXPECT_LE(learned->order, 20) << rate << ' ' << stroke_s;
        EXPECT_LT(log_spectral_distance_db(learned->voices.models[0].spectrum, truth, 0.45 * rate), 1)
            << rate << ' ' << stroke_s;
    }
}

// More poles than half of the samples of each stroke.
TEST(Learning, takes_any_order_from_any_strokes) {
    const ArModel truth = with_poles(4000, {{800, 0.95}});
    std::vector<double> x = drawn(truth, 40000, 0.05, 5);
    for (std::size_t n = 0; n < x.size(); ++n)
        if (n % 400 >= 200) x[n] = 0;
    const Recording r = recorded(100, x, 4000);
    const auto learned = learn({&r, 1}, {.order = 120});
    ASSERT_TRUE(learned);
    EXPECT_NEAR(learned->voices.models[0].level_db, level_db(0.05), 0.5);
    EXPECT_LT(log_spectral_distance_db(learned->voices.models[0].spectrum, truth, 1800), 3);
}

TEST(Learning, brings_fast_recordings_down_and_keeps_their_spectrum) {
    const ArModel truth = known_model(96000);
    const Recording r = recorded(100, drawn(truth, 400000, 0.05, 1), 96000);
    const auto learned = learn({&r, 1});
    ASSERT_TRUE(learned);
    const ArModel& m = learned->voices.models[0].spectrum;
    EXPECT_EQ(m.sample_rate_hz, 48000);
    EXPECT_LT(log_spectral_distance_db(m, truth, 18000), 1);
}

TEST(Learning, fits_the_law_of_unsorted_speeds_and_joins_repeated_ones) {
    const ArModel truth = known_model(44100);
    std::vector<Recording> recordings;
    for (const double speed : {300.0, 30.0, 100.0, 100.0})
        recordings.push_back(recorded(speed, drawn(truth, 100000, 0.03 * std::pow(speed / 100, 0.8),
                                                   static_cast<unsigned>(recordings.size()))));
    const auto learned = learn(recordings);
    ASSERT_TRUE(learned);
    ASSERT_EQ(learned->voices.models.size(), 3u);
    EXPECT_EQ(learned->voices.models[0].speed_mm_per_s, 30);
    EXPECT_EQ(learned->voices.models[2].speed_mm_per_s, 300);
    EXPECT_NEAR(learned->voices.law.db_per_decade_speed, 16, 0.5);
    EXPECT_NEAR(learned->voices.law.level_db, level_db(0.03), 0.3);
    EXPECT_EQ(learned->recordings[0].model, 2);
    EXPECT_EQ(learned->recordings[2].model, 1);
    EXPECT_EQ(learned->recordings[3].model, 1);
    for (const VoiceModel& m : learned->voices.models)
        EXPECT_EQ(m.spectrum.reflection.size(), static_cast<std::size_t>(learned->order));
}

TEST(Learning, tells_forces_apart) {
    const ArModel truth = known_model(44100);
    std::vector<Recording> recordings;
    for (const double force : {2.0, 0.5})
        for (const double speed : {200.0, 50.0})
            recordings.push_back(
                recorded(speed, drawn(truth, 60000, 0.02 * std::sqrt(force * speed / 100), 3), 44100, force));
    const auto learned = learn(recordings);
    ASSERT_TRUE(learned);
    ASSERT_EQ(learned->voices.models.size(), 4u);
    EXPECT_EQ(learned->voices.models[0].force_n, 0.5);
    EXPECT_EQ(learned->voices.models[0].speed_mm_per_s, 50);
    EXPECT_NEAR(learned->voices.law.db_per_decade_force, 10, 0.3);
    EXPECT_NEAR(learned->voices.law.db_per_decade_speed, 10, 0.3);
}

TEST(Learning, removes_the_baseline_and_leaves_silence_out) {
    const ArModel truth = known_model(44100);
    std::vector<double> x = drawn(truth, 100000, 0.05, 1);
    x.insert(x.begin(), 44100, 0.0);
    x.insert(x.end(), 55900, 0.0);
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] += 0.3 + 0.02 * std::sin(2 * std::numbers::pi * 3 * static_cast<double>(n) / 44100);
    const Recording r = recorded(100, x);
    const auto learned = learn({&r, 1});
    ASSERT_TRUE(learned);
    EXPECT_NEAR(learned->recordings[0].silent_share, 0.5, 0.01);
    EXPECT_NEAR(learned->voices.models[0].level_db, level_db(0.05), 0.3);
    EXPECT_LT(log_spectral_distance_db(learned->voices.models[0].spectrum, truth), 1);
    ASSERT_EQ(learned->warnings.size(), 1u);
    EXPECT_NE(learned->warnings[0].text.find("silence"), std::string::npos);
}

TEST(Learning, counts_clipped_samples) {
    std::vector<double> x = drawn(known_model(44100), 100000, 0.4, 1);
    std::size_t clipped = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
        if (std::abs(x[n]) < 0.8) continue;
        x[n] = std::copysign(0.8, x[n]);
        ++clipped;
    }
    const Recording r = recorded(100, x);
    const auto learned = learn({&r, 1});
    ASSERT_TRUE(learned);
    // Tops of one or two samples are not told from peaks.
    EXPECT_GT(learned->recordings[0].clipped_share, 0.6 * static_cast<double>(clipped) / 1e5);
    EXPECT_LE(learned->recordings[0].clipped_share, 1.0 * static_cast<double>(clipped) / 1e5);
    EXPECT_EQ(learned->warnings.size(), 1u);
}

TEST(Learning, refuses_what_holds_no_sound) {
    const std::vector<double> good = drawn(known_model(44100), 20000, 0.1, 1);
    std::vector<double> odd = good;
    odd[77] = std::nan("");
    std::vector<double> huge = good;
    huge[77] = -1e30;
    const struct {
        Recording recording;
        const char* cause;
    } cases[] = {{recorded(100, {}), "holds no sound"},
                 {recorded(100, std::vector<double>(44100)), "is silent"},
                 {recorded(100, std::vector<double>(44100, 0.5)), "is silent"},
                 {recorded(100, {good.begin(), good.begin() + 4000}), "holds only"},
                 {recorded(100, odd), "no numbers"},
                 {recorded(100, huge), "times full scale"},
                 {recorded(0, good), "speed of the finger"},
                 {recorded(-5, good), "speed of the finger"},
                 {recorded(100, good, 44100, 0), "force of the finger"},
                 {recorded(std::nan(""), good), "speed of the finger"}};
    for (const auto& c : cases) {
        const auto learned = learn({&c.recording, 1});
        ASSERT_FALSE(learned) << c.cause;
        EXPECT_NE(learned.error().cause.find(c.cause), std::string::npos) << learned.error().text();
        EXPECT_FALSE(learned.error().remedy.empty());
    }
    EXPECT_FALSE(learn({}));
}

TEST(Learning, burg_finds_reflection_coefficients_of_short_sound) {
    const ArModel truth{8000, {-0.8, 0.5, 0.2}};
    const std::vector<double> x = drawn(truth, 4000, 1, 5);
    const std::span<const double> piece[] = {x};
    const std::vector<double> k = burg(piece, 3);
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(k[n], truth.reflection[n], 0.05);
}

// A Gaussian window of the same length on white noise: the measures against their closed forms.
TEST(SoundStatistics, are_those_of_known_sounds) {
    const std::vector<double> x = drawn({8000, {}}, 800000, 0.5, 2);
    EXPECT_NEAR(kurtosis(x), 3, 0.03);
    // The level of 80 squared Gaussians: 4.343 dB times the root of the trigamma function at 40.
    EXPECT_NEAR(level_deviation_db(x, 8000), 4.343 * std::sqrt(1.0 / 40 + 1.0 / (2 * 40 * 40)), 0.02);
    double mean = 0;
    for (const double p : power_spectrum(x)) mean += p / 512;
    EXPECT_NEAR(mean, 0.25, 0.005);
    // The same of pieces shorter than a frame.
    std::vector<std::span<const double>> pieces;
    for (std::size_t n = 0; n + 700 <= x.size(); n += 700) pieces.push_back(std::span(x).subspan(n, 700));
    double mean_db = 0, pieces_db = 0;
    for (const double p : spectrum_db(x)) mean_db += p / 512;
    for (const double p : spectrum_db(pieces)) pieces_db += p / 512;
    EXPECT_NEAR(pieces_db - level_db(std::sqrt(700.0 * static_cast<double>(pieces.size()))), mean_db, 0.05);
    std::vector<double> sine(100000);
    for (std::size_t n = 0; n < sine.size(); ++n) sine[n] = std::sin(0.1 * static_cast<double>(n));
    EXPECT_NEAR(kurtosis(sine), 1.5, 1e-3);
}

TEST(SoundStatistics, modulation_is_that_of_the_envelope_over_its_mean) {
    // The RMS of 96 Gaussians has a relative variance of 1 / (2 * 96), whatever its frequency.
    std::vector<double> x = drawn({48000, {}}, 48000 * 60, 0.5, 2);
    const std::vector<double> hz{4.76, 9.51, 19.0, 38.1, 100};
    const std::vector<double> noise = modulation_density(x, 48000, hz);
    for (const double density : noise) EXPECT_NEAR(10 * std::log10(density * 2 * 96), 0, 0.6);
    // A swing of m at 19 Hz is m^2 / 2, all of it in the seven of 256 steps of that half octave.
    for (std::size_t n = 0; n < x.size(); ++n) {
        x[n] = (n % 2 == 0 ? 1 : -1) *
               (1 + 0.2 * std::sin(2 * std::numbers::pi * 19 * static_cast<double>(n) / 48000));
    }
    const std::vector<double> swing = modulation_density(x, 48000, hz);
    EXPECT_NEAR(swing[2], 0.02 * 256 / 7, 0.02 * 256 / 7 * 0.1);
    for (const std::size_t other : std::initializer_list<std::size_t>{0, 1, 3, 4})
        EXPECT_LT(swing[other], 1e-3 * swing[2]);
}

}  // namespace
}  // namespace tribo::noise
