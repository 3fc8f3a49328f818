// SPDX-License-Identifier: MIT
// Real recordings, freehand: what `tribo learn` makes of one half and `tribo rub` plays at a steady speed,
// beside both halves. Skipped where ../shared/data is missing.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "app/run/program.hpp"
#include "files/sound/sound_file.hpp"
#include "files/sound/wav.hpp"
#include "noise/learn/learning.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

constexpr double kSlowestHz = 3.5;  // what is slower is the hand's

// The sound over its own level, the power smoothed by a Gaussian that passes kSlowestHz at -3 dB.
std::vector<double> without_hand(const std::vector<double>& x, double rate_hz) {
    const auto frame = static_cast<std::size_t>(0.005 * rate_hz);
    std::vector<double> power;
    for (std::size_t at = 0; at + frame <= x.size(); at += frame) {
        double sum = 1e-14;
        for (std::size_t n = at; n < at + frame; ++n) sum += x[n] * x[n] / static_cast<double>(frame);
        power.push_back(sum);
    }
    const double sigma = 0.1325 / kSlowestHz / 0.005;
    std::vector<double> level;
    for (std::size_t n = 0; n < power.size(); ++n) {
        double sum = 0, weights = 0;
        for (std::size_t m = 0; m < power.size(); ++m) {
            const double d = (static_cast<double>(m) - static_cast<double>(n)) / sigma;
            if (std::abs(d) > 4) continue;
            sum += std::exp(-0.5 * d * d) * power[m];
            weights += std::exp(-0.5 * d * d);
        }
        level.push_back(std::sqrt(sum / weights));
    }
    std::vector<double> y(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double place = std::clamp((static_cast<double>(n) + 0.5) / static_cast<double>(frame) - 0.5,
                                        0.0, static_cast<double>(level.size() - 1));
        const auto index = std::min(static_cast<std::size_t>(place), level.size() - 2);
        const double share = place - static_cast<double>(index);
        y[n] = x[n] / ((1 - share) * level[index] + share * level[index + 1]);
    }
    return y;
}

// Power of the envelope's fluctuation in the octaves from 4 to 32 Hz, dB.
std::vector<double> modulation_db(const std::vector<double>& x, double rate_hz) {
    const std::vector<double> hz{4.76, 6.73, 9.51, 13.5, 19.0, 26.9};
    const std::vector<double> density = noise::modulation_density(without_hand(x, rate_hz), rate_hz, hz);
    std::vector<double> octaves;
    for (std::size_t n = 0; n < hz.size(); n += 2) {
        octaves.push_back(10 * std::log10(hz[n] * density[n] + hz[n + 1] * density[n + 1]));
    }
    return octaves;
}

class RubRecordings : public testing::TestWithParam<const char*> {
  protected:
    void put(const std::string& name, const std::vector<double>& x, double rate_hz) const {
        auto wav = files::WavWriter::create(scratch / name,
                                            {.sample_rate_hz = static_cast<int>(rate_hz), .channels = 1});
        ASSERT_TRUE(wav);
        wav->write(std::vector<float>(x.begin(), x.end()));
        ASSERT_TRUE(wav->finish());
    }
    std::vector<double> sound(const std::string& name) const {
        const auto file = files::read_sound(scratch / name);
        return file ? file->samples : std::vector<double>{};
    }
    std::vector<double> rubbed(std::vector<std::string> more) const {
        std::vector<std::string> all{"rub", "m.json", "--stroke", "s.csv", "--out", "y.wav"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_EQ(run_tribo(all, scratch.path()).code, 0);
        return sound("y.wav");
    }
    Scratch scratch;
};

TEST_P(RubRecordings, have_the_modulation_kurtosis_and_spectrum_of_the_half_they_were_learned_from) {
    const std::string path = std::string(TRIBO_SOURCE_DIR "/../shared/data/audio/") + GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto file = files::read_sound(path);
    ASSERT_TRUE(file);
    const double rate = file->sample_rate_hz;
    const auto middle = file->samples.begin() + static_cast<std::ptrdiff_t>(file->samples.size() / 2);
    const std::vector<double> halves[2]{{file->samples.begin(), middle}, {middle, file->samples.end()}};
    scratch.put("s.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n8,800,0,1\n");
    for (std::size_t half = 0; half < 2; ++half) {
        put("half.wav", halves[half], rate);
        ASSERT_EQ(run_tribo({"learn", "--recording", "100:half.wav", "--out", "m.json"}, scratch.path()).code,
                  0);
        // As they are learned from: without what lies under the high-pass.
        const auto prepared = [&](std::size_t which) {
            return noise::prepare({"half", 100, 1, rate, halves[which]}, 50)->sound;
        };
        const std::vector<double> own = prepared(half), other = prepared(1 - half);
        std::vector<double> kurtoses, spectral;
        std::vector<double> modulation(3);
        const std::vector<double> hz = noise::spectrum_hz(rate), heard = noise::spectrum_db(other);
        for (const char* seed : {"1", "2", "3"}) {
            const std::vector<double> y = rubbed({"--seed", seed});
            kurtoses.push_back(noise::kurtosis(y));
            spectral.push_back(noise::shape_distance_db(noise::spectrum_db(y), heard, hz));
            const std::vector<double> octaves = modulation_db(y, rate);
            for (std::size_t n = 0; n < 3; ++n) modulation[n] += octaves[n] / 3;
        }
        std::ranges::sort(kurtoses);
        std::ranges::sort(spectral);
        const std::string name = std::string(GetParam()) + " " + std::to_string(half);
        EXPECT_LT(std::abs(std::log(kurtoses[1] / noise::kurtosis(own))), std::log(1.5))
            << name << ": " << kurtoses[1] << ", " << noise::kurtosis(own);
        const std::vector<double> recorded = modulation_db(own, rate);
        double square = 0, is = 0, should_be = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            square += std::pow(modulation[n] - recorded[n], 2) / 3;
            is += std::pow(10, 0.1 * modulation[n]);
            should_be += std::pow(10, 0.1 * recorded[n]);
        }
        EXPECT_NEAR(10 * std::log10(is / should_be), 0, 2) << name;
        // A half of 2.4 s tells its slowest octave to 2 dB or so.
        EXPECT_LT(std::sqrt(square), 3) << name;

        const noise::Recording r{"half", 100, 1, rate, halves[half]};
        const auto plain = noise::learn({&r, 1}, {.order = 50, .highpass_hz = 0, .textures = false});
        ASSERT_TRUE(plain);
        const double plain_db =
            noise::shape_distance_db(noise::spectrum_db(plain->voices.models[0].spectrum, hz), heard, hz);
        EXPECT_LT(spectral[1], plain_db + 0.2) << name;

        const std::vector<double> gaussian = rubbed({"--gaussian"});
        EXPECT_NEAR(noise::kurtosis(gaussian), 3, 0.15) << name;
        EXPECT_LT(noise::shape_distance_db(noise::spectrum_db(gaussian), noise::spectrum_db(rubbed({})), hz),
                  0.6)
            << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Freehand, RubRecordings,
                         testing::Values("lmt_carpet.wav", "lmt_rough_paper.wav", "vinyl_hiss_cc0.flac"));

}  // namespace
}  // namespace tribo::test
