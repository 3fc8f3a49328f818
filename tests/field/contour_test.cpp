// SPDX-License-Identifier: MIT
// The mesh against the solids it was made from: closed, sharp, on the surface, few triangles on flats.
#include "field/contour.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "field/box_shape.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;

CarvedField block(double cell) {
    return CarvedField(std::make_unique<BoxShape>(Box3{{0, 0, -10}, {40, 30, 0}}), cell);
}

TEST(Contour, of_a_box_is_that_box) {
    const TriangleMesh mesh = contour(block(0.4));
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_mm3(mesh), 40 * 30 * 10, 0.01);
    EXPECT_NEAR(area_mm2(mesh), 2 * (40 * 30 + 40 * 10 + 30 * 10), 0.01);
    const Box3 box = bounds(mesh);
    EXPECT_NEAR(box.max.x, 40, 1e-5);
    EXPECT_NEAR(box.min.z, -10, 1e-5);
}

TEST(Contour, spends_few_triangles_on_flats) {
    // A uniform grid would need 2 x (100 x 75) x 2 + ... = 44,000 triangles.
    EXPECT_LT(contour(block(0.4)).triangles.size(), 14000u);
}

TEST(Contour, of_grooves_is_closed_and_has_their_volume) {
    auto f = block(0.3);
    double removed = 0;
    for (double y = 5; y < 26; y += 2) {
        removed += f.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y, 2.7}, 4));
    }
    removed += f.carve(std::make_unique<BoxShape>(Box3{{10.1, 8.2, -6.3}, {20.4, 17.7, 5}}));
    const TriangleMesh mesh = contour(f);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_mm3(mesh) / (40 * 30 * 10 - removed), 1, 2e-3);
}

TEST(Contour, in_parts_is_the_whole) {
    auto f = block(0.4);
    for (double y = 5; y < 26; y += 2)
        f.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
    constexpr int kEdge = 4;
    TriangleMesh sum;
    const BrickCoord size = f.size();
    for (int k = 0; k < size.k; k += kEdge) {
        for (int j = 0; j < size.j; j += kEdge) {
            for (int i = 0; i < size.i; i += kEdge) {
                const TriangleMesh part = contour_part(f, {i, j, k}, {i + kEdge, j + kEdge, k + kEdge});
                const auto first = static_cast<std::uint32_t>(sum.positions.size());
                sum.positions.insert(sum.positions.end(), part.positions.begin(), part.positions.end());
                for (Triangle t : part.triangles) {
                    for (std::uint32_t& v : t) v += first;
                    sum.triangles.push_back(t);
                }
            }
        }
    }
    const TriangleMesh whole = contour(f);
    EXPECT_EQ(sum.triangles.size(), whole.triangles.size());
    EXPECT_NEAR(volume_mm3(sum) / volume_mm3(whole), 1, 1e-12);
    weld_exactly(sum);
    EXPECT_TRUE(is_closed(sum));
}

TEST(Contour, vertices_lie_on_the_exact_surface) {
    auto f = block(0.3);
    for (double y = 5; y < 26; y += 2)
        f.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
    const TriangleMesh mesh = contour(f);
    std::size_t off = 0;
    for (std::uint32_t n = 0; n < mesh.positions.size(); ++n) {
        if (std::abs(f.distance_mm(mesh.position(n))) > 2e-4) ++off;
    }
    // Only cells at cusps that do not fit into a cell may miss.
    EXPECT_LT(static_cast<double>(off), 0.02 * static_cast<double>(mesh.positions.size()));
}

TEST(Contour, keeps_corners_sharp) {
    auto f = block(0.3);
    f.carve(std::make_unique<BoxShape>(Box3{{10.1, 8.2, -6.3}, {20.4, 17.7, 5}}));
    const TriangleMesh mesh = contour(f);
    EXPECT_NEAR(area_mm2(mesh), 2 * (40 * 30 + 40 * 10 + 30 * 10) + 2 * 6.3 * (10.3 + 9.5), 0.05);
}

TEST(Contour, of_nothing_is_empty) {
    auto f = block(0.5);
    f.carve(std::make_unique<BoxShape>(Box3{{-5, -5, -20}, {50, 50, 5}}));
    EXPECT_TRUE(contour(f).triangles.empty());
}

}  // namespace
}  // namespace tribo::field
