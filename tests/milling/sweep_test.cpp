// SPDX-License-Identifier: MIT
// The swept volume against a brute force that knows nothing of its formulas: the tool is tried at very many
// instants.
#include "milling/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <random>
#include <rapidcheck/gtest.h>

#include "milling/any_profile.hpp"
#include "milling/brute_sweep.hpp"
#include "milling/sweep/sweep_frames.hpp"
#include "milling/sweep/sweep_kernels.hpp"
#include "milling/sweep/upright_curve.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {
namespace {

using motion::Move;

double number(double lo, double hi) {
    return lo + (hi - lo) * 1e-6 * *rc::gen::inRange(0, 1000001);
}
Vec3 vector(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
}
Vec3 direction() {
    Vec3 v;
    do v = vector(1);
    while (squared_length(v) < 0.01);
    return normalized(v);
}

Cutter any_cutter() {
    Cutter c;
    c.kind = static_cast<CutterKind>(*rc::gen::inRange(0, 3));
    c.diameter_mm = number(1, 12);
    c.corner_mm = c.kind == CutterKind::bull ? number(0.05, 0.95) * c.radius_mm() : 0;
    // A short one shows its top.
    c.length_mm = *rc::gen::inRange(0, 2) == 0 ? 30 : number(0.55, 2) * c.diameter_mm;
    return c;
}

Move straight_move(Vec3 from, Vec3 axis, Vec3 travel) {
    Move m;
    m.start = {from, axis};
    m.end = {m.start.tip_mm + travel, axis};
    return m;
}

Move any_straight() {
    const Vec3 axis = direction();
    Vec3 travel = vector(8);
    if (*rc::gen::inRange(0, 3) == 0) travel = travel - dot(travel, axis) * axis;  // across the axis
    if (*rc::gen::inRange(0, 6) == 0) travel = number(-8, 8) * axis;               // along it
    return straight_move(vector(20), axis, travel);
}

Move any_arc() {
    const Vec3 axis = direction();
    Move m;
    m.start = {vector(20), axis};
    const Vec3 radial = number(0.2, 15) * any_perpendicular(axis);
    const double turn = number(-1, 1) * std::numbers::pi;
    const Vec3 normal = *rc::gen::inRange(0, 2) == 0 ? axis : -axis;
    m.arc = motion::Arc{m.start.tip_mm - radial, normal, turn};
    const Vec3 side = cross(normal, radial);
    m.end = {m.arc->centre_mm + std::cos(turn) * radial + std::sin(turn) * side, axis};
    return m;
}

// A piece of a helix; some plunge.
Move any_upright_curve(double share = 1) {
    const Vec3 axis = direction(), bend = 0.05 * vector(1);
    const Vec3 along = *rc::gen::inRange(0, 6) == 0 ? axis : direction();
    Move m = straight_move(vector(20), axis, number(0.3, share * 10) * along);
    const Vec3 travel = m.end.tip_mm - m.start.tip_mm;
    m.quadratic = motion::Quadratic{
        m.start.tip_mm + 0.5 * travel + length(travel) * (bend - dot(bend, axis) * axis), axis};
    return m;
}

// As long and as bent as elementary moves come, or less.
Move any_curved(double share = 1) {
    if (*rc::gen::inRange(0, 4) == 0) return any_upright_curve(share);
    const Vec3 axis = direction();
    const double turn = share * number(0, 0.3);
    Move m;
    const Vec3 travel = number(0.3, share * 10) * direction();
    m.start = {vector(20), axis};
    m.end = {m.start.tip_mm + travel, normalized(axis + turn * vector(0.7))};
    if (*rc::gen::inRange(0, 2) == 0) {
        m.quadratic = motion::Quadratic{m.start.tip_mm + 0.5 * travel + 0.05 * length(travel) * vector(1),
                                        0.5 * (axis + m.end.axis) + 0.1 * turn * vector(0.7)};
    }
    return m;
}

// A point on the surface of the sweep, found by bisection along a ray that leaves the tool; none if it has no
// luck.
std::optional<Vec3> surface_point(const field::Shape& sweep, const Cutter& c, const Move& m) {
    const motion::ToolPose pose = motion::pose_at(m, number(0, 1));
    Vec3 in = pose.tip_mm + 0.45 * c.radius_mm() * pose.axis + 0.3 * c.radius_mm() * vector(1);
    Vec3 out = in + 40.0 * direction();
    if (sweep.distance_mm(in) >= 0 || sweep.distance_mm(out) <= 0) return std::nullopt;
    for (int n = 0; n < 60; ++n) {
        const Vec3 mid = 0.5 * (in + out);
        (sweep.distance_mm(mid) < 0 ? in : out) = mid;
    }
    return 0.5 * (in + out);
}

// What the search of a sweep proves, 1e-5 mm, what the brute force is good to, 3e-6, and what the quadratic
// that stands for an even turn of 0.3 rad is off at 30 mm, 1e-5.
constexpr double kProvenMm = 2.5e-5;

void surface_is_exact(const Cutter& c, const Move& m, double tolerance) {
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 12; ++n) {
        const auto p = surface_point(*sweep, c, m);
        if (!p) continue;
        const double truth = brute_distance(c, m, *p);
        if (std::abs(truth) >= tolerance)
            RC_FAIL("off the surface by " + std::to_string(1e3 * truth) + " um");
    }
}

