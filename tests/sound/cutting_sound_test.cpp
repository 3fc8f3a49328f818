// SPDX-License-Identifier: MIT
// The sound of a cut, as a listener and a spectrum analyser find it.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "sound/cut/partials.hpp"
#include "sound/cuts.hpp"

namespace tribo::sound {
namespace {

using test::cut_at;
using test::falling_spectrum;
using test::kSamplePerNewton;
using test::track_of;

constexpr double kRate = 48000;

// The wave that the spectrum promises at spindle angle `angle`, all partials played in full.
double promised(const contact::ForceSpectrum& spectrum, double angle) {
    double sum = 0;
    for (std::size_t n = 1; n < spectrum.harmonics.size(); ++n) {
        const contact::ForceHarmonic& h = spectrum.harmonics[n];
        const std::complex<double> along = h.x - std::complex<double>(0, 1) * h.y;
        const std::complex<double> c = std::sqrt(std::norm(h.x) + std::norm(h.y)) * along / std::abs(along);
        sum += 2 * (c * std::polar(1.0, spectrum.order(n) * angle)).real();
    }
    return sum * kSamplePerNewton;
}

TEST(CuttingSound, has_each_harmonic_at_its_multiple_of_the_spindle_and_at_its_calibrated_level) {
    for (const int rate : {44100, 48000}) {
        SoundtrackOptions options;
        options.sample_rate_hz = rate;
        const contact::ForceSpectrum spectrum = falling_spectrum(4, 12);
        const contact::ContactSample samples[] = {cut_at(0, &spectrum, 5625), cut_at(1.3, &spectrum, 5625)};
        const std::vector<float> wave = track_of(samples, 1.3, options);
        const std::span<const float> steady =
            std::span(wave).subspan(static_cast<std::size_t>(rate) / 10, static_cast<std::size_t>(rate));
        for (int n = 1; n <= 12; ++n) {
            // in-plane harmonics of 20 / n N, hence sines of twice that
            const double expected = 40.0 / n * kSamplePerNewton;
            const double found = test::tone_amplitude(steady, n * 4 * 5625 / 60.0, rate);
            EXPECT_NEAR(test::decibel(found / expected), 0, 0.01) << n << " at " << rate;
        }
        // Between the lines, at the spindle's own multiples: what the 24th bit leaves.
        for (const double hz : {93.75, 187.5, 281.25, 468.75, 1000.0, 3333.0, 9000.0, 20000.0}) {
            EXPECT_LT(test::decibel(test::tone_amplitude(steady, hz, rate) / kSamplePerNewton), -90) << hz;
        }
    }
}

TEST(CuttingSound, is_in_phase_with_the_spindle_angle) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 20);
    contact::ContactSample start = cut_at(0, &spectrum, 7000), end = cut_at(0.5, &spectrum, 7000);
    start.phase_rad += 1;
    end.phase_rad += 1;
    const std::vector<float> wave = track_of(std::vector{start, end}, 0.5);
    for (std::size_t n = 1000; n < 24000; ++n) {
        const double angle = 1 + 7000 / 60.0 * 2 * std::numbers::pi * static_cast<double>(n) / kRate;
        ASSERT_NEAR(static_cast<double>(wave[n]), promised(spectrum, angle), 1e-7) << n;
    }
}

// 375 to 400 Hz of tooth passing after 10 s: the case in which the closed form of the print steps.
std::vector<contact::ContactSample> speed_change(const contact::ForceSpectrum& spectrum) {
    const auto rate = [](double rpm) { return rpm / 60 * 2 * std::numbers::pi; };
    std::vector<contact::ContactSample> samples = {cut_at(0, &spectrum, 5625), cut_at(10, &spectrum, 5625),
                                                   cut_at(10.2, &spectrum, 6000),
                                                   cut_at(11, &spectrum, 6000)};
    samples[2].phase_rad = samples[1].phase_rad + 0.1 * (rate(5625) + rate(6000));
    samples[3].phase_rad = samples[2].phase_rad + 0.8 * rate(6000);
    return samples;
}

