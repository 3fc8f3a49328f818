// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_field.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/any_mesh.hpp"
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

// A sheet around a part of a cylinder along y, of radius 10, 8 mm wide: against the distance to a part of a
// tube in closed form, near its straight and its round borders.
TEST(MeshField, makes_a_part_of_a_tube_of_a_bent_sheet) {
    constexpr double kRadius = 10, kWide = 8, kThick = 2;
    for (const double turn : {0.8, 2.5}) {
        for (const bool front_inside : {false, true}) {
            TriangleMesh mesh;
            constexpr std::uint32_t kCells = 400;
            for (std::uint32_t n = 0; n <= kCells; ++n) {
                const double u = turn * n / kCells;
                for (const double y : {0.0, kWide})
                    mesh.positions.push_back(to_float({kRadius * std::cos(u), y, kRadius * std::sin(u)}));
            }
            for (std::uint32_t n = 0; n < kCells; ++n) {
                const std::uint32_t a = 2 * n, b = a + 1, c = a + 2, d = a + 3;
                mesh.triangles.push_back({a, b, d});
                mesh.triangles.push_back({a, d, c});
                if (!front_inside) continue;
                for (Triangle* t : {&mesh.triangles.end()[-2], &mesh.triangles.end()[-1]})
                    std::swap((*t)[1], (*t)[2]);
            }
            const auto field = MeshField::make(mesh, kThick);
            ASSERT_TRUE(field);
            ASSERT_TRUE((*field)->is_sheet());
            const double least = front_inside ? kRadius : kRadius - kThick, most = least + kThick;
            const CounterNoise noise(11);
            for (std::uint64_t n = 0; n < 20'000; ++n) {
                const auto between = [&](std::uint64_t k, double low, double high) {
                    return low + (high - low) * noise.uniform(3 * n + k);
                };
                const Vec3 p{between(0, -14, 15), between(1, -4, kWide + 4), between(2, -5, 15)};
                const double r = std::hypot(p.x, p.z), u = std::atan2(p.z, p.x);
                double across = std::max({least - r, r - most, 0.0});
                if (u < 0 || u > turn) {
                    across = 1e9;
                    for (const double end : {0.0, turn}) {
                        const double along = p.x * std::cos(end) + p.z * std::sin(end),
                                     aside = p.z * std::cos(end) - p.x * std::sin(end);
                        across = std::min(across, std::hypot(aside, std::clamp(along, least, most) - along));
                    }
                }
                const double right = std::hypot(across, std::max({-p.y, p.y - kWide, 0.0}));
                const double got = (*field)->distance_mm(p);
                // At the ends the part of the mesh leans by half of its turn.
                constexpr double kSagitta = 1e-3;
                if (right > 2 * kSagitta)
                    EXPECT_NEAR(got, right, 0.5 * turn / kCells * kThick + kSagitta)
                        << turn << front_inside << " " << p.x << " " << p.y << " " << p.z;
                else
                    EXPECT_LE(got, 0.01);
            }
        }
    }
}

// The distance grows by no more than the way, over the borders of bent sheets too.
TEST(MeshField, has_no_steps_around_sheets) {
    constexpr double kStep = 1e-3;
    long steps = 0, pairs = 0;
    for (std::uint64_t n = 0; n < 40; ++n) {
        test::Draw draw(9, n);
        const TriangleMesh mesh = test::any_sheet(draw);
        const auto field = MeshField::make(mesh, draw.between(0.2, 2));
        ASSERT_TRUE(field);
        for (int k = 0; k < 5000; ++k) {
            const Vec3 from{draw.between(-11, 11), draw.between(-11, 11), draw.between(-5, 5)},
                to = from + kStep * Vec3{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
            const double grown = (*field)->distance_mm(to) - (*field)->distance_mm(from);
            ++pairs;
            if (std::abs(grown) > distance(from, to) + 1e-4) ++steps;
        }
    }
    // In the hollow of a sheet, far behind it, a border may hide what is as near.
    EXPECT_LE(steps, pairs / 20'000);
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