RC_GTEST_PROP(Sweep, straight_surface_is_exact, ()) {
    const Cutter c = any_cutter();
    surface_is_exact(c, any_straight(), c.kind == CutterKind::bull ? kProvenMm : 4e-6);
}
RC_GTEST_PROP(Sweep, arc_surface_is_exact, ()) {
    surface_is_exact(any_cutter(), any_arc(), 4e-6);
}
RC_GTEST_PROP(Sweep, curved_surface_is_good_to_a_tenth_of_a_micrometre, ()) {
    surface_is_exact(any_cutter(), any_curved(), kProvenMm);
}

Move any_move(double share = 1) {
    switch (*rc::gen::inRange(0, 3)) {
        case 0:
            return any_straight();
        case 1:
            return any_arc();
        default:
            return any_curved(share);
    }
}

RC_GTEST_PROP(Sweep, distance_never_grows_faster_than_the_way, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 20; ++n) {
        const Vec3 a = m.start.tip_mm + vector(15), b = a + vector(0.5);
        RC_ASSERT(std::abs(sweep->distance_mm(a) - sweep->distance_mm(b)) <= distance(a, b) + 1e-4);
    }
}

RC_GTEST_PROP(Sweep, sides_agree_with_the_brute_force, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const Box3 box = sweep->bounds_mm();
    for (int n = 0; n < 10; ++n) {
        const Vec3 p = motion::pose_at(m, number(0, 1)).tip_mm + 2 * c.radius_mm() * vector(1);
        const double truth = brute_distance(c, m, p), d = sweep->distance_mm(p);
        RC_ASSERT(std::abs(d - truth) < kProvenMm);
        if (truth < 0) RC_ASSERT(box.inflated(1e-9).contains(p));
    }
}

RC_GTEST_PROP(Sweep, distance_below_a_bound_is_the_distance_or_from_the_bound_up, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move(number(0.01, 1));
    const auto sweep = make_sweep(c, m);
    for (int n = 0; n < 20; ++n) {
        const Vec3 p = motion::pose_at(m, number(0, 1)).tip_mm + 2 * c.radius_mm() * vector(1);
        const double d = sweep->distance_mm(p), bound = d + number(-0.5, 0.5) * number(0, 1);
        const double below = sweep->distance_below(p, bound);
        if (bound > d + kProvenMm) RC_ASSERT(std::abs(below - d) < kProvenMm);
        if (bound < d) RC_ASSERT(below >= bound - kProvenMm);
    }
}

RC_GTEST_PROP(Sweep, lattice_agrees_with_the_exact_distance, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const field::Lattice lattice{m.start.tip_mm + 8 * vector(1), number(0.05, 0.6),
                                 *rc::gen::inRange(-40, 40), 3, -4};
    float nodes[field::kLatticeNodes];
    sweep->sample(lattice, nodes);
    const double size = 1 + length(lattice.node(0, 0, 0) - m.start.tip_mm);
    for (int n = 0; n < field::kLatticeNodes; n += 7) {
        const Vec3 p = lattice.node(n % 8, n / 8 % 8, n / 64);
        const double d = sweep->distance_mm(p);
        // Far away only that it is far counts.
        if (std::abs(d) < 1) RC_ASSERT(std::abs(nodes[n] - d) < 5e-5 * size);
        RC_ASSERT((nodes[n] > 0.5) == (d > 0.5) || std::abs(d - 0.5) < 0.1);
    }
}

