// SPDX-License-Identifier: MIT
// What a cut sounds like as the program renders it, beside third octaves of real cuts, and as each key of
// [sound] says.
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "app/run/job_folder.hpp"
#include "files/riff.hpp"
#include "noise/model/fourier.hpp"

namespace tribo::test {
namespace {

constexpr int kRate = 48000;

// Third octaves from 80 Hz of end milling in steel 4140 on a vertical machining centre: D12.7, five flutes,
// 4500 rpm, 1270 mm/min, 25.4 mm deep, 1.27 mm wide; means of three up cuts and of two down cuts, dB against
// the sum of the bands.
constexpr std::size_t kBands = 20;
using Levels = std::array<double, kBands>;
constexpr Levels kUp{-16, -20, -19, -16, -18, -15, -13, -6,  -14, -18,
                     -12, -17, -12, -10, -15, -12, -15, -15, -14, -18};
constexpr Levels kDown{-19, -19, -18, -16, -18, -14, -7,  -10, -13, -15,
                       -10, -16, -13, -13, -13, -12, -15, -14, -14, -17};

constexpr const char* kSoundJob = R"(
[stock]
box_mm = [[0, 0, -26], [60, 40, 0]]
[[cutter]]
number = 1
kind = "flat"
diameter_mm = 12.7
flutes = 5
length_mm = 60
[material]
name = "steel"
[path]
gcode = "cut.nc"
)";
// 25.4 deep, 1.27 wide, along -y; the feed's sense makes it an up or a down cut.
constexpr const char* kUpCut = "G21 G90 M3 S4500\nG0 X-10 Y-5.08 Z5\nZ-25.4\nG1 X70 F1270\nG0 Z5\nM30\n";
constexpr const char* kDownCut = "G21 G90 M3 S4500\nG0 X70 Y-5.08 Z5\nZ-25.4\nG1 X-10 F1270\nG0 Z5\nM30\n";
constexpr double kFromS = 0.8, kToS = 2.8;  // in full cut

struct Sound {
    std::vector<double> left, right;
};

Sound rendered(const std::string& sound, const std::string& program = kUpCut) {
    const JobFolder job;
    job.put("job.toml", kSoundJob + ("[sound]\nbits = 32\n" + sound));
    job.put("cut.nc", program);
    const Outcome run = job.render({"--only", "sound", "--resolution", "0.5"});
    EXPECT_EQ(run.code, 0) << run.err;
    Sound heard;
    const std::vector<double> wave = Riff(job.get("sound.wav")).samples(32);
    for (std::size_t n = 0; n + 1 < wave.size(); n += 2) {
        heard.left.push_back(wave[n]);
        heard.right.push_back(wave[n + 1]);
    }
    return heard;
}

std::vector<double> part(const std::vector<double>& x, double from_s, double to_s) {
    return {x.begin() + static_cast<std::ptrdiff_t>(from_s * kRate),
            x.begin() + static_cast<std::ptrdiff_t>(to_s * kRate)};
}

double rms(const std::vector<double>& x) {
    double sum = 0;
    for (const double v : x) sum += v * v;
    return std::sqrt(sum / static_cast<double>(x.size()));
}

// Power by frequency, Welch's method.
std::vector<double> power_of(const std::vector<double>& x, std::size_t length = 16384) {
    std::vector<double> power(length / 2 + 1);
    std::vector<std::complex<double>> frame(length);
    for (std::size_t at = 0; at + length <= x.size(); at += length / 2) {
        for (std::size_t n = 0; n < length; ++n) {
            const double turn = (static_cast<double>(n) + 0.5) / static_cast<double>(length);
            frame[n] = (0.5 - 0.5 * std::cos(2 * std::numbers::pi * turn)) * x[at + n];
        }
        noise::fourier(frame);
        for (std::size_t k = 0; k < power.size(); ++k) power[k] += std::norm(frame[k]);
    }
    return power;
}

Levels levels_of(const std::vector<double>& x) {
    const std::vector<double> power = power_of(x);
    const double bin_hz = 0.5 * kRate / static_cast<double>(power.size() - 1);
    Levels sums{};
    for (std::size_t k = 1; k < power.size(); ++k) {
        // Bands of base ten; 1000 Hz is the twelfth.
        const double band = std::floor(10 * std::log10(static_cast<double>(k) * bin_hz / 1000) + 11.5);
        if (band >= 0 && band < kBands) sums[static_cast<std::size_t>(band)] += power[k];
    }
    for (double& v : sums) v = 10 * std::log10(v);
    return sums;
}

// RMS over the bands of the difference but for one gain.
double distance_db(const Levels& a, const Levels& b) {
    double mean = 0, square = 0;
    for (std::size_t n = 0; n < kBands; ++n) mean += (a[n] - b[n]) / kBands;
    for (std::size_t n = 0; n < kBands; ++n) square += (a[n] - b[n] - mean) * (a[n] - b[n] - mean) / kBands;
    return std::sqrt(square);
}

TEST(CutSound, has_the_third_octaves_of_real_cuts) {
    for (const char* mode : {"", "mode = \"pan\"\n", "mode = \"sphere\"\n"}) {
        const Sound up = rendered(mode), down = rendered(mode, kDownCut);
        for (const auto& [sound, real] : {std::pair{&up, &kUp}, std::pair{&down, &kDown}}) {
            for (const std::vector<double>* ear : {&sound->left, &sound->right})
                EXPECT_LT(distance_db(levels_of(part(*ear, kFromS, kToS)), *real), 5) << mode;
        }
    }
    // Force alone is far from it: the measure tells.
    const Sound alone = rendered("mode = \"pan\"\nmachine = \"none\"\n");
    EXPECT_GT(distance_db(levels_of(part(alone.left, kFromS, kToS)), kUp), 15);
}

TEST(CutSound, has_a_hundredth_of_its_energy_in_the_teeth) {
    const std::vector<double> power = power_of(part(rendered("mode = \"pan\"\n").left, kFromS, kToS), 65536);
    const double bin_hz = 0.5 * kRate / static_cast<double>(power.size() - 1);
    double all = 0, teeth = 0, beside = 0;
    for (std::size_t k = 20; k < power.size(); ++k) {
        const double hz = static_cast<double>(k) * bin_hz, off = std::abs(std::remainder(hz, 375));
        all += power[k];
        if (hz < 6000 && off < 2.5) teeth += power[k];
        if (hz < 6000 && off > 5 && off < 55) beside += 0.05 * power[k];
    }
    EXPECT_GT((teeth - beside) / all, 0.002);
    EXPECT_LT((teeth - beside) / all, 0.04);
}

TEST(CutSound, of_no_machine_is_silent_in_the_air_and_of_a_machine_its_spindle) {
    const Sound none = rendered("mode = \"pan\"\nmachine = \"none\"\n");
    const Sound mill = rendered("mode = \"pan\"\n");
    const Sound quiet = rendered("mode = \"pan\"\nspindle_db = -20\n");
    const std::vector<double> air = part(mill.left, 0.05, 0.1);
    EXPECT_EQ(rms(part(none.left, 0, 0.1)), 0);
    EXPECT_GT(rms(air), 1e-3);
    EXPECT_NEAR(rms(air) / rms(part(quiet.left, 0.05, 0.1)), 10, 0.2);
    // After the last chip it goes on, and then ends.
    EXPECT_EQ(mill.left.back(), 0);
}

TEST(CutSound, each_level_moves_what_it_names) {
    const auto loud = [](const std::string& keys) {
        const Sound heard = rendered("mode = \"pan\"\nroom = \"none\"\n" + keys);
        return levels_of(part(heard.left, kFromS, kToS));
    };
    const Levels usual = loud("");
    const Levels chips = loud("chips_db = 20\n"), cut = loud("cut_db = -20\n");
    EXPECT_GT(chips[18] - usual[18], 6);     // 5 kHz
    EXPECT_NEAR(chips[4] - usual[4], 0, 1);  // 200 Hz
    EXPECT_LT(cut[4] - usual[4], -6);
    const double hall =
        rms(part(rendered("mode = \"pan\"\nroom = \"cabin\"\nroom_db = 10\n").left, kFromS, kToS));
    const double open = rms(part(rendered("mode = \"pan\"\nroom = \"none\"\n").left, kFromS, kToS));
    EXPECT_GT(hall, 1.1 * open);
}

TEST(CutSound, refuses_machines_rooms_and_levels_that_do_not_exist) {
    for (const auto& [keys, says] : {std::pair{"machine = \"mil\"", "'mill'"},
                                     {"room = \"workshpo\"", "'workshop'"},
                                     {"chips_db = 90", "chips_db"},
                                     {"spindle_db = nan", "spindle_db"},
                                     {"mode = \"pan\"\nequalize = \"none\"", "equalize"},
                                     {"equalize = \"flat\"", "equalize"}}) {
        const JobFolder job;
        job.put("job.toml", kSoundJob + (std::string("[sound]\n") + keys + "\n"));
        job.put("cut.nc", kUpCut);
        const Outcome run = job.render({"--only", "sound", "--resolution", "0.5"});
        EXPECT_EQ(run.code, 2) << keys;
        EXPECT_NE(run.err.find("job.toml:1"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    }
}

TEST(CutSound, learned_from_a_cut_sounds_as_its_other_half) {
    // A cut of another machine, in another room, stands for the recording.
    const std::string keys = "mode = \"pan\"\nmachine = \"router\"\nroom = \"cabin\"\n";
    const Sound cut = rendered(keys);
    const JobFolder job;
    job.put("half.wav", wav(kRate, part(cut.left, kFromS, 0.5 * (kFromS + kToS))));
    const Outcome learned =
        run_tribo({"learn", "--recording", "100:half.wav", "--out", "half.json"}, job.path());
    ASSERT_EQ(learned.code, 0) << learned.err;
    job.put("cut.nc", kUpCut);
    job.put("job.toml",
            kSoundJob + std::string("[sound]\nbits = 32\nmode = \"pan\"\nchips = \"half.json\"\n"));
    const Outcome run = job.render({"--only", "sound", "--resolution", "0.5"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::vector<double> wave = Riff(job.get("sound.wav")).samples(32);
    std::vector<double> left;
    for (std::size_t n = 0; n + 1 < wave.size(); n += 2) left.push_back(wave[n]);
    const Levels other = levels_of(part(cut.left, 0.5 * (kFromS + kToS), kToS));
    EXPECT_LT(distance_db(levels_of(part(left, kFromS, kToS)), other), 3);
    // The default is not that machine.
    EXPECT_GT(distance_db(levels_of(part(rendered("mode = \"pan\"\n").left, kFromS, kToS)), other), 3);
}

}  // namespace
}  // namespace tribo::test
