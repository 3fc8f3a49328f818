// SPDX-License-Identifier: MIT
#include "field/carved/field_reader.hpp"

#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

#include "field/shape/box_shape.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;

CarvedField block() {
    return {std::make_unique<BoxShape>(Box3{{0, 0, -10}, {20, 10, 0}}), 0.25};
}
std::unique_ptr<const Shape> pass(int n) {
    return std::make_unique<BallPass>(Vec3{-5, 1 + 0.3 * n, 2 - 0.2 * n}, Vec3{25, 1 + 0.3 * n, 2 - 0.2 * n},
                                      3);
}

TEST(FieldReader, keeps_what_it_took_while_the_field_goes_on) {
    CarvedField field = block();
    CarvedField twin = block();
    field.carve(pass(0));
    twin.carve(pass(0));
    FieldReader reader(field);
    for (int n = 1; n < 12; ++n) field.carve(pass(n));
    // Some places of all the field, and what the twin says there.
    const auto expect_like_twin = [&] {
        for (double x = 0.1; x < 20; x += 1.7) {
            for (double y = 0.1; y < 10; y += 0.31) {
                for (double z = -3; z < 1; z += 0.23) {
                    const Vec3 p{x, y, z};
                    ASSERT_EQ(reader.distance_mm(p), twin.distance_mm(p));
                }
            }
        }
    };
    expect_like_twin();
    EXPECT_TRUE(reader.refresh());
    EXPECT_FALSE(reader.refresh());
    for (int n = 1; n < 12; ++n) twin.carve(pass(n));
    expect_like_twin();
    EXPECT_EQ(reader.version(), 12u);
}

TEST(FieldReader, leaves_the_field_as_it_would_be_without_it) {
    CarvedField served = block(), alone = block();
    double removed_served = 0, removed_alone = 0;
    {
        FieldReader reader(served);
        for (int n = 0; n < 12; ++n) {
            removed_served += served.carve(pass(n));
            removed_alone += alone.carve(pass(n));
            if (n % 5 == 0) reader.refresh();
        }
    }
    EXPECT_EQ(removed_served, removed_alone);
    EXPECT_EQ(served.bricks_in_use(), alone.bricks_in_use());  // nothing is kept for a reader that has left
    FieldReader again(served);
    served.carve(pass(12));
    again.refresh();
    alone.carve(pass(12));
    EXPECT_EQ(again.distance_mm({5, 4.6, -2.9}), alone.distance_mm({5, 4.6, -2.9}));
}

// However long the reader stays where it is, no more is kept for it than the bricks it can see.
TEST(FieldReader, that_stands_still_costs_a_bounded_number_of_bricks) {
    CarvedField served = block(), alone = block();
    served.carve(pass(0));
    alone.carve(pass(0));
    const std::size_t seen = served.bricks_in_use();
    FieldReader reader(served);
    for (int n = 0; n < 60; ++n) {
        served.carve(pass(n % 20));
        alone.carve(pass(n % 20));
        ASSERT_LE(served.bricks_in_use(), alone.bricks_in_use() + seen);
    }
}

// Material only goes: whatever the carver does meanwhile, distances at a place never fall, and what is read
// is one state, not a mixture.
TEST(FieldReader, reads_while_another_thread_carves) {
    CarvedField field = block();
    field.carve(pass(0));
    FieldReader reader(field);
    std::atomic<bool> done = false;
    std::thread carver([&] {
        for (int round = 0; round < 6; ++round) {
            for (int n = 0; n < 30; ++n) {
                field.carve(std::make_unique<BallPass>(Vec3{-5, 0.3 * n, 2 - 0.3 * round},
                                                       Vec3{25, 0.3 * n, 2 - 0.3 * round}, 3));
            }
        }
        done = true;
    });
    double last[16] = {};
    for (double& d : last) d = -1e9;
    long rounds = 0;
    Version version = 0;
    while (!done) {
        reader.refresh();
        EXPECT_GE(reader.version(), version);
        version = reader.version();
        for (int n = 0; n < 16; ++n) {
            const Vec3 p{1 + n * 1.1, 0.6 * n, -0.8};
            const double d = reader.distance_mm(p);
            EXPECT_EQ(d, reader.sample(p).distance_mm);
            if (std::abs(d) > 0.2) continue;
            EXPECT_GE(d, last[n] - 1e-9);
            last[n] = d;
        }
        ++rounds;
    }
    carver.join();
    EXPECT_GT(rounds, 0);
    reader.refresh();
    EXPECT_EQ(reader.version(), 181u);
}

}  // namespace
}  // namespace tribo::field
