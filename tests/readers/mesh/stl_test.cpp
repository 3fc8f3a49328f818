// SPDX-License-Identifier: MIT
// STL in both forms: round trips, the ways in which real files lie, and each refusal's message.
#include "readers/mesh/stl.hpp"

#include <algorithm>
#include <cctype>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "readers/mesh/model_samples.hpp"

namespace tribo::readers {
namespace {

using namespace test;

std::string binary(const TriangleMesh& mesh) {
    std::string bytes;
    EXPECT_TRUE(write_stl(mesh, [&](std::string_view chunk) {
        bytes.append(chunk);
        return true;
    }));
    return bytes;
}

std::string facet(const char* a, const char* b, const char* c) {
    return std::string("facet normal nan nan nan\n outer loop\n  vertex ") + a + "\n  vertex " + b +
           "\n  vertex " + c + "\n endloop\nendfacet\n";
}

TEST(Stl, binary_comes_back_as_a_closed_mesh_with_welded_vertices) {
    const std::string bytes = binary(tetrahedron());
    ASSERT_EQ(bytes.size(), 84U + 4 * 50);
    const auto model = read_model(bytes);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->format, ModelFormat::stl);
    EXPECT_EQ(model->mesh.positions.size(), 4U);
    EXPECT_EQ(model->mesh.triangles.size(), 4U);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_DOUBLE_EQ(volume_mm3(model->mesh), 1.0 / 6);
    EXPECT_TRUE(model->warnings.empty());
}

TEST(Stl, the_written_normal_is_that_of_the_corners) {
    const std::string bytes = binary({{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}}, {{0, 1, 2}}, {}});
    float normal[3];
    std::memcpy(normal, bytes.data() + 84, sizeof normal);
    EXPECT_EQ(normal[0], 0);
    EXPECT_EQ(normal[1], -1);
    EXPECT_EQ(normal[2], 0);
}

TEST(Stl, a_sink_that_refuses_ends_the_writing) {
    int calls = 0;
    EXPECT_FALSE(write_stl(tetrahedron(), [&](std::string_view) { return ++calls < 2; }));
    EXPECT_EQ(calls, 2);
}

TEST(Stl, binary_whose_header_starts_with_solid_is_still_binary) {
    std::string bytes = binary(tetrahedron());
    const std::string header = "solid part facet normal 0 0 0";
    std::copy(header.begin(), header.end(), bytes.begin());
    const auto model = read_model(bytes);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 4U);
}

TEST(Stl, bytes_after_the_last_facet_are_told) {
    const auto model = read_model(binary(tetrahedron()) + "rest", ModelFormat::stl);
    ASSERT_TRUE(is_read(model));
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_NE(model->warnings[0].text.find("4 bytes after the last of 4 triangles"), std::string::npos);
}

TEST(Stl, text_reads_in_any_case_and_line_end_with_several_solids) {
    const std::string one = facet("0 0 0", "1 0 0", "0 1 0"), two = facet("-1.5e1 .5 +2.", "1 0 0", "0 1 0");
    std::string upper = one;
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    for (const std::string& end : {std::string("\n"), std::string("\r\n"), std::string("\r")}) {
        std::string text = "\xEF\xBB\xBFsolid p\xE4rt of two\n" + one + "endsolid part of two\nSOLID\n" +
                           upper + two + "ENDSOLID\n";
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size()) {
            text.replace(at, 1, end);
        }
        const auto model = read_model(text);
        ASSERT_TRUE(is_read(model));
        EXPECT_EQ(model->mesh.triangles.size(), 3U);
        EXPECT_EQ(model->mesh.positions.size(), 4U);
        EXPECT_EQ(model->mesh.positions[3], (Point3f{-15, 0.5, 2}));
    }
}

TEST(Stl, a_unit_scales_and_degenerate_triangles_are_counted) {
    const auto model = read_model(
        "solid\n" + facet("0 0 0", "1 0 0", "0 2 0") + facet("0 0 0", "1 0 0", "1 0 -0") + "endsolid",
        {.source_name = "inch.stl", .unit_mm = 25.4});
    ASSERT_TRUE(is_read(model));
    EXPECT_NEAR(area_mm2(model->mesh), 25.4 * 25.4, 1e-4);
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_EQ(model->warnings[0].message(), "inch.stl: warning: 1 degenerate triangle was dropped");
}

