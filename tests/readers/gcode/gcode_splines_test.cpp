// SPDX-License-Identifier: MIT
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "readers/gcode/gcode_text.hpp"
#include "readers/gcode/motion/splines.hpp"
#include "readers/real_files.hpp"

namespace tribo::readers {
namespace {

using motion::Move;
using motion::Program;

constexpr double kToleranceMm = 1e-4;  // of motion::PieceTolerance

Program spline_of(const std::string& text) {
    return program_of("G21 G90 M3 F600\nG0 X0 Y0 Z1\n" + text);
}

// A rational B-spline in the plane by the Cox-de Boor recursion of its basis, independent of the reader.
struct Curve {
    std::size_t order;
    std::vector<double> knots;
    std::vector<Vec3> points;  // x, y, weight

    double basis(std::size_t i, std::size_t k, double u) const {
        if (k == 1) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
        const double a = knots[i + k - 1] - knots[i], b = knots[i + k] - knots[i + 1];
        double sum = 0;
        if (a > 0) sum += (u - knots[i]) / a * basis(i, k - 1, u);
        if (b > 0) sum += (knots[i + k] - u) / b * basis(i + 1, k - 1, u);
        return sum;
    }
    Vec3 at(double u) const {
        Vec3 sum;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double n = basis(i, order, u) * points[i].z;
            sum += n * Vec3{points[i].x, points[i].y, 1};
        }
        return {sum.x / sum.z, sum.y / sum.z, 0};
    }
    double length(int steps) const {
        double sum = 0;
        Vec3 last = at(knots.front());
        for (int i = 1; i <= steps; ++i) {
            const double u = knots.front() + (knots.back() - knots.front()) * (i - 1e-9) / steps;
            const Vec3 next = at(u);
            sum += distance(last, next);
            last = next;
        }
        return sum;
    }
};

double distance_to_path(Vec3 p, const Program& program) {
    double least = 1e9;
    for (const Move& move : program.moves) {
        for (int i = 0; i <= 400; ++i) {
            Vec3 tip = motion::pose_at(move, i / 400.0).tip_mm;
            tip.z = 0;
            least = std::min(least, distance(p, tip));
        }
    }
    return least;
}

TEST(GcodeSplines, G5IsACubicBezierCurve) {
    const Program program = spline_of("G5 X10 Y10 I5 J0 P0 Q-5\n");
    const auto at = [](double t) {
        const double s = 1 - t;
        return Vec3{3 * s * s * t * 5 + 3 * s * t * t * 10 + t * t * t * 10,
                    3 * s * t * t * 5 + t * t * t * 10, 0};
    };
    for (int i = 0; i <= 20; ++i) EXPECT_LT(distance_to_path(at(i / 20.0), program), 0.01);
    for (const Move& move : program.moves) {
        EXPECT_EQ(move.feed_mm_per_min, 600);
        EXPECT_EQ(move.line, 3);
    }
    EXPECT_EQ(program.moves.back().end.tip_mm, (Vec3{10, 10, 1}));
}

TEST(GcodeSplines, G5GoesOnWhereTheLastOneEnded) {
    const Program once = spline_of("G5 X10 I2 J3 P-1 Q2\nG5 X20 I1 J-2 P3 Q1\n");
    const Program again = spline_of("G5 X10 I2 J3 P-1 Q2\nG5 X20 P3 Q1\n");
    EXPECT_NEAR(feed_mm(once), feed_mm(again), 1e-12);
    EXPECT_EQ(once.moves.size(), again.moves.size());
}

TEST(GcodeSplines, G51IsOneExactQuadraticMove) {
    const Program program = spline_of("G5.1 X10 Y5 I3 J4\n");
    ASSERT_EQ(program.moves.size(), 1U);
    ASSERT_TRUE(program.moves[0].quadratic.has_value());
    expect_near(program.moves[0].quadratic->tip_control_mm, {3, 4, 1});
    // A parabola: y = 4 x^2 / a^2 from its vertex has the closed arc length.
    const Program parabola = spline_of("G5.1 X10 Y10 I5 J0\n");
    const double a = std::sqrt(5.0);
    EXPECT_NEAR(feed_mm(parabola), 5 * (a + std::asinh(2.0) / 2), 1e-9);
}

TEST(GcodeSplines, InverseTimeIsTheTimeOfTheWholeCurve) {
    const Program program = spline_of("G93 G5 F4 X10 Y10 I5 J0 P0 Q-5\n");
    double seconds = 0;
    for (const Move& move : program.moves) seconds += move.duration_s;
    EXPECT_NEAR(seconds, 15, 1e-9);
}

TEST(GcodeSplines, WeightsMakeAnExactCircle) {
    // The quarter circle of radius 10 as a quadratic rational curve: weight cos 45 degrees in the middle.
    const Program program =
        program_of("G21 G90 M3 F600\nG0 X10 Y0 Z1\nG5.2 X10 Y10 P0.7071067811865476 L3\nX0 Y10 P1\nG5.3\n");
    EXPECT_NEAR(feed_mm(program), 5 * std::acos(-1.0), 1e-6);
    for (const Move& move : program.moves) {
        const Vec3 middle = motion::pose_at(move, 0.5).tip_mm;
        EXPECT_NEAR(std::hypot(middle.x, middle.y), 10, kToleranceMm);
    }
}

TEST(GcodeSplines, G52HasUniformClampedKnots) {
    const Program program = spline_of("G5.2 X1 Y1 P1 L4\nX2 Y2 P2\nX3 Y0 P0.5\nX4 Y3 P3\nX6 Y0 P1\nG5.3\n");
    const Curve curve{4,
                      {0, 0, 0, 0, 1, 2, 3, 3, 3, 3},
                      {{0, 0, 1}, {1, 1, 1}, {2, 2, 2}, {3, 0, 0.5}, {4, 3, 3}, {6, 0, 1}}};
    EXPECT_NEAR(feed_mm(program), curve.length(20'000), 1e-3);
    for (int i = 0; i < 30; ++i) EXPECT_LT(distance_to_path(curve.at(i / 10.0), program), 0.01);
    // rs274 of linuxcnc-uspace 2.9.0~pre1, which cuts the curve into 90 chords, gives 8.2866140 mm.
    EXPECT_NEAR(feed_mm(program), 8.2866140, 0.005 * 8.29);
    EXPECT_EQ(program.moves.front().line, 3);
}

TEST(GcodeSplines, G62TakesOrderKnotsAndWeightsFromItsBlocks) {
    const Program program =
        spline_of("G6.2 P4 X0 Y0 K0\nX1 Y3 K0\nX4 Y3 R2 K0\nX5 Y0 K0\nX7 Y-2 K1.5\nK2\nK2\nK2\nK2\nG1 X9\n");
    const Curve curve{
        4, {0, 0, 0, 0, 1.5, 2, 2, 2, 2}, {{0, 0, 1}, {1, 3, 1}, {4, 3, 2}, {5, 0, 1}, {7, -2, 1}}};
    const double line = std::hypot(2.0, 0.0);
    EXPECT_NEAR(feed_mm(program) - line, curve.length(20'000), 1e-3);
    EXPECT_EQ(program.moves.back().line, 12);
}

TEST(GcodeSplines, RealButterflyHasTheLengthOfItsBSpline) {
    const auto bytes = real_file("lcnc-3x-nurbs-g6-farfalla.ngc");
    if (!bytes) GTEST_SKIP() << "no ../shared/data/gcode";
    const Program program = program_of(*bytes);
    // De Boor's algorithm at 400,000 parameters, with the lines into and out of the curve.
    EXPECT_NEAR(feed_mm(program), 362.0547, 0.01);
}

}  // namespace
}  // namespace tribo::readers
