// SPDX-License-Identifier: MIT
// The volume swept by cutters with a profile against dense instants of their drawings.
#include "milling/sweep/profile_sweep.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <rapidcheck/gtest.h>

#include "milling/any_profile.hpp"
#include "milling/brute_sweep.hpp"
#include "milling/sweep/sweep.hpp"
#include "milling/tool/convex_zones.hpp"

namespace tribo::milling::profiles {
namespace {

using motion::Move;

Vec3 vector(double size) {
    return {drawn(-size, size), drawn(-size, size), drawn(-size, size)};
}
Vec3 direction() {
    Vec3 v;
    do v = vector(1);
    while (squared_length(v) < 0.01);
    return normalized(v);
}

Move any_straight() {
    const Vec3 axis = direction();
    Vec3 travel = vector(8);
    if (*rc::gen::inRange(0, 3) == 0) travel = travel - dot(travel, axis) * axis;
    if (*rc::gen::inRange(0, 4) == 0) travel = drawn(-8, 8) * axis;
    Move m;
    m.start = {vector(20), axis};
    m.end = {m.start.tip_mm + travel, axis};
    return m;
}

Move any_arc() {
    const Vec3 axis = direction(), radial = drawn(0.2, 15) * any_perpendicular(axis);
    const double turn = drawn(-1, 1) * std::numbers::pi;
    Move m;
    m.start = {vector(20), axis};
    m.arc = motion::Arc{m.start.tip_mm - radial, axis, turn};
    m.end = {m.arc->centre_mm + std::cos(turn) * radial + std::sin(turn) * cross(axis, radial), axis};
    return m;
}

// As long and as bent as elementary moves come.
Move any_curved() {
    const Vec3 axis = direction(), travel = drawn(0.3, 10) * direction();
    const double turn = drawn(0, 0.3);
    Move m;
    m.start = {vector(20), axis};
    m.end = {m.start.tip_mm + travel, normalized(axis + turn * vector(0.7))};
    if (*rc::gen::inRange(0, 2) == 0) {
        m.quadratic = motion::Quadratic{m.start.tip_mm + 0.5 * travel + 0.05 * length(travel) * vector(1),
                                        0.5 * (axis + m.end.axis) + 0.1 * turn * vector(0.7)};
    }
    return m;
}

double truth(const Cutter& c, const Move& m, Vec3 p) {
    return brute_distance([&](const motion::ToolPose& pose, Vec3 q) { return profile_distance(c, pose, q); },
                          m, p);
}

// A point on the surface, on a line from within the tool; none if the line has no luck.
std::optional<Vec3> surface_point(const field::Shape& sweep, const Cutter& c, const Move& m) {
    const motion::ToolPose pose = motion::pose_at(m, drawn(0, 1));
    Vec3 in = pose.tip_mm + drawn(0, 1) * std::min(c.length_mm, 2 * c.diameter_mm) * pose.axis;
    Vec3 out = in + 60.0 * direction();
    if (sweep.distance_mm(in) >= 0 || sweep.distance_mm(out) <= 0) return std::nullopt;
    for (int n = 0; n < 60; ++n) {
        const Vec3 mid = 0.5 * (in + out);
        (sweep.distance_mm(mid) < 0 ? in : out) = mid;
    }
    return 0.5 * (in + out);
}

constexpr double kTenthUm = 1e-4;

void surface_is_exact(const Cutter& c, const Move& m) {
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 2; ++n) {
        const auto p = surface_point(*sweep, c, m);
        if (!p) continue;
        const double off = truth(c, m, *p);
        if (std::abs(off) >= kTenthUm) {
            RC_FAIL(std::string(kCutterKindWords[static_cast<std::size_t>(c.kind)]) + " off the surface by " +
                    std::to_string(1e3 * off) + " um");
        }
    }
}

RC_GTEST_PROP(ProfileSweep, straight_surface_is_good_to_a_tenth_of_a_micrometre, ()) {
    surface_is_exact(any_profile(), any_straight());
}
RC_GTEST_PROP(ProfileSweep, arc_surface_is_good_to_a_tenth_of_a_micrometre, ()) {
    surface_is_exact(any_profile(), any_arc());
}
RC_GTEST_PROP(ProfileSweep, five_axis_surface_is_good_to_a_tenth_of_a_micrometre, ()) {
    surface_is_exact(any_profile(), any_curved());
}

Move any_move() {
    const int kind = *rc::gen::inRange(0, 3);
    return kind == 0 ? any_straight() : kind == 1 ? any_arc() : any_curved();
}

RC_GTEST_PROP(ProfileSweep, sides_agree_with_dense_instants_and_no_distance_is_too_large, ()) {
    const Cutter c = any_profile();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const Box3 box = sweep->bounds_mm();
    for (int n = 0; n < 3; ++n) {
        const motion::ToolPose pose = motion::pose_at(m, drawn(0, 1));
        const Vec3 p = pose.tip_mm + drawn(-0.2, 1.2) * std::min(c.length_mm, 2 * c.diameter_mm) * pose.axis +
                       1.5 * c.radius_mm() * vector(1);
        const double off = truth(c, m, p), d = sweep->distance_mm(p);
        if (std::abs(off) > kTenthUm && (d > 0) != (off > 0))
            RC_FAIL(std::string(kCutterKindWords[static_cast<std::size_t>(c.kind)]) + " is " +
                    std::to_string(1e3 * d) + " um from a point that is " + std::to_string(1e3 * off) +
                    " um from it");
        RC_ASSERT(std::abs(d) <= std::abs(off) + kTenthUm || off < 0);
        if (off < 0) RC_ASSERT(box.inflated(1e-9).contains(p));
    }
}

RC_GTEST_PROP(ProfileSweep, distance_never_grows_faster_than_the_way, ()) {
    const Cutter c = any_profile();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 20; ++n) {
        const Vec3 a = m.start.tip_mm + vector(15), b = a + vector(0.5);
        RC_ASSERT(std::abs(sweep->distance_mm(a) - sweep->distance_mm(b)) <= distance(a, b) + 1e-4);
    }
}

