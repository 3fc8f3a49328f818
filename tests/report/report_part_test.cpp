// SPDX-License-Identifier: MIT
// The part in the report: a mesh with fewer vertices is still that part, and its bytes say so.
#include "report/report_part.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/math.hpp"

namespace tribo::report {
namespace {

// A box of 30 x 20 x 10 mm whose sides are grids of n x n squares: every point of it is known.
TriangleMesh fine_box(std::uint32_t n) {
    TriangleMesh mesh;
    const Vec3 size{30, 20, 10};
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::uint32_t i = 0; i <= n; ++i) {
                for (std::uint32_t j = 0; j <= n; ++j) {
                    Point3f p{};
                    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                    p[static_cast<std::size_t>(axis)] = static_cast<float>(side * size[axis]);
                    p[static_cast<std::size_t>(u)] = static_cast<float>(size[u] * i / n);
                    p[static_cast<std::size_t>(v)] = static_cast<float>(size[v] * j / n);
                    mesh.positions.push_back(p);
                }
            }
            for (std::uint32_t i = 0; i < n; ++i) {
                for (std::uint32_t j = 0; j < n; ++j) {
                    const std::uint32_t a = first + i * (n + 1) + j, b = a + n + 1;
                    if (side == 1) {
                        mesh.triangles.push_back({a, b, b + 1});
                        mesh.triangles.push_back({a, b + 1, a + 1});
                    } else {
                        mesh.triangles.push_back({a, b + 1, b});
                        mesh.triangles.push_back({a, a + 1, b + 1});
                    }
                }
            }
        }
    }
    weld_exactly(mesh);
    return mesh;
}

TEST(ReportPart, a_small_mesh_stays_as_it_is) {
    const TriangleMesh box = fine_box(4);
    std::vector<std::uint8_t> kinds(box.positions.size(), 1);
    const TriangleMesh same = with_fewer_vertices(box, box.positions.size(), kinds);
    EXPECT_EQ(kinds, std::vector<std::uint8_t>(box.positions.size(), 1));
    EXPECT_EQ(same.positions, box.positions);
    EXPECT_EQ(same.triangles, box.triangles);
}

TEST(ReportPart, a_box_with_fewer_vertices_is_still_that_box_with_its_edges) {
    const TriangleMesh box = fine_box(120);
    ASSERT_GT(box.positions.size(), 80'000u);
    // The top is of another kind than the rest.
    std::vector<std::uint8_t> kinds;
    for (const Point3f& p : box.positions) kinds.push_back(p[2] == 10 ? 0 : 1);
    const TriangleMesh fewer = with_fewer_vertices(box, 5000, kinds);
    ASSERT_EQ(kinds.size(), fewer.positions.size());
    for (std::size_t n = 0; n < kinds.size(); ++n)
        EXPECT_EQ(kinds[n], std::abs(fewer.positions[n][2] - 10) < 1e-3 ? 0 : 1);
    EXPECT_LE(fewer.positions.size(), 5000u);
    EXPECT_GT(fewer.positions.size(), 2000u);  // not many fewer than it may have
    EXPECT_NEAR(volume_mm3(fewer), 6000, 1);
    EXPECT_NEAR(area_mm2(fewer), 2200, 1);
    const Box3 b = bounds(fewer);
    EXPECT_NEAR(length(b.min), 0, 1e-3);
    EXPECT_NEAR(distance(b.max, {30, 20, 10}), 0, 1e-3);
    for (const Triangle& t : fewer.triangles) {
        EXPECT_FALSE(is_degenerate(t));
        for (const std::uint32_t v : t) ASSERT_LT(v, fewer.positions.size());
    }
}

TEST(ReportPart, flat_tiny_and_empty_meshes_pass) {
    const auto fewer = [](const TriangleMesh& mesh, std::size_t most) {
        std::vector<std::uint8_t> kinds(mesh.positions.size());
        return with_fewer_vertices(mesh, most, kinds).positions.size();
    };
    EXPECT_EQ(fewer({}, 10), 0u);
    TriangleMesh point;
    point.positions.assign(100, {1, 2, 3});
    EXPECT_LE(fewer(point, 10), 10u);
    TriangleMesh line;
    for (int n = 0; n < 1000; ++n) line.positions.push_back({static_cast<float>(n), 0, 0});
    EXPECT_LE(fewer(line, 10), 10u);
    EXPECT_LE(fewer(fine_box(10), 1), 8u);
}

TEST(ReportPart, its_bytes_give_the_mesh_back) {
    ReportPart part;
    part.mesh = fine_box(3);
    const std::size_t v = part.mesh.positions.size(), t = part.mesh.triangles.size();
    for (std::size_t n = 0; n < v; ++n) {
        part.untouched.push_back(n % 2);
        part.deviation_mm.push_back(static_cast<float>(n) * 0.005F - 0.2F);
    }
    part.deviation_range_mm = 0.25;
    const auto json = nlohmann::json::parse(report_part_json(part));
    const std::string bytes = report_part_bytes(part);
    ASSERT_EQ(json["vertices"], v);
    ASSERT_EQ(json["triangles"], t);
    ASSERT_EQ(bytes.size(), 9 * v + 6 * t);
    EXPECT_EQ(json["deviation_range"], 0.25);
    const auto u16 = [&](std::size_t at) {
        return static_cast<unsigned char>(bytes[at]) | static_cast<unsigned char>(bytes[at + 1]) << 8;
    };
    const double step = json["step"], deviation_step = json["deviation_step"];
    EXPECT_NEAR(step, 30.0 / 65535, 1e-9);
    for (std::size_t n = 0; n < v; ++n) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(json["origin"][axis].get<double>() + step * u16(6 * n + 2 * axis),
                        part.mesh.positions[n][axis], 0.51 * step);
        }
        EXPECT_NEAR(deviation_step * static_cast<std::int16_t>(u16(6 * v + 2 * n)), part.deviation_mm[n],
                    0.51 * deviation_step);
        EXPECT_EQ(bytes[8 * v + 6 * t + n], static_cast<char>(n % 2));
    }
    for (std::size_t n = 0; n < t; ++n) {
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(static_cast<std::uint32_t>(u16(8 * v + 6 * n + 2 * c)), part.mesh.triangles[n][c]);
    }
    // Beyond the numbers there are, the last one.
    part.deviation_mm[0] = 1e6F;
    EXPECT_EQ(static_cast<unsigned char>(report_part_bytes(part)[6 * v + 1]), 0x7fu);
    part.deviation_mm.clear();
    EXPECT_EQ(report_part_bytes(part).size(), 7 * v + 6 * t);
    EXPECT_FALSE(nlohmann::json::parse(report_part_json(part)).contains("deviation_step"));
}

}  // namespace
}  // namespace tribo::report
