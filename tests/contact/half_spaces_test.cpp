// SPDX-License-Identifier: MIT
#include "contact/half_spaces.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"

namespace tribo::contact {
namespace {

// Sides through the origin with random normals.
HalfSpaces random_sides(int count, const CounterNoise& noise, std::uint64_t& drawn) {
    HalfSpaces sides;
    for (int n = 0; n < count; ++n) {
        const auto part = [&] { return 2 * noise.uniform(drawn++) - 1; };
        sides.put({normalized(Vec3{part(), part(), part()}, {0, 0, 1}), 0, static_cast<std::uint32_t>(n)}, 1);
    }
    return sides;
}

TEST(HalfSpaces, a_direction_between_the_normals_is_a_sum_of_them) {
    const CounterNoise noise(5);
    std::uint64_t drawn = 0;
    for (int n = 0; n < 2000; ++n) {
        const HalfSpaces sides = random_sides(1 + n % 4, noise, drawn);
        Vec3 direction;
        for (int i = 0; i < sides.count; ++i)
            direction += noise.uniform(drawn++) * sides.side[static_cast<std::size_t>(i)].normal;
        direction = normalized(direction, sides.side[0].normal);
        const HalfSpaces::Cone cone = sides.cone_to(direction);
        ASSERT_GE(cone.count, 1);
        Vec3 sum;
        for (std::size_t k = 0; k < static_cast<std::size_t>(cone.count); ++k) {
            EXPECT_GE(cone.weight[k], 0);
            sum += cone.weight[k] * sides.side[static_cast<std::size_t>(cone.index[k])].normal;
        }
        EXPECT_NEAR(distance(sum, direction), 0, 1e-6) << n;
        EXPECT_LT(cone.miss, 1e-6) << n;
    }
}

TEST(HalfSpaces, a_direction_beside_the_only_normal_misses_by_the_sine_of_the_angle) {
    HalfSpaces sides;
    sides.put({{0, 0, 1}, 0, 0}, 1);
    for (const double angle : {0.0, 0.001, 0.5, 1.5}) {
        const HalfSpaces::Cone cone = sides.cone_to({std::sin(angle), 0, std::cos(angle)});
        ASSERT_EQ(cone.count, 1);
        EXPECT_NEAR(cone.weight[0], std::cos(angle), 1e-12);
        EXPECT_NEAR(cone.miss, std::sin(angle), 1e-12);
    }
    EXPECT_EQ(sides.cone_to({0, 0, -1}).count, 0);
}

}  // namespace
}  // namespace tribo::contact
