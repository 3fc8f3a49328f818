// SPDX-License-Identifier: MIT
#include "files/sound/wav.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "files/file_size_limit.hpp"
#include "files/riff.hpp"
#include "files/scratch.hpp"

namespace tribo::files {
namespace {

using test::Riff;
using test::Scratch;

std::vector<float> two_tones(std::size_t frames) {
    std::vector<float> x;
    for (std::size_t n = 0; n < frames; ++n) {
        x.push_back(static_cast<float>(0.7 * std::sin(0.05 * static_cast<double>(n))));
        x.push_back(static_cast<float>(0.2 * std::cos(0.31 * static_cast<double>(n))));
    }
    return x;
}

std::string written(const Scratch& scratch, const WavFormat& format, const std::vector<float>& x,
                    std::size_t block = 1000) {
    FileResult<WavWriter> wav = WavWriter::create(scratch / "s.wav", format);
    EXPECT_TRUE(wav);
    for (std::size_t at = 0; at < x.size(); at += block) {
        wav->write(std::span(x).subspan(at, std::min(block, x.size() - at)));
    }
    EXPECT_TRUE(wav->finish());
    return scratch.get("s.wav");
}

TEST(WavWriter, writes_what_the_header_says_and_the_samples_within_a_step) {
    const Scratch scratch;
    const std::vector<float> x = two_tones(12345);
    const struct {
        int bits;
        std::size_t tag;  // 1: integers, 3: IEEE floats
        double error;
    } cases[] = {{16, 1, 1.5 / 32768}, {24, 1, 0.5 / 8388608 + 1e-12}, {32, 3, 0}};
    for (const auto& c : cases) {
        for (const int rate : {44100, 48000}) {
            const Riff riff(written(scratch, {rate, 2, c.bits, 1}, x));
            ASSERT_TRUE(riff.well_formed) << c.bits;
            EXPECT_EQ(riff.format(0, 2), c.tag);
            EXPECT_EQ(riff.format(2, 2), 2u);
            EXPECT_EQ(riff.format(4, 4), static_cast<std::size_t>(rate));
            EXPECT_EQ(riff.format(12, 2), static_cast<std::size_t>(c.bits / 4));
            EXPECT_EQ(riff.format(14, 2), static_cast<std::size_t>(c.bits));
            const std::vector<double> y = riff.samples(c.bits);
            ASSERT_EQ(y.size(), x.size());
            for (std::size_t n = 0; n < x.size(); ++n) {
                ASSERT_NEAR(y[n], static_cast<double>(x[n]), c.error) << c.bits << " bits, sample " << n;
            }
        }
    }
}

TEST(WavWriter, writes_the_same_bytes_every_time_and_in_any_blocks) {
    const Scratch scratch;
    const std::vector<float> x = two_tones(9000);
    for (const int bits : {16, 24, 32}) {
        const std::string once = written(scratch, {48000, 2, bits, 1}, x);
        EXPECT_EQ(written(scratch, {48000, 2, bits, 1}, x, 2), once) << bits;
        EXPECT_EQ(written(scratch, {48000, 2, bits, 1}, x, x.size()), once) << bits;
    }
    EXPECT_NE(written(scratch, {48000, 2, 16, 1}, x), written(scratch, {48000, 2, 16, 2}, x));
}

// Triangular dither of two steps: the error has no mean and the variance of 1/6 + 1/12 steps^2 whatever the
// signal, here a constant far below one step (Lipshitz, Wannamaker, Vanderkooy 1992).
TEST(WavWriter, dithers_16_bits_so_that_the_error_does_not_depend_on_the_signal) {
    const Scratch scratch;
    for (const double steps : {0.1, 0.25, 0.5, 3.7}) {
        const std::vector<float> x(200000, static_cast<float>(steps / 32768));
        const std::vector<double> y = Riff(written(scratch, {48000, 2, 16, 1}, x)).samples(16);
        double mean = 0, variance = 0;
        for (const double v : y) mean += v * 32768 - steps;
        mean /= static_cast<double>(y.size());
        for (const double v : y) variance += (v * 32768 - steps) * (v * 32768 - steps);
        variance /= static_cast<double>(y.size());
        EXPECT_NEAR(mean, 0, 0.006) << steps;
        EXPECT_NEAR(variance, 0.25, 0.005) << steps;
    }
}

TEST(WavWriter, leaves_silence_silent) {
    const Scratch scratch;
    for (const int bits : {16, 24, 32}) {
        for (const double v :
             Riff(written(scratch, {48000, 2, bits, 1}, std::vector<float>(5000))).samples(bits)) {
            ASSERT_EQ(v, 0) << bits;
        }
    }
}

TEST(WavWriter, stops_integers_at_their_ends) {
    const Scratch scratch;
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> x = {1, -1, 7, -7, infinity, -infinity, std::nanf(""), 0};
    for (const int bits : {16, 24}) {
        const double step = bits == 16 ? 0x1p-15 : 0x1p-23;
        const std::vector<double> y = Riff(written(scratch, {48000, 2, bits, 1}, x)).samples(bits);
        for (std::size_t n = 0; n < 6; n += 2) {
            EXPECT_NEAR(y[n], 1 - step, 1.5 * step);
            EXPECT_NEAR(y[n + 1], -1, 1.5 * step);
        }
        EXPECT_EQ(y[6], 0);
        EXPECT_EQ(y[7], 0);
    }
}

TEST(WavWriter, of_no_sound_writes_an_empty_sound) {
    const Scratch scratch;
    const Riff riff(written(scratch, {}, {}));
    EXPECT_TRUE(riff.well_formed);
    EXPECT_TRUE(riff.chunks.at("data").empty());
}

TEST(WavWriter, refuses_more_than_4_gigabytes_and_leaves_no_file) {
    EXPECT_EQ(longest_wav_frames({48000, 2, 24, 1}) / 48000 / 60, 248);  // minutes
    EXPECT_LT(longest_wav_frames({48000, 2, 32, 1}) * 8, std::int64_t{1} << 32);
    const Scratch scratch;
    FileResult<WavWriter> wav = WavWriter::create(scratch / "s.wav", {}, 48000);
    ASSERT_TRUE(wav);
    const std::vector<float> half(48000);
    wav->write(half);
    wav->write(half);
    EXPECT_EQ(wav->frames(), 48000);
    wav->write(std::span(half).first(2));
    EXPECT_EQ(wav->frames(), 48000);
    const FileResult<void> result = wav->finish();
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().fault, FileFault::input);
    EXPECT_NE(result.error().text().find("longer than the 1 s that such a file holds; try --until"),
              std::string::npos)
        << result.error().text();
    {
        const FileResult<WavWriter> gone = std::move(wav);
    }
    EXPECT_EQ(scratch.entries(), 0u);
}

TEST(WavWriter, that_is_not_finished_leaves_no_file) {
    const Scratch scratch;
    {
        FileResult<WavWriter> wav = WavWriter::create(scratch / "s.wav");
        ASSERT_TRUE(wav);
        wav->write(two_tones(5000));
        EXPECT_EQ(scratch.entries(), 1u);
    }
    EXPECT_EQ(scratch.entries(), 0u);
}

TEST(WavWriter, tells_what_the_file_system_refused) {
    const Scratch scratch;
    {
        const test::FileSizeLimit limit(100'000);
        FileResult<WavWriter> wav = WavWriter::create(scratch / "s.wav");
        if (wav) {
            wav->write(two_tones(50000));
            const FileResult<void> result = wav->finish();
            EXPECT_FALSE(result);
            if (!result) {
                EXPECT_EQ(result.error().fault, FileFault::system);
                EXPECT_NE(result.error().text().find("ulimit"), std::string::npos) << result.error().text();
            }
        }
        EXPECT_TRUE(wav);
    }
    EXPECT_EQ(scratch.entries(), 0u);
    const FileResult<WavWriter> nowhere = WavWriter::create(scratch / "no/s.wav");
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().text().find("cannot write"), std::string::npos);
}

TEST(WavWriter, refuses_formats_that_it_does_not_write) {
    const Scratch scratch;
    const struct {
        WavFormat format;
        const char* fragment;
    } cases[] = {{{48000, 2, 8, 1}, "8 bits per sample; try bits = 16, 24 or 32"},
                 {{48000, 2, 0, 1}, "0 bits"},
                 {{100, 2, 16, 1}, "100 Hz; try 48000"},
                 {{48000, 0, 16, 1}, "0 channels"},
                 {{48000, 9, 16, 1}, "9 channels"}};
    for (const auto& c : cases) {
        const FileResult<WavWriter> wav = WavWriter::create(scratch / "s.wav", c.format);
        ASSERT_FALSE(wav) << c.fragment;
        EXPECT_EQ(wav.error().fault, FileFault::input);
        EXPECT_NE(wav.error().text().find(c.fragment), std::string::npos) << wav.error().text();
    }
    EXPECT_EQ(scratch.entries(), 0u);
}

}  // namespace
}  // namespace tribo::files
