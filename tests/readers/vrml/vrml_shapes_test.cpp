// SPDX-License-Identifier: MIT
// VRML 2.0 geometry other than face sets. Areas and volumes are closed forms of the inscribed flat-sided
// bodies, or numbers of Coin 4.0.0 (Debian's libcoin-dev: SoDB::readAllVRML, a SoCallbackAction that sums up
// the triangles in world space), which works in single precision: 1e-6 of the value.
#include <cmath>

#include "readers/mesh/model_samples.hpp"
#include "readers/vrml/shape/surface.hpp"

namespace tribo::readers {
namespace {

using namespace test;

constexpr double kPi = 3.14159265358979323846;

Result<Model> shape(const std::string& geometry) {
    return read_model("#VRML V2.0 utf8\nShape { geometry " + geometry + " }", {.source_name = "part.wrl"});
}

struct Body {
    std::string geometry;
    std::size_t triangles;
    double area, volume;  // volume 0: not closed
};

void expect_body(const Body& body, double tolerance) {
    SCOPED_TRACE(body.geometry);
    const auto model = shape(body.geometry);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), body.triangles);
    EXPECT_NEAR(area_mm2(model->mesh), body.area, tolerance * body.area);
    EXPECT_EQ(is_closed(model->mesh), body.volume > 0);
    if (body.volume > 0) {
        EXPECT_NEAR(volume_mm3(model->mesh), body.volume, tolerance * body.volume);
    }
    EXPECT_TRUE(model->warnings.empty());
}

TEST(VrmlShapes, SolidsAreTheInscribedOnesOf64SidesAndClosed) {
    const double n = kVrmlSides, chord = 2 * std::sin(kPi / n), inradius = std::cos(kPi / n);
    const double disc = 0.5 * n * std::sin(2 * kPi / n);  // of radius 1
    expect_body({"Box { size 1 2 3 }", 12, 22, 6}, 1e-6);
    expect_body({"Box { }", 12, 24, 8}, 1e-6);
    expect_body({"Cylinder { radius 2 height 3 }", 252, 2 * 4 * disc + 3 * n * 2 * chord, 4 * disc * 3},
                1e-6);
    expect_body({"Cylinder { top FALSE bottom FALSE }", 128, 2 * n * chord, 0}, 1e-6);
    expect_body({"Cylinder { side FALSE bottom FALSE }", 62, disc, 0}, 1e-6);
    const double slant = std::hypot(3, 2 * inradius);
    expect_body({"Cone { bottomRadius 2 height 3 }", 126, 4 * disc + 0.5 * n * 2 * chord * slant, 4 * disc},
                1e-6);
    expect_body({"Cone { bottom FALSE }", 64, 0.5 * n * chord * std::hypot(2, inradius), 0}, 1e-6);
    // Of a sphere: bands of trapezia between circles, closed by triangles.
    double area = 0, volume = 0;
    for (int i = 0; i < 32; ++i) {
        const double a = std::sin(kPi * i / 32), b = std::sin(kPi * (i + 1) / 32);
        const double h = std::cos(kPi * i / 32) - std::cos(kPi * (i + 1) / 32);
        area += 0.5 * n * chord * (a + b) * std::hypot(h, inradius * (b - a));
        volume += disc * h * (a * a + a * b + b * b) / 3;
    }
    expect_body({"Sphere { radius 2 }", 64 * 62, 4 * area, 8 * volume}, 1e-6);
    EXPECT_NEAR(area, 4 * kPi, 0.0025 * 4 * kPi);
    EXPECT_NEAR(volume, 4 * kPi / 3, 0.005 * 4 * kPi / 3);
}

TEST(VrmlShapes, SolidsStandInTheMiddleWithTheirAxisAlongY) {
    const auto bounds_of = [](const std::string& geometry) { return bounds(shape(geometry)->mesh); };
    EXPECT_EQ(bounds_of("Sphere { radius 2 }").max, (Vec3{2, 2, 2}));
    EXPECT_EQ(bounds_of("Cylinder { radius 2 height 3 }").min, (Vec3{-2, -1.5, -2}));
    EXPECT_EQ(bounds_of("Cone { bottomRadius 2 height 3 }").max, (Vec3{2, 1.5, 2}));
    EXPECT_EQ(bounds_of("Cone { bottomRadius 2 height 3 bottom FALSE }").min, (Vec3{-2, -1.5, -2}));
}

