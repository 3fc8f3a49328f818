// SPDX-License-Identifier: MIT
#include "sound/cut/partials.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "sound/cuts.hpp"

namespace tribo::sound {
namespace {

std::complex<double> partial(const Partials& p, std::size_t n) {
    return {p.re[n - 1], p.im[n - 1]};
}

contact::ForceSpectrum one_harmonic(std::complex<double> x, std::complex<double> y) {
    contact::ForceSpectrum s;
    s.harmonics = {{}, {x, y, 5.0, 7.0}};
    return s;
}

TEST(InPlanePartials, of_a_force_along_a_line_have_its_size_and_phase_up_to_a_fixed_turn) {
    const std::complex<double> c = std::polar(3.0, 1.1);
    for (const double direction : {0.0, 0.5, 2.0, -1.0}) {
        const Partials p =
            in_plane_partials(one_harmonic(c * std::cos(direction), c * std::sin(direction)), 2);
        ASSERT_EQ(p.count, 1);
        EXPECT_NEAR(std::abs(partial(p, 1)), 6, 1e-12);
        // x - i y turns by the direction of the line.
        EXPECT_NEAR(std::abs(partial(p, 1) - std::polar(6.0, 1.1 - direction)), 0, 1e-12);
    }
}

TEST(InPlanePartials, of_a_force_that_turns_count_both_components) {
    using namespace std::complex_literals;
    // x = 4 sin, y = 4 cos of the angle: clockwise seen from the shank, with the tool.
    const Partials with = in_plane_partials(one_harmonic(-2i, 2.0), 1);
    EXPECT_NEAR(std::abs(partial(with, 1)), std::sqrt(8.0), 1e-12);
    const Partials against = in_plane_partials(one_harmonic(2i, 2.0), 1);
    EXPECT_NEAR(std::abs(partial(against, 1)), std::sqrt(8.0), 1e-12);
}

TEST(InPlanePartials, leave_out_mean_axial_force_torque_and_what_is_beyond_64) {
    contact::ForceSpectrum s;
    s.harmonics = {{10.0, 10.0, 10.0, 10.0}, {0.0, 0.0, 9.0, 9.0}};
    EXPECT_TRUE(in_plane_partials(s, 1).silent());
    EXPECT_TRUE(in_plane_partials({}, 1).silent());
    EXPECT_EQ(in_plane_partials(test::falling_spectrum(1, 100), 1).count, kMaxPartials);
}

TEST(AudibleShare, is_full_in_the_audible_band_and_nothing_at_half_the_rate_and_below_10_hertz) {
    for (const double rate : {44100.0, 48000.0}) {
        for (const double hz : {20.0, 100.0, 10000.0, 0.9 * rate / 2}) {
            EXPECT_DOUBLE_EQ(audible_share(hz, rate), 1) << hz;
        }
        for (const double hz : {0.0, 10.0, 0.98 * rate / 2, rate / 2, rate, 1e9}) {
            EXPECT_DOUBLE_EQ(audible_share(hz, rate), 0) << hz;
        }
        EXPECT_NEAR(audible_share(0.94 * rate / 2, rate), 0.5, 1e-9);
        EXPECT_NEAR(audible_share(15, rate), 0.5, 1e-9);
    }
}

RC_GTEST_PROP(Play, is_the_sum_of_sines_that_it_says, ()) {
    const auto value = [](double size) {
        return size * *rc::gen::map(rc::gen::inRange(-1000, 1001), [](int i) { return i / 1000.0; });
    };
    Partials before, here, after;
    for (Partials* p : {&before, &here, &after}) {
        p->count = *rc::gen::inRange(0, kMaxPartials + 1);
        for (std::size_t n = 0; n < static_cast<std::size_t>(p->count); ++n) {
            p->re[n] = value(1);
            p->im[n] = value(1);
        }
    }
    const PhasePiece phase{value(3), value(0.2), value(1e-4), value(1e-6)};
    const int step = *rc::gen::inRange(1, 9);
    Quantum out;
    play(before, here, after, phase, step, out);
    for (int j = 0; j < kQuantumFrames; ++j) {
        const long double angle =
            step * (static_cast<long double>(phase.c0) +
                    j * (phase.c1 + j * (phase.c2 + j * static_cast<long double>(phase.c3))));
        long double sum = 0;
        const long double t = j / 64.0L;
        for (std::size_t n = 0; n < kMaxPartials; ++n) {
            const auto spline = [&](long double p, long double q, long double r) {
                return (1 - t) * (1 - t) / 2 * p + (0.5L + t - t * t) * q + t * t / 2 * r;
            };
            const long double re = spline(before.re[n], here.re[n], after.re[n]);
            const long double im = spline(before.im[n], here.im[n], after.im[n]);
            const auto order = static_cast<long double>(n + 1);
            sum += 2 * (re * std::cos(order * angle) - im * std::sin(order * angle));
        }
        RC_ASSERT(std::abs(static_cast<double>(sum) - out[static_cast<std::size_t>(j)]) < 1e-10);
    }
}

RC_GTEST_PROP(Peak, is_never_exceeded, ()) {
    Partials p;
    p.count = *rc::gen::inRange(1, 8);
    for (std::size_t n = 0; n < static_cast<std::size_t>(p.count); ++n) {
        p.re[n] = *rc::gen::inRange(-100, 101) / 100.0;
        p.im[n] = *rc::gen::inRange(-100, 101) / 100.0;
    }
    Quantum out;
    play(p, p, p, {*rc::gen::inRange(0, 628) / 100.0, 0.0981747704246810, 0, 0}, 1, out);
    for (const double v : out) RC_ASSERT(std::abs(v) <= p.peak() * (1 + 1e-12));
}

}  // namespace
}  // namespace tribo::sound
