// SPDX-License-Identifier: MIT
// A point that is drawn along the bottom of a sharp groove: without friction nothing holds it back.
#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "field/carved/carved_field.hpp"
#include "field/mesh/mesh_field.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/contact/field_contact.hpp"
#include "milling/sweep/sweep.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::haptics {
namespace {

constexpr double kDeep = 2;  // the bottom of the groove lies so far under z = 0, mm

// A block with a groove along a direction in x and y.
std::unique_ptr<field::MeshField> grooved_mesh(double angle, double yaw) {
    const double half = kDeep * std::tan(0.5 * angle);
    const double across[] = {-8, -half, 0, half, 8, 8, -8}, height[] = {0, 0, -kDeep, 0, 0, -6, -6};
    constexpr std::uint32_t kCorners = 7, kEnd[][3] = {{0, 6, 1}, {1, 6, 2}, {2, 6, 5}, {2, 5, 3}, {3, 5, 4}};
    TriangleMesh mesh;
    for (const double along : {-20.0, 20.0}) {
        for (std::size_t n = 0; n < kCorners; ++n) {
            mesh.positions.push_back(
                to_float({std::cos(yaw) * along - std::sin(yaw) * across[n],
                          std::sin(yaw) * along + std::cos(yaw) * across[n], height[n]}));
        }
    }
    for (std::uint32_t n = 0; n < kCorners; ++n) {
        const std::uint32_t next = (n + 1) % kCorners;
        mesh.triangles.push_back({n, next, next + kCorners});
        mesh.triangles.push_back({n, next + kCorners, n + kCorners});
    }
    for (const auto& e : kEnd) {
        mesh.triangles.push_back({e[0], e[1], e[2]});
        mesh.triangles.push_back({e[0] + kCorners, e[2] + kCorners, e[1] + kCorners});
    }
    auto field = field::MeshField::make(mesh);
    EXPECT_TRUE(field && !(*field)->is_sheet());
    return std::move(*field);
}

std::unique_ptr<field::CarvedField> grooved_stock(double angle, double yaw) {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::v;
    cutter.diameter_mm = 2 * kDeep * std::tan(0.5 * angle);
    cutter.point_deg = angle * math::kDegPerRad;
    cutter.length_mm = 0;
    EXPECT_TRUE(milling::make_profile(cutter));
    auto field = std::make_unique<field::CarvedField>(
        std::make_unique<field::BoxShape>(Box3{{-15, -15, -6}, {15, 15, 0}}), 0.15);
    const Vec3 along = 12 * Vec3{std::cos(yaw), std::sin(yaw), 0}, bottom{0, 0, -kDeep};
    motion::Move move;
    move.start.tip_mm = bottom - along;
    move.end.tip_mm = bottom + along;
    field->carve(milling::make_sweep(cutter, move));
    return field;
}

// Drawn 0.5 mm under the bottom over 8 mm, `aside` the groove's middle.
void expect_no_drag(const contact::DistanceField& field, double yaw, double hz, double aside,
                    const std::string& what) {
    constexpr double kSpring = 0.5, kSpeed = 20, kWay = 8;  // N/mm, mm/s, mm
    ContactOptions options;
    options.stiffness_n_per_mm = kSpring;
    options.tick_s = 1 / hz;
    FieldContact contact(field, options);
    const Vec3 along{std::cos(yaw), std::sin(yaw), 0}, across{-along.y, along.x, 0};
    const auto at = [&](double way, double z) { return way * along + aside * across + Vec3{0, 0, z}; };
    (void)contact.update(at(-0.5 * kWay, 3));
    const int down = static_cast<int>(0.2 * hz), ticks = static_cast<int>(kWay / kSpeed * hz);
    for (int n = 1; n <= down; ++n)
        (void)contact.update(at(-0.5 * kWay, 3 - (3.5 + kDeep) * n / static_cast<double>(down)));
    double most = 0;
    for (int n = 0; n <= ticks; ++n) {
        const ProbeContact felt =
            contact.update(at(kWay * (n / static_cast<double>(ticks) - 0.5), -kDeep - 0.5));
        most = std::max(most, std::abs(dot(felt.force_n, along)));
    }
    // Some ticks of the way, while it finds out how sharp the groove is.
    EXPECT_LE(most, 0.3 * kSpring) << what;
    ProbeContact held;
    for (int n = 0; n < 0.02 * hz; ++n) held = contact.update(at(0.5 * kWay, -kDeep - 0.5));
    EXPECT_TRUE(held.settled) << what;
    EXPECT_NEAR(distance(held.force_n, {0, 0, 0.5 * kSpring}), 0, 5e-3) << what;
}

TEST(SharpGroove, lets_a_point_pass_along_its_bottom) {
    for (const double degrees : {8, 10, 15, 20, 25, 30, 45, 60, 90}) {
        const double angle = degrees * math::kRadPerDeg;
        for (const double yaw : {0.0, 0.3}) {
            const auto mesh = grooved_mesh(angle, yaw);
            const auto stock = grooved_stock(angle, yaw);
            for (const double hz : {1000.0, 10000.0}) {
                for (const double aside : {0.0, 0.001}) {
                    const std::string what = std::to_string(degrees) + " degrees, yaw " +
                                             std::to_string(yaw) + ", " + std::to_string(hz) + " Hz, " +
                                             std::to_string(aside);
                    expect_no_drag(*mesh, yaw, hz, aside, "mesh, " + what);
                    if (degrees >= 10) expect_no_drag(*stock, yaw, hz, aside, "stock, " + what);
                }
            }
        }
    }
}

}  // namespace
}  // namespace tribo::haptics