TEST(VrmlShapes, ExtrusionsAndGridsMatchCoin) {
    const Body bodies[] = {
        {"Extrusion { }", 12, 16, 4},
        {"Extrusion { crossSection [ 1 0, 0.3 -0.9, -0.8 -0.6, -0.8 0.6, 0.3 0.9, 1 0 ] spine [ 0 0 0, 0 3 "
         "0, 2 5 "
         "1, 5 5 3, 7 4 6 ] scale [ 1 1, 0.8 1.2, 1 1, 0.5 0.5, 0.2 0.7 ] orientation [ 0 1 0 0, 0 1 0 0.3, "
         "0 1 0 "
         "0.6, 1 0 0 0.2, 0 0 1 0.1 ] }",
         46, 61.9317407, 17.99603},
        {"Extrusion { convex TRUE crossSection [ 0 0, 0 2, 1 2, 1 1, 2 1, 2 0, 0 0 ] spine [ 0 0 0, 0 0 4 ] "
         "}",
         20, 38, 12},
        {"Extrusion { crossSection [ 2 1, 1 -1, -1 -1, -1 1, 2 1 ] spine [ 0 3 0, 0 2 0, 0 0 0 ] }", 20,
         37.7082039, 15},
        {"Extrusion { crossSection [ 1 0, 0 -1, -1 0 ] spine [ 0 0 0, 1 1 0, 2 1 0 ] scale 2 1 orientation 0 "
         "1 0 "
         "0.5 }",
         10, 13.7878705, 0},
        // Coin has 20: those of no area at the two tips as well.
        {"Extrusion { crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] spine [ 0 0 0, 0 1 0, 0 2 0 ] scale [ 0 "
         "0, 1 1, "
         "0 0 ] }",
         8, 11.3137085, 2.66666667},
        // Coin has 60; here a pair of sides lies where the spine stands still.
        {"Extrusion { crossSection [ 1 1, 1 -1, -1 -1, -1 1, 1 1 ] spine [ 0 0 0, 1 0 0, 2 1 0, 3 1 0, 4 0 "
         "0, 5 0 "
         "0, 5 0 0, 6 1 1 ] solid FALSE }",
         60, 71.7325477, 27.5453974},
        {"ElevationGrid { xDimension 3 zDimension 4 xSpacing 2 zSpacing 1.5 height [ 0 1 0.5, 2 0 1, 0.3 0.7 "
         "4, 1 1 "
         "2 ] }",
         12, 27.664669, 0},
    };
    for (const Body& body : bodies) expect_body(body, 1e-6);
    const auto down = shape(bodies[3].geometry);
    EXPECT_EQ(bounds(down->mesh).min, (Vec3{-2, 0, -1}));
}

TEST(VrmlShapes, ATorusByExtrusionIsClosedWithoutCaps) {
    // Pappus, for the inscribed polygons: the ring of 12 corners turns in 16 mitred steps.
    std::string section, spine;
    for (int i = 0; i <= 12; ++i) {
        const double a = -2 * kPi * (i % 12) / 12;
        section += std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + ", ";
    }
    for (int i = 0; i <= 16; ++i) {
        const double a = 2 * kPi * (i % 16) / 16;
        spine += std::to_string(4 * std::cos(a)) + " 0 " + std::to_string(4 * std::sin(a)) + ", ";
    }
    const auto model = shape("Extrusion { beginCap FALSE endCap FALSE crossSection [ " + section +
                             "] spine [ " + spine + "] }");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 2U * 12 * 16);
    EXPECT_TRUE(is_closed(model->mesh));
    EXPECT_NEAR(area_mm2(model->mesh), 153.628107, 1e-4);
    EXPECT_NEAR(volume_mm3(model->mesh), 3 * 4 * 16 * std::sin(2 * kPi / 16), 1e-4);
}

TEST(VrmlShapes, AGridLooksUpUnlessItIsClockwise) {
    const auto up = [](const std::string& more) {
        const auto model =
            shape("ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] " + more + " }");
        const TriangleMesh& m = model->mesh;
        const Triangle t = m.triangles[1];
        return cross(m.position(t[1]) - m.position(t[0]), m.position(t[2]) - m.position(t[0])).y;
    };
    EXPECT_EQ(up(""), 1);
    EXPECT_EQ(up("ccw FALSE"), -1);
    EXPECT_FALSE(shape("ElevationGrid { xDimension 2 zDimension 1 height [ 0 0 ] }").has_value());
    EXPECT_FALSE(shape("ElevationGrid { }").has_value());
}

TEST(VrmlShapes, ColoursComeFromTheGeometryElseFromTheMaterial) {
    const std::string square =
        "coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 0 2 3 -1 ] ";
    const auto colours = [](const std::string& body) {
        const auto model = read_model("#VRML V2.0 utf8\n" + body);
        EXPECT_TRUE(is_read(model));
        return model ? model->colours : std::vector<Rgb8>{};
    };
    const auto face_set = [&](const std::string& more) {
        return "Shape { geometry IndexedFaceSet { " + square + more + " } }\n";
    };
    const Rgb8 red{255, 0, 0}, green{0, 255, 0}, grey{204, 204, 204};
    const std::string two = "color Color { color [ 1 0 0, 0 1 0 ] } ";
    using List = std::vector<Rgb8>;
    EXPECT_TRUE(colours(face_set("")).empty());
    EXPECT_EQ(colours(face_set(two + "colorPerVertex FALSE")), (List{red, green}));
    EXPECT_EQ(colours(face_set(two + "colorPerVertex FALSE colorIndex [ 1 0 ]")), (List{green, red}));
    EXPECT_EQ(colours(face_set(two + "colorIndex [ 0 0 0 -1 1 1 1 -1 ]")), (List{red, green}));
    EXPECT_EQ(colours(face_set(two + "colorIndex [ 0 0 1 -1 1 1 1 ]")), (List{{170, 85, 0}, green}));
    // A colour for each of the four points, which there are not.
    const auto few = read_model("#VRML V2.0 utf8\n" + face_set(two));
    ASSERT_TRUE(is_read(few));
    EXPECT_TRUE(few->colours.empty());
    ASSERT_EQ(few->warnings.size(), 1U);
    EXPECT_EQ(few->warnings[0].line, 2);
    const std::string box = "Shape { geometry Box {} appearance Appearance { material Material { ";
    const List mixed = colours(face_set("") + box + "diffuseColor 0 1 0 } } }\n" + box + "shininess 1 } } }");
    ASSERT_EQ(mixed.size(), 26U);
    EXPECT_EQ(mixed[0], grey);
    EXPECT_EQ(mixed[2], green);
    EXPECT_EQ(mixed[25], grey);
    EXPECT_EQ(colours("Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] "
                      "colorPerVertex FALSE color Color { color 1 0 0 } } }"),
              (List{red, red}));
}

}  // namespace
}  // namespace tribo::readers
