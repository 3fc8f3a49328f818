// SPDX-License-Identifier: MIT
// A probe on a surface that was only read and is open: front, back, border, and a trough.
#include <cmath>
#include <gtest/gtest.h>

#include "field/mesh/mesh_field.hpp"
#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

constexpr double kTrough = 30;

// 40 x 20 mm, front up, flat or a trough along y with its axis over x = 20.
std::unique_ptr<field::MeshField> sheet(bool trough, int cells = 40) {
    TriangleMesh mesh;
    const auto edge = static_cast<std::uint32_t>(cells);
    for (std::uint32_t j = 0; j <= edge; ++j) {
        for (std::uint32_t i = 0; i <= edge; ++i) {
            const double x = 40.0 * i / edge, off = x - 20;
            const double z = trough ? kTrough - std::sqrt(kTrough * kTrough - off * off) : 0;
            mesh.positions.push_back(
                {static_cast<float>(x), static_cast<float>(20.0 * j / edge), static_cast<float>(z)});
        }
    }
    for (std::uint32_t j = 0; j < edge; ++j) {
        for (std::uint32_t i = 0; i < edge; ++i) {
            const std::uint32_t a = j * (edge + 1) + i, b = a + 1, c = a + edge + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return std::move(*field::MeshField::make(std::move(mesh)));
}

ContactOptions options(double radius) {
    ContactOptions o;
    o.stiffness_n_per_mm = 1;
    o.probe_radius_mm = radius;
    return o;
}

TEST(SheetContact, holds_on_its_front_and_on_its_back) {
    const auto field = sheet(false);
    for (const double radius : {0.0, 0.5}) {
        FieldContact front(*field, options(radius)), back(*field, options(radius));
        (void)front.update({10, 10, 3});
        (void)back.update({10, 10, -4});
        for (int n = 0; n < 100; ++n) {
            const double x = 10 + 0.1 * n;
            // Deeper than the sheet is thick: still on this side.
            EXPECT_NEAR(distance(front.update({x, 10, radius - 2}).force_n, {0, 0, 2}), 0, 1e-3) << x;
            EXPECT_NEAR(distance(back.update({x, 10, -1 - radius + 0.7}).force_n, {0, 0, -0.7}), 0, 1e-3)
                << x;
        }
    }
}

TEST(SheetContact, lets_go_beyond_the_border) {
    const auto field = sheet(false);
    for (const double radius : {0.0, 0.5}) {
        FieldContact contact(*field, options(radius));
        (void)contact.update({35, 10, 3});
        ProbeContact c;
        for (int n = 0; n < 80; ++n) {
            c = contact.update({35 + 0.1 * n, 10, radius - 0.3});
            EXPECT_GE(c.force_n.z, 0);
            EXPECT_GE(dot(c.force_n, c.normal), 0);
        }
        EXPECT_FALSE(c.in_contact);
        // Back against the wall of the border.
        for (int n = 0; n < 35; ++n) c = contact.update({42.9 - 0.1 * n, 10, -0.5});
        EXPECT_TRUE(c.in_contact);
        EXPECT_NEAR(distance(c.force_n, {40 + radius - 39.5, 0, 0}), 0, 1e-3) << radius;
    }
}

// Distance to the trough's cylinder less the facets' own, 40 of them: at most 4.2 um.
TEST(SheetContact, feels_a_trough_as_deep_as_it_is) {
    const auto field = sheet(true);
    for (const double radius : {0.0, 0.5}) {
        FieldContact contact(*field, options(radius));
        (void)contact.update({12, 10, 8});
        for (int n = 0; n < 400; ++n) {
            const double angle = -0.25 + 0.5 * n / 400;
            const Vec3 in{std::sin(angle), 0, -std::cos(angle)};
            const Vec3 probe = Vec3{20, 10, kTrough} + (kTrough - radius + 0.4) * in;
            const ProbeContact c = contact.update(probe);
            EXPECT_NEAR(distance(c.force_n, -0.4 * in), 0, 0.02) << angle << " " << radius;
            EXPECT_NEAR(length(c.force_n), 0.4, 0.006) << angle << " " << radius;
        }
    }
}

}  // namespace
}  // namespace tribo::haptics
