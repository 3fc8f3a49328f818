// SPDX-License-Identifier: MIT
#include "sweep/distribution.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace tribo::sweep {
namespace {

// The share below a value of the normal distribution, by the error function of the C library.
double normal_share(double value) {
    return 0.5 * std::erfc(-value / std::sqrt(2.0));
}

TEST(Distribution, the_normal_quantile_inverts_the_error_function) {
    for (double below = 1e-12; below < 0.5; below *= 1.07) {
        EXPECT_NEAR(normal_share(normal_quantile(below)) / below, 1, 1e-12) << below;
        EXPECT_NEAR(normal_quantile(1 - below), -normal_quantile(below), 1e-3 * -normal_quantile(below))
            << below;
    }
    EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(Distribution, has_its_stated_share_below_each_quantile) {
    EXPECT_DOUBLE_EQ(quantile({DistributionKind::uniform, -2, 6}, 0.25), 0);
    EXPECT_NEAR(quantile({DistributionKind::normal, 10, 2}, normal_share(1.5)), 13, 1e-12);
    const Distribution forces{DistributionKind::lognormal, 800, 0.5};
    EXPECT_NEAR(quantile(forces, 0.5), 800, 1e-9);
    EXPECT_NEAR(quantile(forces, 0.05), 800 / 1.5, 1e-9);
    EXPECT_NEAR(quantile(forces, 0.95), 800 * 1.5, 1e-9);
}

}  // namespace
}  // namespace tribo::sweep