RC_GTEST_PROP(ProfileSweep, distance_below_a_bound_is_the_distance_or_from_the_bound_up, ()) {
    const Cutter c = any_profile();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 10; ++n) {
        const Vec3 p = motion::pose_at(m, drawn(0, 1)).tip_mm + 2 * c.radius_mm() * vector(1);
        const double d = sweep->distance_mm(p), bound = d + drawn(-0.5, 0.5);
        const double below = sweep->distance_below(p, bound);
        if (bound > d + kProvenMm) RC_ASSERT(std::abs(below - d) < 2 * kProvenMm);
        if (bound < d) RC_ASSERT(below >= bound - kProvenMm);
    }
}

RC_GTEST_PROP(ProfileSweep, lattice_agrees_near_the_surface_and_keeps_the_side_elsewhere, ()) {
    const Cutter c = any_profile();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const double cell = drawn(0.05, 0.6), near = 1.8 * cell;
    const field::Lattice lattice{motion::pose_at(m, drawn(0, 1)).tip_mm + c.radius_mm() * vector(1), cell,
                                 *rc::gen::inRange(-8, 2), *rc::gen::inRange(-8, 2), -4};
    float all[field::kLatticeNodes], some[field::kLatticeNodes];
    sweep->sample(lattice, all);
    sweep->sample_near(lattice, near, some);
    constexpr float kSlack = 5e-5F;
    const auto edge = static_cast<float>(near);
    for (int n = 0; n < field::kLatticeNodes; n += 3) {
        const double d = sweep->distance_mm(lattice.node(n % 8, n / 8 % 8, n / 64));
        RC_ASSERT(std::abs(all[n] - d) < 1e-5 * (1 + std::abs(d)) + kSlack);
        if (std::abs(all[n]) < edge - kSlack) RC_ASSERT(std::abs(some[n] - all[n]) < kSlack);
        if (all[n] >= edge) RC_ASSERT(some[n] >= edge - kSlack && some[n] <= all[n] + kSlack);
        if (all[n] <= -edge) RC_ASSERT(some[n] <= -edge + kSlack && some[n] >= all[n] - kSlack);
    }
}

RC_GTEST_PROP(ProfileSweep, gradient_points_where_the_distance_grows, ()) {
    const Cutter c = any_profile();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const auto p = surface_point(*sweep, c, m);
    if (!p) return;
    const Vec3 g = sweep->gradient(*p);
    RC_ASSERT(std::abs(length(g) - 1) < 1e-9);
    // A short step: what the point of a cone sweeps is thin.
    constexpr double kStep = 5e-4;
    RC_ASSERT(sweep->distance_mm(*p + kStep * g) > -kTenthUm);
    RC_ASSERT(sweep->distance_mm(*p - kStep * g) < kTenthUm);
}

