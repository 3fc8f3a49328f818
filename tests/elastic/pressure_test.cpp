// SPDX-License-Identifier: MIT
#include "elastic/pressure.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "elastic/pressure_share.hpp"

namespace tribo::elastic {
namespace {

using test::pressure_share;

// The law of the kernels, as its comment says it.
double law_share(ContactShape shape, double rho) {
    if (!(rho < kReach)) return 0;
    const ShareLaw law = share_law(shape);
    const double w = 1 - rho * rho / (kReach * kReach), x = rho - static_cast<double>(law.origin);
    const auto rising = [&](float rate) { return std::exp2(static_cast<double>(rate) * x); };
    if (rho <= static_cast<double>(law.edge))
        return w * w *
               (static_cast<double>(law.inner_base) +
                static_cast<double>(law.inner) * rising(law.inner_rate));
    return w * w * static_cast<double>(law.outer) * rising(law.outer_rate);
}

TEST(PressureShare, of_the_kernels_is_that_of_the_equations) {
    for (const ContactShape shape : {ContactShape::area, ContactShape::point}) {
        for (int i = 0; i <= 7000; ++i)
            EXPECT_NEAR(law_share(shape, 1e-3 * i), pressure_share(shape, 1e-3 * i), 1e-6);
    }
}

TEST(PressureShare, is_one_at_the_centre_and_falls_to_nothing_without_a_jump) {
    for (const ContactShape shape : {ContactShape::area, ContactShape::point}) {
        EXPECT_NEAR(law_share(shape, 0), 1, 1e-6);
        double before = 1;
        for (int i = 1; i <= 70'000; ++i) {
            const double share = law_share(shape, 1e-4 * i);
            EXPECT_LE(share, before + 1e-7);
            EXPECT_LT(before - share, 1.3e-4);  // the steepest slope is that of a point's tip, 1.26
            before = share;
        }
        EXPECT_EQ(before, 0);
    }
}

TEST(PressureShare, has_no_kink_at_the_edge_of_the_contact) {
    const auto slope = [](double rho) {
        return (law_share(ContactShape::area, rho + 1e-7) - law_share(ContactShape::area, rho - 1e-7)) / 2e-7;
    };
    EXPECT_NEAR(slope(1 - 1e-5), slope(1 + 1e-5), 2e-3);
    EXPECT_NEAR(slope(kReach - 1e-5), 0, 1e-6);
}

// Figure 3 of the paper: R_th 0.25, so that R_max is 10.
TEST(PublishedPressure, follows_equations_1_and_2) {
    const auto p = [](double d, double t) { return published_pressure(ContactShape::area, d, t, 0.25); };
    EXPECT_NEAR(p(0, 0.5), (std::exp(-5) - 1) / 10 - 0.5, 1e-12);
    EXPECT_NEAR(p(0.25, 0.5), -0.5, 1e-12);
    EXPECT_NEAR(p(1.25, 0.5), -std::exp(-5 / (10 * 0.5)) * 0.48, 1e-12);
    EXPECT_NEAR(p(10, 2), -std::exp(-5 * 9.75 / 20) * 1.98, 1e-12);
    EXPECT_EQ(p(10.001, 2), 0);
}

TEST(PublishedPressure, keeps_the_quirks_of_the_print) {
    const auto p = [](double d, double t) { return published_pressure(ContactShape::area, d, t, 6); };
    EXPECT_NEAR(p(6.000001, 1) - p(6, 1), 0.02, 1e-5);  // the jump of 1/50 at R_th
    EXPECT_GT(p(6.5, 0.01), 0);                         // lifted for t < 1/50
    EXPECT_EQ(p(6.5, 0), 0);                            // 0/0 in print
    EXPECT_NEAR(p(0, 0), -0.0993, 1e-4);                // a tenth at once
    EXPECT_LT(p(0, 1e4), -1e4);                         // growth without bound
}

TEST(PublishedPressure, point_is_the_limit_of_a_small_contact) {
    // R_th -> 0 with R_max kept, and t far above 1/50.
    const double t = 100, reach = kPublishedReach * 6;
    for (const double d : {0.5, 5.0, 100.0}) {
        EXPECT_NEAR(published_pressure(ContactShape::point, d, t, 6), -std::exp(-5 * d / (reach * t)) * t,
                    1e-12);
    }
    EXPECT_EQ(published_pressure(ContactShape::point, 1, 0, 6), 0);
    EXPECT_EQ(published_pressure(ContactShape::point, reach + 1, t, 6), 0);
}

}  // namespace
}  // namespace tribo::elastic
