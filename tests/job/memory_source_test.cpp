// SPDX-License-Identifier: MIT
// Files as a page drops them: found without their folders, refused with words for the one who drops them.
#include "job/memory_source.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "job/loader.hpp"

namespace tribo::job {
namespace {

constexpr const char* kNotHere =
    ": error: the file is not here; drop it into the window together with the file that names it";

TEST(MemorySource, finds_a_file_by_its_whole_name_or_by_the_only_one_of_its_last_name) {
    MemorySource files;
    files.put("bowl/bowl.csv", "a");
    files.put("plate.nc", "b");
    EXPECT_EQ(files.read("bowl/bowl.csv", 10).value(), "a");
    EXPECT_EQ(files.read("bowl.csv", 10).value(), "a");
    EXPECT_EQ(files.read("programs/plate.nc", 10).value(), "b");
    EXPECT_EQ(files.read("late.nc", 10).error().text(), std::string("late.nc") + kNotHere);
    // Two of a name: neither is guessed, the whole name still counts.
    files.put("other/bowl.csv", "c");
    EXPECT_EQ(files.read("bowl.csv", 10).error().text(), std::string("bowl.csv") + kNotHere);
    EXPECT_EQ(files.read("other/bowl.csv", 10).value(), "c");
    files.put("other/bowl.csv", "d");
    EXPECT_EQ(files.read("other/bowl.csv", 10).value(), "d");
    files.clear();
    EXPECT_FALSE(files.read("plate.nc", 10));
}

TEST(MemorySource, tells_a_tool_library_from_other_files) {
    for (const auto& [name, text] : {std::pair{"mill.tbl", "T1 P1 D6\n"},
                                     {"a/My.JSON", "{\"data\":[]}"},
                                     {"bit.fctb", "{}"},
                                     {"shop.xml", "<a/>"},
                                     {"t.tools", "PK"},
                                     {"tools.csv", "number,diameter_mm\n1,6\n"},
                                     {"hsm.csv", "Number (tool_number),Diameter (tool_diameter)\n"}}) {
        MemorySource files;
        files.put("part.nc", "G21\n");
        files.put("path.csv", "x,y,z,i,j,k\n");
        files.put("job.toml", "[path]\n");
        EXPECT_EQ(files.tool_table(), "") << name;
        files.put(name, text);
        EXPECT_EQ(files.tool_table(), name);
    }
}

TEST(MemorySource, gives_a_program_the_tools_of_its_library) {
    MemorySource files;
    files.put("p.nc", "G21 G90 T2 M6\nS1000 M3 F100\nG0 X0 Y0 Z5\nG1 Z-1\nX10\nM30\n");
    files.put("mill.tbl", "T1 P1 D3\nT2 P2 D7.5\n");
    LoadOptions options;
    options.program.tool_table = files.tool_table();
    const auto loaded = load_job(files, "p.nc", options);
    ASSERT_TRUE(loaded) << loaded.error().text();
    ASSERT_EQ(loaded->job.cutters.size(), 1U);
    EXPECT_EQ(loaded->job.cutters[0].number, 2);
    EXPECT_EQ(loaded->job.cutters[0].diameter_mm, 7.5);
}

TEST(MemorySource, refuses_what_is_longer_than_its_kind_may_be) {
    MemorySource files;
    files.put("a.toml", "12345");
    EXPECT_EQ(files.read("a.toml", 5).value(), "12345");
    EXPECT_EQ(files.read("a.toml", 4).error().text(),
              "a.toml: error: is longer than the 4 bytes that this kind of file may have; check that it is "
              "the right one");
}

TEST(MemorySource, reads_models_with_their_neighbours) {
    MemorySource files;
    files.put("m/main.wrl", "#VRML V2.0 utf8\nInline { url \"part.wrl\" }\n");
    EXPECT_EQ(files.read_model({"m/main.wrl", {}}).error().text(),
              "m/main.wrl:2:14: error: the file 'part.wrl' is not read: the file is not here; put the file "
              "beside the model, or export the model as one file");
    files.put(
        "m/part.wrl",
        "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 "
        "0] } coordIndex [0 1 2 -1] } }\n");
    const auto model = files.read_model({"m/main.wrl", 2});
    ASSERT_TRUE(model) << model.error().text();
    ASSERT_EQ(model->mesh.triangles.size(), 1u);
    EXPECT_EQ(model->mesh.positions[1][0], 2.0F);
}

TEST(MemorySource, refuses_what_a_page_does_not_read) {
    MemorySource files;
    files.put("a.gltf", "{\"asset\": {\"version\": \"2.0\"}}");
    EXPECT_EQ(files.read_model({"a.gltf", {}}).error().text(),
              "a.gltf: error: glTF models are not read in the page; save it as STL, OBJ, PLY or VRML, or use "
              "the program");
    EXPECT_EQ(files.read_model({"b.stl", {}}).error().text(), std::string("b.stl") + kNotHere);
    EXPECT_EQ(files.stock_source("first.toml")->job, "first.toml");
    EXPECT_EQ(files.stock_source("out").error().text(),
              "error: a page takes the stock from a job alone, not from 'out'; name the earlier job (.toml) "
              "and drop it too, or use the program");
}

}  // namespace
}  // namespace tribo::job
