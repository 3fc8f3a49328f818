// SPDX-License-Identifier: MIT
#include "sweep/sensitivity.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "base/math.hpp"
#include "sweep/plan.hpp"

namespace tribo::sweep {
namespace {

template <class F>
Sensitivity sensitivity_of(const Plan& plan, const F& f) {
    Sensitivity result(plan.axes.size());
    std::vector<double> block, x;
    for (std::uint64_t n = 0; n < plan.cases(); ++n) {
        x.clear();
        for (const Value& value : plan.values(n)) x.push_back(std::get<double>(value));
        block.push_back(f(x));
        if (block.size() < plan.block()) continue;
        result.add(block);
        block.clear();
    }
    return result;
}

// Ishigami and Homma 1990 with a = 7, b = 0.1; the closed forms of its variances are in Saltelli et al. 2000.
TEST(Sensitivity, of_the_ishigami_function_within_two_hundredths) {
    Plan plan{{}, Design::sobol, 4000};  // 20,000 cases
    for (const char* key : {"x", "y", "z"})
        plan.axes.push_back({key, {}, Distribution{DistributionKind::uniform, -math::kPi, math::kPi}});
    const auto result = sensitivity_of(plan, [](const std::vector<double>& x) {
        const double s = std::sin(x[1]);
        return std::sin(x[0]) * (1 + 0.1 * std::pow(x[2], 4)) + 7 * s * s;
    });
    const double pi4 = std::pow(math::kPi, 4);
    const double x = 0.5 * std::pow(1 + 0.1 * pi4 / 5, 2), y = 49.0 / 8,
                 xz = 0.01 * pi4 * pi4 * (1.0 / 18 - 1.0 / 50), all = x + y + xz;
    EXPECT_NEAR(result.mean(), 3.5, 0.02);
    EXPECT_NEAR(result.variance() / all, 1, 0.02);
    const auto indices = result.indices();
    EXPECT_NEAR(indices[0].first, x / all, 0.02);
    EXPECT_NEAR(indices[1].first, y / all, 0.02);
    EXPECT_NEAR(indices[2].first, 0, 0.02);
    EXPECT_NEAR(indices[0].total, (x + xz) / all, 0.02);
    EXPECT_NEAR(indices[1].total, y / all, 0.02);
    EXPECT_NEAR(indices[2].total, xz / all, 0.02);
}

// The offset of a result has no influence, and a block with a failed case is left out.
TEST(Sensitivity, of_a_sum_is_the_share_of_each_variance) {
    Plan plan{{}, Design::sobol, 2048};
    plan.axes.push_back({"a", {}, Distribution{DistributionKind::normal, 0, 3}});
    plan.axes.push_back({"b", {}, Distribution{DistributionKind::normal, 0, 4}});
    auto result = sensitivity_of(plan, [](const std::vector<double>& x) { return 1e6 + x[0] + x[1]; });
    result.add(std::vector<double>{1, std::nan(""), 3, 4});
    EXPECT_EQ(result.blocks(), 2048u);
    const auto indices = result.indices();
    EXPECT_NEAR(indices[0].first, 0.36, 0.01);
    EXPECT_NEAR(indices[1].first, 0.64, 0.01);
    EXPECT_NEAR(indices[0].total, 0.36, 0.01);
    EXPECT_NEAR(indices[1].total, 0.64, 0.01);
}

TEST(Sensitivity, of_a_constant_is_nothing) {
    Plan plan{{{"a", {}, Distribution{}}}, Design::sobol, 100};
    const auto result = sensitivity_of(plan, [](const std::vector<double>&) { return 0.1; });
    EXPECT_EQ(result.indices()[0].first, 0);
    EXPECT_EQ(result.indices()[0].total, 0);
}

}  // namespace
}  // namespace tribo::sweep
