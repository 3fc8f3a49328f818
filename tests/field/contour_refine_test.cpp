// SPDX-License-Identifier: MIT
// A refined mesh against the solids that it shows: between its vertices it follows them too, and it stays a
// solid.
#include "field/contour/contour_refine.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/contour/contour.hpp"
#include "field/shape/box_shape.hpp"
#include "self_intersection.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;
using tribo::test::expect_solid;

// A round pocket with a flat floor, or, inside out, all but a round pin.
class Pocket final : public test::PlainShape {
  public:
    Pocket(Vec3 middle_of_floor, double radius, bool pin = false)
        : middle_(middle_of_floor), radius_(radius), pin_(pin) {}
    Box3 bounds_mm() const override {
        const double reach = pin_ ? 100 : radius_;
        return {middle_ - Vec3{reach, reach, 0}, middle_ + Vec3{reach, reach, 100}};
    }
    double distance_mm(Vec3 p) const override { return std::max(beside(p), middle_.z - p.z); }
    Vec3 gradient(Vec3 p) const override {
        if (middle_.z - p.z > beside(p)) return {0, 0, -1};
        return (pin_ ? -1.0 : 1.0) * normalized({p.x - middle_.x, p.y - middle_.y, 0}, {1, 0, 0});
    }

  private:
    double beside(Vec3 p) const {
        const double off = std::hypot(p.x - middle_.x, p.y - middle_.y) - radius_;
        return pin_ ? -off : off;
    }
    Vec3 middle_;
    double radius_;
    bool pin_;
};

// Of vertices, middles of edges and of triangles: the farthest, and how many are off by more than 0.02 mm.
struct Off {
    double most_mm = 0;
    std::size_t far = 0;
};
Off off_surface(const CarvedField& field, const TriangleMesh& mesh) {
    Off off;
    const auto look = [&](Vec3 p) {
        const double mm = std::abs(field.distance_mm(p));
        off.most_mm = std::max(off.most_mm, mm);
        off.far += mm > 0.02 ? 1 : 0;
    };
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.position(t[0]), b = mesh.position(t[1]), c = mesh.position(t[2]);
        for (const Vec3 p : {a, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3}) look(p);
    }
    return off;
}

TEST(ContourRefine, follows_round_walls_and_their_edges_on_coarse_grids) {
    for (const double cell : {0.2, 0.37, 0.71, 1.3}) {
        for (const double radius : {3.0, 7.77}) {
            for (const bool pin : {false, true}) {
                CarvedField field(std::make_unique<BoxShape>(Box3{{-10, -10, -9}, {10, 10, 0}}), cell);
                field.carve(std::make_unique<Pocket>(Vec3{0.123, 0.071, -5.3}, radius, pin));
                TriangleMesh mesh = contour(field);
                refine(mesh, field, 0.01);
                const double most_mm = cell < radius / 3 ? 0.021 : 0.06;
                EXPECT_LT(off_surface(field, mesh).most_mm, most_mm) << cell << " " << radius << " " << pin;
                expect_solid(mesh);
                const double disc = std::acos(-1.0) * radius * radius;
                EXPECT_NEAR(volume_mm3(mesh), 400 * 9 - 5.3 * (pin ? 400 - disc : disc), 0.004 * 5.3 * disc)
                    << cell << " " << radius << " " << pin;
            }
        }
    }
}

TEST(ContourRefine, of_flats_changes_nothing) {
    CarvedField field(std::make_unique<BoxShape>(Box3{{-10, -10, -9}, {10, 10, 0}}), 0.7);
    field.carve(std::make_unique<BoxShape>(Box3{{-3.1, -20, -4.2}, {2.7, 20, 5}}));
    const TriangleMesh before = contour(field);
    TriangleMesh after = before;
    refine(after, field, 0.01);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.positions, before.positions);
}

// Grooves of balls that are not much wider than a cell, at random, with their cusps and corners.
TEST(ContourRefine, of_random_grooves_stays_a_solid_and_comes_nearer) {
    const CounterNoise noise(21);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    std::size_t far_before = 0, far_after = 0;
    for (int n = 0; n < 40; ++n) {
        const double cell = between(0.2, 1.2);
        CarvedField field(std::make_unique<BoxShape>(Box3{{0, 0, -8}, {16, 13, 0}}), cell);
        for (int k = 0; k < 12; ++k) {
            const double radius = cell * between(1, 8), z = radius - between(0.1, 3);
            field.carve(std::make_unique<BallPass>(Vec3{between(-2, 18), between(-2, 15), z},
                                                   Vec3{between(-2, 18), between(-2, 15), z}, radius));
        }
        field.carve(std::make_unique<Pocket>(Vec3{between(0, 16), between(0, 13), between(-4, -1)},
                                             cell * between(2, 5)));
        TriangleMesh mesh = contour(field);
        const Off before = off_surface(field, mesh);
        refine(mesh, field, 0.01);
        const Off after = off_surface(field, mesh);
        far_before += before.far;
        far_after += after.far;
        EXPECT_LE(after.most_mm, before.most_mm + 0.02) << n;
        expect_solid(mesh);
    }
    EXPECT_LT(4 * far_after, 3 * far_before);
}

TEST(ContourRefine, does_not_depend_on_the_order_of_the_work) {
    CarvedField field(std::make_unique<BoxShape>(Box3{{-10, -10, -9}, {10, 10, 0}}), 0.6);
    field.carve(std::make_unique<Pocket>(Vec3{0.123, 0.071, -5.3}, 6));
    field.carve(std::make_unique<BallPass>(Vec3{-12, 2, 1}, Vec3{12, 3, 1}, 4));
    TriangleMesh forth = contour(field), back = forth;
    refine(forth, field, 0.003);
    refine(back, field, 0.003, [](std::size_t count, const std::function<void(std::size_t)>& body) {
        for (std::size_t n = count; n-- > 0;) body(n);
    });
    EXPECT_EQ(forth.triangles, back.triangles);
    EXPECT_EQ(forth.positions, back.positions);
}

}  // namespace
}  // namespace tribo::field
