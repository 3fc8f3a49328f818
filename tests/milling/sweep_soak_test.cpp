// SPDX-License-Identifier: MIT
// The promise of curved sweeps over very many points: those near their surface, for tools, turns and travels
// far wider than programs have. Minutes long, so `make soak BUDGET=long` runs the whole and each test run a
// thousandth of it, the same every time.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

#include "milling/brute_sweep.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::milling {
namespace {

class Draw {
  public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}
    double number(double lo, double hi) {
        return lo + (hi - lo) * 0x1p-53 * static_cast<double>(random_() >> 11);
    }
    int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    // Even in the logarithm: as many small ones as large ones.
    double size(double lo, double hi) { return std::exp(number(std::log(lo), std::log(hi))); }
    Vec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    Vec3 direction() {
        Vec3 v;
        do v = vector(1);
        while (squared_length(v) < 0.01 || squared_length(v) > 1);
        return normalized(v);
    }

  private:
    std::mt19937_64 random_;
};

Cutter any_cutter(Draw& draw) {
    Cutter c;
    c.kind = static_cast<CutterKind>(draw.below(3));
    c.diameter_mm = draw.size(0.1, 25);
    if (c.kind == CutterKind::bull) c.corner_mm = draw.number(0.03, 0.97) * c.radius_mm();
    c.length_mm = draw.below(2) == 0 ? 40 : draw.number(0.51, 2) * c.diameter_mm;
    return c;
}

// Up to 10 mm and 0.5 rad: along the axis, across it, askew, or about a tip that stands; evenly or bent.
motion::Move any_curved(Draw& draw) {
    motion::Move m;
    const Vec3 axis = draw.direction();
    const double turn = 0.5 * draw.size(0.004, 1), way = draw.below(5) == 0 ? 0 : draw.size(0.1, 10);
    Vec3 along = draw.direction();
    const int kind = draw.below(6);
    if (kind == 0) along = axis;
    if (kind == 1) along = normalized(along - dot(along, axis) * axis, along);
    m.start = {draw.vector(20), axis};
    m.end = {m.start.tip_mm + way * along,
             normalized(axis + turn * normalized(cross(axis, draw.direction()), {}))};
    // An even turn of more than this is cut by motion::to_elementary.
    constexpr double kEven = 0.3;
    if (turn > kEven || draw.below(2) == 0) {
        const Vec3 tip = m.start.tip_mm + 0.5 * way * along + 0.1 * way * draw.vector(1);
        m.quadratic = motion::Quadratic{
            tip, (0.5 + turn * turn / 16) * (axis + m.end.axis) + 0.05 * turn * draw.vector(1)};
    }
    return m;
}

struct Found {
    long points = 0, off = 0;
    double worst_mm = 0;
};

// Points on the surface, some of them up to 0.9 mm away from it.
Found compare(Draw& draw, long wanted, double tolerance_mm) {
    Found found;
    while (found.points < wanted) {
        const Cutter c = any_cutter(draw);
        const motion::Move m = any_curved(draw);
        const auto sweep = make_sweep(c, m);
        for (int n = 0; n < 20; ++n) {
            const double top = draw.below(3) == 0 ? 28 : 2 * c.radius_mm() + 2;
            const motion::ToolPose pose = motion::pose_at(m, draw.number(0, 1));
            Vec3 in = pose.tip_mm + draw.number(0.02, 1) * top * pose.axis,
                 out = in + 60.0 * draw.direction();
            if (sweep->distance_mm(in) >= 0 || sweep->distance_mm(out) <= 0) continue;
            for (int k = 0; k < 50; ++k) {
                const Vec3 middle = 0.5 * (in + out);
                (sweep->distance_mm(middle) < 0 ? in : out) = middle;
            }
            const Vec3 p = draw.below(4) == 0 ? in + draw.vector(0.5) : in;
            const double error = std::abs(sweep->distance_mm(p) - brute_distance(c, m, p));
            ++found.points;
            if (error >= tolerance_mm) ++found.off;
            found.worst_mm = std::max(found.worst_mm, error);
        }
    }
    return found;
}

void no_point_is_off(std::uint64_t seed, long points) {
    // The proof of the search, 1e-5, the brute force, 3e-6, the quadratic for an even turn, 2e-5 at 40 mm.
    constexpr double kToleranceMm = 4e-5;
    Draw draw(seed);
    const Found found = compare(draw, points, kToleranceMm);
    EXPECT_EQ(found.off, 0) << "of " << found.points << " points; the worst by " << 1e3 * found.worst_mm
                            << " um";
    std::printf("%ld points, %ld off, the worst by %.4f um\n", found.points, found.off, 1e3 * found.worst_mm);
}

TEST(SweepSoak, ten_thousand_points_are_exact) {
    no_point_is_off(1, 10'000);
}
TEST(SweepSoak, DISABLED_ten_million_points_are_exact) {
    no_point_is_off(2, 10'000'000);
}

}  // namespace
}  // namespace tribo::milling
