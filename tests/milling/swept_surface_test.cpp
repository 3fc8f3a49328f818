// SPDX-License-Identifier: MIT
#include "milling/swept_surface.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "milling/sweep/scallop.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/curve/keyframe_motion.hpp"

using namespace tribo;
using namespace tribo::milling;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

double uniform_between(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}
Vec3 random_vector(double range) {
    const double x = uniform_between(-range, range), y = uniform_between(-range, range),
                 z = uniform_between(-range, range);
    return {x, y, z};
}

BezierMotion random_motion() {
    std::vector<DualQuaternion> units{
        displacement(normalized(Quaternion(uniform_between(-1, 1), random_vector(1))), random_vector(80))};
    std::vector<double> weights{1};
    for (int i = *rc::gen::inRange(1, 5); i > 0; --i) {
        units.push_back(displacement(normalized(Quaternion(1, random_vector(0.4))), random_vector(10)) *
                        units.back());
        weights.push_back(uniform_between(0.5, 2));
    }
    return weighted_motion(units, weights);
}

}  // namespace

RC_GTEST_PROP(SweptCircle, is_where_the_circle_of_the_moving_cutter_is, ()) {
    const BezierMotion m = random_motion();
    const double radius = uniform_between(0.5, 20), height = uniform_between(0, 30);
    const std::array<SweptPatch, 4> patches = swept_circle(m, radius, height);
    for (std::size_t k = 0; k < 4; ++k) {
        RC_ASSERT(patches[k].degree_u == 2 * m.degree());
        RC_ASSERT(patches[k].net.size() == 3 * (2 * m.degree() + 1));
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; j <= 4; ++j) {
                const double u = i / 4.0, v = j / 4.0;
                const Vec3 p = patches[k].point(u, v);
                // Back in the tool: on the circle, in the right quarter.
                const DualQuaternion q = m.at(u);
                const Vec3 local = rotate(conjugate(q.real), p - translation_mm(q));
                RC_ASSERT(std::abs(local.z - height) < 1e-9);
                RC_ASSERT(std::abs(std::hypot(local.x, local.y) - radius) < 1e-9);
                // A quarter as rational quadratic passes the angle 2 atan(x), tan of it known in closed form.
                const double w = std::sqrt(0.5), b0 = (1 - v) * (1 - v), b1 = 2 * v * (1 - v) * w, b2 = v * v;
                const double angle =
                    std::atan2(b1 + b2, b0 + b1) + static_cast<double>(k) * std::numbers::pi / 2;
                const Vec3 on_circle{radius * std::cos(angle), radius * std::sin(angle), height};
                RC_ASSERT(distance(p, transform_point(q, on_circle)) < 1e-9);
            }
    }
}

RC_GTEST_PROP(SweptCircle, of_a_spline_motion_joins_from_piece_to_piece_and_quarter_to_quarter, ()) {
    std::vector<Keyframe> keys;
    for (int i = 0; i < 5; ++i)
        keys.push_back({{{10.0 * i + uniform_between(-2, 2), uniform_between(-3, 3), uniform_between(-3, 3)},
                         normalized(Vec3{0, 0, 2} + random_vector(1))}});
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    RC_ASSERT(m.has_value());
    const auto pieces = swept_circle(m->motion, 6);
    RC_ASSERT(pieces.size() == 4u);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const double t = uniform_between(0, 1);
            RC_ASSERT(distance(pieces[i][k].point(t, 1), pieces[i][(k + 1) % 4].point(t, 0)) < 1e-9);
            if (i + 1 < pieces.size())
                RC_ASSERT(distance(pieces[i][k].point(1, t), pieces[i + 1][k].point(0, t)) < 1e-9);
        }
}

RC_GTEST_PROP(SweptCircle, has_the_normal_of_its_differences, ()) {
    const std::array<SweptPatch, 4> patches = swept_circle(random_motion(), 6);
    const double u = uniform_between(0.1, 0.9), v = uniform_between(0.1, 0.9), h = 1e-5;
    const SweptPatch& p = patches[static_cast<std::size_t>(*rc::gen::inRange(0, 4))];
    const Vec3 by_u = p.point(u + h, v) - p.point(u - h, v), by_v = p.point(u, v + h) - p.point(u, v - h);
    RC_PRE(length(cross(normalized(by_u), normalized(by_v))) > 0.05);
    RC_ASSERT(std::abs(length(p.normal(u, v)) - 1) < 1e-12);
    RC_ASSERT(distance(p.normal(u, v), normalized(cross(by_u, by_v))) < 1e-5);
}

