// SPDX-License-Identifier: MIT
// Modes that are known, made to a response, and found again.
#include "dynamics/mode_fit.hpp"

#include <gtest/gtest.h>

#include "dynamics/made_response.hpp"

namespace tribo::dynamics {
namespace {

// Two modes 5 to 10 % apart and one far from them, of 150 to 4000 Hz, with dampings of 1 to 4 % and
// stiffnesses within a factor of 4.
std::vector<FittedMode> random_modes(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    const auto between = [&](double low, double high) { return low * std::pow(high / low, share(random)); };
    const double first = between(330, 1900), apart = 1 + between(0.05, 0.1), k = between(1e3, 1e4);
    const double far = share(random) < 0.5 ? 0.45 : 1.9;
    std::vector<FittedMode> modes;
    for (const double hz : {first, first * apart, far * first * apart})
        modes.push_back({hz, between(0.01, 0.04), between(0.5, 2) * k});
    std::ranges::sort(modes, {}, &FittedMode::frequency_hz);
    return modes;
}

void expect_modes(const Result<ModeFit>& fit, std::span<const FittedMode> modes, double frequency,
                  double stiffness, double damping) {
    ASSERT_TRUE(fit) << fit.error().text();
    ASSERT_EQ(fit->modes.size(), modes.size());
    for (std::size_t n = 0; n < modes.size(); ++n) {
        const FittedMode &found = fit->modes[n], &made = modes[n];
        EXPECT_NEAR(found.frequency_hz / made.frequency_hz, 1, frequency) << made.frequency_hz;
        EXPECT_NEAR(found.stiffness_n_per_mm / made.stiffness_n_per_mm, 1, stiffness) << made.frequency_hz;
        EXPECT_NEAR(found.damping_ratio / made.damping_ratio, 1, damping) << made.frequency_hz;
    }
}

std::string refusal_of(const MadeResponse& made, const ModeFitOptions& options = {}) {
    const auto fit = fit_modes(made.hz, made.h, options);
    EXPECT_FALSE(fit) << fit->modes.size() << " modes, the first of " << fit->modes[0].frequency_hz << " Hz";
    return fit ? "" : fit.error().text();
}

TEST(ModeFit, is_exact_without_noise) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const auto modes = random_modes(seed);
        const MadeResponse made = made_of(modes, 2, 5000, 2);
        const auto fit = fit_modes(made.hz, made.h);
        expect_modes(fit, modes, 1e-9, 1e-6, 1e-6);
        EXPECT_LT(fit->residual, 1e-9);
    }
}

// At the resolutions of a tap test.
TEST(ModeFit, finds_two_close_modes_and_a_far_one_in_noise_of_2_percent) {
    for (const double step_hz : {1.0, 2.0, 4.0}) {
        for (unsigned seed = 0; seed < 10; ++seed) {
            SCOPED_TRACE(std::to_string(step_hz) + " Hz, seed " + std::to_string(seed));
            const auto modes = random_modes(100 + seed);
            MadeResponse made = made_of(modes, step_hz, 5000, step_hz);
            made.add_noise(0.02, 0, seed);
            const auto fit = fit_modes(made.hz, made.h);
            expect_modes(fit, modes, 0.003, 0.04, 0.06);
            EXPECT_NEAR(fit->residual, 0.02, 0.01);
        }
    }
}

// Noise of 2 % of the largest value at every frequency is a tenth of the response.
TEST(ModeFit, finds_them_in_noise_that_is_even_over_frequency) {
    const std::vector<FittedMode> modes{{800, 0.02, 2000}, {868, 0.025, 2500}, {1900, 0.015, 4000}};
    for (unsigned seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(seed);
        MadeResponse made = made_of(modes, 1, 5000, 1);
        made.add_noise(0, 0.02, seed);
        const auto fit = fit_modes(made.hz, made.h);
        expect_modes(fit, modes, 0.003, 0.04, 0.06);
        EXPECT_NEAR(fit->residual, 0.1, 0.02);
    }
}

TEST(ModeFit, weighs_what_was_measured_by_an_accelerometer) {
    for (unsigned seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const auto modes = random_modes(200 + seed);
        // At 1 Hz this noise is far above the response.
        MadeResponse made = made_of(modes, 1, 5000, 1);
        made.add_noise(0.02, 0.0005, seed, 2);
        expect_modes(fit_modes(made.hz, made.h, {.derivatives = 2}), modes, 0.003, 0.04, 0.06);
    }
}

TEST(ModeFit, knows_other_signs) {
    const std::vector<FittedMode> modes{{922, 0.011, 1340}, {1400, 0.02, 4000}};
    for (const bool time : {false, true}) {
        for (const bool force : {false, true}) {
            MadeResponse made = made_of(modes, 2, 3000, 2);
            made.add_noise(0.02, 0.002, 3);
            for (auto& h : made.h) h = (force ? -1.0 : 1.0) * (time ? std::conj(h) : h);
            const auto fit = fit_modes(made.hz, made.h);
            expect_modes(fit, modes, 0.003, 0.04, 0.06);
            EXPECT_EQ(fit->other_time_sign, time);
            EXPECT_EQ(fit->other_force_sign, force);
        }
    }
}

