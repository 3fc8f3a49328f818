// SPDX-License-Identifier: MIT
// VRML 2.0: what is seen, where it is placed, what is refused, and files made to be slow or deep.
#include "readers/vrml/vrml.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#include "places.hpp"
#include "readers/mesh/model_samples.hpp"
#include "readers/vrml/lexer.hpp"
#include "readers/vrml/vrml_text.hpp"

namespace tribo::readers {
namespace {

using namespace test;

Result<Model> read(const std::string& body) {
    return read_model(kHeader + body, {.source_name = "part.wrl"});
}

TEST(Vrml, a_square_is_two_triangles_in_any_spelling) {
    const char* spellings[] = {
        "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ] } "
        "coordIndex [ 0 1 2 3 ] } }",
        "Shape{geometry IndexedFaceSet{coordIndex[0,1,2,3,-1]coord Coordinate{point[0 0 0 2. 0 0 +2 20e-1 0 "
        "0 2e-000 .0]}}}",
        "# a { [ \" comment\nDEF a.b+1 Shape { appearance Appearance { material Material { diffuseColor 1 0 "
        "0 } }\r"
        "geometry DEF f\xFCr IndexedFaceSet { coord Coordinate { point [ 0 0 0, 2 0 0, 2 2 0, 0 2 0 ] }\r\n"
        "coordIndex [ 0x0 0X1 0x2 3 -1 ] convex TRUE texCoord TextureCoordinate { point [ 0 0 1 1 ] } } }"};
    for (const char* text : spellings) {
        const auto model = read(text);
        ASSERT_TRUE(is_read(model));
        EXPECT_EQ(model->format, ModelFormat::vrml);
        EXPECT_EQ(model->mesh.triangles.size(), 2U);
        EXPECT_EQ(model->mesh.positions.size(), 4U);
        EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 4);
        EXPECT_TRUE(model->warnings.empty()) << model->warnings[0].message();
    }
}

TEST(Vrml, a_concave_face_is_cut_right_whatever_convex_says) {
    const char* corners[] = {"0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"};
    for (std::size_t start = 0; start < 6; ++start) {
        std::string text = "Shape { geometry IndexedFaceSet { convex TRUE coord Coordinate { point [";
        for (std::size_t i = 0; i < 6; ++i) text += std::string(corners[(start + i) % 6]) + ", ";
        const auto model = read(text + "] } coordIndex [ 0 1 2 3 4 5 -1 ] } }");
        ASSERT_TRUE(is_read(model));
        EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 3) << start;
    }
}

TEST(Vrml, a_transform_scales_turns_about_its_centre_and_moves) {
    // Scale 2 about (1, 1, 0): (0,0,0) to (-1,-1,0); a quarter turn about z there: to (3,-1,0); and +10 in x.
    const auto model = read(
        "Transform { translation 10 0 0 rotation 0 0 2 1.5707963267948966 scale 2 2 2 center 1 1 0 "
        "children [ " +
        kTriangle + " ] }");
    ASSERT_TRUE(is_read(model));
    const Point3f corner = model->mesh.positions[0];
    EXPECT_NEAR(corner[0], 13, 1e-6);
    EXPECT_NEAR(corner[1], -1, 1e-6);
    EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 2);
}

TEST(Vrml, scale_orientation_stretches_along_a_turned_axis) {
    // Stretched by 3 along the diagonal of x and y: that diagonal's end goes three times as far.
    const auto model = read(
        "Transform { scale 3 1 1 scaleOrientation 0 0 1 0.78539816339744831 children Shape { geometry "
        "IndexedFaceSet { coord Coordinate { point [ 1 1 0, 1 -1 0, 0 0 1 ] } coordIndex [ 0 1 2 ] } } }");
    ASSERT_TRUE(is_read(model));
    EXPECT_NEAR(model->mesh.positions[0][0], 3, 1e-6);
    EXPECT_NEAR(model->mesh.positions[0][1], 3, 1e-6);
    EXPECT_NEAR(model->mesh.positions[1][0], 1, 1e-6);
    EXPECT_NEAR(model->mesh.positions[1][1], -1, 1e-6);
}

