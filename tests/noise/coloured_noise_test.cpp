// SPDX-License-Identifier: MIT
// Noises of a drawn spectrum, measured from outside: their power in third octaves.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "noise/learn/learning.hpp"
#include "noise/model/fourier.hpp"
#include "noise/play/bass_noise.hpp"
#include "noise/play/colour.hpp"
#include "noise/play/pink_noise.hpp"

namespace tribo::noise {
namespace {

// Mean square in the third octave around `hz`.
class Bands {
  public:
    Bands(const std::vector<double>& x, double rate_hz) : bin_hz_(rate_hz / kFrame) {
        std::vector<std::complex<double>> frame(kFrame);
        for (std::size_t at = 0; at + kFrame <= x.size(); at += kFrame / 2, ++count_) {
            for (std::size_t n = 0; n < kFrame; ++n) {
                const double hann =
                    0.5 - 0.5 * std::cos(math::kTwoPi * (static_cast<double>(n) + 0.5) / kFrame);
                frame[n] = hann * x[at + n];
            }
            fourier(frame);
            for (std::size_t k = 0; k < power_.size(); ++k) power_[k] += std::norm(frame[k]);
        }
    }
    double at(double hz) const {
        double sum = 0;
        const double low = hz * std::pow(2, -1.0 / 6), high = hz * std::pow(2, 1.0 / 6);
        for (std::size_t k = 1; k < power_.size(); ++k) {
            const double f = static_cast<double>(k) * bin_hz_;
            if (f >= low && f < high) sum += power_[k];
        }
        return 2 * sum / (0.375 * kFrame * kFrame * static_cast<double>(count_));
    }
    double db(double hz) const { return 10 * std::log10(at(hz)); }

