// SPDX-License-Identifier: MIT
// The distance of stock after any passes against that of its shapes, asked one by one.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "milling/any_passes.hpp"

namespace tribo::milling {
namespace {

TEST(CarvedDistance, is_that_of_the_shape_that_leaves_least) {
    constexpr double kError = 2e-4;
    int near_surface = 0;
    for (std::uint64_t n = 0; n < 60; ++n) {
        test::Draw draw(94, n);
        const test::AnyPasses stock(draw, 0, n % 2 == 0);
        const double cell = stock.field->cell_mm();
        for (int k = 0; k < 20000; ++k) {
            const Vec3 p = draw.aside(12, -16, 0.5);
            double want = stock.shapes[0]->distance_mm(p);
            for (std::size_t s = 1; s < stock.shapes.size(); ++s)
                want = std::max(want, -stock.shapes[s]->distance_mm(p));
            const double got = stock.field->distance_mm(p);
            if (std::abs(want) > kError) {
                EXPECT_EQ(got > 0, want > 0) << n << " " << k << " " << want << " " << got;
            }
            EXPECT_LE(got, std::max(want + kError, field::FieldQuery::kClearCells * cell));
            if (std::abs(want) > 0.1 * cell) continue;
            EXPECT_NEAR(got, want, kError) << n << " " << k;
            ++near_surface;
        }
    }
    EXPECT_GT(near_surface, 5000);
}

}  // namespace
}  // namespace tribo::milling
