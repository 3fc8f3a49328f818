// SPDX-License-Identifier: MIT
#include "milling/force/published_force.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "milling/force/force.hpp"
#include "reference_cases.hpp"

namespace tribo::milling {
namespace {

using reference::kPi;
using reference::rad;

constexpr PublishedCut kCut{
    .radius_mm = 6, .feed_per_tooth_mm = 0.1, .helix_rad = 30 * kPi / 180, .kt_n_per_mm2 = 800, .eta_r = 0.3};

Vec3 one_flute(PublishedForm form, const PublishedCut& cut, double entry_deg, double exit_deg) {
    const FluteSpan span{rad(entry_deg), rad(exit_deg)};
    return published_force(form, cut, {&span, 1});
}

// docs/printed-model.md: the corrected force, N, and the print with one R f taken out, (feed, axis, normal).
TEST(PublishedForce, table_of_printed_and_corrected_is_met) {
    const struct {
        double entry, exit;
        Vec3 corrected, printed;
    } rows[] = {
        {20, 60, {-347.600, 211.052, 152.654}, {301.0, 211.1, 290.1}},
        {30, 120, {-558.748, 655.692, 940.968}, {483.9, 655.7, 939.6}},
        {0, 90, {-641.887, 480.000, 508.968}, {555.9, 480.0, 690.2}},
        {90, 170, {177.470, 472.708, 791.161}, {-153.7, 472.7, 443.3}},
        {0, 180, {-452.389, 960.000, 1305.936}, {391.8, 960.0, 1131.0}},
    };
    for (const auto& row : rows) {
        const Vec3 corrected = one_flute(PublishedForm::corrected, kCut, row.entry, row.exit);
        const Vec3 printed = one_flute(PublishedForm::printed, kCut, row.entry, row.exit) /
                             (kCut.radius_mm * kCut.feed_per_tooth_mm);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(corrected[i], row.corrected[i], 0.0005) << row.entry;
            EXPECT_NEAR(printed[i], row.printed[i], 0.05) << row.entry;
        }
    }
}

// Ktc = Kt, Krc = eta Kt / cos(helix), Kac = -Kt tan(helix), as the paper's axial force points to the shank:
// the same force as the engine's closed form.
TEST(PublishedForce, corrected_is_the_engines_force_with_these_coefficients) {
    const CuttingCoefficients k{
        .ktc = 800, .krc = 240 / std::cos(kCut.helix_rad), .kac = -800 * std::tan(kCut.helix_rad)};
    for (const auto& [entry, exit] : {std::pair{20.0, 60.0}, {0.0, 180.0}, {90.0, 170.0}}) {
        const double height = 6 * rad(exit - entry) / std::tan(kCut.helix_rad);
        const Vec3 f = flute_segment_force(k, 6, 0.1, rad(entry), rad(exit), height).force_n;
        const Vec3 published = one_flute(PublishedForm::corrected, kCut, entry, exit);
        EXPECT_NEAR(published.x, f.x, 1e-9);
        EXPECT_NEAR(published.y, f.z, 1e-9);
        EXPECT_NEAR(published.z, f.y, 1e-9);
    }
}

// In-plane force over chip area must not depend on where the tooth stands; as printed it changes
// by (cos helix + eta) / (cos helix - eta) = 2.06, the ratio of the in-plane matrix's eigenvalues.
TEST(PublishedForce, printed_signs_make_the_pressure_turn_with_the_tool) {
    const auto ratio_over_a_turn = [](PublishedForm form) {
        double low = 1e9, high = 0;
        for (double phi = 1; phi < 179; phi += 0.25) {
            const Vec3 f = one_flute(form, kCut, phi - 1e-3, phi + 1e-3);
            const double pressure = std::hypot(f.x, f.z) / std::sin(rad(phi));
            low = std::min(low, pressure);
            high = std::max(high, pressure);
        }
        return high / low;
    };
    const double eigenvalues = (std::cos(kCut.helix_rad) + 0.3) / (std::cos(kCut.helix_rad) - 0.3);
    EXPECT_NEAR(ratio_over_a_turn(PublishedForm::printed), eigenvalues, 1e-4);
    EXPECT_NEAR(ratio_over_a_turn(PublishedForm::corrected), 1, 1e-6);
}

// With one R f taken out the tangential part is still off by 1 / (2 tan helix).
TEST(PublishedForce, printed_factor_is_wrong_by_half_the_cotangent_of_the_helix) {
    for (const auto& [helix_deg, factor] : {std::pair{30.0, 0.866}, {10.0, 2.836}}) {
        PublishedCut cut = kCut;
        cut.helix_rad = rad(helix_deg);
        cut.eta_r = 0;
        const Vec3 corrected = one_flute(PublishedForm::corrected, cut, 30, 120);
        const Vec3 printed = one_flute(PublishedForm::printed, cut, 30, 120) / 0.6;
        EXPECT_NEAR(printed.z / corrected.z, factor, 0.0005);
        EXPECT_NEAR(-printed.x / corrected.x, factor, 0.0005);  // and a sign
        EXPECT_NEAR(printed.y, corrected.y, 1e-9);
    }
}

TEST(PublishedForce, over_a_turn_corrected_is_the_engine_without_edge_forces) {
    reference::Cut c = reference::cases()[1].cut;
    c.k.kte = c.k.kre = c.k.kae = 0;
    c.k.kac = -c.k.ktc * std::tan(rad(30));
    EngagedEdges edges(c.cutter, c.k);
    edges.engage(c.engagement, c.feed);
    const PublishedCut cut = published_cut(c.cutter, c.k, c.feed.across_mm).value();
    for (int i = 0; i < 50; ++i) {
        const Vec3 f = published_force_at(PublishedForm::corrected, cut, edges, 0.13 * i);
        EXPECT_LT(length(f - force_at(edges, 0.13 * i).force_n), 1e-9);
    }
    const ForcePeaks published = published_peaks(PublishedForm::corrected, cut, edges),
                     ours = PeakFinder().find(edges);
    EXPECT_NEAR(published.peak_xy_n, ours.peak_xy_n, 0.1);
    EXPECT_NEAR(published.peak_force_n, ours.peak_force_n, 0.1);
    EXPECT_LT(length(published.mean_n - ours.mean_n), 0.01);
}

TEST(PublishedForce, refuses_what_it_cannot_do) {
    const CuttingCoefficients k{.ktc = 800};
    EXPECT_FALSE(published_cut(Cutter{.kind = CutterKind::ball}, k, 0.1));
    const auto straight = published_cut(Cutter{.helix_deg = 0}, k, 0.1);
    ASSERT_FALSE(straight);
    EXPECT_NE(straight.error().remedy.find("helix_deg"), std::string::npos);
}

}  // namespace
}  // namespace tribo::milling