RC_GTEST_PROP(Sweep, lattice_near_the_surface_agrees_there_and_keeps_the_side_elsewhere, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const double cell = number(0.05, 0.6), near = 1.8 * cell;
    const field::Lattice lattice{motion::pose_at(m, number(0, 1)).tip_mm + c.radius_mm() * vector(1), cell,
                                 *rc::gen::inRange(-8, 2), *rc::gen::inRange(-8, 2), -4};
    float all[field::kLatticeNodes], some[field::kLatticeNodes];
    sweep->sample(lattice, all);
    sweep->sample_near(lattice, near, some);
    // Twice what single precision lets the search prove.
    constexpr float kTwice = 1e-4f;
    const auto edge = static_cast<float>(near);
    for (int n = 0; n < field::kLatticeNodes; ++n) {
        if (std::abs(all[n]) < edge - kTwice) RC_ASSERT(std::abs(some[n] - all[n]) < kTwice);
        if (all[n] >= edge) RC_ASSERT(some[n] >= edge - kTwice && some[n] <= all[n] + kTwice);
        // Under the top of a short tool the depth may be too great.
        const bool is_bound = c.length_mm < 30 || some[n] >= all[n] - kTwice;
        if (all[n] <= -edge) RC_ASSERT(some[n] <= kTwice - edge && is_bound);
    }
}

// Small bricks beside the tool, where one end of a short travel is often nearest to all nodes, and only a
// part of a long one counts.
RC_GTEST_PROP(Sweep, small_lattices_of_curved_sweeps_agree_and_share_the_bits_of_shared_nodes, ()) {
    const Cutter c = any_cutter();
    const Move m = any_curved(number(0.03, 1));
    const auto sweep = make_sweep(c, m);
    for (int round = 0; round < 6; ++round) {
        const auto at = surface_point(*sweep, c, m);
        if (!at) continue;
        const double cell = std::exp(number(std::log(0.003), std::log(0.4))), near = 1.8 * cell;
        const field::Lattice a{*at - 3 * cell * Vec3{1, 1, 1} + 3 * cell * vector(1), cell, 0, 0, 0};
        float own[field::kLatticeNodes], other[field::kLatticeNodes];
        sweep->sample_near(a, near, own);
        const double size = 1 + length(a.node(0, 0, 0) - m.start.tip_mm);
        for (int n = 0; n < field::kLatticeNodes; n += 5) {
            const double d = sweep->distance_mm(a.node(n % 8, n / 8 % 8, n / 64));
            if (std::abs(d) < near) RC_ASSERT(std::abs(own[n] - d) < 5e-5 + 3e-6 * size);
        }
        for (int axis = 0; axis < 3; ++axis) {
            field::Lattice b = a;
            (axis == 0 ? b.i0 : axis == 1 ? b.j0 : b.k0) = 7;
            sweep->sample_near(b, near, other);
            const int step = axis == 0 ? 1 : axis == 1 ? 8 : 64;
            for (int n = 0; n < field::kLatticeNodes; ++n) {
                if (n / step % 8 != 0 || std::abs(other[n]) > 0.99 * near) continue;
                RC_ASSERT(own[n + 7 * step] == other[n]);
            }
        }
    }
}

RC_GTEST_PROP(Sweep, lattices_share_the_bits_of_shared_nodes, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const field::Lattice a{m.start.tip_mm - Vec3{2, 2, 2}, 0.21, 0, 0, 0};
    field::Lattice b = a;
    b.i0 = 7;
    float left[field::kLatticeNodes], right[field::kLatticeNodes];
    sweep->sample(a, left);
    sweep->sample(b, right);
    for (int n = 0; n < 64; ++n) RC_ASSERT(left[7 + 8 * n] == right[8 * n]);
}