TEST(CuttingSound, glides_through_a_change_of_spindle_speed_without_a_step) {
    const contact::ForceSpectrum spectrum = falling_spectrum(4, 8);
    const std::vector<contact::ContactSample> samples = speed_change(spectrum);
    const std::vector<float> wave = track_of(samples, 11);
    // The angle in closed form, the ramp included.
    const double r0 = samples[0].phase_rate_rad_per_s, r1 = samples[3].phase_rate_rad_per_s;
    double worst = 0;
    for (std::size_t n = 9 * 48000; n < 11 * 48000; ++n) {
        const double t = static_cast<double>(n) / kRate;
        const double ramp = std::clamp(t - 10, 0.0, 0.2);
        const double angle =
            r0 * std::min(t, 10.0) + r0 * ramp + (r1 - r0) / 0.4 * ramp * ramp + r1 * std::max(t - 10.2, 0.0);
        worst = std::max(worst, std::abs(static_cast<double>(wave[n]) - promised(spectrum, angle)));
    }
    // States are met at the border of a quantum, at most 0.7 ms off on a ramp of 39 rad/s in 0.2 s.
    EXPECT_LT(worst, 1e-3 * promised(spectrum, 0) + 4 * 8 * 4e-4 * 40 * kSamplePerNewton);
    double bound = 0;  // of the second difference of such partials at the higher speed
    for (int n = 1; n <= 8; ++n) {
        const double w = 2 * std::numbers::pi * n * 400 / kRate;
        bound += 40.0 / n * kSamplePerNewton * w * w;
    }
    EXPECT_LE(test::roughest(std::span(wave).subspan(48000, 10 * 48000)), bound);
}

TEST(CuttingSound, as_published_does_step_there) {
    const contact::ForceSpectrum spectrum = falling_spectrum(4, 1);
    SoundtrackOptions options;
    options.as_published = true;
    const std::vector<float> wave = track_of(speed_change(spectrum), 11, options);
    const double amplitude = 100 * kSamplePerNewton, w = 2 * std::numbers::pi * 100 / kRate;
    const std::span<const float> around = std::span(wave).subspan(9 * 48000, 2 * 48000);
    EXPECT_GT(test::roughest(around), 10 * amplitude * w * w);
}

TEST(CuttingSound, starts_and_stops_without_a_click) {
    const contact::ForceSpectrum spectrum = falling_spectrum(4, 1), none;
    // Steps: contact from one moment to the next, and back.
    const contact::ContactSample samples[] = {
        cut_at(0, &none, 6000),          cut_at(0.1, &none, 6000),    cut_at(0.1, &spectrum, 6000, 0),
        cut_at(0.3003, &spectrum, 6000), cut_at(0.3003, &none, 6000), cut_at(0.5, &none, 6000)};
    const std::vector<float> wave = track_of(samples, 0.5);
    const double steady = test::roughest(std::span(wave).subspan(9600, 2400));
    EXPECT_GT(steady, 0);
    EXPECT_LT(test::roughest(wave), 1.2 * steady);
    // A cut-out of the same wave does click, so the measure would tell.
    std::vector<float> hard(wave.begin() + 9600, wave.begin() + 9600 + 2413);
    hard.resize(4000);
    EXPECT_GT(test::roughest(hard), 10 * steady);
    // Digital silence before and 20 ms after.
    for (std::size_t n = 0; n < 4700; ++n) ASSERT_EQ(wave[n], 0);
    for (std::size_t n = 15400; n < wave.size(); ++n) ASSERT_EQ(wave[n], 0);
}

TEST(CuttingSound, does_not_click_where_force_chips_and_speed_step_at_once) {
    const contact::ForceSpectrum light = falling_spectrum(4, 1, 5), heavy = falling_spectrum(4, 1, 60);
    const contact::ContactSample samples[] = {cut_at(0, &light, 6000), cut_at(0.2, &light, 6000),
                                              cut_at(0.2, &heavy, 6300), cut_at(0.4, &heavy, 6300)};
    const std::vector<float> wave = track_of(samples, 0.4);
    EXPECT_LT(test::roughest(wave), 1.2 * test::roughest(std::span(wave).subspan(14400, 2400)));
}

