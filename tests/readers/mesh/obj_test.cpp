// SPDX-License-Identifier: MIT
// OBJ: indices of every kind, faces of every shape, and each refusal's message.
#include "readers/mesh/obj.hpp"

#include "readers/mesh/model_polygon.hpp"
#include "readers/mesh/model_samples.hpp"

namespace tribo::readers {
namespace {

using namespace test;

const std::string kCubeVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";

TEST(Obj, a_cube_of_quadrangles_is_closed) {
    const auto model = read_model("# cube\nmtllib x.mtl\no cube\n" + kCubeVertices +
                                  "vt 0 0\nvn 0 0 1\nusemtl red\ns off\n"
                                  "f 4/1/1 3/1/1 2/1/1 1/1/1\nf 5//1 6//1 7//1 8//1\nf 1/1 2/1 6/1 5/1\n"
                                  "f 3 4 8 7 # back\nf 2 3 \\\n 7 6\nf -8 -4 -1 -5\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->format, ModelFormat::obj);
    EXPECT_EQ(model->mesh.triangles.size(), 12U);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_DOUBLE_EQ(volume_mm3(model->mesh), 1);
    EXPECT_TRUE(model->warnings.empty());
}

TEST(Obj, a_concave_face_keeps_its_area_wherever_it_starts) {
    const char* corners[] = {"0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"};  // an L of area 3
    for (std::size_t start = 0; start < 6; ++start) {
        std::string text;
        for (std::size_t i = 0; i < 6; ++i) text += std::string("v ") + corners[(start + i) % 6] + "\n";
        const auto model = read_model(text + "f 1 2 3 4 5 6\n");
        ASSERT_TRUE(is_read(model));
        EXPECT_EQ(model->mesh.triangles.size(), 4U);
        EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 3) << start;
    }
}

TEST(Obj, a_vertex_may_carry_weight_or_colour_and_unused_ones_do_not_count) {
    const auto model =
        read_model("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 99 99 99\nf 1 2 3\nl 1 2\np 3\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(bounds(model->mesh).max, (Vec3{1, 1, 0}));
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_NE(model->warnings[0].message().find("2 statements of points or lines"), std::string::npos);
    EXPECT_EQ(model->warnings[0].line, 6);
}

TEST(Obj, a_degenerate_face_is_dropped_and_counted) {
    const auto model = read_model("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\nf 3 1 1 3\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 1U);
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_NE(model->warnings[0].text.find("1 degenerate triangle was dropped"), std::string::npos);
}

TEST(Obj, a_face_that_crosses_itself_is_told) {
    const auto model = read_model("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
    ASSERT_TRUE(is_read(model));
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_NE(model->warnings[0].text.find("a face crosses itself"), std::string::npos);
}

TEST(Obj, refuses_what_it_cannot_place_and_says_where) {
    const std::string two = "v 0 0 0\nv 1 0 0\n", three = two + "v 0 1 0\n";
    const BadInput table[] = {
        {"no face", three, 0, "no triangles"},
        {"index beyond the end", three + "f 1 2 4\n", 4, "uses vertex 4, but 3 were read so far"},
        {"index before its vertex", two + "f 1 2 3\nv 0 1 0\n", 3, "uses vertex 3, but 2 were read so far"},
        {"index zero", three + "f 0 1 2\n", 4, "uses vertex 0"},
        {"negative beyond the start", three + "\n\nf -1 -2 -4\n", 6, "uses vertex -4"},
        {"huge index", three + "f 1 2 99999999999999999999\n", 4, "expected a vertex number"},
        {"no index", three + "f 1 2 /3\n", 4, "expected a vertex number, found '/3'"},
        {"two corners", three + "f 1 2\n", 4, "three corners"},
        {"short vertex", two + "v 1 2\n", 3, "x, y and z"},
        {"no number", two + "v 1 2 z\n", 3, "expected a number, found 'z'"},
        {"not a number", two + "v 1 nan 0\n", 3, "expected a number, found 'nan'"},
        {"infinite", two + "v 1 1e400 0\n", 3, "not finite"},
        {"free-form surface", three + "cstype bezier\ndeg 3 3\n", 4, "'cstype' is not read"},
        {"another file", "call other.obj\n", 1, "'call' is not read"},
        {"another format", "G21 G90\n", 1, "'G21' is not an OBJ statement"},
        {"a page", "<html>\n", 1, "'<html>' is not an OBJ statement"},
        {"zero bytes", std::string("v 0 0 0\n\0\0", 10), 2, "'?\?' is not an OBJ statement"},
    };
    for (const BadInput& bad : table) expect_refused(bad, ModelFormat::obj);
}

// Cutting a face is quadratic in its corners at best. A file of 700 kB must not take half a minute.
TEST(Obj, refuses_a_face_of_too_many_corners) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\n";
    for (const char* repeated : {" 1 2 3", " 1 2 4", " 1 2 4 5 4 2"}) {
        std::string face = "f";
        for (int i = 0; i < 40'000; ++i) face += repeated;
        const auto model = read_model(vertices + face + "\n", ModelFormat::obj, {.source_name = "long.obj"});
        ASSERT_FALSE(model) << repeated;
        EXPECT_EQ(model.error().line, 6);
        EXPECT_NE(model.error().cause.find("too long"), std::string::npos) << model.error().text();
        EXPECT_NE(model.error().remedy.find(std::to_string(PolygonTriangulator::kAlwaysCut)),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace tribo::readers