TEST(Vrml, clockwise_faces_and_mirrored_places_keep_the_outside_outside) {
    const auto up = [](const Result<Model>& model) {
        const auto& m = model->mesh;
        const Triangle t = m.triangles[0];
        return cross(m.position(t[1]) - m.position(t[0]), m.position(t[2]) - m.position(t[0])).z;
    };
    std::string clockwise = kTriangle;
    clockwise.replace(clockwise.find("coordIndex"), 0, "ccw FALSE ");
    EXPECT_EQ(up(read(kTriangle)), 1);
    EXPECT_EQ(up(read(clockwise)), -1);
    EXPECT_EQ(up(read("Transform { scale -1 1 1 children " + kTriangle + "}")), 1);
    EXPECT_EQ(up(read("Transform { scale -1 1 1 children " + clockwise + "}")), -1);
}

TEST(Vrml, used_nodes_are_seen_again_and_a_name_may_be_given_anew) {
    const auto model = read("DEF A " + kTriangle + "Transform { translation 5 0 0 children USE A }\n" +
                            "DEF A Transform { translation 0 7 0 children USE A }\nUSE A");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 4U);
    EXPECT_EQ(bounds(model->mesh).max, (Vec3{6, 8, 0}));
    EXPECT_EQ(model->parts.size(), 4U);
}

TEST(Vrml, parts_carry_what_shading_needs) {
    std::string smooth = kTriangle;
    smooth.replace(smooth.find("coordIndex"), 0, "solid FALSE creaseAngle 0.5 ");
    smooth.replace(smooth.find("0 1 2 -1"), 8, "0 1 2 -1 0 0 1 -1");
    const auto model = read(smooth + kTriangle);
    ASSERT_TRUE(is_read(model));
    ASSERT_EQ(model->parts.size(), 2U);
    EXPECT_EQ(model->parts[0].triangles, 1U);
    EXPECT_EQ(model->parts[0].crease_angle_rad, 0.5);
    EXPECT_FALSE(model->parts[0].solid);
    EXPECT_EQ(model->parts[1].first_triangle, 1U);
    EXPECT_TRUE(model->parts[1].solid);
}

TEST(Vrml, grouping_nodes_show_what_they_show) {
    const auto count = [](const std::string& body) {
        const auto model = read(body + kTriangle);
        EXPECT_TRUE(is_read(model));
        return model ? model->mesh.triangles.size() - 1 : 0;
    };
    EXPECT_EQ(count("Switch { whichChoice 1 choice [ Group {} " + kTriangle + "] }"), 1U);
    EXPECT_EQ(count("Switch { choice " + kTriangle + "}"), 0U);
    EXPECT_EQ(count("Switch { whichChoice 7 choice Box {} }"), 0U);
    EXPECT_EQ(count("LOD { range [ 10 ] level [ " + kTriangle + " Shape { geometry Sphere {} } ] }"), 1U);
    EXPECT_EQ(count("Anchor { url \"x\" children [ Collision { collide FALSE children " + kTriangle +
                    " proxy Shape { geometry Box {} } } Billboard { axisOfRotation 0 1 0 children " +
                    kTriangle + "} ] }"),
              2U);
}