TEST(CuttingSound, has_nothing_above_half_the_sample_rate_and_no_alias_of_it) {
    // 16 harmonics of 2041 Hz: 5 of them beyond 24 kHz, which would fold down to 23507 ... 15343 Hz.
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 16);
    const contact::ContactSample samples[] = {cut_at(0, &spectrum, 61230), cut_at(1.2, &spectrum, 61230)};
    const std::vector<float> wave = track_of(samples, 1.2);
    const std::span<const float> steady = std::span(wave).subspan(4800, 48000);
    for (int n = 1; n <= 16; ++n) {
        const double hz = n * 2041.0;
        const double full = 40.0 / n * kSamplePerNewton;
        if (hz < 24000) {
            EXPECT_NEAR(test::tone_amplitude(steady, hz, kRate), full * audible_share(hz, kRate),
                        1e-3 * full);
        } else {
            EXPECT_LT(test::decibel(test::tone_amplitude(steady, kRate - hz, kRate) / full), -90) << n;
        }
    }
}

TEST(CuttingSound, fades_a_partial_before_it_crosses_half_the_sample_rate) {
    contact::ForceSpectrum spectrum = falling_spectrum(16, 1);
    contact::ContactSample samples[] = {cut_at(0, &spectrum, 60000), cut_at(0.5, &spectrum, 120000)};
    samples[1].phase_rad = 0.25 * (samples[0].phase_rate_rad_per_s + samples[1].phase_rate_rad_per_s);
    const std::vector<float> wave = track_of(samples, 0.5);  // 16 to 32 kHz
    EXPECT_GT(test::rms(std::span(wave).subspan(4800, 2400)), 0.5 * 40 * kSamplePerNewton);
    // 23.52 kHz is passed at 0.235 s.
    for (std::size_t n = static_cast<std::size_t>(0.237 * kRate); n < wave.size(); ++n) ASSERT_EQ(wave[n], 0);
}

TEST(CuttingSound, of_a_spindle_at_rest_is_silence) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 4);
    const contact::ContactSample samples[] = {cut_at(0, &spectrum, 0), cut_at(0.5, &spectrum, 0)};
    for (const float v : track_of(samples, 0.5)) ASSERT_EQ(v, 0);
}

TEST(CuttingSound, does_not_listen_to_the_spindle_of_a_tool_in_the_air) {
    const contact::ForceSpectrum spectrum = falling_spectrum(2, 5);
    const auto wave = [&](double rpm_in_the_air) {
        return track_of(
            std::vector{cut_at(0.05, nullptr, rpm_in_the_air), cut_at(0.1, nullptr, rpm_in_the_air),
                        cut_at(0.15, &spectrum, 7000), cut_at(0.2, &spectrum, 7000),
                        cut_at(0.22, nullptr, rpm_in_the_air), cut_at(0.4, &spectrum, 7000)},
            0.4);
    };
    const std::vector<float> told = wave(7000);
    EXPECT_GT(test::rms(told), 0.001);
    EXPECT_EQ(wave(0), told);
    EXPECT_EQ(wave(20000), told);
    // At full level the phase is the spindle's from the first sample in contact on.
    for (std::size_t n = 7200 + 800; n < 9600; ++n) {
        const double angle = 7000 / 60.0 * 2 * std::numbers::pi * static_cast<double>(n) / kRate;
        ASSERT_NEAR(static_cast<double>(told[n]), promised(spectrum, angle), 1e-6) << n;
    }
}

TEST(CuttingSound, level_is_linear_in_force) {
    const contact::ForceSpectrum once = falling_spectrum(3, 9, 10), twice = falling_spectrum(3, 9, 20);
    const std::vector<float> a = track_of(std::vector{cut_at(0, &once, 8000), cut_at(1, &once, 8000)}, 1);
    const std::vector<float> b = track_of(std::vector{cut_at(0, &twice, 8000), cut_at(1, &twice, 8000)}, 1);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n) ASSERT_EQ(2 * a[n], b[n]);
}

TEST(CuttingSound, has_no_chips_machine_or_room_unless_they_are_chosen) {
    const contact::ContactSample samples[] = {cut_at(0, nullptr, 6000, 1000), cut_at(1, nullptr, 6000, 1000)};
    for (const float v : track_of(samples, 1)) ASSERT_EQ(v, 0);
}

