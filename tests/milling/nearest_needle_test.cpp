// SPDX-License-Identifier: MIT
// The nearest surface around a cusp that tapers to nothing: between two passes of a bull or a ball nose
// cutter that just meet. Above its tip there is no wall, however near the two sides are to each other. Below
// it the wall is not lost.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "base/noise_hash.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::milling {
namespace {

// Two straight passes of an upright cutter. Across them at x, above their floor at z.
struct MeetingPasses {
    double radius, corner, half_apart;  // `half_apart`: of the axes

    struct Foot {
        double x = 0, z = 0, away = 1e30;
    };
    // The nearest place of one pass alone; `side`: -1 or 1.
    Foot foot(double x, double z, double side) const {
        const double from_axis = x - side * half_apart, out = from_axis < 0 ? -1 : 1,
                     beyond = std::max(0.0, std::abs(from_axis) - (radius - corner));
        if (z >= corner) return {side * half_apart + out * radius, z, radius - std::abs(from_axis)};
        const double way = std::hypot(beyond, corner - z), share = corner / way;
        return {x + out * beyond * (share - 1), corner - (corner - z) * share, corner - way};
    }
    // Height of the cusp where it is as thick.
    double height(double thick) const {
        const double half = half_apart - (radius - corner) - 0.5 * thick;
        return corner - std::sqrt(std::max(0.0, corner * corner - half * half));
    }
    // Distance of a point in air to the surface, where walls less thick do not count.
    double distance(double x, double z, double thick) const {
        const double tip = height(thick);
        double least = std::hypot(x, z - tip);
        for (const double side : {-1.0, 1.0}) {
            const Foot at = foot(x, z, side), over = foot(at.x, at.z, -side);
            const bool is_thin = thick > 0 && at.z > tip && std::abs(at.x) < thick;
            if (at.away > 0 && over.away <= 0 && !is_thin) least = std::min(least, at.away);
            if (std::abs(x - side * half_apart) <= radius - corner) least = std::min(least, z);
        }
        return least;
    }
};

TEST(NearestNeedle, is_that_of_the_closed_form_around_cusps_that_taper_to_nothing) {
    constexpr int kFields = 120, kPoints = 60;
    constexpr double kFloor = -14, kThick = 1.2 * contact::kThinnestWall;
    const CounterNoise noise(81);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    int known = 0;
    for (int n = 0; n < kFields; ++n) {
        constexpr double kOverlaps[] = {0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 0.03, 0.1, 0.25, 0.5};
        Cutter cutter;
        cutter.diameter_mm = 6;
        cutter.length_mm = 40;
        const double radius = 3, turn = between(0, 6.3);
        if (n % 3 == 0) {
            cutter.kind = CutterKind::ball;
        } else {
            cutter.kind = CutterKind::bull;
            cutter.corner_mm = between(0.5, 2);
        }
        const MeetingPasses passes{radius, n % 3 == 0 ? radius : cutter.corner_mm,
                                   radius - 0.5 * kOverlaps[n % 10] * between(0.5, 1)};
        field::CarvedField field(std::make_unique<field::BoxShape>(Box3{{-20, -20, -25}, {20, 20, 0}}),
                                 between(0.2, 0.7));
        const Vec3 across{std::cos(turn), std::sin(turn), 0}, along{-across.y, across.x, 0},
            middle{between(-1, 1), between(-1, 1), kFloor};
        for (const double side : {-1.0, 1.0}) {
            motion::Move move;
            move.start.tip_mm = middle + side * passes.half_apart * across - 30 * along;
            move.end.tip_mm = move.start.tip_mm + 60 * along;
            field.carve(make_sweep(cutter, move));
        }
        for (int k = 0; k < kPoints; ++k) {
            const double tip = passes.height(0), x = between(-1.5, 1.5), y = between(-3, 3),
                         z = k % 2 == 0 ? tip + between(-0.2, 0.2) : between(0, 2 * tip + 1);
            if (std::max(passes.foot(x, z, -1).away, passes.foot(x, z, 1).away) < contact::kThinnestWall)
                continue;
            const double least = passes.distance(x, z, 0), most = passes.distance(x, z, kThick),
                         within = between(0.7, 2.5) * std::max(most, 0.3);
            contact::NearHint hint;
            const double got =
                field.nearest(middle + x * across + y * along + Vec3{0, 0, z}, within, hint).distance_mm;
            EXPECT_GE(got, std::min(within, least) - contact::kThinnestWall) << n << " " << k;
            if (most > within - contact::kThinnestWall) continue;
            EXPECT_LE(got, most + contact::kThinnestWall) << n << " " << k;
            ++known;
        }
    }
    EXPECT_GT(known, kFields * kPoints / 2);
}

}  // namespace
}  // namespace tribo::milling
