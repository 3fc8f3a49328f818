// SPDX-License-Identifier: MIT
// The mesh against the solids it was made from: closed, sharp, on the surface, few triangles on flats.
#include "field/contour/contour.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/shape/box_shape.hpp"
#include "self_intersection.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;

CarvedField block_of(double cell) {
    return CarvedField(std::make_unique<BoxShape>(Box3{{0, 0, -10}, {40, 30, 0}}), cell);
}

TEST(Contour, of_a_box_is_that_box) {
    const TriangleMesh mesh = contour(block_of(0.4));
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_mm3(mesh), 40 * 30 * 10, 0.01);
    EXPECT_NEAR(area_mm2(mesh), 2 * (40 * 30 + 40 * 10 + 30 * 10), 0.01);
    const Box3 box = bounds(mesh);
    EXPECT_NEAR(box.max.x, 40, 1e-5);
    EXPECT_NEAR(box.min.z, -10, 1e-5);
}

TEST(Contour, spends_few_triangles_on_flats) {
    // A uniform grid would need 2 x (100 x 75) x 2 + ... = 44,000 triangles.
    EXPECT_LT(contour(block_of(0.4)).triangles.size(), 14000u);
}

TEST(Contour, of_grooves_is_closed_and_has_their_volume) {
    auto f = block_of(0.3);
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
    auto f = block_of(0.4);
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
    auto f = block_of(0.3);
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

// Where a crest meets a wall three faces have a corner: no triangle cuts it off.
TEST(Contour, of_grooves_through_walls_keeps_their_corners) {
    for (const double cell : {0.2, 0.3, 0.4, 0.5}) {
        auto f = block_of(cell);
        for (double y = 5; y < 26; y += 2)
            f.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
        const TriangleMesh mesh = contour(f);
        double most = 0;
        for (const Triangle& t : mesh.triangles) {
            for (int k = 0; k < 3; ++k) {
                const Vec3 a = mesh.position(t[static_cast<std::size_t>(k)]);
                const Vec3 b = mesh.position(t[static_cast<std::size_t>((k + 1) % 3)]);
                most = std::max(most, std::abs(f.distance_mm(0.5 * (a + b))));
            }
        }
        EXPECT_LT(most, 0.02) << cell;
    }
}

// Cusps of small balls in all directions. Vertices that stay in their cell, and those on faces of cells that
// several pieces share, may miss.
TEST(Contour, of_random_grooves_has_its_vertices_on_the_surface) {
    constexpr double cell = 0.3;
    std::size_t off = 0, all = 0;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        auto f = block_of(cell);
        const CounterNoise noise(seed);
        std::uint64_t drawn = 0;
        const auto between = [&](double a, double b) { return a + (b - a) * noise.uniform(drawn++); };
        for (int pass = 0; pass < 40; ++pass) {
            const double radius = between(0.8, 3), z = radius * between(0.1, 0.8);
            const Vec3 from{between(-5, 45), between(-5, 35), z}, to{between(-5, 45), between(-5, 35), z};
            f.carve(std::make_unique<BallPass>(from, to, radius));
        }
        const TriangleMesh mesh = contour(f);
        all += mesh.positions.size();
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            const double mm = std::abs(f.distance_mm(mesh.position(v)));
            ASSERT_LT(mm, cell);
            off += mm > 2e-3 * cell ? 1 : 0;
        }
    }
    EXPECT_LT(static_cast<double>(off), 0.02 * static_cast<double>(all));
}

// In a hurry: closed, and within the sagitta of a cell of the surface but at the cusps.
TEST(Contour, that_is_rough_is_closed_and_near_the_surface) {
    constexpr double cell = 0.3;
    auto field = block_of(cell);
    for (double y = 5; y < 26; y += 2)
        field.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
    ContourOptions options;
    options.rough = true;
    const TriangleMesh rough = contour(field, serial_for, options), exact = contour(field);
    EXPECT_TRUE(is_closed(rough));
    EXPECT_NEAR(volume_mm3(rough) / volume_mm3(exact), 1, 2e-3);
    EXPECT_LT(10 * rough.triangles.size(), 11 * exact.triangles.size());
    constexpr double sagitta_mm = cell * cell / (8 * 4);
    std::size_t off = 0;
    for (std::uint32_t v = 0; v < rough.positions.size(); ++v) {
        const double mm = std::abs(field.distance_mm(rough.position(v)));
        ASSERT_LT(mm, 0.5 * cell);
        off += mm > 2 * sagitta_mm ? 1 : 0;
    }
    EXPECT_LT(5 * off, rough.positions.size());
}

