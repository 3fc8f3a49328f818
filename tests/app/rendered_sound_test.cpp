// SPDX-License-Identifier: MIT
// sound.wav of a job: the tooth's tone from the first chip of a cut to its last.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

#include "app/run/job_folder.hpp"
#include "files/riff.hpp"

namespace tribo::test {
namespace {

// Two cuts along a fin so narrow that all of it is met at once, by a cutter of two flutes at 6000 rpm, so 200
// teeth a second: a slow one and, 0.4 s after it, a fast one; rows last half a second and a twentieth.
constexpr const char* kJob = R"(
[stock]
box_mm = [[0, 9.75, -14], [30, 10.25, 0]]
[cutter]
kind = "flat"
diameter_mm = 6
flutes = 2
helix_deg = 10
length_mm = 20
[material]
name = "al7075-t6"
[process]
spindle_rpm = 6000
[path]
gcode = "slots.nc"
[sound]
bits = 32
mode = "sphere"
machine = "none"
)";
constexpr const char* kProgram = "G21 G90 M3\nG0 X-5 Y10 Z-6\nG1 X3 F60\nG0 Z5\nX-5\nZ-12\nG1 X3 F600\nM30\n";
constexpr int kRate = 48000;

// Amplitude of a frequency in one channel over [from, to) seconds, whole turns of the spindle long.
double amplitude(const std::vector<double>& stereo, double hz, double from_s, double to_s) {
    std::complex<double> sum = 0;
    const int first = static_cast<int>(from_s * kRate), last = static_cast<int>(to_s * kRate);
    for (int n = first; n < last; ++n) {
        sum += std::polar(stereo.at(static_cast<std::size_t>(2 * n)), -2 * std::numbers::pi * hz * n / kRate);
    }
    return 2 * std::abs(sum) / (last - first);
}

TEST(RenderedSound, has_the_tooths_tone_from_a_cuts_first_chip_to_its_last) {
    const JobFolder job;
    job.put("job.toml", kJob);
    job.put("slots.nc", kProgram);
    const Outcome run = job.render({"--only", "forces,sound"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::vector<double> wave = Riff(job.get("sound.wav")).samples(32);

    // Cuts, from where their rows begin to where the last one ends.
    const ForceColumns rows = job.forces();
    const std::vector<double>& t = rows.at("t_s");
    struct Cut {
        double from, to;
    };
    std::vector<Cut> cuts;
    for (std::size_t n = 0; n < t.size(); ++n) {
        if (cuts.empty() || t[n] > cuts.back().to + 1e-3) cuts.push_back({t[n], 0});
        cuts.back().to = t[n] + rows.at("duration_s")[n];
    }
    ASSERT_EQ(cuts.size(), 2u);

    constexpr double kSilent = 1e-9;               // what still rings by then is 180 dB below full scale
    constexpr double kFade = 0.02, kTurns = 0.04;  // amplitudes follow their excitation in 13 ms
    constexpr double kEntry = 0.011;               // the slow cut takes that long to meet the whole fin
    for (const Cut& cut : cuts) {
        for (const double from : {cut.from + kEntry + kFade, cut.to - kTurns}) {
            const double tone = amplitude(wave, 200, from, from + kTurns);
            EXPECT_GT(tone, 0.02) << from;
            // A spindle that runs up, or a sound that fades, would smear the line over its neighbours.
            for (const double beside : {50, 100, 150, 250, 300}) {
                EXPECT_LT(amplitude(wave, beside, from, from + kTurns), 0.03 * tone)
                    << from << ", " << beside;
            }
        }
        for (const double silent : {cut.from - kTurns, cut.to + kFade}) {
            const auto first = static_cast<std::size_t>(silent * kRate) * 2;
            for (std::size_t n = first; n < std::min(first + 2 * 900, wave.size()); ++n) {
                ASSERT_LT(std::abs(wave[n]), kSilent) << static_cast<double>(n) / 2 / kRate;
            }
        }
    }
}

}  // namespace
}  // namespace tribo::test