// A ball, a bull and a flat drawn as profiles sweep what their closed forms sweep.
RC_GTEST_PROP(ProfileSweep, of_a_ball_drawn_as_a_profile_is_that_of_the_ball, ()) {
    const double r = drawn(1, 6), corner = drawn(0.1, 1) * r;
    Cutter closed{
        .kind = corner == r ? CutterKind::ball : CutterKind::bull, .diameter_mm = 2 * r, .corner_mm = corner};
    Cutter profile{.kind = CutterKind::profile, .length_mm = 40};
    profile.profile = {{r - corner, 0, std::tan(std::numbers::pi / 8)}, {r, corner, 0}};
    profile = finished(profile);
    const Move m = any_move();
    const auto a = make_sweep(closed, m), b = make_sweep(profile, m);
    for (int n = 0; n < 20; ++n) {
        const Vec3 p = motion::pose_at(m, drawn(0, 1)).tip_mm + 2 * r * vector(1);
        RC_ASSERT((a->distance_mm(p) > 0) == (b->distance_mm(p) > 0) ||
                  std::abs(a->distance_mm(p)) < kTenthUm);
    }
}

// Along the line of its tip a pointed tool leaves two sides, neither of which faces the way.
TEST(ProfileSweep, of_a_pointed_tool_tells_of_no_wall_ahead) {
    Cutter c;
    c.kind = CutterKind::v;
    c.diameter_mm = 4;
    c.point_deg = 40;
    c.length_mm = 0;
    ASSERT_TRUE(make_profile(c));
    for (int n = 0; n < 40; ++n) {
        const double yaw = 0.17 * n, rise = n % 2 == 0 ? 0 : 0.3;
        Move level;
        level.start.tip_mm = {1.1, -0.7, 0.3 * n};
        level.end.tip_mm = level.start.tip_mm + Vec3{7.3 * std::cos(yaw), 7.3 * std::sin(yaw), rise};
        const auto sweep = make_sweep(c, level);
        const Vec3 way = normalized(level.end.tip_mm - level.start.tip_mm);
        for (const double share : {0.1, 0.3, 1.0 / 3, 0.77}) {
            const Vec3 at = lerp(level.start.tip_mm, level.end.tip_mm, share);
            // As steep as the way rises.
            EXPECT_LE(std::abs(dot(sweep->gradient(at), way)), rise == 0 ? 1e-6 : 0.1) << n << ' ' << share;
        }
    }
    Move arc;
    arc.start.tip_mm = {5, 0, 1};
    arc.end.tip_mm = {0, 5, 1};
    arc.arc = motion::Arc{{0, 0, 1}, {0, 0, 1}, 0.5 * std::numbers::pi};
    const auto sweep = make_sweep(c, arc);
    for (const double angle : {0.2, 0.5, 1.1}) {
        const Vec3 at{5 * std::cos(angle), 5 * std::sin(angle), 1}, way{-std::sin(angle), std::cos(angle), 0};
        EXPECT_LE(std::abs(dot(sweep->gradient(at), way)), 1e-6) << angle;
    }
}

// A quarter circle that is hollow, about (4, 0): near it the distance is the way, at its centre less. The
// cutter goes on above its level end.
TEST(ProfileSweep, of_a_hollow_arc_tells_the_way_to_its_circle) {
    Cutter c;
    c.kind = CutterKind::profile;
    c.profile = {{2, 0, 1 - std::numbers::sqrt2}, {4, 2, 0}, {4, 6, 0}};
    c.length_mm = 6;
    c.diameter_mm = 8;
    const ConvexZones zones(c);
    for (const double angle : {0.1, 0.5, 1.0, 1.3}) {
        for (const double radius : {1.01, 1.5, 1.999999, 2.000001, 2.01}) {
            const PlanePoint at{4 - radius * std::cos(angle), radius * std::sin(angle)};
            EXPECT_NEAR(zones.distance_mm(at), 2 - radius, 1e-12) << angle << ' ' << radius;
        }
    }
    EXPECT_NEAR(zones.distance_mm({4, 0}), 1.5, 1e-12);
}

// A hollow arc that goes on from a wall: straight down its tangent the tool ends at the corner of the bottom.
TEST(ProfileSweep, of_a_hollow_arc_above_a_wall_ends_at_the_bottom) {
    Cutter c;
    c.kind = CutterKind::profile;
    c.profile = {{0.518702, 0},
                 {0.518702, 0.8500265, 1 - std::numbers::sqrt2},
                 {0.818702, 1.1500265},
                 {0.818702, 2.000053}};
    c.length_mm = 2.000053;
    c.diameter_mm = 2 * 0.818702;
    const ConvexZones zones(c);
    // Before an edge a zone gives the largest distance to its faces, which may be less than the way.
    for (const double r : {0.0, 0.3, 0.5, 0.518}) {
        EXPECT_GT(zones.distance_mm({r, -1.858}), 0.4 * 1.858) << r;
        EXPECT_LE(zones.distance_mm({r, -1.858}), 1.858 + 1e-9) << r;
    }
}

}  // namespace
}  // namespace tribo::milling::profiles
