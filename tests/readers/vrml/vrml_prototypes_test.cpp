// SPDX-License-Identifier: MIT
// PROTO, EXTERNPROTO and Inline: what instances unfold to, which files are asked for, and where it ends.
#include <map>

#include "readers/mesh/model_samples.hpp"
#include "readers/vrml/vrml_text.hpp"

namespace tribo::readers {
namespace {

using namespace test;

const std::string kCubeOf2 = "Shape { geometry Box { } } ";  // 8 mm3, from -1 to 1

// A folder in memory.
using Files = std::map<std::string, std::string>;

Result<Model> read_among(const std::string& body, const Files& files = {}) {
    ModelOptions options;
    options.source_name = "part.wrl";
    options.neighbours = [&](std::string_view url, const std::string&,
                             std::uint64_t limit) -> Result<ModelNeighbour> {
        if (url == "part.wrl") return ModelNeighbour{"part.wrl", {}};
        const auto found = files.find(std::string(url));
        if (found == files.end()) return fail("there is no such file");
        if (found->second.size() > limit) return fail("it is too large");
        return ModelNeighbour{found->first, found->second};
    };
    return read_model(kHeader + body, options);
}

TEST(VrmlPrototypes, AnInstanceTakesTheValuesGivenElseTheDefaults) {
    const auto model = read_among(
        "PROTO Post [ field SFVec3f size 1 1 1 field SFVec3f at 0 0 0 eventIn SFBool go exposedField MFNode "
        "more [ ] "
        "] {\n"
        "  Transform { translation IS at children [ Shape { geometry Box { size IS size } } Group { children "
        "IS "
        "more } ] }\n"
        "  TimeSensor { enabled IS go }\n}\n"
        "Post { }\n"
        "Post { size 2 4 8 at 10 0 0 more [ " +
        kCubeOf2 + " Post { at 0 0 5 } ] }\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 4U * 12);
    EXPECT_NEAR(volume_mm3(model->mesh), 1 + 64 + 8 + 1, 1e-9);
    EXPECT_EQ(bounds(model->mesh).max, (Vec3{11, 2, 5.5}));
    EXPECT_TRUE(model->warnings.empty()) << model->warnings[0].message();
}

TEST(VrmlPrototypes, PrototypesStandInPrototypesAndAnywhereANodeMay) {
    const auto model = read_among(
        "PROTO Cube [ field SFVec3f edges 1 1 1 ] { Shape { geometry DEF Own Box { size IS edges } } }\n"
        "PROTO Pair [ field SFVec3f e 1 2 3 field SFVec3f at 1 0 0 ] {\n"
        "  PROTO Tall [ field SFFloat unused 1 ] { Cube { edges 1 9 1 } }\n"
        "  Group { children [ Cube { edges IS e } Transform { translation IS at children [ Cube { } Tall { } "
        "] } ] "
        "} }\n"
        "PROTO Round [ ] { Sphere { } }\n"
        "Group { PROTO Here [ ] { Pair { e 2 2 2 } } children [ Pair { } DEF P Here { } USE P ] }\n"
        "Shape { geometry Round { } }\n");
    ASSERT_TRUE(is_read(model));
    EXPECT_NEAR(volume_mm3(model->mesh), (6 + 1 + 9) + 2 * (8 + 1 + 9) + 4.17199, 1e-4);
}

TEST(VrmlPrototypes, NamesHoldInTheirBodyOnly) {
    expect_refused({"use", kHeader + "DEF A " + kCubeOf2 + "PROTO P [ ] {\nGroup { children USE A } }\nP {}",
                    3, "USE of 'A'"},
                   ModelFormat::vrml);
    expect_refused({"use of inner", kHeader + "PROTO P [ ] { DEF A Group { } }\nUSE A", 3, "USE of 'A'"},
                   ModelFormat::vrml);
    const auto hidden = read_among("PROTO P [ ] { PROTO Q [ ] { " + kCubeOf2 + "} Q { } }\nP { }\nQ { }");
    ASSERT_TRUE(is_read(hidden));
    EXPECT_EQ(hidden->mesh.triangles.size(), 12U);
    ASSERT_EQ(hidden->warnings.size(), 1U);
    EXPECT_EQ(hidden->warnings[0].message(), "part.wrl:4: warning: the unknown node 'Q' was skipped");
}

TEST(VrmlPrototypes, InlineAndExternalPrototypesReadTheModelsOtherFiles) {
    const Files files = {
        {"bolt.wrl", kHeader + "DEF A " + kCubeOf2 + "Transform { translation 0 0 5 children USE A }"},
        {"lib.wrl", "\xEF\xBB\xBF" + kHeader +
                        "PROTO Nut [ field SFVec3f s 1 1 1 ] { Shape { geometry Box { size IS s } } }\n"
                        "PROTO Bar [ ] { Nut { s 1 1 7 } }\n" +
                        kCubeOf2},
        {"bare.wrl", kCubeOf2},
        {"deep.wrl", kHeader + "Inline { url \"bolt.wrl\" }"},
    };
    const auto model = read_among(
        "EXTERNPROTO Nut [ field SFVec3f s ] [ \"gone.wrl#Nut\" \"lib.wrl#Nut\" ]\n"
        "EXTERNPROTO First [ ] \"lib.wrl\"\nEXTERNPROTO Bar [ ] \"lib.wrl#Bar\"\n"
        "PROTO Part [ field MFString file [ ] ] { Inline { url IS file } }\n"
        "Nut { s 2 2 2 } First { } Bar { }\n"
        "Inline { url [ \"gone.wrl\" \"bolt.wrl\" ] bboxSize 1 1 1 }\n"
        "Part { file \"deep.wrl\" } Part { }\nInline { url \"bare.wrl\" } Inline { }\n"
        "Switch { choice Inline { url \"gone.wrl\" } }",
        files);
    ASSERT_TRUE(is_read(model));
    EXPECT_NEAR(volume_mm3(model->mesh), 8 + 1 + 7 + 16 + 16 + 8, 1e-9);
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_EQ(model->warnings[0].message(),
              "bare.wrl:1: warning: no '#VRML V2.0 utf8' at the start: read all the same");
}

TEST(VrmlPrototypes, SkipsWhatAnExternalPrototypeDoesNotFind) {
    const auto model =
        read_among("EXTERNPROTO Far [ field SFInt32 a exposedField SFNode b ] \"urn:x#Far\"\n" + kCubeOf2 +
                   "\nFar { a 1 b " + kCubeOf2 + "} Group { children Far { } }");
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 12U);
    ASSERT_EQ(model->warnings.size(), 1U);
    EXPECT_EQ(model->warnings[0].message(),
              "part.wrl:4: warning: the node 'Far' was skipped: the file of its EXTERNPROTO is not there");
}

TEST(VrmlPrototypes, FilesThatCannotBeReadAreRefusedWhereTheyWouldBeSeen) {
    std::string chain = "Inline { url \"f0.wrl\" }";
    Files files = {{"old.wrl", "#VRML V1.0 ascii\n"},
                   {"broken.wrl", kHeader + "\nGroup { children [ 1"},
                   {"me.wrl", kHeader + "\n Inline { url \"part.wrl\" }"},
                   {"a.wrl", kHeader + "Inline { url \"b.wrl\" }"},
                   {"b.wrl", kHeader + "Inline { url \"a.wrl\" }"},
                   {"lib.wrl", kHeader + "PROTO Nut [ ] { Group { } }"}};
    for (int i = 0; i < 12; ++i) {
        files["f" + std::to_string(i) + ".wrl"] =
            kHeader + (i < 11 ? "Inline { url \"f" + std::to_string(i + 1) + ".wrl\" }" : kCubeOf2);
    }
    struct Row {
        std::string body;
        const char* message;
    };
    const Row rows[] = {
        {kCubeOf2 + "\n  Inline { url \"gone.wrl\" }",
         "part.wrl:3:16: error: the file 'gone.wrl' is not read: there is no such file; put the file beside "
         "the "
         "model, or export the model as one file"},
        {"Inline { url \"part.wrl\" }",
         "part.wrl:2:14: error: the file 'part.wrl' names itself, directly or through others; break the "
         "circle"},
        {"Inline { url \"me.wrl\" }",
         "me.wrl:3:15: error: the file 'part.wrl' names itself, directly or through others; break the "
         "circle"},
        {"Inline { url \"a.wrl\" }",
         "b.wrl:2:14: error: the file 'a.wrl' names itself, directly or through others; break the circle"},
        {"Inline { url \"old.wrl\" }", "old.wrl:1:1: error: a VRML 1.0 file; convert it to VRML 2.0"},
        {"Inline { url \"broken.wrl\" }",
         "broken.wrl:3:21: error: the file ends where a value of the field 'children' is due; the file is "
         "cut short"},
        {chain, "f7.wrl:2:14: error: files name each other more than 8 deep; export the model as one file"},
    };
    for (const Row& row : rows) {
        const auto model = read_among(row.body, files);
        ASSERT_FALSE(model.has_value()) << row.body;
        EXPECT_EQ(model.error().text(), row.message);
        // Nobody looks at it: no matter.
        EXPECT_TRUE(is_read(read_among("Switch { choice [ " + row.body + "] }" + kCubeOf2, files)));
    }
    const auto alone = read_model(kHeader + "Inline { url \"a.wrl\" }", {.source_name = "part.wrl"});
    ASSERT_FALSE(alone.has_value());
    EXPECT_NE(alone.error().cause.find("without its folder"), std::string::npos);
}

TEST(VrmlPrototypes, EachFileIsAskedForOnceFromEachFile) {
    int asked = 0;
    ModelOptions options;
    options.source_name = "part.wrl";
    options.neighbours = [&](std::string_view, const std::string& from,
                             std::uint64_t) -> Result<ModelNeighbour> {
        ++asked;
        EXPECT_EQ(from, "part.wrl");
        return ModelNeighbour{"box.wrl", kHeader + kCubeOf2};
    };
    std::string body = kHeader;
    for (int i = 0; i < 100; ++i) body += "Inline { url \"box.wrl\" }\n";
    const auto model = read_model(body, options);
    ASSERT_TRUE(is_read(model));
    EXPECT_EQ(model->mesh.triangles.size(), 1200U);
    EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace tribo::readers