TEST(Stl, a_thin_triangle_that_closes_the_mesh_stays) {
    // A tetrahedron whose edge from 1 to 2 has a vertex in its middle on one side only: the sliver closes it.
    TriangleMesh mesh = tetrahedron();
    mesh.positions.push_back({0.5, 0.5, 0});
    mesh.triangles = {{0, 4, 1}, {0, 2, 4}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {1, 4, 2}};
    ASSERT_TRUE(is_closed(mesh));
    const auto model = read_model(binary(mesh));
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 6U);
    EXPECT_TRUE(is_closed(model->mesh));
}

TEST(Stl, refuses_what_is_not_a_whole_model_and_says_where) {
    std::string lying = binary(tetrahedron());
    const std::uint32_t many = 0xFFFFFFFF;
    std::memcpy(lying.data() + 80, &many, sizeof many);
    std::string endless = binary(tetrahedron());
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(endless.data() + 84 + 50 + 12, &infinite, sizeof infinite);
    const std::string good = facet("0 0 0", "1 0 0", "0 1 0");
    const BadInput table[] = {
        {"nothing", "", 0, "neither text STL nor long enough"},
        {"a word", "solid", 0, "neither text STL nor long enough"},
        {"a count beyond the file", lying, 0, "says 4294967295 triangles, but there are bytes for 4"},
        {"cut short", binary(tetrahedron()).substr(0, 200), 0, "says 4 triangles, but there are bytes for 2"},
        {"an infinite vertex", endless, 0, "a vertex of triangle 2 is not finite"},
        {"no triangle", binary({}), 0, "no triangles"},
        {"text without facets", "solid a\nendsolid a\n", 0, "no triangles"},
        {"text cut short", "solid a\n" + good, 9, "the file ends where 'endsolid' is due"},
        {"text cut in a vertex", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0", 4, "the file ends"},
        {"no number", "solid a\n" + facet("0 0 0", "1 o 0", "0 1 0"), 5, "expected a number, found 'o'"},
        {"not a number", "solid a\n" + facet("0 0 0", "1 nan 0", "0 1 0"), 5,
         "expected a number, found 'nan'"},
        {"too large", "solid a\n" + facet("0 0 0", "1e39 0 0", "0 1 0"), 5, "not finite"},
        {"too large for a double", "solid a\n" + facet("0 0 0", "1e999 0 0", "0 1 0"), 5, "not finite"},
        {"four corners",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0", 7,
         "expected 'endloop', found 'vertex'"},
        {"a stranger", "solid a\n" + good + "colour red\nendsolid", 9, "expected 'facet' or 'endsolid'"},
        {"after the end", "solid a\n" + good + "endsolid a\nmore", 10, "expected 'solid', found 'more'"},
    };
    for (const BadInput& bad : table) expect_refused(bad, ModelFormat::stl);
}

RC_GTEST_PROP(Stl, any_soup_of_triangles_survives_the_round_trip, ()) {
    const auto n = *rc::gen::inRange(1, 40);
    const auto coordinate =
        rc::gen::map(rc::gen::inRange(-3, 4), [](int i) { return static_cast<float>(i) * 0.5F; });
    TriangleMesh soup;
    for (int i = 0; i < 3 * n; ++i) soup.positions.push_back({*coordinate, *coordinate, *coordinate});
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
        soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto flat = [&](const Triangle& t) {
        const auto& p = soup.positions;
        return p[t[0]] == p[t[1]] || p[t[1]] == p[t[2]] || p[t[2]] == p[t[0]];
    };
    std::vector<Triangle> whole;
    std::copy_if(soup.triangles.begin(), soup.triangles.end(), std::back_inserter(whole),
                 [&](const Triangle& t) { return !flat(t); });
    const auto model = read_model(binary(soup), ModelFormat::stl);
    RC_ASSERT(model.has_value() == !whole.empty());
    if (!model) return;
    RC_ASSERT(model->mesh.triangles.size() == whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            RC_ASSERT(model->mesh.positions[model->mesh.triangles[i][c]] == soup.positions[whole[i][c]]);
        }
    }
    auto sorted = model->mesh.positions;
    std::sort(sorted.begin(), sorted.end());
    RC_ASSERT(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
}

}  // namespace
}  // namespace tribo::readers
