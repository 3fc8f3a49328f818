// SPDX-License-Identifier: MIT
// The stock field against closed forms: volumes, heights of cusps, what a brick remembers.
#include "field/carved/carved_field.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>
#include <thread>

#include "field/shape/box_shape.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;
using test::HalfSpace;

CarvedField block(double cell, Vec3 size = {40, 30, 10}) {
    return CarvedField(std::make_unique<BoxShape>(Box3{{0, 0, -size.z}, {size.x, size.y, 0}}), cell);
}

// Height of the surface below (x, y, from above), by bisection of the exact level.
double height_at(const CarvedField& f, double x, double y, double lo, double hi) {
    for (int n = 0; n < 60; ++n) {
        const double mid = 0.5 * (lo + hi);
        (f.distance_mm({x, y, mid}) > 0 ? hi : lo) = mid;
    }
    return 0.5 * (lo + hi);
}

TEST(CarvedField, removes_the_exact_volume_of_a_rectangular_slot) {
    auto f = block(0.25);
    const double removed = f.carve(std::make_unique<BoxShape>(Box3{{-5, 10.1, -3.3}, {50, 16.4, 5}}));
    EXPECT_NEAR(removed / (40 * 6.3 * 3.3), 1, 1e-3);
    EXPECT_EQ(f.carve(std::make_unique<BoxShape>(Box3{{-5, 10.1, -3.3}, {50, 16.4, 5}})), 0);
}

TEST(CarvedField, removes_the_exact_volume_of_a_ball_groove) {
    auto f = block(0.1);
    const double radius = 4, depth = 1.5;
    const double removed = f.carve(
        std::make_unique<BallPass>(Vec3{-10, 15, radius - depth}, Vec3{50, 15, radius - depth}, radius));
    const double half = std::acos((radius - depth) / radius);
    const double section = radius * radius * (half - std::sin(half) * std::cos(half));
    EXPECT_NEAR(removed / (40 * section), 1, 1e-3);
}

TEST(CarvedField, removes_the_exact_volume_above_a_tilted_plane) {
    auto f = block(0.2);
    const double removed = f.carve(
        std::make_unique<HalfSpace>(Vec3{20, 15, -3}, Vec3{0.1, 0.05, 1}, Box3{{-5, -5, -15}, {50, 50, 5}}));
    EXPECT_NEAR(removed / (40 * 30 * 3), 1, 1e-3);
}

TEST(CarvedField, measures_cusps_exactly_at_any_grid_up_to_half_the_sidestep) {
    const double radius = 4, sidestep = 2;
    for (const double cell : {0.1, 0.25, 0.5, 1.0}) {
        auto f = block(cell);
        for (double y = 5; y <= 25; y += sidestep) {
            for (double x = 4; x < 36; x += 1) {
                f.carve(
                    std::make_unique<BallPass>(Vec3{x, y, radius - 2}, Vec3{x + 1, y, radius - 2}, radius));
            }
        }
        double worst = 0;
        for (double y = 9; y < 21; y += 0.01) {
            const double off = std::abs(y - 5 - sidestep * std::round((y - 5) / sidestep));
            const double expected = radius - 2 - std::sqrt(radius * radius - off * off);
            worst = std::max(worst, std::abs(height_at(f, 20.3 + 0.1 * y, y, -3, -1) - expected));
        }
        EXPECT_LT(worst, 1e-6) << "cell " << cell;
    }
}

// A wall between two slots, wherever it stands between the nodes; then without it.
TEST(CarvedField, removes_the_exact_volume_beside_a_wall_thinner_than_a_cell) {
    for (const double cell : {0.3, 0.5}) {
        for (const double width : {0.02, 0.1, 0.25}) {
            for (double y = 15; y < 16; y += 0.137) {
                auto f = block(cell);
                const auto slot = [&](double from, double to) {
                    return f.carve(std::make_unique<BoxShape>(Box3{{-5, from, -6.3}, {50, to, 5}}));
                };
                // At edges of the material the volume is good to a seventh of a cell's section.
                const double rounding = 0.15 * cell * cell * (2 * 40 + 4 * 6.3 + 24);
                const double beside = slot(y - 6, y) + slot(y + width, y + width + 6);
                EXPECT_NEAR(beside, 40 * 6.3 * 12, rounding) << cell << " " << width << " " << y;
                EXPECT_LT(slot(y - 6, y) + slot(y + width, y + width + 6), 1e-6) << "cut again";
                EXPECT_NEAR(beside + slot(y - 1, y + 1), 40 * 6.3 * (12 + width), rounding);
            }
        }
    }
}

// Dives beside a face, deeper and deeper: where the ball stands a hair off it, what is cut again is nothing.
TEST(CarvedField, removes_nothing_where_it_was_cut_before) {
    auto f = block(0.25, {30, 16, 6});
    for (int n = 0; n < 60; ++n) {
        const Vec3 above{2.0 + 2 * (n % 14), 0.5 + 2.9 * (n % 6), 5}, below{above.x, above.y, 2 - 0.05 * n};
        f.carve(std::make_unique<BallPass>(above, below, 3));
        EXPECT_LT(f.carve(std::make_unique<BallPass>(below, above, 3)), 1e-6) << n;
    }
}

TEST(CarvedField, frees_bricks_that_hold_nothing_any_more) {
    auto f = block(0.25);
    f.carve(std::make_unique<BallPass>(Vec3{5, 15, 2}, Vec3{35, 15, 2}, 4));
    EXPECT_GT(f.bricks_in_use(), 0u);
    f.carve(std::make_unique<BoxShape>(Box3{{-5, -5, -20}, {50, 50, 5}}));
    EXPECT_EQ(f.bricks_in_use(), 0u);
    EXPECT_NEAR(f.removed_mm3() / (40 * 30 * 10), 1, 1e-3);
    EXPECT_FALSE(f.is_material({20, 15, -5}));
}