// Bricks outside the box are not carved: it must hold the cap.
RC_GTEST_PROP(Sweep, box_holds_the_solid, ()) {
    Cutter c = any_cutter();
    c.length_mm = number(0.8, 3) * c.diameter_mm;
    if (*rc::gen::inRange(0, 4) == 0) c = finished(form_tool());
    const int what = *rc::gen::inRange(0, 3);
    const auto sweep = make_sweep(c, what == 0 ? any_straight() : what == 1 ? any_arc() : any_curved());
    const Box3 box = sweep->bounds_mm().inflated(1e-9), around = box.inflated(4);
    for (int n = 0; n < 200; ++n) {
        const Vec3 p{number(around.min.x, around.max.x), number(around.min.y, around.max.y),
                     number(around.min.z, around.max.z)};
        RC_ASSERT(sweep->distance_mm(p) >= 0 || box.contains(p));
    }
}

RC_GTEST_PROP(Sweep, kernels_for_old_and_new_processors_give_the_same_bits, ()) {
    if (!sweep_kernels_v3()) return;
    const ToolProfile tool(any_cutter());
    const Vec3 z = direction(), x = any_perpendicular(z);
    const Frame frame{x, cross(z, x), z};
    const field::Lattice lattice{vector(3), 0.2, -3, -4, -5};
    float a[field::kLatticeNodes], b[field::kLatticeNodes];
    const auto same = [&] { return std::equal(a, a + field::kLatticeNodes, b); };
    const StraightLine line{number(0, 5), *rc::gen::inRange(0, 2) == 0 ? 0 : number(-3, 3)};
    sweep_kernels_sse2()->straight(tool, line, frame, vector(2), lattice, 1e30, a);
    const Vec3 from = vector(2);
    sweep_kernels_sse2()->straight(tool, line, frame, from, lattice, 1e30, a);
    sweep_kernels_v3()->straight(tool, line, frame, from, lattice, 1e30, b);
    RC_ASSERT(same());
    const ArcLine arc{number(0.5, 5), 0.6, 0.8};
    sweep_kernels_sse2()->arc(tool, arc, frame, from, lattice, a);
    sweep_kernels_v3()->arc(tool, arc, frame, from, lattice, b);
    RC_ASSERT(same());
    const CurvedLine curve{vector(2), 0.1 * vector(1), z, 0.1 * vector(1), 0.01 * vector(1)};
    sweep_kernels_sse2()->curved(tool, curve, CurvedInstants(curve), from, lattice, 1e30, nullptr, a);
    sweep_kernels_v3()->curved(tool, curve, CurvedInstants(curve), from, lattice, 1e30, nullptr, b);
    RC_ASSERT(same());
}

// No instant of a thousand comes nearer than the one that is found, which is as near as it says.
RC_GTEST_PROP(UprightCurve, finds_the_nearest_instant, ()) {
    Cutter cutter = any_cutter();
    cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball);
    const ToolProfile tool(cutter);
    Move move = any_upright_curve();
    // Bends as sharp as those of a bore that is hardly wider than its cutter.
    const Vec3 middle = 0.5 * (move.start.tip_mm + move.end.tip_mm);
    move.quadratic->tip_control_mm += number(0, 3) * (move.quadratic->tip_control_mm - middle);
    const CurvedLine line = curved_line(move);
    const auto curve = UprightCurve::of(tool, line);
    RC_ASSERT(curve.has_value());
    const Vec3 axis = move.start.axis;
    const auto at = [&](Vec3 p, double t) {
        const Vec3 d = p - t * (line.tip1 + t * line.tip2);
        const double z = dot(d, axis), rho = length(d - z * axis);
        return cutter.kind == CutterKind::ball
                   ? std::hypot(rho, std::min(z - tool.radius_mm, 0.0)) - tool.radius_mm
                   : std::max(rho - tool.radius_mm, -z);
    };
    for (int n = 0; n < 20; ++n) {
        const Vec3 p = vector(10);
        const auto near = curve->nearest(p);
        if (!near) continue;
        RC_ASSERT(near->t >= 0 && near->t <= 1);
        RC_ASSERT(std::abs(at(p, near->t) - near->distance_mm) < 1e-9);
        for (int k = 0; k <= 1000; ++k) RC_ASSERT(at(p, k / 1000.0) > near->distance_mm - 1e-9);
        RC_ASSERT(std::abs(curve->lowest_mm(p) -
                           std::min(dot(p, axis), dot(p - line.tip1 - line.tip2, axis))) < 1e-9);
    }
}

