// SPDX-License-Identifier: MIT
#include "dynamics/beam.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "dynamics/shot_beam.hpp"

namespace tribo::dynamics {
namespace {

constexpr BeamMaterial kSteel{210e3, 0.3, 7.85e-9}, kCarbide{600e3, 0.22, 14.5e-9};
constexpr BeamJoint kClamp{1e12, 1e15};

double inertia_mm4(double diameter_mm) {
    return math::kPi / 64 * std::pow(diameter_mm, 4);
}

TEST(Beam, has_the_modes_of_a_slender_cantilever) {
    // Euler and Bernoulli: cos b cosh b = -1; every modal mass at the tip is a quarter of the beam's.
    constexpr double kLength = 1000, kDiameter = 1;
    const BeamPart part{{{kDiameter, kLength, kSteel}}, kClamp};
    const auto modes = bending_modes({&part, 1}, 4);
    ASSERT_EQ(modes.size(), 4u);
    const double ei = kSteel.young_n_per_mm2 * inertia_mm4(kDiameter);
    const double mass = kSteel.density_t_per_mm3 * math::kPi / 4 * kDiameter * kDiameter * kLength;
    const double roots[] = {1.875104068712, 4.694091132974, 7.854757438238, 10.995540734875};
    for (std::size_t n = 0; n < 4; ++n) {
        const double w = roots[n] * roots[n] * std::sqrt(ei / (mass * std::pow(kLength, 3)));
        EXPECT_NEAR(modes[n].frequency_hz / (w / math::kTwoPi), 1, 1e-4) << n;
        EXPECT_NEAR(modes[n].stiffness_n_per_mm / (mass / 4 * w * w), 1, 1e-3) << n;
    }
}

TEST(Beam, yields_as_much_in_all_its_modes_as_under_a_resting_load) {
    constexpr double kLength = 1000, kDiameter = 2.5;
    const BeamPart part{{{kDiameter, kLength, kSteel}}, kClamp};
    double yields = 0;
    for (const BendingMode& mode : bending_modes({&part, 1}, 8)) yields += 1 / mode.stiffness_n_per_mm;
    EXPECT_NEAR(yields * 3 * kSteel.young_n_per_mm2 * inertia_mm4(kDiameter) / std::pow(kLength, 3), 1, 2e-4);
}

TEST(Beam, yields_with_steps_shear_and_joints_as_the_unit_load_says) {
    const BeamPart tool{{{8, 20, kCarbide}, {6, 15, kCarbide}, {10, 12, kCarbide}}, {20e3, 5e7}};
    const BeamPart holder{{{24, 30, kSteel}, {40, 35, kSteel}}, {50e3, 4e8}};
    const BeamPart parts[] = {tool, holder};
    double expected = 0, height = 0;
    for (const BeamPart& part : parts) {
        for (const BeamSection& s : part.sections) {
            const double top = height + s.length_mm, e = s.material.young_n_per_mm2, nu = s.material.poisson;
            const double area = math::kPi / 4 * s.diameter_mm * s.diameter_mm;
            expected += (std::pow(top, 3) - std::pow(height, 3)) / (3 * e * inertia_mm4(s.diameter_mm));
            expected += s.length_mm * (7 + 6 * nu) / (6 * (1 + nu)) * 2 * (1 + nu) / (e * area);
            height = top;
        }
        expected += 1 / part.joint.across_n_per_mm + height * height / part.joint.turn_nmm_per_rad;
    }
    double yields = 0;
    for (const BendingMode& mode : bending_modes(parts, 30)) yields += 1 / mode.stiffness_n_per_mm;
    EXPECT_NEAR(yields / expected, 1, 2e-3);
}

TEST(Beam, resonates_where_its_equations_do_integrated_without_elements) {
    const BeamPart stubby{{{20, 50, kSteel}}, kClamp};
    const BeamPart tool{{{8, 20, kCarbide}, {6, 15, kCarbide}, {10, 12, kCarbide}}, {20e3, 5e8}};
    const BeamPart holder{{{24, 30, kSteel}, {40, 35, kSteel}}, {50e3, 1.5e9}};
    for (const std::vector<BeamPart>& parts : {std::vector{stubby}, std::vector{tool, holder}}) {
        for (const BendingMode& mode : bending_modes(parts, 4)) {
            double below = 0.9998 * mode.frequency_hz, above = 1.0002 * mode.frequency_hz;
            ASSERT_GT(test::tip_receptance(parts, below), 0);
            ASSERT_LT(test::tip_receptance(parts, above), 0);
            for (int n = 0; n < 50; ++n) {
                const double middle = 0.5 * (below + above);
                (test::tip_receptance(parts, middle) > 0 ? below : above) = middle;
            }
            EXPECT_NEAR(mode.frequency_hz / below, 1, 1e-4) << mode.frequency_hz;
            // A mode alone answers with 1 / (k (1 - r^2)); the others with the same on both sides.
            constexpr double kAside = 1e-4;
            const double jump = test::tip_receptance(parts, (1 - kAside) * below) -
                                test::tip_receptance(parts, (1 + kAside) * below);
            EXPECT_NEAR(mode.stiffness_n_per_mm * kAside * jump, 1, 2e-3) << mode.frequency_hz;
        }
    }
}

}  // namespace
}  // namespace tribo::dynamics