TEST(CuttingSound, chips_are_as_loud_as_their_number_and_size_say) {
    // Removed per second, edges; a thousand chips of 1 mm^3 a second make kChipPascal.
    const struct {
        double removal, rpm;
        int edges;
        double factor;
    } cuts[] = {{1000, 6000, 10, 1},
                {1000, 60000, 1, 1},
                {2000, 6000, 20, std::sqrt(2.0)},        // twice as many
                {2000, 6000, 10, std::pow(2, 2.0 / 3)},  // twice as large
                {10, 600, 0, std::sqrt(0.01)}};          // one a turn where edges are not told
    for (const auto& cut : cuts) {
        SoundtrackOptions options;
        options.chips.material = ChipMaterial::steel;
        contact::ContactSample samples[] = {cut_at(0, nullptr, cut.rpm, cut.removal),
                                            cut_at(10, nullptr, cut.rpm, cut.removal)};
        for (contact::ContactSample& s : samples) s.edges = cut.edges;
        const std::vector<float> wave = track_of(samples, 10, options);
        const double expected = kChipPascal * cut.factor / kFullScalePascal;
        EXPECT_NEAR(test::rms(std::span(wave).subspan(4800, 470000)) / expected, 1, 0.02) << cut.factor;
    }
}

TEST(CuttingSound, chip_noise_swings_with_the_teeth_by_half_its_level) {
    // One partial, 50 teeth a second: the noise alone is the difference to the same cut without chips.
    const contact::ForceSpectrum spectrum = falling_spectrum(1, 1, 1);
    SoundtrackOptions options;
    options.chips.material = ChipMaterial::aluminium;
    const auto wave = [&](double removal) {
        return track_of(
            std::vector{cut_at(0, &spectrum, 3000, removal), cut_at(24, &spectrum, 3000, removal)}, 24,
            options);
    };
    const std::vector<float> both = wave(1000), tone = wave(0);
    double high = 0, low = 0;
    int highs = 0, lows = 0;
    const double top = 2 * kSamplePerNewton;
    for (std::size_t n = 4800; n < 1150000; ++n) {
        const double noise = static_cast<double>(both[n]) - static_cast<double>(tone[n]);
        if (tone[n] > 0.98 * top) high += noise * noise, ++highs;
        if (tone[n] < -0.98 * top) low += noise * noise, ++lows;
    }
    EXPECT_NEAR(std::sqrt(high / highs / (low / lows)), 1.5 / 0.5, 0.1);
}

TEST(CuttingSound, changes_the_number_of_teeth_through_silence) {
    const contact::ForceSpectrum two = falling_spectrum(2, 3), five = falling_spectrum(5, 3);
    const contact::ContactSample samples[] = {cut_at(0, &two, 6000), cut_at(0.5, &two, 6000),
                                              cut_at(0.5, &five, 6000), cut_at(2, &five, 6000)};
    const std::vector<float> wave = track_of(samples, 2);
    const std::span<const float> before = std::span(wave).subspan(2400, 19200);
    const std::span<const float> after = std::span(wave).subspan(30000, 48000);
    EXPECT_NEAR(test::tone_amplitude(before, 200, kRate) / (40 * kSamplePerNewton), 1, 1e-3);
    EXPECT_LT(test::tone_amplitude(before, 500, kRate) / (40 * kSamplePerNewton), 1e-4);
    EXPECT_NEAR(test::tone_amplitude(after, 500, kRate) / (40 * kSamplePerNewton), 1, 1e-3);
    EXPECT_LT(test::tone_amplitude(after, 200, kRate) / (40 * kSamplePerNewton), 1e-4);
    EXPECT_LT(test::roughest(wave), 1.3 * test::roughest(after));
}

TEST(CuttingSound, as_published_is_a_sine_at_the_spindle_speed_with_the_force_as_amplitude) {
    SoundtrackOptions options;
    options.as_published = true;
    const contact::ForceSpectrum spectrum = falling_spectrum(4, 8);
    // 100 N; chips that the print cannot sound.
    const contact::ContactSample samples[] = {cut_at(0, &spectrum, 6000, 5000),
                                              cut_at(1.2, &spectrum, 6000, 5000)};
    const std::vector<float> wave = track_of(samples, 1.2, options);
    for (std::size_t n = 0; n < 57000; ++n) {
        const double expected =
            100 * kSamplePerNewton * std::sin(2 * std::numbers::pi * 100 * static_cast<double>(n) / kRate);
        ASSERT_NEAR(static_cast<double>(wave[n]), expected, 1e-7);
    }
}

}  // namespace
}  // namespace tribo::sound