// All nodes near the surface, on both kinds of processors.
RC_GTEST_PROP(UprightCurve, of_eight_nodes_at_once_is_that_of_one_point, ()) {
    Cutter cutter = any_cutter();
    cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball);
    cutter.length_mm = 100;  // the top is not the kernel's
    const ToolProfile tool(cutter);
    Move move = any_upright_curve(number(0.02, 1));
    const Vec3 middle = 0.5 * (move.start.tip_mm + move.end.tip_mm);
    move.quadratic->tip_control_mm += number(0, 3) * (move.quadratic->tip_control_mm - middle);
    const CurvedLine line = curved_line(move);
    const auto curve = UprightCurve::of(tool, line);
    RC_ASSERT(curve.has_value());
    const auto sweep = make_sweep(cutter, move);
    for (int round = 0; round < 6; ++round) {
        const auto at = surface_point(*sweep, cutter, move);
        if (!at) continue;
        const double cell = std::exp(number(std::log(0.003), std::log(0.4))), near = 1.8 * cell;
        const field::Lattice lattice{*at - 3 * cell * Vec3{1, 1, 1} + 3 * cell * vector(1), cell, 0, 0, 0};
        float nodes[field::kLatticeNodes], other[field::kLatticeNodes];
        const auto sample = [&](const SweepKernels& kernels, float* out) {
            kernels.upright(tool, curve->line(), curve->frame(), line, move.start.tip_mm, lattice, near,
                            nullptr, out);
        };
        sample(*sweep_kernels_sse2(), nodes);
        const double size = 1 + length(lattice.node(0, 0, 0) - move.start.tip_mm);
        for (int n = 0; n < field::kLatticeNodes; ++n) {
            const Vec3 at_node = lattice.node(n % 8, n / 8 % 8, n / 64);
            const double d = sweep->distance_mm(at_node);
            // Where the square of the distance to the axis may not be convex, it is searched.
            const Vec3 q = curve->frame().into(at_node - move.start.tip_mm);
            const UprightLine& travel = curve->line();
            const bool is_searched = q.x * travel.bend_x + q.y * travel.bend_y > travel.convex_below - 1e-6;
            const double close = (is_searched ? 4e-5 : 2e-5) + 1e-6 * size;
            if (std::abs(d) < near - close) RC_ASSERT(std::abs(nodes[n] - d) < close);
        }
        if (!sweep_kernels_v3()) continue;
        sample(*sweep_kernels_v3(), other);
        RC_ASSERT(std::equal(nodes, nodes + field::kLatticeNodes, other));
    }
}

TEST(UprightCurve, is_none_of_a_turning_axis_an_uneven_rise_or_a_bull_nose) {
    const ToolProfile flat{Cutter{}};
    EXPECT_TRUE(UprightCurve::of(flat, {{4, 0, 1}, {0, 0.1, 0}, {0, 0, 1}, {}, {}}));
    EXPECT_FALSE(UprightCurve::of(flat, {{4, 0, 1}, {0, 0.1, 0.1}, {0, 0, 1}, {}, {}}));
    EXPECT_FALSE(UprightCurve::of(flat, {{4, 0, 1}, {0, 0.1, 0}, {0, 0, 1}, {0.1, 0, 0}, {}}));
    EXPECT_FALSE(UprightCurve::of(ToolProfile{Cutter{.kind = CutterKind::bull, .corner_mm = 1}},
                                  {{4, 0, 1}, {0, 0.1, 0}, {0, 0, 1}, {}, {}}));
}

