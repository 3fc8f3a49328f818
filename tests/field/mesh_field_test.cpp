// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/mesh/mesh_tree.hpp"

namespace tribo::field {
namespace {

// A square sheet at z = 0, 20 mm wide, in cells of 1 mm, front up; `bend`: a trough of that radius along y.
TriangleMesh sheet(double bend = 0) {
    TriangleMesh mesh;
    constexpr std::uint32_t kCells = 20;
    for (std::uint32_t j = 0; j <= kCells; ++j) {
        for (std::uint32_t i = 0; i <= kCells; ++i) {
            const double x = i - 10.0;
            const double z = bend > 0 ? bend - std::sqrt(bend * bend - x * x) : 0;
            mesh.positions.push_back({static_cast<float>(i), static_cast<float>(j), static_cast<float>(z)});
        }
    }
    for (std::uint32_t j = 0; j < kCells; ++j) {
        for (std::uint32_t i = 0; i < kCells; ++i) {
            const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

// Against the distance to a plate of 20 x 20 x 2 mm in closed form.
TEST(MeshField, makes_a_plate_of_a_sheet) {
    const auto field = MeshField::make(sheet(), 2);
    ASSERT_TRUE(field);
    EXPECT_TRUE((*field)->is_sheet());
    for (double x = -3; x < 24; x += 0.83) {
        for (double y = -3; y < 24; y += 0.97) {
            for (double z = -5; z < 3; z += 0.31) {
                const Vec3 out{std::max({-x, x - 20, 0.0}), std::max({-y, y - 20, 0.0}),
                               std::max({z, -2 - z, 0.0})};
                const double right = length(out);
                const contact::SurfaceSample s = (*field)->sample({x, y, z});
                if (right > 0) {
                    // 1e-6: the border's wall is found by its edge, in single precision.
                    EXPECT_NEAR(s.distance_mm, right, 1e-6) << x << " " << y << " " << z;
                    const Vec3 way{x < 0 ? -out.x : out.x, y < 0 ? -out.y : out.y, z < -1 ? -out.z : out.z};
                    EXPECT_NEAR(dot(s.normal, way), right, 1e-6) << x << " " << y << " " << z;
                } else {
                    EXPECT_LE(s.distance_mm, 1e-6) << x << " " << y << " " << z;
                }
                EXPECT_NEAR(length(s.normal), 1, 1e-9);
            }
        }
    }
}

TEST(MeshField, takes_a_closed_mesh_as_a_solid_whichever_way_it_is_turned) {
    TriangleMesh box;
    for (int n = 0; n < 8; ++n)
        box.positions.push_back({n & 1 ? 20.f : 0.f, n & 2 ? 20.f : 0.f, n & 4 ? 0.f : -6.f});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (int turned = 0; turned < 2; ++turned) {
        const auto field = MeshField::make(box);
        ASSERT_TRUE(field);
        EXPECT_FALSE((*field)->is_sheet());
        EXPECT_NEAR((*field)->distance_mm({5, 5, -2.9}), -2.9, 1e-6);
        EXPECT_NEAR((*field)->distance_mm({-3, 5, 4}), 5, 1e-6);
        for (Triangle& t : box.triangles) std::swap(t[1], t[2]);
    }
}

TEST(MeshField, refuses_what_has_no_surface) {
    EXPECT_FALSE(MeshField::make({}));
}

// Whichever way its triangles face, a skin is the unsigned distance to them less half of its thickness.
TEST(MeshField, makes_a_skin_of_triangles_that_do_not_agree_on_a_side) {
    CounterNoise noise(7);
    std::uint64_t drawn = 0;
    TriangleMesh turned = sheet();
    const TriangleMesh straight = turned;
    for (std::size_t n = 0; n < turned.triangles.size(); ++n) {
        if (n == 7 || noise.uniform(drawn++) < 0.5) std::swap(turned.triangles[n][0], turned.triangles[n][1]);
    }
    const auto field = MeshField::make(std::move(turned));
    ASSERT_TRUE(field);
    EXPECT_FALSE((*field)->is_sheet());
    const Box3 box = bounds(straight);
    const double diagonal = distance(box.min, box.max), skin = (*field)->skin_mm();
    EXPECT_NEAR(skin, std::min(1.0, 0.002 * diagonal), 1e-12);
    const MeshTree tree(straight);
    for (int n = 0; n < 2000; ++n) {
        const auto between = [&](double low, double high) {
            return low + (high - low) * noise.uniform(drawn++);
        };
        const Vec3 p{between(box.min.x - 2, box.max.x + 2), between(box.min.y - 2, box.max.y + 2),
                     between(box.min.z - 2, box.max.z + 2)};
        const contact::SurfaceSample s = (*field)->sample(p);
        const double away = distance(tree.nearest(p).at.point_mm, p);
        EXPECT_NEAR(s.distance_mm, away - 0.5 * skin, 1e-9);
        if (away < 1e-3) continue;
        EXPECT_NEAR(distance(tree.nearest(p).at.point_mm + away * s.normal, p), 0, 1e-6);
    }
}

}  // namespace
}  // namespace tribo::field
