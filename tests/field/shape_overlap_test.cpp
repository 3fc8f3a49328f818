// SPDX-License-Identifier: MIT
// Overlaps of solids against what boxes and balls say in closed form, and against a search of all points.
#include "field/shape/shape_overlap.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "field/mesh/mesh_shape.hpp"
#include "field/shape/box_shape.hpp"
#include "mesh_samples.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

double drawn(double low, double high) {
    return low + (high - low) * 1e-4 * *rc::gen::inRange(0, 10001);
}

Vec3 drawn_point(double reach) {
    return {drawn(-reach, reach), drawn(-reach, reach), drawn(-reach, reach)};
}

class Ball final : public test::PlainShape {
  public:
    Ball(Vec3 centre, double radius) : centre_(centre), radius_(radius) {}
    Box3 bounds_mm() const override { return Box3{centre_, centre_}.inflated(radius_); }
    double distance_mm(Vec3 p) const override { return distance(p, centre_) - radius_; }
    Vec3 gradient(Vec3 p) const override { return normalized(p - centre_, {0, 0, 1}); }

  private:
    Vec3 centre_;
    double radius_;
};

// A mesh of a box, turned by any angle, as thin as a foil.
std::unique_ptr<MeshShape> turned_box(Vec3 centre, Vec3 half) {
    const Vec3 z = normalized(drawn_point(1), {0, 0, 1}), x = any_perpendicular(z), y = cross(z, x);
    TriangleMesh mesh = test::box_mesh({-half, half});
    for (Point3f& p : mesh.positions) {
        const Vec3 q = centre + static_cast<double>(p[0]) * x + static_cast<double>(p[1]) * y +
                       static_cast<double>(p[2]) * z;
        p = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    }
    return std::move(*MeshShape::make(mesh));
}

TEST(SharedPlace, a_sheet_as_thin_as_paper_is_met) {
    const BoxShape tool({{-5, -5, 0}, {500, 5, 30}});
    for (const double thick : {1.0, 0.1, 0.001, 1e-5}) {
        const BoxShape sheet({{200, -40, -40}, {200 + thick, 80, 5}});
        const auto place = shared_place(tool, sheet, 0.05);
        ASSERT_TRUE(place.has_value()) << thick;
        EXPECT_LT(sheet.distance_mm(*place), 0);
        EXPECT_LT(tool.distance_mm(*place), -0.05);
    }
}

TEST(SharedPlace, what_only_touches_or_is_less_deep_than_asked_for_is_none) {
    const BoxShape tool({{0, 0, 0}, {10, 10, 10}});
    EXPECT_FALSE(shared_place(tool, BoxShape({{0, 0, -5}, {10, 10, 0}}), 0).has_value());
    EXPECT_FALSE(shared_place(tool, BoxShape({{0, 0, -5}, {10, 10, 0.04}}), 0.05).has_value());
    EXPECT_TRUE(shared_place(tool, BoxShape({{0, 0, -5}, {10, 10, 0.1}}), 0.05).has_value());
    EXPECT_FALSE(shared_place(tool, BoxShape({{20, 0, -5}, {30, 10, 0.08}}), 0.05).has_value());
}

// A ball and a turned plate: they share a place as deep as asked for exactly when the ball's depth at the
// nearest point of the plate says so.
RC_GTEST_PROP(SharedPlace, of_a_ball_and_a_turned_plate_is_as_the_distance_says, ()) {
    const double radius = drawn(0.1, 8), depth = *rc::gen::element(0.0, 0.05, 0.5);
    const Vec3 centre = drawn_point(12);
    const Ball ball(centre, radius);
    const auto plate = turned_box(drawn_point(6), {drawn(0.001, 1), drawn(0.5, 10), drawn(0.5, 10)});
    const auto place = shared_place(ball, *plate, depth);
    if (place) {
        RC_ASSERT(plate->distance_mm(*place) < 0);
        RC_ASSERT(ball.distance_mm(*place) < -depth);
    }
    const double reach = radius - depth - std::max(0.0, plate->distance_mm(centre));
    if (reach > 4 * kFinestOverlapMm) RC_ASSERT(place.has_value());
    if (reach < 0) RC_ASSERT(!place.has_value());
}

// Two turned boxes: wherever points of a lattice lie in both, a place is found, and what is found is in both.
RC_GTEST_PROP(SharedPlace, is_found_where_a_search_of_all_points_finds_one, ()) {
    const Vec3 half{drawn(0.01, 3), drawn(0.3, 6), drawn(0.3, 6)};
    const auto a = turned_box(drawn_point(4), half);
    const auto b = turned_box(drawn_point(4), {drawn(0.01, 3), drawn(0.3, 6), drawn(0.3, 6)});
    const auto place = shared_place(*a, *b, 0);
    if (place) {
        RC_ASSERT(a->distance_mm(*place) < 0);
        RC_ASSERT(b->distance_mm(*place) < 0);
        return;
    }
    const Box3 box = a->bounds_mm();
    for (int n = 0; n < 4000; ++n) {
        const auto along = [&](int axis, int of, int steps) {
            return box.min[axis] + (box.max[axis] - box.min[axis]) * (of % steps + 0.5) / steps;
        };
        const Vec3 p{along(0, n, 16), along(1, n / 16, 16), along(2, n / 256, 16)};
        RC_ASSERT(!(a->distance_mm(p) < -4 * kFinestOverlapMm && b->distance_mm(p) < 0));
    }
}

}  // namespace
}  // namespace tribo::field
