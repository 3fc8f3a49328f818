// SPDX-License-Identifier: MIT
// What the VRML reader refuses or warns of: file, line, column, text.
#include "readers/mesh/model_samples.hpp"
#include "readers/vrml/vrml_text.hpp"

namespace tribo::readers {
namespace {

using test::kHeader;

const std::string kBox = "Shape { geometry Box { } }\n";

struct Row {
    std::string body;  // after the header line
    int line, column;
    const char* text;
};

TEST(VrmlRefusals, NameThePlaceAndTheReason) {
    const auto shape = [](const std::string& geometry) { return "Shape { geometry\n" + geometry + " }"; };
    const Row rows[] = {
        {shape("Box { size 1 2 }"), 3, 12, "'size' must have 3 numbers"},
        {shape("Box { size 1 0 2 }"), 3, 12, "'size' must be three numbers above 0"},
        {shape("Sphere { radius -1 }"), 3, 17, "'radius' must be one number above 0"},
        {shape("Sphere { radius 1 2 }"), 3, 17, "'radius' must be one number above 0"},
        {shape("Cone { height 0 }"), 3, 15, "'height' must be one number above 0"},
        {shape("Cone { bottom 1 }"), 3, 15, "'bottom' must be TRUE or FALSE"},
        {shape("Cylinder { top NULL }"), 3, 16, "'top' must be TRUE or FALSE"},
        {shape("Cylinder { radius [ ] }"), 3, 19, "'radius' must be one number above 0"},
        {shape("ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 ] }"), 3, 50,
         "ElevationGrid has 3 heights for 2 times 2 points"},
        {shape("ElevationGrid { xDimension 2 zDimension 2 }"), 3, 1, "has 0 heights for 2 times 2"},
        {shape("ElevationGrid { xDimension 2 zDimension 2 xSpacing 0 height [ 0 0 0 0 ] }"), 3, 52,
         "'xSpacing' must be one number above 0"},
        {shape("Extrusion { crossSection [ 1 2 3 ] }"), 3, 26, "'crossSection' must hold two numbers"},
        {shape("Extrusion { spine [ 0 0 0 1 ] }"), 3, 19, "'spine' must hold three numbers"},
        {shape("Extrusion { scale [ 1 1, 2 2 ] spine [ 0 0 0, 0 1 0, 0 2 0 ] }"), 3, 19,
         "'scale' must have one value, or one for each of the 3 points of the spine"},
        {shape("Extrusion { orientation 1 2 3 }"), 3, 25, "'orientation' must hold four numbers"},
        {shape("Extrusion { beginCap 0 }"), 3, 22, "'beginCap' must be TRUE or FALSE"},
        {shape("Extrusion { creaseAngle -1 }"), 3, 25, "'creaseAngle' must be one number, 0 or more"},
        {shape("IndexedFaceSet { coord Coordinate { point [ 0 0 ] } }"), 3, 43,
         "'point' must hold three numbers"},
        {shape("IndexedFaceSet { coord Coordinate { point [ 0 0 0 ] } coordIndex [ 0\n 0 7 ] }"), 4, 4,
         "a face uses a point that is not one of the 1"},
        {shape("IndexedFaceSet { colorPerVertex 1 }") + kBox, 3, 33,
         "'colorPerVertex' must be TRUE or FALSE"},
        {shape("Transform { }"), 3, 1, "Transform cannot stand here"},
        {"Group { children [ Sphere { } ] }", 2, 20, "Sphere cannot stand here"},
        {"Transform { translation 0 0 children " + kBox + "}", 2, 25, "'translation' must have 3 numbers"},
        {"Group { children \"x\" }", 2, 18, "'children' must hold nodes"},
        {"PROTO P [ field ] { }", 2, 17, "expected the field's type, found ']'"},
        {"PROTO P [ thing SFInt32 a 1 ] { }", 2, 11,
         "expected 'field', 'exposedField', 'eventIn', 'eventOut'"},
        {"PROTO P { }", 2, 9, "expected '[' after 'P'"},
        {"PROTO P [ ] Group { }", 2, 13, "expected '{' after the prototype's interface"},
        {"PROTO P [ ] { Box { size IS big } }", 2, 29, "the prototype 'P' declares no field 'big'"},
        {"PROTO P [ ] { Group { children P { } } }", 2, 32, "the prototype 'P' contains itself"},
        {"PROTO P [ ] { Group { }", 2, 24, "the file ends where a node is due"},
        {"Group { children IS c }", 2, 18, "IS outside of a prototype"},
        {"EXTERNPROTO P [ ]", 2, 18, "the file ends where the url of the prototype's file is due"},
        {"EXTERNPROTO P [ ] [ 1 ]", 2, 21, "expected the url of the prototype's file, found '1'"},
        {"EXTERNPROTO P [ field {", 2, 23, "expected a field of the prototype or ']', found '{'"},
        {"PROTO P [ field SFVec3f s 1 1 1 ] { Shape { geometry Box { size IS s } } }\nP { s 1 2 }", 3, 7,
         "'size' must have 3 numbers"},
    };
    for (const Row& row : rows) {
        const auto model = read_model(kHeader + row.body, {.source_name = "part.wrl"});
        ASSERT_FALSE(model.has_value()) << row.body;
        const Error& error = model.error();
        EXPECT_EQ(error.file, "part.wrl");
        EXPECT_EQ(error.line, row.line) << row.body << "\n" << error.text();
        EXPECT_EQ(error.column, row.column) << row.body << "\n" << error.text();
        EXPECT_NE(error.cause.find(row.text), std::string::npos) << row.body << "\n" << error.text();
        EXPECT_FALSE(error.remedy.empty()) << error.text();
    }
}

TEST(VrmlRefusals, WarningsNameWhatIsPassedOver) {
    const Row rows[] = {
        {"Shape { geometry Text { string \"a\" } }\n", 2, 0, "Text has no surface and was skipped"},
        {"\nShape { geometry PointSet { } }\n", 3, 0, "PointSet has no surface and was skipped"},
        {"Shape { geometry Sphere { slices 4 } }\n", 2, 0,
         "the unknown field 'slices' of Sphere was skipped"},
        {"NurbsSurface { }\n", 2, 0, "the unknown node 'NurbsSurface' was skipped"},
        {"PROTO P [ ] { Group { } }\nP { odd 1 }\n", 3, 0, "the unknown field 'odd' of P was skipped"},
        {"EXTERNPROTO E [ ] \"e.wrl\"\nE { }\n", 3, 0,
         "the node 'E' was skipped: the file of its EXTERNPROTO"},
        {"Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 1 1 0 ] } "
         "coordIndex [ 0 3 "
         "1 2 -1 ] } }\n",
         2, 0, "a face crosses itself or has no area"},
        {"Shape { geometry\n\nIndexedFaceSet { color Color { color [ 1 0 0 ] } coord Coordinate { point [ 0 "
         "0 0 1 0 "
         "0 0 1 0 ] } coordIndex [ 0 1 2 ] } }\n",
         4, 0, "the colours of an IndexedFaceSet do not fit its faces"},
        {"Shape { geometry ElevationGrid { xDimension 2 zDimension 2 height [ 0 0 0 0 ] color Color { color "
         "1 0 0 } "
         "} }\n",
         2, 0, "the colours of an ElevationGrid do not fit"},
    };
    for (const Row& row : rows) {
        const auto model = read_model(kHeader + row.body + kBox, {.source_name = "part.wrl"});
        ASSERT_TRUE(test::is_read(model)) << row.body;
        ASSERT_EQ(model->warnings.size(), 1U) << row.body;
        EXPECT_EQ(model->warnings[0].file, "part.wrl");
        EXPECT_EQ(model->warnings[0].line, row.line) << row.body;
        EXPECT_NE(model->warnings[0].text.find(row.text), std::string::npos) << model->warnings[0].message();
    }
}

}  // namespace
}  // namespace tribo::readers