// Where it is cut the block keeps its edges: of its sides no strip is taken for machined surface.
TEST(Contour, that_is_rough_leaves_the_faces_of_the_blank_flat_up_to_their_edges) {
    auto field = block_of(0.3);
    for (double y = 5; y < 26; y += 2)
        field.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
    ContourOptions options;
    options.rough = true;
    const auto area_on_blank = [&](const TriangleMesh& mesh) {
        TriangleMesh faces;
        faces.positions = mesh.positions;
        for (const Triangle& t : mesh.triangles) {
            if (std::ranges::all_of(t, [&](std::uint32_t v) {
                    return std::abs(field.blank().distance_mm(mesh.position(v))) < 1e-3;
                }))
                faces.triangles.push_back(t);
        }
        return area_mm2(faces);
    };
    EXPECT_NEAR(area_on_blank(contour(field, serial_for, options)) / area_on_blank(contour(field)), 1, 5e-3);
}

TEST(Contour, keeps_corners_sharp) {
    auto f = block_of(0.3);
    f.carve(std::make_unique<BoxShape>(Box3{{10.1, 8.2, -6.3}, {20.4, 17.7, 5}}));
    const TriangleMesh mesh = contour(f);
    EXPECT_NEAR(area_mm2(mesh), 2 * (40 * 30 + 40 * 10 + 30 * 10) + 2 * 6.3 * (10.3 + 9.5), 0.05);
}

void expect_closed_solid(const TriangleMesh& mesh) {
    EXPECT_TRUE(is_closed(mesh));
    const tribo::test::SelfIntersections found(mesh);
    EXPECT_EQ(found.pairs().size(), 0u);
}

TEST(Contour, of_grooves_does_not_meet_itself) {
    for (const double cell : {0.2, 0.37, 0.8}) {
        auto f = block_of(cell);
        for (double y = 5; y < 26; y += 2) {
            f.carve(std::make_unique<BallPass>(Vec3{-10, y, 2.7}, Vec3{50, y + 1, 2.7}, 4));
            f.carve(std::make_unique<BallPass>(Vec3{y, -10, 2.6}, Vec3{y + 2, 50, 2.6}, 4));
        }
        expect_closed_solid(contour(f));
    }
}

// The wall stands anywhere between the nodes, which it meets or not.
TEST(Contour, keeps_a_wall_that_is_thinner_than_a_cell) {
    for (const double cell : {0.3, 0.5}) {
        for (const double width : {0.02, 0.1, 0.25}) {
            for (double y = 15; y < 15.6; y += 0.117) {
                auto f = block_of(cell);
                f.carve(std::make_unique<BoxShape>(Box3{{-5, y - 6, -6.3}, {50, y, 5}}));
                f.carve(std::make_unique<BoxShape>(Box3{{-5, y + width, -6.3}, {50, y + width + 6, 5}}));
                const TriangleMesh mesh = contour(f);
                expect_closed_solid(mesh);
                // Its top and its ends, 40 + 2 x 6.3 mm long, become a ridge within their cells.
                EXPECT_NEAR(volume_mm3(mesh), 40 * 30 * 10 - 40 * 6.3 * 12,
                            0.5 * cell * width * (40 + 2 * 6.3) + 0.01 * cell * cell * 40)
                    << cell << " " << width << " " << y;
            }
        }
    }
}

// More bricks in a layer than are looked at together, and layers without any between two solids: what is
// known of the bricks behind is neither lost nor taken from elsewhere.
TEST(Contour, of_wide_layers_and_of_solids_far_above_each_other) {
    for (const double gap : {0.5, 130.0}) {
        const double top = 2 + gap;
        CarvedField f(std::make_unique<BoxShape>(Box3{{0, 0, 0}, {300, 260, top + 3}}), 0.5);
        f.carve(std::make_unique<BoxShape>(Box3{{-5, -5, 2}, {305, 265, top}}));
        f.carve(std::make_unique<BoxShape>(Box3{{100, 120, -5}, {200, 140, top + 10}}));
        f.carve(std::make_unique<BoxShape>(Box3{{-5, 100, 0.7}, {305, 103, top + 2}}));
        const TriangleMesh mesh = contour(f);
        EXPECT_TRUE(is_closed(mesh));
        const double plate = 300 * 260 - 100 * 20;
        EXPECT_NEAR(volume_mm3(mesh), plate * 5 - 300 * 3 * (2 - 0.7 + 2), 0.1) << gap;
    }
}

TEST(Contour, of_nothing_is_empty) {
    auto f = block_of(0.5);
    f.carve(std::make_unique<BoxShape>(Box3{{-5, -5, -20}, {50, 50, 5}}));
    EXPECT_TRUE(contour(f).triangles.empty());
}

}  // namespace
}  // namespace tribo::field
