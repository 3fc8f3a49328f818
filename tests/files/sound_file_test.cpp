// SPDX-License-Identifier: MIT
#include "files/sound/sound_file.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>
#include <random>

#include "files/scratch.hpp"
#include "files/sound/wav.hpp"
#include "noise/learn/learning.hpp"
#include "noise/learn/sound_statistics.hpp"
#include "noise/play/model_noise.hpp"
#include "places.hpp"

namespace tribo::files {
namespace {

std::string wav_of(const std::vector<float>& samples, const WavFormat& format, const test::Scratch& folder) {
    auto writer = WavWriter::create(folder / "x.wav", format);
    EXPECT_TRUE(writer);
    writer->write(samples);
    EXPECT_TRUE(writer->finish());
    return folder.get("x.wav");
}

std::string corpus(const char* name) {
    std::ifstream in(std::string(TRIBO_SOURCE_DIR) + "/fuzz/corpus/sound/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SoundFile, gives_the_samples_of_wav_files_of_every_depth) {
    const test::Scratch folder;
    std::vector<float> samples;
    for (int n = 0; n < 1000; ++n) samples.push_back(0.5F * std::sin(0.1F * static_cast<float>(n)));
    for (const int bits : {16, 24, 32}) {
        const auto read = parse_sound(wav_of(samples, {44100, 1, bits, 1}, folder), "x.wav");
        ASSERT_TRUE(read) << read.error().text();
        EXPECT_EQ(read->sample_rate_hz, 44100);
        EXPECT_EQ(read->bits, bits == 32 ? 0 : bits);
        ASSERT_EQ(read->samples.size(), samples.size());
        for (std::size_t n = 0; n < samples.size(); ++n)
            EXPECT_NEAR(read->samples[n], samples[n], bits == 16 ? 5e-5 : 2e-7);
        EXPECT_TRUE(read->warnings.empty());
    }
}

TEST(SoundFile, takes_the_loudest_channel_and_says_so) {
    const test::Scratch folder;
    std::vector<float> samples;
    for (int n = 0; n < 500; ++n) samples.insert(samples.end(), {0.01F, -0.5F});
    const auto read = parse_sound(wav_of(samples, {48000, 2, 24, 1}, folder), "x.wav");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->channels, 2);
    EXPECT_NEAR(read->samples[7], -0.5, 1e-6);
    EXPECT_EQ(read->warnings.size(), 1u);
}

TEST(SoundFile, reads_flac_and_what_is_left_of_a_file_cut_short) {
    const auto flac = parse_sound(corpus("e.flac"), "e.flac");
    ASSERT_TRUE(flac) << flac.error().text();
    EXPECT_EQ(flac->sample_rate_hz, 44100);
    EXPECT_EQ(flac->bits, 16);
    EXPECT_GT(flac->samples.size(), 2000u);
    const test::Scratch folder;
    const std::string whole = wav_of(std::vector<float>(4000, 0.25F), {44100, 1, 16, 1}, folder);
    const auto cut = parse_sound(std::string_view(whole).substr(0, 4000), "cut.wav");
    ASSERT_TRUE(cut) << cut.error().text();
    EXPECT_LT(cut->samples.size(), 2001u);
    ASSERT_EQ(cut->warnings.size(), 1u);
    EXPECT_NE(cut->warnings[0].text.find("ends before"), std::string::npos);
}

TEST(SoundFile, is_refused_with_the_reason) {
    const test::Scratch folder;
    const std::string good = wav_of(std::vector<float>(100, 0.25F), {44100, 1, 32, 1}, folder);
    std::string slow = good, odd = good;
    slow.replace(24, 4, std::string("\x10\x00\x00\x00", 4));
    odd.replace(odd.size() - 4, 4, std::string("\x00\x00\xc0\x7f", 4));
    const struct {
        std::string bytes;
        const char* cause;
    } cases[] = {{"", "is empty"},
                 {"MThd....", "neither WAV nor FLAC"},
                 {"RIFF", "cannot be read"},
                 {"fLaC" + std::string(50, 'x'), "cannot be read"},
                 {slow, "sample rate"},
                 {odd, "no numbers"},
                 {good.substr(0, 30), "cannot be read"}};
    for (const auto& c : cases) {
        const auto read = parse_sound(c.bytes, "x.wav");
        ASSERT_FALSE(read) << c.cause;
        EXPECT_NE(read.error().cause.find(c.cause), std::string::npos) << read.error().text();
        EXPECT_FALSE(read.error().remedy.empty());
    }
}

// Learned and played again at the same speed: kurtosis (median over 20 noise seeds) within a factor of 1.5 of
// the recording's own.
void expect_as_grainy(const noise::Recording& recording) {
    const auto learned = noise::learn({&recording, 1});
    ASSERT_TRUE(learned);
    const noise::VoiceModel& m = learned->voices.models[0];
    ASSERT_TRUE(m.texture);
    const auto prepared = noise::prepare(recording, 50);
    std::vector<double> kurtoses, plain;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        noise::ModelNoise textured(m.spectrum, &*m.texture, seed), gaussian(m.spectrum, seed);
        std::vector<double> x, y(prepared->sound.size());
        for (std::uint64_t n = 0; x.size() < y.size(); ++n)
            for (const float v : textured.block(n, 100 * 64 / recording.sample_rate_hz)) x.push_back(v);
        gaussian.render(0, y);
        kurtoses.push_back(noise::kurtosis(x));
        plain.push_back(noise::kurtosis(y));
    }
    std::ranges::sort(kurtoses);
    const double own = noise::kurtosis(prepared->sound);
    EXPECT_GT(own, 3.5) << recording.name << " is not grainy";
    EXPECT_LT(std::abs(std::log(kurtoses[10] / own)), std::log(1.5)) << recording.name << " " << own;
    EXPECT_LT(plain[10], 3.2) << "without a texture none of it is there";
}

// Of the level deviation of real friction most is the hand's; the modulation is tested in
// tests/app/touch/rub_recordings_test.cpp.
TEST(RealFriction, is_played_as_grainy_as_it_was_recorded) {
    const std::string folder = std::string(TRIBO_SOURCE_DIR) + "/../shared/data/audio/";
    for (const char* name : {"lmt_carpet.wav", "lmt_rough_paper.wav"}) {
        const auto file = read_sound(folder + name);
        if (!file) GTEST_SKIP() << "no recordings here";
        expect_as_grainy({name, 100, 1, file->sample_rate_hz, file->samples});
    }
}

// The same of friction made up: noise through a resonance, with 40 grains a second of random size over it.
TEST(MadeFriction, is_played_as_grainy_as_it_was_made) {
    noise::Recording made{"made up", 100, 1, 44100, {}};
    std::mt19937 random(3);
    std::normal_distribution<double> gauss;
    const double turn = 2 * std::numbers::pi * 1200 / made.sample_rate_hz;
    double one = 0, two = 0;
    for (int n = 0; n < 5 * 44100; ++n) {
        const double grain = random() % 1100 == 0 ? 25 * gauss(random) : 0;
        const double x = gauss(random) + grain + 2 * 0.9 * std::cos(turn) * one - 0.81 * two;
        two = one;
        one = x;
        made.samples.push_back(0.005 * x);
    }
    expect_as_grainy(made);
}

}  // namespace
}  // namespace tribo::files