// Who looks along the tool asks only for the ends of a line.
RC_GTEST_PROP(Sweep, meets_each_line_along_its_axis_in_one_piece, ()) {
    Move move = *rc::gen::inRange(0, 2) == 0 ? any_straight() : any_arc();
    const Vec3 axis = move.start.axis;
    if (!move.arc && *rc::gen::inRange(0, 2) == 0)
        move.quadratic = motion::Quadratic{0.5 * (move.start.tip_mm + move.end.tip_mm) + vector(1), axis};
    const Cutter cutter = any_cutter();
    const auto sweep = make_sweep(cutter, move);
    if (!sweep->is_whole_along(axis)) {
        // On a bent path of a short tool that rises, a line may leave the volume and enter it again.
        RC_ASSERT(move.quadratic.has_value());
        const double half = dot(move.quadratic->tip_control_mm - move.start.tip_mm, axis),
                     end = dot(move.end.tip_mm - move.start.tip_mm, axis);
        RC_ASSERT(std::max({half, end, 0.0}) - std::min({half, end, 0.0}) >
                  cutter.length_mm - cutter.corner_radius_mm());
        return;
    }
    const Vec3 from = (move.arc ? move.arc->centre_mm : move.start.tip_mm) + vector(8) - 12 * axis;
    constexpr double kSure = 1e-4;
    int borders = 0;
    bool inside = false;
    for (int n = 0; n < 600; ++n) {
        const double d = sweep->distance_mm(from + 0.1 * n * axis);
        if (std::abs(d) < kSure || (d < 0) == inside) continue;
        inside = d < 0;
        ++borders;
    }
    RC_ASSERT(borders <= 2);
}

RC_GTEST_PROP(Sweep, gradient_points_where_the_distance_grows, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const auto p = surface_point(*sweep, c, m);
    if (!p) return;
    const Vec3 g = sweep->gradient(*p);
    RC_ASSERT(std::abs(length(g) - 1) < 1e-9);
    // Ahead along it lies the outside, behind it the inside; across it the surface runs on.
    constexpr double kStep = 0.02;
    RC_ASSERT(sweep->distance_mm(*p + kStep * g) > -1e-9);
    RC_ASSERT(sweep->distance_mm(*p - kStep * g) < 1e-9);
}

// Where it grows evenly.
RC_GTEST_PROP(Sweep, tells_how_fast_the_distance_grows_along_the_gradient, ()) {
    const Cutter c = any_cutter();
    const Move m = any_move();
    const auto sweep = make_sweep(c, m);
    const auto p = surface_point(*sweep, c, m);
    if (!p) return;
    const field::Shape::Slope slope = sweep->slope(*p);
    constexpr double kStep = 2e-3;
    const auto at = [&](double way) { return sweep->distance_mm(*p + way * slope.gradient); };
    const double here = at(0), up = (at(kStep) - here) / kStep, down = (here - at(-kStep)) / kStep;
    if (std::abs(up - down) < 0.01)
        RC_ASSERT(std::abs(0.5 * (up + down) - 1 / static_cast<double>(slope.way_per_mm)) < 0.015);
}

// What feels a surface follows its normal: an error of a thousandth beside an edge is a livelock.
RC_GTEST_PROP(Sweep, of_a_ball_has_the_normal_of_its_nearest_centre, ()) {
    Cutter cutter = any_cutter();
    cutter.kind = CutterKind::ball;
    cutter.length_mm = 100;  // out of reach
    const Move move = any_curved(number(0.03, 1));
    const CurvedLine line = curved_line(move);
    const auto sweep = make_sweep(cutter, move);
    const double r = cutter.radius_mm();
    double height = 0;  // above the centre
    const auto from_centre = [&](Vec3 p, double t) {
        const Vec3 axis = normalized(line.axis0 + t * (line.axis1 + t * line.axis2));
        const Vec3 d = p - move.start.tip_mm - t * (line.tip1 + t * line.tip2) - r * axis;
        height = dot(d, axis);
        return d - std::max(height, 0.0) * axis;
    };
    constexpr int kCount = 400;
    for (int round = 0; round < 6; ++round) {
        const auto p = surface_point(*sweep, cutter, move);
        if (!p) continue;
        const auto off = [&](double t) { return squared_length(from_centre(*p, t)); };
        std::array<double, kCount + 1> seen;
        for (int k = 0; k <= kCount; ++k)
            seen[static_cast<std::size_t>(k)] = std::sqrt(off(k / double{kCount}));
        const auto best = static_cast<double>(std::ranges::min_element(seen) - seen.begin());
        // Of two instants that are as near either is right.
        int valleys = 0;
        for (std::size_t k = 0; k <= kCount; ++k) {
            const bool is_low = (k == 0 || seen[k] <= seen[k - 1]) && (k == kCount || seen[k] <= seen[k + 1]);
            if (is_low && seen[k] < *std::ranges::min_element(seen) + 1e-4) ++valleys;
        }
        if (valleys > 1) continue;
        double low = std::max(0.0, (best - 1) / kCount), high = std::min(1.0, (best + 1) / kCount);
        // By the sign of the rate: the least value itself hardly tells instants apart.
        constexpr double kStep = 1e-5;
        for (int n = 0; n < 60; ++n) {
            const double t = 0.5 * (low + high);
            (off(std::min(1.0, t + kStep)) > off(std::max(0.0, t - kStep)) ? high : low) = t;
        }
        const Vec3 normal = normalized(from_centre(*p, 0.5 * (low + high)));
        // Where ball and shank meet, the rate of the slope jumps.
        if (std::abs(height) < 0.02) continue;
        RC_ASSERT(length(sweep->gradient(*p) - normal) < 5e-5);
    }
}

