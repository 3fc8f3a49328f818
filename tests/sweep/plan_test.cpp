// SPDX-License-Identifier: MIT
#include "sweep/plan.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "sweep/sobol_sequence.hpp"

namespace tribo::sweep {
namespace {

// Of the first 2^m points, each of the 2^m equal cells holds one, in every dimension.
TEST(SobolSequence, fills_every_dimension_evenly) {
    for (std::size_t dimension = 0; dimension < kMostSobolDimensions; ++dimension) {
        for (const std::uint32_t count : {2u, 64u, 4096u}) {
            std::set<std::uint32_t> cells;
            for (std::uint32_t n = 0; n < count; ++n)
                cells.insert(static_cast<std::uint32_t>(sobol_coordinate(n, dimension) * count));
            EXPECT_EQ(cells.size(), count) << dimension;
        }
    }
}

// The points that Bratley and Fox 1988 begin with, in the order of their numbers, not of the Gray code.
TEST(SobolSequence, begins_as_published) {
    const double first[][2]{{0, 0}, {0.5, 0.5}, {0.25, 0.75}, {0.75, 0.25}, {0.125, 0.625}, {0.625, 0.125}};
    for (std::uint32_t n = 0; n < std::size(first); ++n) {
        EXPECT_NEAR(sobol_coordinate(n, 0), first[n][0], 1e-9) << n;
        EXPECT_NEAR(sobol_coordinate(n, 1), first[n][1], 1e-9) << n;
    }
}

// In two dimensions: the worst of all pairs is better than random points are on average.
TEST(SobolSequence, integrates_products_of_any_two_dimensions) {
    constexpr std::uint32_t kCount = 4096;
    std::vector<std::vector<double>> off(kMostSobolDimensions);
    for (std::size_t d = 0; d < off.size(); ++d) {
        for (std::uint32_t n = 0; n < kCount; ++n) off[d].push_back(sobol_coordinate(n, d) - 0.5);
    }
    double worst = 0;
    for (std::size_t a = 0; a < off.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::uint32_t n = 0; n < kCount; ++n) sum += off[a][n] * off[b][n];
            worst = std::max(worst, std::abs(sum / kCount));
        }
    }
    EXPECT_LT(worst, 1.0 / 12 / std::sqrt(kCount));
}

TEST(Plan, a_grid_has_every_combination_once) {
    const Plan plan{{{"a", {1.0, 2.0, 3.0}, {}}, {"b", {std::string("x"), std::string("y")}, {}}}};
    ASSERT_EQ(plan.cases(), 6u);
    std::set<std::vector<Value>> seen;
    for (std::uint64_t n = 0; n < plan.cases(); ++n) seen.insert(plan.values(n));
    EXPECT_EQ(seen.size(), 6u);
    EXPECT_EQ(plan.values(1), (std::vector<Value>{1.0, std::string("y")}));
    EXPECT_EQ(Plan{}.cases(), 1u);
    Plan huge;
    for (int n = 0; n < 70; ++n) huge.axes.push_back({"a", {1.0, 2.0}, {}});
    EXPECT_EQ(huge.cases(), std::uint64_t{1} << 63);
}

TEST(Plan, a_block_differs_from_its_first_case_in_one_axis_each) {
    Plan plan{{}, Design::sobol, 16};
    for (const char* key : {"a", "b", "c"}) plan.axes.push_back({key, {}, Distribution{}});
    ASSERT_EQ(plan.cases(), 80u);
    for (std::uint64_t point = 0; point < plan.points; ++point) {
        const auto a = plan.values(5 * point), b = plan.values(5 * point + 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto mixed = plan.values(5 * point + 2 + axis);
            EXPECT_EQ(mixed[axis], b[axis]);
            mixed[axis] = a[axis];
            EXPECT_EQ(mixed, a);
        }
    }
}

TEST(Plan, has_no_case_twice) {
    Plan plan{{}, Design::sobol, 64};
    for (const char* key : {"a", "b", "c", "d", "e"}) plan.axes.push_back({key, {}, Distribution{}});
    std::set<std::vector<Value>> seen;
    for (std::uint64_t n = 0; n < plan.cases(); ++n) seen.insert(plan.values(n));
    EXPECT_EQ(seen.size(), plan.cases());
}

TEST(Plan, values_of_a_list_are_equally_likely) {
    const Plan plan{{{"a", {1.0, 2.0, 3.0, 4.0}, {}}}, Design::sobol, 1024};
    int counts[5]{};
    for (std::uint64_t n = 0; n < plan.cases(); n += plan.block())
        ++counts[static_cast<int>(std::get<double>(plan.values(n)[0]))];
    for (int value = 1; value <= 4; ++value) EXPECT_EQ(counts[value], 256);
}

}  // namespace
}  // namespace tribo::sweep
