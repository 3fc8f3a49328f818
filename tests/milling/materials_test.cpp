// SPDX-License-Identifier: MIT
#include "milling/tool/materials.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <set>

namespace tribo::milling {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

// Ti6Al4V out of its orthogonal data, rake 12, helix 30 degrees: an independent calculation, rounded to 1
// N/mm2.
TEST(Coefficients, oblique_transformation_gives_the_known_values_for_titanium) {
    const OrthogonalData titanium{.shear_stress_n_per_mm2 = 613,
                                  .ratio = 1.755,
                                  .ratio_per_deg = -0.028,
                                  .exponent = 0.331,
                                  .exponent_per_deg = -0.0082,
                                  .friction_deg = 19.1,
                                  .friction_deg_per_deg = 0.29,
                                  .kte = 24,
                                  .kre = 43};
    const double known[][4] = {
        {0.0127, 1681, 239, 573}, {0.025, 1571, 223, 536}, {0.05, 1510, 215, 515}, {0.1, 1503, 214, 513}};
    for (const auto& row : known) {
        const CuttingCoefficients k =
            oblique_coefficients(titanium, 12 * kRadPerDeg, 30 * kRadPerDeg, row[0]);
        EXPECT_NEAR(k.ktc, row[1], 0.5);
        EXPECT_NEAR(k.krc, row[2], 0.5);
        EXPECT_NEAR(k.kac, row[3], 0.5);
        EXPECT_EQ(k.kte, 24);
        EXPECT_EQ(k.kre, 43);
    }
}

// Merchant's orthogonal limit: at inclination 0 nothing is axial, and Kr / Kt = tan(friction - rake).
TEST(Coefficients, oblique_transformation_without_inclination_is_orthogonal) {
    const OrthogonalData d{.shear_stress_n_per_mm2 = 500, .ratio = 0.5, .friction_deg = 30};
    const CuttingCoefficients k = oblique_coefficients(d, 10 * kRadPerDeg, 0, 0.1);
    EXPECT_NEAR(k.kac, 0, 1e-9);
    EXPECT_NEAR(k.krc / k.ktc, std::tan(20 * kRadPerDeg), 1e-12);
    const double shear = std::atan(0.5 * std::cos(10 * kRadPerDeg) / (1 - 0.5 * std::sin(10 * kRadPerDeg)));
    EXPECT_NEAR(
        k.ktc, 500 * std::cos(20 * kRadPerDeg) / (std::sin(shear) * std::cos(shear + 20 * kRadPerDeg)), 1e-9);
}

TEST(Coefficients, what_cannot_cut_is_refused) {
    EXPECT_TRUE(check(CuttingCoefficients{.ktc = 700}));
    EXPECT_FALSE(check(CuttingCoefficients{}));
    EXPECT_FALSE(check(CuttingCoefficients{.ktc = -700}));
    EXPECT_FALSE(check(CuttingCoefficients{.ktc = 700, .kte = -1}));
    EXPECT_FALSE(check(CuttingCoefficients{.ktc = 700, .kae = std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_TRUE(check(CuttingCoefficients{.ktc = 700, .krc = -50}));
}

TEST(Materials, each_has_its_own_name_a_source_and_a_band_around_its_value) {
    std::set<std::string> names;
    for (const WorkpieceMaterial& m : materials()) {
        EXPECT_TRUE(names.insert(m.name).second) << m.name;
        EXPECT_TRUE(check(m.coefficients)) << m.name;
        EXPECT_FALSE(m.source.empty() || m.what.empty()) << m.name;
        EXPECT_LE(m.spread_low, 1) << m.name;
        EXPECT_GE(m.spread_high, 1) << m.name;
        // Without a calibration no better than a factor of two from end to end.
        EXPECT_GE(m.spread_high / m.spread_low, 2) << m.name;
        // An assumed value is said to be assumed.
        const bool doubtful = m.coefficients.kac == 0 || m.confidence == Confidence::suspect;
        EXPECT_TRUE(!doubtful || !m.note.empty()) << m.name;
    }
    for (const char* name :
         {"al7075-t6", "al7075-hss", "al7075", "al6061-t6", "al6082-t6", "ti6al4v", "gh909"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
}

TEST(Materials, spread_of_al7075_is_the_one_between_its_sources) {
    const WorkpieceMaterial m = find_material("al7075-t6").value();
    EXPECT_EQ(m.coefficients.ktc, 767.01);
    EXPECT_EQ(m.coefficients.kae, 0.7);
    EXPECT_NEAR(m.coefficients.ktc * m.spread_low, 600, 1);
    EXPECT_NEAR(m.coefficients.ktc * m.spread_high, 1319, 1);
}

TEST(Materials, an_unknown_name_is_answered_with_the_nearest) {
    const auto typo = find_material("al7075-t66");
    ASSERT_FALSE(typo);
    EXPECT_NE(typo.error().cause.find("al7075-t66"), std::string::npos);
    EXPECT_NE(typo.error().remedy.find("'al7075-t6'"), std::string::npos) << typo.error().remedy;
    const auto strange = find_material("unobtainium-xyz-1234");
    ASSERT_FALSE(strange);
    EXPECT_NE(strange.error().remedy.find("gh909"), std::string::npos) << strange.error().remedy;
    EXPECT_FALSE(find_material(""));
}

}  // namespace
}  // namespace tribo::milling
