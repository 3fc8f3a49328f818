// SPDX-License-Identifier: MIT
#include "sound/place/head.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include "sound/cuts.hpp"
#include "sound/ears.hpp"

namespace tribo::sound {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kHeadRate = test::kEarRate;

// Pressure at the ear of a rigid sphere, time e^{i w t}, by the standard library's Bessel functions.
Complex sphere_pressure(double hz, double angle) {
    const double mu = 2 * kPi * hz * kHeadRadius / kSoundSpeed;
    Complex sum = 0, power = Complex(0, 1) / (mu * mu);
    for (unsigned m = 0; m < 40; ++m) {
        const auto h = [&](unsigned n) { return Complex(std::sph_bessel(n, mu), std::sph_neumann(n, mu)); };
        const Complex derivative = m > 0 ? h(m - 1) - (m + 1) / mu * h(m) : -h(1);
        sum += power * static_cast<double>(2 * m + 1) * std::legendre(m, std::cos(angle)) / derivative;
        power *= Complex(0, -1);
    }
    return std::conj(sum);
}

// What the head does to a steady tone at both ears: filter and delay as one number.
std::array<Complex, 2> response(const Head& head, Vec3 direction, double hz) {
    EarResponses heard;
    head.hear(10 * direction, heard);
    std::array<Complex, 2> out;
    for (std::size_t ear = 0; ear < 2; ++ear) {
        for (std::size_t k = 0; k < kHeadTaps; ++k) {
            out[ear] += static_cast<double>(heard.taps[ear][k]) *
                        std::polar(1.0, -2 * kPi * hz / kHeadRate * static_cast<double>(k));
        }
        out[ear] *= std::polar(1.0, -2 * kPi * hz * heard.delay_s[ear]);
    }
    return out;
}

Vec3 horizontal(double azimuth_deg) {
    const double a = azimuth_deg * kPi / 180;
    return {std::sin(a), std::cos(a), 0};
}

TEST(SphereHead, has_the_arrival_offset_of_a_rigid_sphere_within_10_us) {
    for (const double azimuth : {10.0, 22.5, 45.0, 61.0, 90.0, 120.0, 170.0}) {
        const Vec3 d = horizontal(azimuth);
        const Vec3 right{std::cos(kPi / 18), -std::sin(kPi / 18), 0}, left{-right.x, right.y, 0};
        for (const double hz : {400.0, 700.0, 1000.0, 1400.0}) {
            const Complex l = sphere_pressure(hz, std::acos(dot(left, d)));
            const Complex r = sphere_pressure(hz, std::acos(dot(right, d)));
            const auto heard = response(*test::sphere(), d, hz);
            const double expected = std::arg(r / l) / (2 * kPi * hz);
            const double found = std::arg(heard[1] / heard[0]) / (2 * kPi * hz);
            EXPECT_NEAR(1e6 * found, 1e6 * expected, 10) << azimuth << " deg, " << hz << " Hz";
        }
    }
}

TEST(SphereHead, shades_the_far_ear_as_a_rigid_sphere_does) {
    const auto shelf = [](Vec3 d, double hz) {  // of the outer ear; 1 in front
        const double g = std::pow(10, -8.0 / 20 * std::pow(0.5 * (1 - d.y), 2));
        const double f = std::tan(kPi * hz / kHeadRate) / std::tan(kPi * 3000 / kHeadRate);
        return std::abs(Complex(1, g * f) / Complex(1, f));
    };
    const Vec3 right{std::cos(kPi / 18), -std::sin(kPi / 18), 0};
    const auto wanted = [&](Vec3 d, double hz) {
        return std::abs(sphere_pressure(hz, std::acos(dot(right, d)))) * shelf(d, hz);
    };
    const double front =
        test::decibel(std::abs(response(*test::sphere(), {0, 1, 0}, 1000)[1]) / wanted({0, 1, 0}, 1000));
    for (const double azimuth : {-120.0, -90.0, -45.0, 0.0, 45.0, 90.0, 135.0, 180.0}) {
        for (const double hz : {200.0, 500.0, 1000.0, 4000.0, 8000.0}) {
            const Vec3 d = horizontal(azimuth);
            const double found = test::decibel(std::abs(response(*test::sphere(), d, hz)[1]));
            EXPECT_NEAR(found - front, test::decibel(wanted(d, hz)), hz > 1000 ? 0.3 : 0.1)
                << azimuth << " deg, " << hz << " Hz";
        }
    }
}

TEST(SphereHead, muffles_what_is_behind) {
    EXPECT_LT(test::decibel(std::abs(response(*test::sphere(), {0, -1, 0}, 8000)[0]) /
                            std::abs(response(*test::sphere(), {0, 1, 0}, 8000)[0])),
              -3);
    EXPECT_NEAR(test::decibel(std::abs(response(*test::sphere(), {0, -1, 0}, 100)[0]) /
                              std::abs(response(*test::sphere(), {0, 1, 0}, 100)[0])),
                0, 0.2);
}

TEST(SphereHead, is_the_same_at_other_sample_rates) {
    const auto slow = Head::sphere(44100);
    EarResponses a, b;
    for (const double azimuth : {0.0, 40.0, 90.0, 200.0}) {
        slow->hear(horizontal(azimuth), a);
        test::sphere()->hear(horizontal(azimuth), b);
        EXPECT_NEAR(a.delay_s[0], b.delay_s[0], 1e-6);
        EXPECT_NEAR(a.delay_s[1], b.delay_s[1], 1e-6);
    }
}

TEST(PanningHead, keeps_the_power_and_has_no_delays) {
    const auto pan = Head::panning(kHeadRate);
    EarResponses heard;
    for (int azimuth = 0; azimuth < 360; azimuth += 5) {
        pan->hear(5 * horizontal(azimuth), heard);
        const auto l = static_cast<double>(heard.taps[0][0]), r = static_cast<double>(heard.taps[1][0]);
        EXPECT_NEAR(l * l + r * r, 2, 1e-5);
        EXPECT_NEAR(heard.delay_s[0], 0, 1e-12);
        EXPECT_NEAR(heard.delay_s[1], 0, 1e-12);
    }
    pan->hear({0, 1, 0}, heard);
    EXPECT_NEAR(heard.taps[0][0], 1, 1e-6);
    pan->hear({3, 0, 0}, heard);
    EXPECT_NEAR(heard.taps[0][0], 0, 1e-6);
}

// A made-up head: a click whose delay and level follow from the direction.
HrirSet clicks(double rate_hz) {
    HrirSet set;
    set.sample_rate_hz = rate_hz;
    set.taps = 256;
    for (int row = 0; row <= 12; ++row) {
        for (int column = 0; column < (row % 12 == 0 ? 1 : 24); ++column) {
            const double up = (row * 15 - 90) * kPi / 180, a = column * kPi / 12;
            const Vec3 d{std::cos(up) * std::sin(a), std::cos(up) * std::cos(a), std::sin(up)};
            set.directions.push_back(d);
            for (const double side : {-1.0, 1.0}) {
                const double delay = 40 - 12 * side * d.x;  // samples
                for (int k = 0; k < set.taps; ++k) {
                    // A sinc, Hann-windowed over 64 samples.
                    const double x = k - delay;
                    const double sinc = x == 0 ? 1 : std::sin(kPi * x) / (kPi * x);
                    const double w = std::abs(x) < 32 ? 0.5 + 0.5 * std::cos(kPi * x / 32) : 0;
                    set.responses.push_back(static_cast<float>((1 + 0.5 * side * d.x) * sinc * w));
                }
                set.extra_delays_s.push_back(side < 0 ? 0 : 1e-4);
            }
        }
    }
    return set;
}

TEST(MeasuredHead, takes_delays_and_levels_from_the_responses_at_any_rate) {
    for (const double rate : {44100.0, 96000.0}) {
        const auto head = Head::measured(clicks(rate), kHeadRate);
        ASSERT_TRUE(head);
        for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-0.5, 0.5, std::sqrt(0.5)}, Vec3{0, 0, -1}}) {
            EarResponses heard;
            (*head)->hear(3 * d, heard);
            // Of the filters and the delays together, as ears compare phases.
            double phase = 0, power = 0;
            for (double hz = 300; hz <= 1500; hz += 50) {
                const auto both = response(**head, d, hz);
                const double w = 2 * kPi * hz, late = -24 * d.x / rate + 1e-4;
                const Complex apart = both[0] * std::conj(both[1]) * std::polar(1.0, -w * late);
                phase += w * apart.imag();
                power += w * w * apart.real();
            }
            EXPECT_NEAR(phase / power, 0, 3e-6);
            const auto level = [&](std::size_t ear, double hz) {
                Complex sum;
                for (std::size_t k = 0; k < kHeadTaps; ++k) {
                    sum += static_cast<double>(heard.taps[ear][k]) *
                           std::polar(1.0, -2 * kPi * hz / kHeadRate * static_cast<double>(k));
                }
                return std::abs(sum);
            };
            for (const double hz : {1000.0, 4000.0, 12000.0}) {
                EXPECT_NEAR(level(1, hz) / level(0, hz), (1 + 0.5 * d.x) / (1 - 0.5 * d.x), 5e-3) << hz;
            }
            // Far below, no head is in the way (these would go on: -6 to 3.5 dB).
            for (const std::size_t ear : {0u, 1u}) EXPECT_NEAR(test::decibel(level(ear, 20)), 0, 2);
        }
    }
}

TEST(MeasuredHead, refuses_what_is_no_set_of_responses) {
    const auto cause = [](auto change) {
        HrirSet set = clicks(48000);
        change(set);
        const auto ok = check_hrirs(set);
        return ok ? std::string() : ok.error().text();
    };
    EXPECT_EQ(cause([](auto&) {}), "");
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(cause([](auto& s) { s.sample_rate_hz = 0; }).find("sample rate"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { s.directions.resize(2); }).find("2 directions"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { s.taps = 1 << 20; }).find("samples long"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { s.responses.pop_back(); }).find("size"), std::string::npos);
    EXPECT_NE(cause([&](auto& s) { s.responses[7] = nan; }).find("number"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { s.directions[3] = {0, 0, 0}; }).find("direction"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { s.extra_delays_s[3] = -1; }).find("delayed"), std::string::npos);
    EXPECT_NE(cause([](auto& s) { std::ranges::fill(s.responses, 0.0f); }).find("silent"), std::string::npos);
}

}  // namespace
}  // namespace tribo::sound
