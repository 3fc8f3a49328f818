// SPDX-License-Identifier: MIT
// A hand that goes anywhere on meshes of other people: into them, through them, and held.
#include <gtest/gtest.h>
#include <string>

#include "field/any_mesh.hpp"
#include "field/mesh/mesh_field.hpp"
#include "haptics/rider.hpp"

namespace tribo::haptics {
namespace {

using test::Rider;
using test::Rides;
using tribo::test::Draw;

enum class Kind { bumpy_ball, star, wide_star, two_bodies, sheet, tube, crumpled_ball };

TriangleMesh any_mesh(Draw& draw, Kind kind) {
    if (kind == Kind::bumpy_ball) return field::test::any_bumpy_ball(draw);
    if (kind == Kind::two_bodies) return field::test::any_two_bodies(draw);
    if (kind == Kind::sheet) return field::test::any_sheet(draw);
    if (kind == Kind::tube) return field::test::any_tube(draw);
    if (kind == Kind::crumpled_ball) return field::test::any_crumpled_ball(draw);
    return field::test::any_star(draw, kind == Kind::wide_star);
}

Rides ride_meshes(std::uint64_t seed, std::uint64_t scenes, Kind kind, bool points) {
    Rides rides;
    for (std::uint64_t n = 0; n < scenes; ++n) {
        Draw draw(seed, n);
        const auto made = field::MeshField::make(any_mesh(draw, kind));
        EXPECT_TRUE(made) << n;
        if (!made) continue;
        const Box3 box = (*made)->bounds_mm();
        const double half = 0.5 * distance(box.min, box.max);
        const Vec3 middle = lerp(box.min, box.max, 0.5);
        for (int k = 0; k < 8; ++k) {
            constexpr double kRates[] = {1000, 4000, 10000};
            const double radius = points ? 0 : draw.between(0.05, 2);
            Rider hand(**made, radius, draw.one_of(kRates), rides);
            hand.begin(middle + (1.5 * half + radius + 3) * draw.direction());
            Vec3 to;
            for (int hold = 0; hold < 5; ++hold) {
                const double far = hold < 3 ? draw.between(0, 0.9) * half : draw.between(0, 2);
                to = (hold < 3 ? middle : to) + far * draw.direction();
                hand.go(to, draw.between(100, 2000));
                hand.hold(false);
            }
        }
    }
    return rides;
}

// At the border of a bent sheet its wall may end in the air: there 1 hold in 300 stands still.
TEST(RideMeshes, feels_a_spring_to_the_nearest_free_place) {
    for (const Kind kind : {Kind::bumpy_ball, Kind::star, Kind::wide_star, Kind::two_bodies, Kind::sheet}) {
        for (const bool points : {true, false}) {
            const Rides rides = ride_meshes(31, 30, kind, points);
            const auto what = [&] {
                return std::to_string(static_cast<int>(kind)) + (points ? " points" : " balls");
            };
            EXPECT_EQ(rides.in_wall, 0) << what();
            EXPECT_LE(rides.stuck, kind == Kind::sheet ? rides.holds / 300 : 0) << what();
            EXPECT_LE(rides.weak, 1 + rides.holds / 1000) << what();
            EXPECT_LE(rides.not_least, 1 + rides.holds / (kind == Kind::sheet && !points ? 50 : 300))
                << what();
        }
    }
}

// Surfaces that pass through each other leave cracks of some micrometres: a point may stand still in one.
TEST(RideMeshes, feels_the_outside_of_a_mesh_that_passes_through_itself) {
    for (const Kind kind : {Kind::tube, Kind::crumpled_ball}) {
        for (const bool points : {true, false}) {
            const Rides rides = ride_meshes(31, 20, kind, points);
            const auto what = [&] {
                return std::to_string(static_cast<int>(kind)) + (points ? " points" : " balls");
            };
            const long share = kind == Kind::tube ? 40 : 12;
            EXPECT_EQ(rides.in_wall, 0) << what();
            EXPECT_LE(rides.stuck, points ? rides.holds / share : 0) << what();
            EXPECT_LE(rides.weak, points ? rides.holds / 60 : 1 + rides.holds / 300) << what();
            EXPECT_LE(rides.not_least, points ? rides.holds / share : 1 + rides.holds / 300) << what();
        }
    }
}

}  // namespace
}  // namespace tribo::haptics
