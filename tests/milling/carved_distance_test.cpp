// SPDX-License-Identifier: MIT
// The distance of stock after passes of all kinds against that of its shapes, asked one by one.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "base/noise_hash.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::milling {
namespace {

// Passes of cutters of all kinds, one in two with an axis that leans, one in four with one that turns.
std::unique_ptr<const field::Shape> any_pass(const CounterNoise& noise, std::uint64_t& drawn) {
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    const auto aside = [&](double most) { return Vec3{between(-most, most), between(-most, most), 0}; };
    constexpr CutterKind kKinds[] = {CutterKind::flat, CutterKind::bull, CutterKind::ball};
    Cutter cutter;
    cutter.kind = kKinds[static_cast<std::size_t>(between(0, 3))];
    cutter.diameter_mm = between(1, 9);
    cutter.length_mm = 60;
    if (cutter.kind == CutterKind::bull) cutter.corner_mm = between(0.1, 0.45) * cutter.diameter_mm;
    motion::Move move;
    const Vec3 middle = aside(5) + Vec3{0, 0, between(-12, -1)},
               half = between(1.5, 10) * normalized(aside(1), Vec3{1, 0, 0});
    const double leans = between(0, 1) < 0.5 ? 0.4 : 0, turns = between(0, 1) < 0.25 ? 0.2 : 0;
    move.start = {middle - half, normalized(Vec3{0, 0, 1} + aside(leans))};
    move.end = {middle + half, normalized(move.start.axis + aside(turns))};
    return make_sweep(cutter, move);
}

TEST(CarvedDistance, is_that_of_the_shape_that_leaves_least) {
    constexpr double kError = 2e-4;
    const CounterNoise noise(95);
    int near_surface = 0;
    for (std::uint64_t n = 0; n < 60; ++n) {
        std::uint64_t drawn = 1000000 * n;
        const auto between = [&](double low, double high) {
            return low + (high - low) * noise.uniform(drawn++);
        };
        const double cell = between(0.2, 0.7), passes = between(2, 9);
        const auto blank = [] {
            return std::make_unique<field::BoxShape>(Box3{{-15, -15, -20}, {15, 15, 0}});
        };
        field::CarvedField field(blank(), cell);
        std::vector<std::unique_ptr<const field::Shape>> shapes;
        for (int k = 0; k < passes; ++k) {
            std::uint64_t same = drawn;
            shapes.push_back(any_pass(noise, same));
            field.carve(any_pass(noise, drawn));
        }
        for (int k = 0; k < 20000; ++k) {
            const Vec3 p{between(-12, 12), between(-12, 12), between(-16, 0.5)};
            double want = blank()->distance_mm(p);
            for (const auto& shape : shapes) want = std::max(want, -shape->distance_mm(p));
            const double got = field.distance_mm(p);
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
