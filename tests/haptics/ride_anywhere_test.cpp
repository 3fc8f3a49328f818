// SPDX-License-Identifier: MIT
// A hand that goes anywhere in stock after any passes: into them, through their walls, held, and out above
// the stock. Above the stock there is nothing; what it feels elsewhere is checked by rider.hpp.
#include <array>
#include <gtest/gtest.h>

#include "haptics/rider.hpp"
#include "milling/any_passes.hpp"

namespace tribo::haptics {
namespace {

using milling::test::AnyPasses;
using milling::test::Draw;
using test::Rider;
using test::Rides;

Rides ride_anywhere(std::uint64_t seed, std::uint64_t scenes, double meeting_share) {
    Rides rides;
    for (std::uint64_t n = 0; n < scenes; ++n) {
        const bool upright = n % 2 == 0;
        Draw draw(seed, n);
        const AnyPasses stock(draw, meeting_share, upright);
        for (int k = 0; k < 8; ++k) {
            constexpr double kRates[] = {1000, 4000, 10000};
            const double radius = k % 4 == 0 ? 0 : draw.between(0.1, 1.5),
                         above = AnyPasses::kTop + radius + 2;
            Rider hand(*stock.field, radius, draw.one_of(kRates), rides);
            const Vec3 start = stock.on_way(draw);
            hand.begin({start.x, start.y, above});
            std::array<Vec3, 4> way;
            way[0] = start + Vec3{0, 0, radius} + draw.aside(1, -0.6, 1.5);
            way[1] = way[0] + draw.aside(4, -1, 3);
            way[2] = way[1] + draw.aside(4, -2, 2);
            way[3] = {way[2].x, way[2].y, above};
            for (const Vec3& to : way) {
                hand.go(to, draw.between(300, 2000));
                hand.hold(upright && &to == &way.back());
            }
        }
    }
    return rides;
}

void expect_sound(std::uint64_t seed, std::uint64_t scenes) {
    for (const double meeting_share : {0.0, 0.5}) {
        const Rides rides = ride_anywhere(seed, scenes, meeting_share);
        EXPECT_EQ(rides.in_air, 0) << rides.holds;
        EXPECT_LE(rides.in_wall, rides.holds / 10000) << rides.holds;
        // Wide balls in slots as wide creep still after 30 ms, and some rest too early on edges that bend.
        EXPECT_LE(rides.weak, 1 + rides.holds / 2000) << rides.holds;
        EXPECT_LE(rides.not_least, 1 + rides.holds / 500) << rides.holds;
        EXPECT_LE(rides.stuck, rides.holds / 5000) << rides.holds;
    }
}

TEST(RideAnywhere, feels_a_spring_to_the_nearest_free_place_and_nothing_above_the_stock) {
    expect_sound(41, 25);
}

// For a long `make soak`.
TEST(RideAnywhere, DISABLED_feels_a_spring_to_the_nearest_free_place_in_a_hundred_thousand_holds) {
    expect_sound(51, 1600);
}

}  // namespace
}  // namespace tribo::haptics
