// SPDX-License-Identifier: MIT
// A probe on milled material: against closed forms, while it is cut, and without an allocation.
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

#include "base/counted_allocations.hpp"
#include "field/carved/field_reader.hpp"
#include "field/mesh/mesh_shape.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/contact/field_contact.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::haptics {
namespace {

using tribo::test::allocations;

constexpr double kBall = 5;

std::unique_ptr<const field::Shape> pass(double x, double bottom) {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 2 * kBall;
    cutter.flutes = 2;
    cutter.length_mm = 30;
    motion::Move move;
    move.start.tip_mm = {x, -20, bottom};
    move.end.tip_mm = {x, 40, bottom};
    return milling::make_sweep(cutter, move);
}

// Scallops of 25 um: passes of a ball every millimetre, bottoms at z = -1.
std::unique_ptr<field::CarvedField> scallops(double cell = 0.25) {
    auto field = std::make_unique<field::CarvedField>(
        std::make_unique<field::BoxShape>(Box3{{0, 0, -6}, {20, 20, 0}}), cell);
    for (int x = -3; x <= 23; ++x) field->carve(pass(x, -1));
    return field;
}

// How far a point in the material is from air: the nearest pass. For a ball of that radius the passes are
// narrower.
double depth_under_passes(Vec3 p, double radius) {
    double least = 1e9;
    for (int x = -3; x <= 23; ++x)
        least = std::min(least, std::hypot(p.x - x, p.z - (kBall - 1)) - (kBall - radius));
    return least;
}

TEST(CarvedContact, pushes_back_by_the_distance_to_the_air_at_every_depth) {
    const auto field = scallops();
    for (const double radius : {0.0, 0.3}) {
        for (const double depth : {0.05, 0.2, 0.5, 1.0}) {
            ContactOptions options;
            options.stiffness_n_per_mm = 1;
            options.probe_radius_mm = radius;
            FieldContact contact(*field, options);
            contact.update({4, 4, 1});
            double sum = 0, right = 0;
            int off = 0;
            for (int n = 0; n < 3000; ++n) {
                const Vec3 p{4 + 0.004 * n, 4 + 0.003 * n, -1 + radius - depth};
                const ProbeContact c = contact.update(p);
                const double force = length(c.force_n), wanted = depth_under_passes(p, radius);
                sum += force;
                right += wanted;
                if (std::abs(force - wanted) > 0.2 * wanted + 0.02) ++off;
                EXPECT_GE(dot(c.force_n, c.normal), 0);
            }
            EXPECT_NEAR(sum / right, 1, 0.05) << radius << " " << depth;
            EXPECT_EQ(off, 0) << radius << " " << depth;
        }
    }
}

TEST(CarvedContact, does_not_depend_on_the_grid) {
    const auto fine = scallops(0.2), coarse = scallops(0.45);
    FieldContact a(*fine), b(*coarse);
    a.update({4, 4, 1});
    b.update({4, 4, 1});
    for (int n = 0; n < 1000; ++n) {
        const Vec3 p{4 + 0.01 * n, 5, -1.4};
        EXPECT_NEAR(distance(a.update(p).force_n, b.update(p).force_n), 0, 2e-3) << n;
    }
}

// A part that was only read: a field whose blank is a mesh, and from which nothing is carved.
TEST(CarvedContact, is_the_same_on_a_mesh_that_was_read) {
    TriangleMesh box;
    for (int n = 0; n < 8; ++n)
        box.positions.push_back({n & 1 ? 20.f : 0.f, n & 2 ? 20.f : 0.f, n & 4 ? 0.f : -6.f});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    auto shape = field::MeshShape::make(std::move(box));
    ASSERT_TRUE(shape);
    const field::CarvedField field(std::move(*shape), 0.5);
    for (const double radius : {0.0, 0.4}) {
        ContactOptions options;
        options.stiffness_n_per_mm = 1;
        options.probe_radius_mm = radius;
        FieldContact contact(field, options);
        contact.update({5, 5, 2});
        for (int n = 0; n < 200; ++n) {
            const ProbeContact c = contact.update({5 + 0.05 * n, 5, radius - 0.3});
            EXPECT_NEAR(distance(c.force_n, {0, 0, 0.3}), 0, 1e-3) << radius << " " << n;
        }
        // Over the edge at x = 20 and down the side.
        for (int n = 0; n < 200; ++n) {
            const double t = 0.05 * n;
            contact.update({15 + t, 5, radius - 0.3});
        }
        EXPECT_FALSE(contact.update({25, 5, -0.3}).in_contact);
    }
}

// The servo's side of a cut: what it feels never kicks inwards, and it follows the surface down.
TEST(CarvedContact, goes_on_while_another_thread_carves) {
    auto field = scallops();
    field::FieldReader reader(*field);
    FieldContact contact(reader);
    contact.update({10, 10, 1});
    std::atomic<bool> done = false;
    std::thread carver([&] {
        for (int layer = 1; layer <= 6; ++layer) {
            for (int x = 4; x <= 16; ++x) field->carve(pass(x, -1 - 0.05 * layer));
        }
        done = true;
    });
    bool last = false;
    ProbeContact c;
    int n = 0;
    while (!last) {
        last = done;
        reader.refresh();
        for (int k = 0; k < 20; ++k, ++n)
            c = contact.update({10 + std::sin(0.003 * n), 10 + 2 * std::cos(0.002 * n), -1.6});
        EXPECT_GE(c.force_n.z, 0);
        EXPECT_GE(dot(c.force_n, c.normal), 0);
    }
    carver.join();
    for (int k = 0; k < 50; ++k) c = contact.update({10, 10, -1.6});
    EXPECT_NEAR(c.force_n.z, 0.5 * 0.3, 1e-3);
}

TEST(CarvedContact, allocates_nothing) {
    auto field = scallops();
    field::FieldReader reader(*field);
    for (const double radius : {0.0, 0.5}) {
        ContactOptions options;
        options.probe_radius_mm = radius;
        options.friction_static = 0.4;
        options.friction_kinetic = 0.3;
        FieldContact contact(reader, options);
        const long before = allocations;
        double sum = 0;
        for (int n = 0; n < 2000; ++n) {
            reader.refresh();
            sum += contact
                       .update({6 + 3 * std::sin(0.01 * n), 6 + 3 * std::cos(0.013 * n),
                                -1.2 + radius + std::sin(0.02 * n)})
                       .force_n.z;
        }
        EXPECT_EQ(allocations - before, 0);
        EXPECT_GT(sum, 0);
    }
}

// A stylus lying on the surface is held all along, not only at its tip; which way it points matters.
TEST(CarvedContact, a_stylus_touches_with_all_its_length) {
    const auto field = scallops();
    FieldContact contact(*field);
    const auto stylus = [](Vec3 way) {
        std::array<Vec3, 21> balls;
        for (std::size_t n = 0; n < balls.size(); ++n) balls[n] = 0.5 * static_cast<double>(n) * way;
        return balls;
    };
    const auto up = stylus({0, 0, 1}), down = stylus(normalized({0, 1, -0.05}));
    contact.update({10, 5, 1}, up);
    EXPECT_FALSE(contact.update({10, 5, -0.8}, up).in_contact);
    // Tilted over, its far end would be 0.3 mm in.
    ProbeContact c;
    for (int n = 0; n < 20; ++n) c = contact.update({10, 5, -0.8}, down);
    EXPECT_TRUE(c.in_contact);
    EXPECT_NEAR(c.force_n.z, 0.5 * (10 * 0.05 / std::hypot(1, 0.05) - 0.2), 0.01);
    EXPECT_GT(c.lever_mm.y, 9);
}

}  // namespace
}  // namespace tribo::haptics