TEST(Vrml, what_has_no_surface_is_passed_over) {
    const auto model = read(
        "WorldInfo { title \"a \\\"quoted\\\" } title\" info [ \"x\" \"y\" ] }\nNavigationInfo { type [ "
        "\"EXAMINE\", \"ANY\" ] }\n"
        "Script { url \"javascript: if (a) { b }\" field SFNode n DEF Inner Group {} eventIn SFBool go "
        "directOutput TRUE }\n"
        "DEF T TouchSensor {}\nVendorNode { thing [ 1 { 2 } ] odd USE x }\n"
        "Group { vendorField AUTO vendorNode Strange { a 1 } children [ USE Inner, " +
        kTriangle +
        " Shape { geometry IndexedLineSet { coord DEF C Coordinate { point [ 0 0 0 3 0 0 0 3 0 ] } "
        "coordIndex [ 0 1 ] } }\n"
        "Shape { geometry IndexedFaceSet { coord USE C coordIndex [ 0 1 2 ] } } ] }\nROUTE T.touchTime TO "
        "T.enabled\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(area_mm2(model->mesh), 0.5 + 4.5);
    std::string told;
    for (const Warning& w : model->warnings) told += w.message() + "\n";
    EXPECT_EQ(told,
              "part.wrl:6: warning: the unknown node 'VendorNode' was skipped\n"
              "part.wrl:7: warning: the unknown field 'vendorField' of Group was skipped\n"
              "part.wrl:7: warning: the unknown field 'vendorNode' of Group was skipped\n"
              "part.wrl:7: warning: the unknown node 'Strange' was skipped\n"
              "part.wrl:8: warning: IndexedLineSet has no surface and was skipped\n");
}

TEST(Vrml, refuses_by_name_what_would_be_lost_and_says_where) {
    const auto with = [](const std::string& body) { return kHeader + body; };
    const auto face = [&](const std::string& rest) {
        return kHeader +
               "Shape { geometry IndexedFaceSet {\ncoord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] }\n" +
               rest + "\n} }";
    };
    const std::string long_word(70'000, 'a');
    const BadInput table[] = {
        {"nothing", "", 1, "no '#VRML V2.0 utf8'"},
        {"no header", kTriangle, 1, "no '#VRML V2.0 utf8'"},
        {"older", "#VRML V1.0 ascii\nSeparator {}", 1, "a VRML 1.0 file"},
        {"Inventor", "#Inventor V2.1 ascii\n", 1, "an Open Inventor file"},
        {"X3D", "#X3D V3.0 utf8\nPROFILE Immersive\n", 1, "an X3D file"},
        {"X3D in XML", "<?xml version=\"1.0\"?>\n<X3D profile='Full'/>", 1, "an X3D file"},
        {"compressed", "\x1f\x8b\x08", 1, "gzip"},
        {"header alone", with(""), 0, "no triangles"},
        {"index beyond", face("coordIndex [ 0 1 2 -1\n 0 1\n 3 -1 ]"), 6, "not one of the 3"},
        {"negative index", face("coordIndex [ 0 1 2 -2 ]"), 4, "not one of the 3"},
        {"broken index", face("coordIndex [ 0 1 1.5 ]"), 4, "not one of the 3"},
        {"huge index", face("coordIndex [ 0 1 2147483647 ]"), 4, "not one of the 3"},
        {"indices of words", face("coordIndex [ 0 1 two ]"), 4, "expected '{' after 'two'"},
        {"two kinds", face("coordIndex [ 0 1 \"2\" ]"), 4, "mixes kinds"},
        {"no coordinates", with("Shape { geometry IndexedFaceSet {\ncoordIndex [ 0 1 2 ] } }"), 3,
         "not one of the 0"},
        {"flat points",
         with("Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 1 0 ] } coordIndex [ 0 1 2 ] "
              "} }"),
         2, "three numbers for each of its values"},
        {"wrong coordinates",
         with(
             "Shape { geometry IndexedFaceSet {\ncoord Normal { vector [ 0 0 1 ] } coordIndex [ 0 1 2 ] } }"),
         3, "'coord' must be a Coordinate"},
        {"flag", face("ccw 1 coordIndex [ 0 1 2 ]"), 4, "'ccw' must be TRUE or FALSE"},
        {"angle", face("creaseAngle -1 coordIndex [ 0 1 2 ]"), 4, "'creaseAngle' must be"},
        {"short rotation", with("Transform { rotation 0 0 1 children " + kTriangle + "}"), 2,
         "'rotation' must have 4 numbers"},
        {"too large", with("Transform {\ntranslation 1e999 0 0 children " + kTriangle + "}"), 3,
         "'1e999' is too large"},
        {"too far", with("Transform { scale 1e39 1 1 children\n" + kTriangle + "}"), 3,
         "not finite where it is placed"},
        {"geometry alone", with("\nIndexedFaceSet {}"), 3, "IndexedFaceSet cannot stand here"},
        {"group as geometry", with("Shape { geometry\nGroup {} }"), 3, "Group cannot stand here"},
        {"children of numbers", with("Group {\nchildren 1 2 3 }"), 3, "'children' must hold nodes"},
        {"unknown name", with("Group { children [\nUSE Nobody ] }"), 3, "USE of 'Nobody'"},
        {"itself", with("DEF A Group { children [\nUSE A ] }"), 3, "USE of 'A'"},
        {"open group", with("Group { children [\n"), 3, "the file ends"},
        {"open skipped node", with("Strange {\n{ }"), 3, "the file ends where the end of the node of line 2"},
        {"open string", with("WorldInfo { title\n \"no end }"), 3, "no closing quote"},
        {"closed twice", with("Group { } }"), 2, "expected a node, found '}'"},
        {"no brace", with("Group\nchildren"), 3, "expected '{' after 'Group'"},
        {"half a route", with(kTriangle + "ROUTE a.b\nPUT c.d"), 4, "expected 'TO'"},
        {"long word", with(kTriangle + long_word), 3, "longer than 64 kB"},
        {"long number", face("coordIndex [ 0 1 " + std::string(70'000, '1') + " ]"), 4, "longer than 64 kB"},
        {"long string", with("WorldInfo { title \"" + long_word + "\" }"), 2, "longer than 64 kB"},
        {"zero bytes", kHeader + std::string(3, '\0') + "}", 2, "expected a node, found '}'"},
    };
    for (const BadInput& bad : table) expect_refused(bad, ModelFormat::vrml);
}

std::string doubled(const std::string& shape, int times) {
    std::string text = kHeader + "DEF N0 " + shape;
    for (int i = 1; i <= times; ++i) {
        const std::string below = "USE N" + std::to_string(i - 1);
        text += "DEF N" + std::to_string(i) + " Group { children [ " + below + " " + below + " ] }\n";
    }
    return text;
}

TEST(Vrml, doubling_by_use_fails_at_once) {
    std::string forty = kTriangle, none = kTriangle, faces;
    for (int i = 0; i < 40; ++i) faces += "0 1 2 -1 ";
    forty.replace(forty.find("0 1 2 -1"), 8, faces);
    none.replace(none.find("0 1 2 -1"), 8, "0 1 -1");
    // All of N0 to N18 are seen: 40 (2^19 - 1) triangles are the first sum above the limit.
    expect_refused({"triangles", doubled(forty, 200), 20, "more than 20000000 triangles"}, ModelFormat::vrml);
    expect_refused({"nodes", doubled(kTriangle, 200), 22, "more than 4 million nodes"}, ModelFormat::vrml);
    // Nothing to see unfolds to nothing, and costs nothing.
    expect_refused({"nothing", doubled(none, 200), 0, "no triangles"}, ModelFormat::vrml);
}

TEST(Vrml, long_chains_of_groups_are_counted_as_well) {
    // 18 doublings of a chain of 200 groups over one triangle: 262,144 triangles, but 52 million nodes.
    std::string chain = kTriangle;
    for (int i = 0; i < 200; ++i) chain = "Group { children " + chain + "}";
    std::string text = kHeader + "Switch { choice [ DEF N0 " + chain;
    for (int i = 1; i <= 18; ++i) {
        const std::string below = "USE N" + std::to_string(i - 1);
        text += "\nDEF N" + std::to_string(i) + " Group { children [ " + below + " " + below + " ] }";
    }
    expect_refused({"nodes", text + "] }\nUSE N18", 21, "more than 4 million nodes"}, ModelFormat::vrml);
}

TEST(Vrml, nesting_is_limited_in_the_text_and_through_use) {
    std::string nested, chained = kHeader + "DEF N0 " + kTriangle;
    for (int i = 0; i < 20'000; ++i) nested += "Group { children ";
    expect_refused({"text", kHeader + nested, 2, "more than 256 deep"}, ModelFormat::vrml);
    for (int i = 1; i <= 300; ++i) {
        chained += "DEF N" + std::to_string(i) + " Group { children USE N" + std::to_string(i - 1) + " }\n";
    }
    expect_refused({"use", chained, 257, "more than 256 deep through USE"}, ModelFormat::vrml);
}

TEST(Vrml, one_coordinate_used_by_many_face_sets_costs_what_they_show) {
    std::string text = kHeader + "Shape { geometry IndexedFaceSet { coord DEF C Coordinate { point [";
    for (int i = 0; i < 100'000; ++i) text += std::to_string(i) + " 0 " + std::to_string(i % 2) + ",";
    text += "] } coordIndex [ 0 1 2 ] } }\n";
    for (int i = 0; i < 50'000; ++i) text += "Shape{geometry IndexedFaceSet{coord USE C coordIndex[7 8 9]}}";
    const auto model = read_model(text);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 50'001U);
    EXPECT_EQ(model->mesh.positions.size(), 3U * 50'001);
}

TEST(VrmlLexer, tells_lines_and_columns_for_every_line_end) {
    VrmlLexer lexer("a\n b\r  c\r\n   d # e\n\"x\r\ny\" f");
    const int lines[] = {1, 2, 3, 4, 5, 6}, columns[] = {1, 2, 3, 4, 1, 4};
    for (int i = 0; i < 6; ++i) {
        const VrmlToken token = lexer.next();
        EXPECT_EQ(token.line, lines[i]) << i;
        EXPECT_EQ(token.column, columns[i]) << i;
    }
    EXPECT_EQ(lexer.next().kind, VrmlTokenKind::end);
}

std::string shared_file(const std::string& name) {
    std::ifstream in(TRIBO_SOURCE_DIR "/../shared/data/vrml/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// Numbers of an independent reader (Coin), where it is right.
TEST(Vrml, reads_a_real_teapot_of_3014_triangles) {
    const std::string bytes = shared_file("teapot.wrl");
    if (bytes.empty()) GTEST_SKIP() << "no shared data here";
    const auto model = read_model(bytes);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 3014U);
    EXPECT_NEAR(area_mm2(model->mesh), 40.39187, 1e-5);
}

TEST(Vrml, reads_the_face_set_of_a_real_robot_part) {
    const std::string bytes = shared_file("hand_base.wrl");
    if (bytes.empty()) GTEST_SKIP() << "no shared data here";
    const auto model = read_model(bytes);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 1520U);
    EXPECT_NEAR(area_mm2(model->mesh), 0.247492, 1e-6);
}

// Coin 4.0 sees 14,527 triangles, of which five cylinders have 76 each where we draw 252; all else counts the
// same. Its area, 1890.030, is that of coarser cylinders.
TEST(Vrml, reads_a_real_house_of_boxes_cylinders_and_face_sets) {
    const std::string bytes = shared_file("house.wrl");
    if (bytes.empty()) GTEST_SKIP() << "no shared data here";
    const auto model = read_model(bytes);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 14'527U + 5 * (252 - 76));
    EXPECT_NEAR(area_mm2(model->mesh), 1890.030, 0.002);
    EXPECT_EQ(model->colours.size(), model->mesh.triangles.size());
}

// A small house of our own: walls of a box, a roof of four triangles, a chimney used twice.
TEST(Vrml, reads_a_house_of_a_box_a_face_set_and_used_parts) {
    const auto model = read_model(
        "#VRML V2.0 utf8\n"
        "DEF House Group { children [\n"
        "  Shape { appearance Appearance { material Material { diffuseColor 0.8 0.7 0.5 } }\n"
        "          geometry Box { size 6 4 4 } }\n"
        "  Transform { translation 0 2 0 children Shape { geometry IndexedFaceSet {\n"
        "    coord Coordinate { point [ -3 0 -2, 3 0 -2, 3 0 2, -3 0 2, 0 1.5 0 ] }\n"
        "    coordIndex [ 1 0 4 -1 2 1 4 -1 3 2 4 -1 0 3 4 -1 ] solid FALSE } } }\n"
        "  Transform { translation 2 4 0 children DEF Chimney Shape { geometry Box { size 1 2 1 } } }\n"
        "  Transform { translation -2 4 0 scale 1 2 1 children USE Chimney }\n"
        "] }\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 12U + 4 + 12 + 12);
    // Slopes of the roof: bases of 6 and 4, heights over them of 2.5 and sqrt(11.25).
    const double roof = 6 * 2.5 + 4 * std::sqrt(11.25);
    EXPECT_NEAR(area_mm2(model->mesh), 2 * (24 + 24 + 16) + roof + (2 + 4 * 2) + (2 + 4 * 4), 1e-5);
    EXPECT_EQ(model->colours.size(), model->mesh.triangles.size());
}

}  // namespace
}  // namespace tribo::readers
