// SPDX-License-Identifier: MIT
// What all readers share: telling the format, cutting polygons, and the units.
#include "readers/mesh/model.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "readers/mesh/model_polygon.hpp"
#include "readers/mesh/model_samples.hpp"
#include "readers/text/model_text.hpp"

namespace tribo::readers {
namespace {

using namespace test;

TEST(Model, the_content_tells_the_format_before_the_name_does) {
    EXPECT_EQ(detect_model_format("#VRML V2.0 utf8\n", "a.stl"), ModelFormat::vrml);
    EXPECT_EQ(detect_model_format("ply\nformat ascii 1.0\n", "a.obj"), ModelFormat::ply);
    EXPECT_EQ(detect_model_format("solid a\nfacet normal", "a.obj"), ModelFormat::stl);
    EXPECT_EQ(detect_model_format("glTF\x02", "a.stl"), ModelFormat::gltf);
    EXPECT_EQ(detect_model_format("# words\n\nv 0 0 0\n", ""), ModelFormat::obj);
    EXPECT_EQ(detect_model_format("something", "A.STL"), ModelFormat::stl);
    EXPECT_EQ(detect_model_format("{}", "a.gltf"), ModelFormat::gltf);
    EXPECT_EQ(detect_model_format("something", "a.step"), std::nullopt);
    EXPECT_EQ(detect_model_format("", ""), std::nullopt);
}

TEST(Model, refuses_an_empty_file_a_stranger_and_a_unit_without_length) {
    EXPECT_EQ(read_model("", {.source_name = "a.stl"}).error().text(),
              "a.stl: error: the file is empty; export the model again");
    EXPECT_EQ(read_model("ISO-10303-21;", {.source_name = "a.step"}).error().text(),
              "a.step: error: STEP models are not read; export the model as STL, OBJ, PLY, VRML 2.0 or glTF");
    EXPECT_EQ(read_model("a thing", {.source_name = "a.txt"}).error().text(),
              "a.txt: error: not a model format that is known; export the model as STL, OBJ, PLY, VRML 2.0 "
              "or glTF");
    for (const double unit : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        const auto model =
            read_model("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", {.source_name = "a.obj", .unit_mm = unit});
        ASSERT_FALSE(model.has_value());
        EXPECT_NE(model.error().cause.find("unit"), std::string::npos);
    }
}

TEST(TextCursor, counts_lines_and_columns_for_every_line_end) {
    TextCursor cursor("a\nbb\r  c\r\n\r\n\td");
    const int lines[] = {1, 2, 3, 5}, columns[] = {1, 1, 3, 2};
    for (int i = 0; i < 4; ++i) {
        EXPECT_FALSE(cursor.word().empty());
        EXPECT_EQ(cursor.line(), lines[i]) << i;
        EXPECT_EQ(cursor.column(), columns[i]) << i;
    }
    EXPECT_TRUE(cursor.word().empty());
}

struct Cut {
    std::vector<Triangle> triangles;
    double signed_area = 0, area = 0;  // in x and y
    std::uint64_t crossing = 0;
};

Cut cut(const std::vector<Vec3>& points) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < points.size(); ++i) corners.push_back(i);
    Cut result;
    PolygonTriangulator triangulator;
    EXPECT_TRUE(triangulator.append(corners, points, result.triangles));
    for (const Triangle& t : result.triangles) {
        const double twice = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z;
        result.signed_area += twice / 2;
        result.area += std::abs(twice) / 2;
    }
    result.crossing = triangulator.crossing_faces();
    return result;
}

double shoelace(const std::vector<Vec3>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        twice += cross(points[i], points[(i + 1) % points.size()]).z;
    return twice / 2;
}