TEST(CarvedField, stays_small_where_the_same_place_is_cut_again_and_again) {
    auto f = block(0.25);
    for (int n = 0; n < 2000; ++n) {
        const double z = 3 - 1e-4 * n;
        f.carve(std::make_unique<BallPass>(Vec3{10, 15, z}, Vec3{12, 15, z}, 4));
    }
    const BrickCoord b = f.brick_at({11, 15, -1.15});
    ASSERT_GE(f.ref(b), kFirstBrick);
    EXPECT_LE(f.brick(f.ref(b)).shapes.size(), 16u);
}

// A pocket in layers of a fifth of a cell: the layer below gives the walls of all layers above it.
TEST(CarvedField, keeps_one_shape_for_a_wall_that_many_layers_share) {
    auto f = block(0.25);
    double depth = 0;
    for (int n = 0; n < 120; ++n) {
        depth += 0.05;
        f.carve(std::make_unique<BoxShape>(Box3{{10, 5, -depth}, {20, 25, 5}}));
    }
    for (const double z : {-1.0, -2.5, -4.0, -5.5}) {
        const BrickRef ref = f.ref(f.brick_at({10, 15, z}));
        ASSERT_GE(ref, kFirstBrick) << z;
        EXPECT_LE(f.brick(ref).shapes.size(), 2u) << z;
        EXPECT_NEAR(f.distance_mm({10.05, 15, z}), 0.05, 1e-12);
        EXPECT_NEAR(f.distance_mm({9.95, 15, z}), -0.05, 1e-12);
    }
    EXPECT_NEAR(f.removed_mm3(), 10 * 20 * depth, 0.5);
}

// True if the ball that gives the distance at p gives it at no node of the brick there: its share of the
// surface is smaller than a cell, and the grid cannot know of it.
bool is_between_nodes(const CarvedField& f, const std::vector<BallPass>& passes, Vec3 p) {
    const auto deepest = [&](Vec3 at) {
        std::size_t best = passes.size();
        double most = f.blank().distance_mm(at);
        for (std::size_t n = 0; n < passes.size(); ++n) {
            if (-passes[n].distance_mm(at) > most) {
                most = -passes[n].distance_mm(at);
                best = n;
            }
        }
        return best;
    };
    const std::size_t here = deepest(p);
    const Lattice lattice = f.lattice(f.brick_at(p));
    for (int n = 0; n < kLatticeNodes; ++n) {
        const int a = n % kLatticeEdge, b = n / kLatticeEdge % kLatticeEdge,
                  c = n / kLatticeEdge / kLatticeEdge;
        if (deepest(lattice.node(a, b, c)) == here) return false;
    }
    return true;
}

RC_GTEST_PROP(CarvedField, agrees_with_the_maximum_over_all_shapes_at_the_surface, ()) {
    auto f = block(0.5);
    std::vector<BallPass> passes;
    const auto coordinate = [](int hi) { return 0.01 * *rc::gen::inRange(0, hi); };
    const int count = *rc::gen::inRange(1, 12);
    for (int n = 0; n < count; ++n) {
        const Vec3 a{coordinate(4000), coordinate(3000), 1 + coordinate(300)};
        const Vec3 b{coordinate(4000), coordinate(3000), 1 + coordinate(300)};
        if (squared_length(b - a) < 1) continue;
        passes.emplace_back(a, b, 3.0);
        f.carve(std::make_unique<BallPass>(passes.back()));
    }
    for (int n = 0; n < 100; ++n) {
        const Vec3 p{coordinate(4000), coordinate(3000), -0.01 * *rc::gen::inRange(1, 500)};
        double expected = f.blank().distance_mm(p);
        for (const BallPass& pass : passes) expected = std::max(expected, -pass.distance_mm(p));
        const double d = f.distance_mm(p);
        if (std::abs(d - expected) > 1e-9 && is_between_nodes(f, passes, p)) {
            RC_ASSERT(d < expected);  // material is left there
            continue;
        }
        // Both near the surface: the same number. Off it: the same side.
        if (std::abs(expected) < 0.2) RC_ASSERT(std::abs(d - expected) < 1e-9);
        if (std::abs(expected) > 1e-9) RC_ASSERT((d < 0) == (expected < 0));
        RC_ASSERT(f.is_material(p) == (d < 0));
    }
}

TEST(CarvedField, gives_the_same_whatever_the_number_of_threads) {
    const auto carve = [](ParallelFor loop) {
        CarvedField f(std::make_unique<BoxShape>(Box3{{0, 0, -10}, {40, 30, 0}}), 0.2, std::move(loop));
        for (int n = 0; n < 20; ++n) {
            f.carve(std::make_unique<BallPass>(Vec3{1.0 + n, 2, 2}, Vec3{30.0 - n, 28, 1}, 3));
        }
        return f;
    };
    const CarvedField one = carve(serial_for);
    const CarvedField two = carve([](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::thread other([&] {
            for (std::size_t n = 1; n < count; n += 2) body(n);
        });
        for (std::size_t n = 0; n < count; n += 2) body(n);
        other.join();
    });
    EXPECT_EQ(one.removed_mm3(), two.removed_mm3());
    EXPECT_EQ(one.bricks_in_use(), two.bricks_in_use());
    for (double y = 1; y < 29; y += 0.7) {
        EXPECT_EQ(height_at(one, 15.5, y, -3, 0.5), height_at(two, 15.5, y, -3, 0.5));
    }
}

}  // namespace
}  // namespace tribo::field