// What lies outside the band bends too, as a constant and as a line of mass.
TEST(ModeFit, keeps_to_the_band) {
    const std::vector<FittedMode> modes{{60, 0.03, 30000}, {922, 0.011, 1340}, {4800, 0.02, 900}};
    MadeResponse made = made_of(modes, 2, 6000, 2);
    made.add_noise(0.01, 0, 1);
    const auto fit = fit_modes(made.hz, made.h, {.from_hz = 500, .to_hz = 1500});
    expect_modes(fit, std::span(modes).subspan(1, 1), 0.003, 0.04, 0.06);
    EXPECT_EQ(fit->from_hz, 500);
    EXPECT_EQ(fit->to_hz, 1500);
    EXPECT_EQ(fit->points, 501u);
    // A mode may lie at the edge.
    const auto edge = fit_modes(made.hz, made.h, {.from_hz = 915, .to_hz = 1500});
    ASSERT_TRUE(edge) << edge.error().text();
    EXPECT_NEAR(edge->modes[0].frequency_hz, 922, 3);
}

TEST(ModeFit, averages_a_fine_response) {
    const std::vector<FittedMode> modes{{700, 0.01, 2000}, {1900, 0.02, 3000}};
    MadeResponse made = made_of(modes, 0.1, 5000, 0.1);
    made.add_noise(0.02, 0.01, 9);
    const auto fit = fit_modes(made.hz, made.h);
    expect_modes(fit, modes, 0.001, 0.01, 0.015);
    EXPECT_EQ(fit->points, 49999u);
}

TEST(ModeFit, fits_as_many_modes_as_are_asked_for) {
    const std::vector<FittedMode> modes{{700, 0.01, 2000}, {1900, 0.02, 3000}, {3100, 0.02, 900000}};
    MadeResponse made = made_of(modes, 2, 5000, 2);
    made.add_noise(0, 1e-6, 1);
    // The third is far below a hundredth of the largest.
    expect_modes(fit_modes(made.hz, made.h), std::span(modes).first(2), 1e-3, 1e-3, 1e-2);
    expect_modes(fit_modes(made.hz, made.h, {.modes = 3}), modes, 1e-2, 1e-2, 1e-2);
    const auto one = fit_modes(made.hz, made.h, {.modes = 1});
    ASSERT_TRUE(one) << one.error().text();
    EXPECT_EQ(one->modes.size(), 1u);
    EXPECT_GT(one->residual, 0.1);
}

TEST(ModeFit, gives_the_same_bits_again) {
    MadeResponse made = made_of(random_modes(1), 2, 3000, 2);
    made.add_noise(0.02, 0.01, 1);
    const auto one = fit_modes(made.hz, made.h), again = fit_modes(made.hz, made.h);
    ASSERT_TRUE(one && again);
    EXPECT_EQ(one->modes[0].stiffness_n_per_mm, again->modes[0].stiffness_n_per_mm);
    EXPECT_EQ(one->residual, again->residual);
}

TEST(ModeFit, refuses_noise) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        MadeResponse made = made_of({}, 2, 4000, 2);
        for (auto& h : made.h) h = 0.001;
        made.add_noise(1, 0, seed);
        EXPECT_NE(refusal_of(made).find("no mode stands out of the response from 2 to 4000 Hz"),
                  std::string::npos);
    }
}

TEST(ModeFit, refuses_the_noise_of_an_accelerometer) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        MadeResponse made = made_of({}, 2, 4000, 2);
        for (std::size_t n = 0; n < made.h.size(); ++n) made.h[n] = 1 / (made.hz[n] * made.hz[n]);
        made.add_noise(1, 0, seed);
        EXPECT_NE(refusal_of(made, {.derivatives = 2}).find("no mode stands out"), std::string::npos);
    }
}

TEST(ModeFit, refuses_what_is_flat_empty_or_short) {
    MadeResponse flat = made_of({}, 2, 4000, 2);
    EXPECT_NE(refusal_of(flat).find("the response is 0 at 2000 of 2000 frequencies"), std::string::npos);
    for (std::size_t n = 0; n < 900; ++n) flat.h[n] = {1e-4, -1e-5};
    EXPECT_NE(refusal_of(flat).find("the response is 0 at 1100 of 2000"), std::string::npos);
    for (auto& h : flat.h) h = {1e-4, -1e-5};
    EXPECT_NE(refusal_of(flat).find("no mode stands out"), std::string::npos);
    for (std::size_t n = 0; n < flat.h.size(); ++n) flat.h[n] = -5 / (flat.hz[n] * flat.hz[n]);
    EXPECT_NE(refusal_of(flat).find("no mode stands out"), std::string::npos);
    const std::vector<FittedMode> one{{900, 0.01, 1000}};
    const MadeResponse made = made_of(one, 2, 4000, 2);
    EXPECT_NE(refusal_of(made, {.from_hz = 5000, .to_hz = 6000}).find("the band has 0 points"),
              std::string::npos);
    EXPECT_NE(refusal_of(made, {.from_hz = 890, .to_hz = 910}).find("the band has 11 points, too few"),
              std::string::npos);
    // Too stiff to be computed with.
    MadeResponse stiff = made_of(one, 2, 4000, 2);
    for (auto& h : stiff.h) h *= 1e-300;
    EXPECT_FALSE(refusal_of(stiff).empty());
}

}  // namespace
}  // namespace tribo::dynamics