// On the wall of a plunge all instants at which the tip is lower have the same distance: the side makes it,
// whatever the rounding. Likewise the bottom makes the floor of a level move.
TEST(Sweep, of_a_flat_plunge_has_a_level_gradient_at_its_wall) {
    Cutter c;
    c.kind = CutterKind::flat;
    c.diameter_mm = 6;
    const auto plunge = make_sweep(c, straight_move({1, 2, 3}, {0, 0, 1}, {0, 0, -10}));
    const auto level = make_sweep(c, straight_move({1, 2, 3}, {0, 0, 1}, {10, 0, 0}));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (int n = 0; n < 20000; ++n) {
        const double off = 1e-7 * std::floor(5 * share(random) - 2), turn = 6.3 * share(random);
        const Vec3 out{std::cos(turn), std::sin(turn), 0};
        const Vec3 wall = Vec3{1, 2, -6.5 + 9 * share(random)} + (3 + off) * out;
        ASSERT_LT(length(plunge->gradient(wall) - out), 1e-3) << n;
        const Vec3 floor{1 + 10 * share(random), 2 + 5.9 * (share(random) - 0.5), 3 - off};
        ASSERT_LT(length(level->gradient(floor) - Vec3{0, 0, -1}), 1e-3) << n;
    }
}

TEST(Sweep, that_turns_is_not_sure_of_lines) {
    Move move = straight_move({0, 0, 0}, {0, 0, 1}, {5, 0, 0});
    EXPECT_TRUE(make_sweep({}, move)->is_whole_along({0, 0, 1}));
    move.end.axis = normalized({0.1, 0, 1});
    EXPECT_FALSE(make_sweep({}, move)->is_whole_along({0, 0, 1}));
}

TEST(Sweep, of_a_reversed_move_is_the_same_volume) {
    Cutter c;
    c.diameter_mm = 6;
    const Move there = straight_move({3, 4, 5}, normalized({0.2, 0.1, 1}), {5, 2, -1});
    Move back = there;
    std::swap(back.start, back.end);
    const auto a = make_sweep(c, there), b = make_sweep(c, back);
    for (int n = 0; n < 200; ++n) {
        const Vec3 p = there.start.tip_mm + Vec3{0.05 * n - 4, 0.03 * n - 3, 0.02 * n - 2};
        EXPECT_NEAR(a->distance_mm(p), b->distance_mm(p), 1e-9);
    }
}

TEST(Sweep, of_a_tool_at_rest_is_the_tool) {
    for (const CutterKind kind : {CutterKind::flat, CutterKind::ball, CutterKind::bull}) {
        Cutter c;
        c.kind = kind;
        c.corner_mm = 1;
        const Move rest = straight_move({3, 4, 5}, {0, 0, 1}, {});
        const auto sweep = make_sweep(c, rest);
        for (const Vec3 p : {Vec3{7, 0, 3}, Vec3{0.5, 0.2, -1}, Vec3{4.9, 0, 0.05}, Vec3{1, 1, 2}}) {
            EXPECT_NEAR(sweep->distance_mm(rest.start.tip_mm + p) > 0,
                        tool_distance(c, rest.start, rest.start.tip_mm + p) > 0, 0);
        }
    }
}

}  // namespace
}  // namespace tribo::milling
