// SPDX-License-Identifier: MIT
// The part's mesh as others take it: from the file, closed, nowhere through itself, and as stock again.
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "app/run/job_folder.hpp"
#include "app/run/program.hpp"
#include "field/self_intersection.hpp"
#include "files/model/model_file.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

const std::string kMeshExamples = std::string(TRIBO_SOURCE_DIR) + "/examples/";

TEST(PartMesh, of_every_example_is_closed_and_does_not_meet_itself) {
    for (const std::string name : {"blade", "bowl", "bracket", "dome", "plate", "rose"}) {
        const Scratch scratch;
        const Outcome run = run_tribo({"render", kMeshExamples + name + "/" + name + ".toml", "--out",
                                       scratch / "out", "--only", "mesh", "--resolution", "0.4"});
        ASSERT_EQ(run.code, 0) << run.err;
        const auto model = files::read_model_file({scratch / "out/machined.stl", {}});
        ASSERT_TRUE(model.has_value());
        EXPECT_TRUE(is_closed(model->mesh)) << name;
        EXPECT_TRUE(SelfIntersections(model->mesh).pairs().empty()) << name;
        const Outcome said = run_tribo({"inspect", scratch / "out/machined.stl", "--json"});
        EXPECT_NE(said.out.find("\"closed\": true"), std::string::npos) << said.out;
        EXPECT_NE(said.out.find("\"warnings\": []"), std::string::npos) << said.out;
    }
}

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The part is the design of the job that mills it: what deviates is the mesh. Cusps of the rose end anywhere
// in their cells. At the foot of the dome a wall, a crest and a floor share cells.
TEST(PartMesh, deviates_from_the_part_by_less_than_20_um_on_coarse_grids) {
    struct Case {
        std::string name, cell;
    };
    for (const Case& c : {Case{"rose", "0.4"}, {"rose", "0.2"}, {"dome", "0.4"}}) {
        const JobFolder folder;
        const std::string example = kMeshExamples + c.name + "/" + c.name;
        folder.put(c.name + ".nc", text_of(example + ".nc"));
        folder.put("job.toml", text_of(example + ".toml"));
        ASSERT_EQ(folder.render({"--only", "mesh", "--resolution", c.cell}).code, 0) << c.name;
        folder.put("own.stl", folder.get("machined.stl"));
        folder.put("job.toml", text_of(example + ".toml") + "\n[part]\nsurface = \"own.stl\"\n");
        const Outcome run = folder.render({"--only", "summary", "--resolution", c.cell});
        ASSERT_EQ(run.code, 0) << run.err;
        const nlohmann::json summary = folder.summary();
        EXPECT_LT(summary["gouge_max_mm"].get<double>(), 0.02) << c.name << " " << c.cell;
        EXPECT_LT(summary["rest_max_mm"].get<double>(), 0.02) << c.name << " " << c.cell;
    }
}

TEST(PartMesh, is_stock_for_the_next_job) {
    const Scratch scratch;
    const auto job = [&](const std::string& name, const std::string& stock, const std::string& y) {
        std::ofstream(scratch / (name + ".nc")) << "G21 G90 S6000 M3\nG0 X-10 Y" + y + " Z-5\nG1 X70 F800\n";
        std::ofstream(scratch / (name + ".toml"))
            << "[stock]\n" + stock +
                   "\n[cutter]\nkind = \"ball\"\ndiameter_mm = 10\nlength_mm = 20\n"
                   "[material]\nname = \"al7075-t6\"\n[path]\ngcode = \"" +
                   name + ".nc\"\n";
        const Outcome run = run_tribo({"render", scratch / (name + ".toml"), "--out", scratch / name,
                                       "--only", "mesh", "--resolution", "0.5"});
        EXPECT_EQ(run.code, 0) << run.err;
        const auto model = files::read_model_file({scratch / (name + "/machined.stl"), {}});
        EXPECT_TRUE(model.has_value());
        return model ? model->mesh : TriangleMesh{};
    };
    const TriangleMesh first = job("first", "box_mm = [[0, 0, -20], [60, 60, 0]]", "30");
    const double groove = 60 * 60 * 20 - volume_mm3(first);
    for (const std::string kind : {"stl", "glb"}) {
        const TriangleMesh second = job(kind, "mesh = \"first/machined." + kind + "\"", "12");
        EXPECT_TRUE(is_closed(second)) << kind;
        EXPECT_TRUE(SelfIntersections(second).pairs().empty()) << kind;
        // A second groove, as long and as deep as the first.
        EXPECT_NEAR(volume_mm3(second), 60 * 60 * 20 - 2 * groove, 2e-3 * groove) << kind;
    }
}

}  // namespace
}  // namespace tribo::test
