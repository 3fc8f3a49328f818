// SPDX-License-Identifier: MIT
// The force over the displacement against a sum over many short edges.
#include "dynamics/cut_feedback.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"

namespace tribo::dynamics {
namespace {

const milling::CuttingCoefficients kForces{900, 300, 150, 0, 0, 0};

// Of one tooth that stands at `rotation_rad`, over discs of the cutter that are seen one by one.
Matrix3 by_discs(const milling::Cutter& cutter, const milling::EngagementBand& band, double rotation_rad) {
    constexpr int kDiscs = 200'000;
    const double corner = cutter.corner_radius_mm();
    Matrix3 sum{};
    // Discs of equal height on the cylinder; of equal length of edge on the rounded part.
    const auto add = [&](double z, double length, double kappa) {
        const double angle =
            rotation_rad - z * std::tan(cutter.helix_deg * math::kRadPerDeg) / cutter.radius_mm();
        const double turned = angle - math::kTwoPi * std::floor(angle / math::kTwoPi);
        if (z < band.z0_mm || z > band.z1_mm || turned < band.entry_rad || turned > band.exit_rad) return;
        const Vec3 radial{std::sin(angle), std::cos(angle), 0}, up{0, 0, 1};
        const Vec3 outward = std::sin(kappa) * radial - std::cos(kappa) * up;
        const Vec3 meridian = std::cos(kappa) * radial + std::sin(kappa) * up;
        const Vec3 along{std::cos(angle), -std::sin(angle), 0};
        const Vec3 force = length * (-kForces.ktc * along - kForces.krc * outward - kForces.kac * meridian);
        sum[0] += force.x * outward;
        sum[1] += force.y * outward;
        sum[2] += force.z * outward;
    };
    for (int n = 0; n < kDiscs; ++n) {
        const double share = (n + 0.5) / kDiscs, kappa = share * math::kHalfPi;
        if (corner > 0) add(corner * (1 - std::cos(kappa)), corner * math::kHalfPi / kDiscs, kappa);
        const double height = cutter.length_mm - corner;
        add(corner + share * height, height / kDiscs, math::kHalfPi);
    }
    return sum;
}

TEST(CutFeedback, is_the_sum_over_short_edges) {
    using milling::CutterKind;
    for (const CutterKind kind : {CutterKind::flat, CutterKind::bull, CutterKind::ball}) {
        for (const double helix : {0.0, 35.0, -35.0}) {
            const milling::Cutter cutter{.kind = kind,
                                         .diameter_mm = 8,
                                         .corner_mm = kind == CutterKind::bull ? 1.0 : 0.0,
                                         .flutes = 1,
                                         .helix_deg = helix,
                                         .length_mm = 25};
            // From the tip, across the end of the rounded part, and longer than a turn of the helix.
            for (const milling::EngagementBand band :
                 {milling::EngagementBand{0, 0.6, 0.2, 2}, {0.3, 6, 0.5, 3}, {2, 24, 0, 6}}) {
                const CutFeedback feedback(cutter, kForces, {&band, 1}, 6000);
                for (const double rotation : {0.4, 1.7, 2.9}) {
                    const Matrix3 found = feedback.stiffness(0, rotation / (100 * math::kTwoPi));
                    const Matrix3 expected = by_discs(cutter, band, rotation);
                    for (std::size_t row = 0; row < 3; ++row)
                        EXPECT_LT(length(found[row] - expected[row]), 0.5) << helix << " " << rotation;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tribo::dynamics
