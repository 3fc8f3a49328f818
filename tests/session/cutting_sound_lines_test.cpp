// SPDX-License-Identifier: MIT
// From engagement to what is heard: the lines of a cut, and a spindle that runs up.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "milling/force/force.hpp"
#include "milling/tool/materials.hpp"
#include "sound/place/minimum_phase.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::session {
namespace {

constexpr double kPi = std::numbers::pi, kRate = 48000;

// Five flutes, 4 mm deep, engaged from entry to exit.
contact::ForceSpectrum spectrum_of(double entry_deg, double exit_deg, double feed_per_tooth_mm = 0.1) {
    milling::Cutter cutter;
    cutter.diameter_mm = 12;
    cutter.flutes = 5;
    cutter.helix_deg = 30;
    cutter.length_mm = 40;
    milling::Engagement engagement;
    engagement.bands.push_back({0, 4, entry_deg * kPi / 180, exit_deg * kPi / 180});
    contact::ForceSpectrum spectrum;
    milling::force_spectrum(cutter, milling::find_material("al7075-t6")->coefficients, engagement,
                            {feed_per_tooth_mm, 0}, 32, spectrum);
    return spectrum;
}

contact::ContactSample sample_at(double t, double rpm, double angle, const contact::ForceSpectrum& spectrum) {
    contact::ContactSample s;
    s.t_s = t;
    s.force_n = {100, 0, 0};
    s.removed_mm3_per_s = 100;
    s.phase_rad = angle;
    s.phase_rate_rad_per_s = rpm / 60 * 2 * kPi;
    s.spectrum = &spectrum;
    return s;
}

// The left channel of a spindle at rpm(t); samples every 50 ms.
template <class Rpm>
std::vector<float> sound_of(const contact::ForceSpectrum& spectrum, double seconds, Rpm rpm,
                            std::shared_ptr<const sound::Head> head = nullptr) {
    sound::SoundtrackOptions options;
    options.head = std::move(head);
    options.tool = sound::tool_body(12, 40, sound::material_damping("al7075-t6"));
    sound::Soundtrack track(options);
    std::vector<float> left;
    const auto keep = [&](std::span<const float> block) {
        for (std::size_t n = 0; n < block.size(); n += 2) left.push_back(block[n]);
    };
    double angle = 0;
    constexpr double kStep = 0.05;
    for (double t = 0; t < seconds + kStep / 2; t += kStep) {
        if (t > 0) angle += 0.5 * (rpm(t - kStep) + rpm(t)) / 60 * 2 * kPi * kStep;
        track.play_to(sample_at(t, rpm(t), angle, spectrum), keep);
    }
    return left;
}

// The strongest line, by a transform of 2^17 samples and a parabola through its peak.
double strongest_hz(const std::vector<float>& x) {
    const sound::FourierTransform fourier(17);
    std::vector<std::complex<double>> f(fourier.size());
    for (std::size_t n = 0; n < f.size(); ++n) {
        const double a = 2 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(f.size());
        f[n] = (1 - std::cos(a)) * static_cast<double>(x[n + 9600]);
    }
    fourier.forward(f);
    std::size_t peak = 1;
    for (std::size_t k = 1; k < f.size() / 2; ++k) peak = std::norm(f[k]) > std::norm(f[peak]) ? k : peak;
    const double a = std::log(std::norm(f[peak - 1])), b = std::log(std::norm(f[peak])),
                 c = std::log(std::norm(f[peak + 1]));
    return (static_cast<double>(peak) + 0.5 * (a - c) / (a - 2 * b + c)) * kRate /
           static_cast<double>(f.size());
}

TEST(CuttingSoundLines, of_down_milling_are_led_by_tooth_passing) {
    const contact::ForceSpectrum down = spectrum_of(120, 180);
    EXPECT_NEAR(strongest_hz(sound_of(down, 3, [](double) { return 4500.0; })) / 375, 1, 1e-3);
    EXPECT_NEAR(strongest_hz(sound_of(down, 3, [](double) { return 9000.0; })) / 750, 1, 1e-3);
}

// The in-plane force of the same cut without any closed form: every tooth, in slices, at every angle of the
// spindle; then its lines at the first and second multiple of the tooth's.
std::array<double, 2> lines_by_slices(double entry_deg, double exit_deg, double feed_per_tooth_mm) {
    const milling::CuttingCoefficients k = milling::find_material("al7075-t6")->coefficients;
    constexpr int kAngles = 720, kSlices = 100, kFlutes = 5;
    const double lag = std::tan(30 * kPi / 180) / 6, slice = 4.0 / kSlices;
    std::complex<double> x[2], y[2];
    for (int n = 0; n < kAngles; ++n) {
        const double turned = 2 * kPi * (n + 0.5) / kAngles;
        double fx = 0, fy = 0;
        for (int flute = 0; flute < kFlutes; ++flute) {
            for (int z = 0; z < kSlices; ++z) {
                double phi = turned + 2 * kPi * flute / kFlutes - lag * slice * (z + 0.5);
                phi -= 2 * kPi * std::floor(phi / (2 * kPi));
                if (phi < entry_deg * kPi / 180 || phi > exit_deg * kPi / 180) continue;
                const double h = feed_per_tooth_mm * std::sin(phi);
                const double tangential = slice * (k.ktc * h + k.kte);
                const double radial = slice * (k.krc * h + k.kre);
                fx -= tangential * std::cos(phi) + radial * std::sin(phi);
                fy += tangential * std::sin(phi) - radial * std::cos(phi);
            }
        }
        for (int line = 0; line < 2; ++line) {
            const auto turn = std::polar(1.0 / kAngles, -kFlutes * (line + 1) * turned);
            x[line] += fx * turn;
            y[line] += fy * turn;
        }
    }
    return {std::sqrt(std::norm(x[0]) + std::norm(y[0])), std::sqrt(std::norm(x[1]) + std::norm(y[1]))};
}

double amplitude(const std::vector<float>& x, double hz) {
    std::complex<double> sum = 0;
    constexpr std::size_t kFrames = 48000;
    for (std::size_t n = 0; n < kFrames; ++n) {
        sum += (1 - std::cos(2 * kPi * static_cast<double>(n) / kFrames)) *
               std::polar(static_cast<double>(x[n + 9600]), -2 * kPi * hz * static_cast<double>(n) / kRate);
    }
    return std::abs(sum);
}

// Over half a turn the integral of e^{i (q - m) phi} vanishes where q - m is even: of an odd number of flutes
// the first line (m = 5) holds only cutting forces (q = 0, +-2; by the feed), the second (m = 10) only edge
// forces (q = +-1; whatever the feed). So with little feed the second leads: 900 mm/min at 4500 rpm is 0.04
// mm per tooth, and 0.055 is where they are even.
TEST(CuttingSoundLines, of_a_full_slot_are_led_by_the_second_harmonic) {
    for (const double rpm : {4500.0, 9000.0}) {
        const double feed_mm = 900 / (5 * rpm);
        const auto truth = lines_by_slices(0, 180, feed_mm);
        ASSERT_GT(truth[1], truth[0]);
        const auto wave = sound_of(spectrum_of(0, 180, feed_mm), 3, [&](double) { return rpm; });
        EXPECT_NEAR(strongest_hz(wave) / (2 * 5 * rpm / 60), 1, 1e-3) << rpm;
        // Down milling at the same feed is led by the first, as above.
        const auto down = sound_of(spectrum_of(120, 180, feed_mm), 3, [&](double) { return rpm; });
        EXPECT_NEAR(strongest_hz(down) / (5 * rpm / 60), 1, 1e-3) << rpm;
    }
}

TEST(CuttingSoundLines, have_the_levels_of_a_force_added_up_slice_by_slice) {
    for (const double feed_mm : {0.02, 0.04, 0.1, 0.3}) {
        const auto truth = lines_by_slices(0, 180, feed_mm);
        const auto wave = sound_of(spectrum_of(0, 180, feed_mm), 2, [](double) { return 4500.0; });
        // The tool's first mode, at 3 kHz, lifts both a little.
        EXPECT_NEAR(20 * std::log10(amplitude(wave, 750) / amplitude(wave, 375) * truth[0] / truth[1]), 0,
                    0.5)
            << feed_mm;
    }
    // With much feed the first line leads again.
    const auto heavy = lines_by_slices(0, 180, 0.3);
    EXPECT_GT(heavy[0], heavy[1]);
}

double roughness(const std::vector<float>& x, std::size_t from, std::size_t count) {
    double sum = 0;
    for (std::size_t n = from + 2; n < from + count; ++n) {
        const double d =
            static_cast<double>(x[n]) - 2 * static_cast<double>(x[n - 1]) + static_cast<double>(x[n - 2]);
        sum += d * d;
    }
    return sum;
}

TEST(CuttingSoundLines, of_a_spindle_that_runs_up_are_as_rough_as_at_each_speed_and_no_rougher) {
    const contact::ForceSpectrum down = spectrum_of(120, 180);
    for (const auto& head : {std::shared_ptr<const sound::Head>(), sound::Head::sphere(kRate)}) {
        const auto swept = sound_of(down, 4, [](double t) { return 4500 + 4500 * t / 4; }, head);
        for (const double at : {0.5, 1.3, 2.0, 2.7, 3.5}) {
            const double rpm = 4500 + 4500 * at / 4;
            const auto steady = sound_of(down, 1, [&](double) { return rpm; }, head);
            constexpr std::size_t kWindow = 9600;
            const double during =
                roughness(swept, static_cast<std::size_t>(at * kRate) - kWindow / 2, kWindow);
            EXPECT_NEAR(10 * std::log10(during / roughness(steady, 19200, kWindow)), 0, 1) << at;
        }
    }
}

}  // namespace
}  // namespace tribo::session