  private:
    static constexpr std::size_t kFrame = 32768;
    double bin_hz_;
    std::size_t count_ = 0;
    std::vector<double> power_ = std::vector<double>(kFrame / 2 + 1);
};

template <class Noise>
std::vector<double> seconds_of(Noise& noise, double seconds, double rate_hz) {
    std::vector<double> x;
    for (std::uint64_t block = 0; static_cast<double>(x.size()) < seconds * rate_hz; ++block) {
        const auto samples = noise.block(block);
        x.insert(x.end(), samples.begin(), samples.end());
    }
    return x;
}

double mean_square(const std::vector<double>& x) {
    double sum = 0;
    for (const double v : x) sum += v * v;
    return sum / static_cast<double>(x.size());
}

TEST(PinkNoise, has_the_same_power_in_every_third_octave) {
    for (const double rate : {44100.0, 48000.0, 96000.0}) {
        PinkNoise pink(1, rate);
        const std::vector<double> x = seconds_of(pink, 60, rate);
        EXPECT_NEAR(mean_square(x), 1, 0.05);
        const Bands bands(x, rate);
        const double middle = bands.db(1000);
        for (const double hz : {50, 100, 200, 400, 800, 1600, 3150, 6300, 10000})
            EXPECT_NEAR(bands.db(hz), middle, hz < 150 ? 1.2 : 0.6) << hz << " at " << rate;
    }
}

TEST(PinkNoise, says_its_own_spectrum) {
    PinkNoise pink(3, 48000);
    const Bands bands(seconds_of(pink, 120, 48000), 48000);
    double mean = 0;
    for (int n = 0; n < 24000; ++n) mean += pink.power_at(n + 0.5) / 24000;
    EXPECT_NEAR(mean, 1, 2e-3);
    for (const double hz : {200, 1000, 5000}) {
        const double width = hz * (std::pow(2, 1.0 / 6) - std::pow(2, -1.0 / 6));
        EXPECT_NEAR(bands.db(hz), 10 * std::log10(pink.power_at(hz) * width / 24000), 0.3) << hz;
    }
}

TEST(Colour, comes_out_as_drawn) {
    const ColourPoint drawn[] = {{500, -20}, {1000, -4}, {4000, 0}, {8000, -12}, {16000, -30}};
    ModelNoise noise(model_of(drawn, 48000, 60), 5);
    std::vector<double> x;
    for (std::uint64_t block = 0; block < 60 * 750; ++block) {
        for (const float v : noise.block(block)) x.push_back(static_cast<double>(v));
    }
    const Bands bands(x, 48000);
    const double middle = bands.db(4000);
    for (const auto& [hz, db] : {ColourPoint{1414, -3}, {2000, -2}, {8000, -12}, {11314, -21}})
        EXPECT_NEAR(bands.db(hz) - middle, db, 1.5) << hz;
}

// Sound with lines at 100 and 400 Hz over a floor that a model of the whole band cannot tell from them.
std::vector<double> hum(double rate_hz, double seconds, double line) {
    PinkNoise pink(9, rate_hz);
    std::vector<double> x = seconds_of(pink, seconds, rate_hz);
    for (std::size_t n = 0; n < x.size(); ++n) {
        const double t = static_cast<double>(n) / rate_hz;
        x[n] = 0.2 * x[n] + line * (std::sin(math::kTwoPi * 100 * t) + std::sin(math::kTwoPi * 400 * t));
    }
    return x;
}

TEST(Bass, is_heard_third_octave_by_third_octave_where_a_model_of_the_whole_is_not) {
    for (const double rate : {44100.0, 48000.0}) {
        const Recording recording{"hum", 100, 1, rate, hum(rate, 20, 0.1)};
        const auto learned = learn({&recording, 1}, {.order = 60, .textures = false});
        ASSERT_TRUE(learned);
        const VoiceModel& voice = learned->voices.models[0];
        ASSERT_TRUE(voice.bass);
        EXPECT_LE(std::abs(voice.bass->spectrum.reflection[0]), kLargestReflection);
        const Bands original(recording.samples, rate);
        // Also at another rate than it was learned at.
        for (const double play : {44100.0, 48000.0, 96000.0}) {
            DetailedNoise detailed(voice.spectrum, *voice.bass, play, 2);
            const std::vector<double> x = seconds_of(detailed, 30, play);
            EXPECT_NEAR(mean_square(x), 1, 0.1);
            const Bands made(x, play);
            double error = 0, bands = 0, level = 0;
            std::vector<double> off;
            for (double hz = 80; hz < 6000; hz *= std::pow(2, 1.0 / 3)) {
                off.push_back(made.db(hz) - original.db(hz));
                level += off.back();
                ++bands;
            }
            for (const double db : off) error += (db - level / bands) * (db - level / bands) / bands;
            EXPECT_LT(std::sqrt(error), 1.5) << rate << " played at " << play;
            EXPECT_GT(made.db(100) - made.db(200), 4);
        }
        // The model of the whole alone does not have it.
        const ArModel whole = at_rate(voice.spectrum, 48000);
        EXPECT_LT(10 * std::log10(power_at(whole, 100) / power_at(whole, 200)), 4);
    }
}

TEST(Bass, is_left_out_where_the_model_of_the_whole_tells_of_it) {
    // White above 50 Hz: any model has that.
    std::vector<double> x(44100 * 10);
    const CounterNoise white(4);
    for (std::size_t n = 0; n < x.size(); ++n) x[n] = 0.1 * white.gaussian(n);
    const Recording recording{"white", 100, 1, 44100, std::move(x)};
    const auto learned = learn({&recording, 1}, {.order = 20, .textures = false});
    ASSERT_TRUE(learned);
    EXPECT_FALSE(learned->voices.models[0].bass);
    // A click is too short to tell of the bass.
    const std::vector<double> click(1000, 0.5);
    const std::span<const double> pieces[] = {click};
    EXPECT_FALSE(learn_bass(pieces, {44100, {0.5}}, 50));
    EXPECT_FALSE(learn_bass({}, {44100, {0.5}}, 50));
}

}  // namespace
}  // namespace tribo::noise