// A star around the origin is simple whatever its radii: the cut must fill it without overlap.
RC_GTEST_PROP(PolygonTriangulator, fills_any_star_without_overlap, ()) {
    const auto radii = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 100));
    RC_PRE(radii.size() >= 4U);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(radii.size());
        points.push_back({radii[i] * std::cos(angle), radii[i] * std::sin(angle), 0});
    }
    const Cut result = cut(points);
    RC_ASSERT(result.triangles.size() == points.size() - 2);
    RC_ASSERT(std::abs(result.signed_area - shoelace(points)) < 1e-9 * shoelace(points));
    RC_ASSERT(std::abs(result.area - result.signed_area) < 1e-9 * shoelace(points));
    RC_ASSERT(result.crossing == 0U);
}

TEST(PolygonTriangulator, a_hole_reached_over_a_bridge_stays_open) {
    // A 4 x 4 square with a 2 x 2 hole, joined by a cut from (0, 0) to (1, 1).
    const Cut result = cut({{0, 0, 0},
                            {4, 0, 0},
                            {4, 4, 0},
                            {0, 4, 0},
                            {0, 0, 0},
                            {1, 1, 0},
                            {1, 3, 0},
                            {3, 3, 0},
                            {3, 1, 0},
                            {1, 1, 0}});
    EXPECT_EQ(result.triangles.size(), 8U);
    EXPECT_DOUBLE_EQ(result.signed_area, 12);
    EXPECT_DOUBLE_EQ(result.area, 12);
    EXPECT_EQ(result.crossing, 0U);
}

TEST(PolygonTriangulator, a_straight_corner_gives_no_empty_triangle) {
    for (int start = 0; start < 5; ++start) {
        const Vec3 square[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
        std::vector<Vec3> points;
        for (int i = 0; i < 5; ++i) points.push_back(square[(start + i) % 5]);
        const Cut result = cut(points);
        ASSERT_EQ(result.triangles.size(), 3U);
        EXPECT_DOUBLE_EQ(result.area, 4);
        for (const Triangle& t : result.triangles) {
            EXPECT_GT(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z, 0) << start;
        }
    }
}

TEST(PolygonTriangulator, repeated_neighbours_count_once_and_lines_give_nothing_to_fill) {
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}).triangles.size(), 1U);
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}).area, 0);
    const Cut flat = cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
    EXPECT_EQ(flat.area, 0);
    EXPECT_EQ(flat.crossing, 1U);
    const Cut pentagram = cut({{0, 10, 0}, {-6, -8, 0}, {9, 3, 0}, {-9, 3, 0}, {6, -8, 0}});
    EXPECT_EQ(pentagram.triangles.size(), 3U);
}

TEST(PolygonTriangulator, combs_of_many_corners_end_at_the_limit) {
    std::vector<Vec3> points{{0, -1, 0}, {20'000, -1, 0}};
    for (int i = 20'000; i > 0; --i) points.push_back({i - 0.5, i % 2 ? 1.0 : 0.0, 0});
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < points.size(); ++i) corners.push_back(i);
    std::vector<Triangle> out;
    PolygonTriangulator triangulator;
    bool going = true;
    for (int face = 0; face < 200 && going; ++face) {
        out.clear();
        going = triangulator.append(corners, points, out);
    }
    EXPECT_FALSE(going);
}

// Whatever its shape: three points over and over, a line to and fro, and a comb, whose teeth are no ears.
TEST(PolygonTriangulator, always_cuts_a_face_of_the_corners_that_its_remedy_names) {
    const std::uint32_t count = PolygonTriangulator::kAlwaysCut;
    std::vector<Vec3> repeated, line, comb;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < count; ++i) {
        corners.push_back(i);
        repeated.push_back({i % 3 == 1 ? 1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0, 0});
        line.push_back({i % 7 + 1.0, 0, 0});
        comb.push_back({count - i - 0.5, i % 2 != 0 ? 1.0 : 0.0, 0});
    }
    for (const std::vector<Vec3>& points : {repeated, line, comb}) {
        std::vector<Triangle> out;
        PolygonTriangulator triangulator;
        EXPECT_TRUE(triangulator.append(corners, points, out));
        EXPECT_EQ(out.size(), count - 2);
    }
}

}  // namespace
}  // namespace tribo::readers