TEST(SweptCircle, shows_the_effective_cutting_shape_and_its_scallop) {
    // An inclined flat end mill fed straight along x in two passes: seen along the feed its patch is the
    // ellipse, and between the passes stands the cusp.
    const double tilt = 0.2, turn = 0.5, sidestep = 3;
    const Vec3 axis{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
    const std::vector<ToolPose> ends{{{0, 0, 0}, axis}, {{30, 0, 0}, axis}};
    const std::vector<double> weights{1, 1};
    const auto patches = swept_circle(weighted_motion(minimal_twist_displacements(ends), weights), 6);
    double lowest = 1e300;
    std::vector<Vec3> shape;
    for (const SweptPatch& p : patches)
        for (int j = 0; j < 4000; ++j) {
            shape.push_back(p.point(0.5, j / 4000.0));
            lowest = std::min(lowest, shape.back().z);
        }
    // The cusp is as high as the horizontal chord of the length of the sidestep: search it.
    const auto chord = [&](double height) {
        double left = 1e300, right = -1e300;
        for (std::size_t i = 0; i < shape.size(); ++i) {
            const Vec3 p = shape[i], q = shape[(i + 1) % shape.size()];
            if ((p.z - lowest < height) == (q.z - lowest < height)) continue;
            const double y = p.y + (q.y - p.y) * (height + lowest - p.z) / (q.z - p.z);
            left = std::min(left, y);
            right = std::max(right, y);
        }
        return right - left;
    };
    double low = 0, high = 1;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (chord(middle) > sidestep ? high : low) = middle;
    }
    Cutter cutter;
    cutter.diameter_mm = 12;
    EXPECT_NEAR(scallop_height_mm(cutter, {tilt, turn}, sidestep), high, 1e-6);
}

// The solid that the engine takes away under a five-axis motion, move by move, has the exact surface on its
// border: the bottom circle inside or on it, the flank's envelope on it.
TEST(SweptCircle, borders_the_solid_that_is_cut) {
    std::vector<Keyframe> keys;
    for (int i = 0; i <= 6; ++i) {
        const double x = 5.0 * i;
        keys.push_back({{{x, 2 * std::sin(0.2 * x), -0.01 * x * x},
                         normalized(Vec3{0.1 * std::cos(0.1 * x), 0.2 + 0.01 * x, 1})}});
    }
    Cutter cutter;
    cutter.diameter_mm = 8;
    cutter.length_mm = 30;
    const auto moves = keyframe_moves(keys, 900);
    const auto motion = interpolate_keyframes(keys);
    ASSERT_TRUE(moves && motion);
    std::vector<std::unique_ptr<field::Shape>> sweeps;
    for (const Move& move : *moves)
        for (const Move& piece : to_elementary(move)) sweeps.push_back(make_sweep(cutter, piece));
    const auto distance_to_cut = [&](Vec3 p) {
        double least = 1e300;
        for (const auto& sweep : sweeps) least = std::min(least, sweep->distance_mm(p));
        return least;
    };
    constexpr double kOffMm = 3e-4;  // moves stand for the motion to 0.1 um at the tip and 2.5 urad
    for (const auto& piece : swept_circle(motion->motion, cutter.radius_mm()))
        for (const SweptPatch& patch : piece)
            for (int i = 0; i <= 4; ++i)
                for (int j = 0; j <= 8; ++j)
                    EXPECT_LT(distance_to_cut(patch.point(0.25 * i, 0.125 * j)), kOffMm);
    for (int i = 1; i < 20; ++i) {
        const double u = motion->motion.end() * i / 20;
        const auto flank = flank_grazing_points(rates(motion->motion, u), cutter.radius_mm(), 12);
        ASSERT_TRUE(flank);
        for (const Vec3& p : *flank) EXPECT_NEAR(distance_to_cut(p), 0, kOffMm) << i;
    }
}

RC_GTEST_PROP(FlankEnvelope, touches_the_flank_where_it_moves_along_itself, ()) {
    const BezierMotion m = random_motion();
    const double radius = uniform_between(1, 10), height = uniform_between(0, 30);
    const PoseRates r = rates(m, uniform_between(0, 1));
    const auto points = flank_grazing_points(r, radius, height);
    RC_PRE(points.has_value());
    const Vec3 centre = r.pose.tip_mm + height * r.pose.axis;
    const Vec3 speed = r.tip_rate_mm + height * r.axis_rate;
    for (const Vec3& p : *points) {
        const Vec3 out = p - centre;
        RC_ASSERT(std::abs(length(out) - radius) < 1e-9);
        RC_ASSERT(std::abs(dot(out, r.pose.axis)) < 1e-9);
        RC_ASSERT(std::abs(dot(out, speed)) < 1e-9 * radius * length(speed));
    }
}

TEST(FlankEnvelope, has_no_point_in_a_plunge) {
    PoseRates r;
    r.tip_rate_mm = {0, 0, -5};
    EXPECT_FALSE(flank_grazing_points(r, 6, 10));
    r.tip_rate_mm = {2, 0, 0};
    const auto points = flank_grazing_points(r, 6, 10);
    ASSERT_TRUE(points);
    EXPECT_LT(distance((*points)[0], {0, 6, 10}), 1e-15);
}
