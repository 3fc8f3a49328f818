// SPDX-License-Identifier: MIT
#include "report/facts.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "field/mesh/mesh_parts.hpp"
#include "job/memory_source.hpp"
#include "job/program_file.hpp"
#include "job/toml/job_toml.hpp"

namespace tribo::report {
namespace {

using Json = nlohmann::json;

Facts of_program(const char* text) {
    const auto program = job::parse_program(text, "p.ngc", job::PathKind::gcode);
    EXPECT_TRUE(program) << program.error().text();
    motion::ProgramMeter meter;
    for (const motion::Move& move : program->moves) meter.add(move);
    return describe(*program, meter, job::PathKind::gcode);
}

TEST(Facts, of_a_program_have_the_promised_keys) {
    // A quarter circle of radius 10 at feed after a rapid of 5; the arc bulges to x = 10.
    const Facts facts = of_program("G21 G90\nT2 M6\nM3 S5000\nG0 X0 Y-10 Z5\nG0 Z0\nG3 X10 Y0 I0 J10 F600\n");
    const Json json = Json::parse(facts.json);
    EXPECT_EQ(json["schema"], "tribo.inspect/1");
    EXPECT_EQ(json["kind"], "program");
    EXPECT_EQ(json["moves"], 2);
    EXPECT_NEAR(json["path_mm"].get<double>(), 15.707963267948966, 1e-9);
    EXPECT_NEAR(json["rapid_mm"].get<double>(), 5, 1e-12);
    const double expected[2][3] = {{0, -10, 0}, {10, 0, 0}};
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(json["bounds_mm"][i][k].get<double>(), expected[i][k], 1e-9);
        }
    }
    EXPECT_EQ(json["tools"], Json::parse("[2]"));
    EXPECT_EQ(json["rotary"], false);
    EXPECT_EQ(json["dialect"], "LinuxCNC");
    EXPECT_TRUE(json["warnings"].is_array());
    const std::string text = aligned(facts.lines);
    EXPECT_NE(text.find("path     15.708 mm at feed, 5 mm rapid"), std::string::npos) << text;
}

TEST(Facts, of_a_program_with_rotary_words_warn) {
    const Json json = Json::parse(of_program("G21\nM3 S1\nG0 X0 Y0 Z0\nG1 X1 A5 F100\n").json);
    EXPECT_EQ(json["rotary"], true);
    EXPECT_NE(json["warnings"].dump().find("without a machine"), std::string::npos);
}

TEST(Facts, of_a_model_have_the_promised_keys) {
    readers::Model cube;  // of edge 2
    for (int i = 0; i < 8; ++i) {
        cube.mesh.positions.push_back({i & 1 ? 2.0F : 0, i & 2 ? 2.0F : 0, i & 4 ? 2.0F : 0});
    }
    cube.mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                           {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    cube.warnings = {{"c.stl", 0, "odd"}};
    const Json json = Json::parse(describe(cube).json);
    EXPECT_EQ(json["kind"], "model");
    EXPECT_EQ(json["triangles"], 12);
    EXPECT_EQ(json["area_mm2"], 24.0);
    EXPECT_EQ(json["bounds_mm"], Json::parse("[[0.0,0.0,0.0],[2.0,2.0,2.0]]"));
    EXPECT_EQ(json["closed"], true);
    EXPECT_EQ(json["volume_mm3"], 8.0);
    EXPECT_EQ(json["pieces"], 1);
    EXPECT_EQ(json["warnings"], Json::parse("[\"c.stl: warning: odd\"]"));
    readers::Model twice = cube;  // the second one half within the first
    field::append(twice.mesh, cube.mesh);
    for (std::size_t i = 8; i < 16; ++i) twice.mesh.positions[i][0] += 1;
    const Facts once = describe(twice);
    EXPECT_NEAR(Json::parse(once.json)["volume_mm3"].get<double>(), 12, 1e-9);
    EXPECT_NE(aligned(once.lines).find("each place counts once"), std::string::npos);
    for (Triangle& t : cube.mesh.triangles) std::swap(t[1], t[2]);
    const Facts turned = describe(cube);
    EXPECT_EQ(Json::parse(turned.json)["volume_mm3"], -8.0);
    EXPECT_NE(turned.json.find("inside out"), std::string::npos);
    cube.mesh.triangles.pop_back();
    const Facts open = describe(cube);
    const Json json_open = Json::parse(open.json);
    EXPECT_EQ(json_open["closed"], false);
    EXPECT_EQ(json_open["holes"], 1);
    EXPECT_EQ(json_open["open_edges"], 3);
    EXPECT_FALSE(json_open.contains("volume_mm3"));
    EXPECT_NE(aligned(open.lines).find("closed     no: 1 hole of 3 edges"), std::string::npos);
}

TEST(Facts, of_a_model_guess_at_a_wrong_unit) {
    readers::Model model;
    const auto warning_at = [&](float size) {
        model.mesh.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        model.mesh.triangles = {{0, 1, 2}};
        const Warnings warnings = describe(model).warnings;
        return warnings.empty() ? std::string() : warnings[0].text;
    };
    model.format = readers::ModelFormat::vrml;
    EXPECT_EQ(warning_at(100), "");
    EXPECT_EQ(
        warning_at(1),
        "the model is only 1.414 mm across: if its unit is not the millimetre, set unit_mm, 1000 for metres "
        "or 25.4 for inches; VRML means metres");
    EXPECT_EQ(warning_at(1e4F),
              "the model is 14.142 m across: if its unit is not the millimetre, set unit_mm");
}

TEST(Facts, of_a_job_hold_those_of_its_files) {
    const auto job = job::parse_job(
        "[stock]\nbox_mm=[[0,0,0],[1,2,3]]\n[cutter]\nkind=\"ball\"\ndiameter_mm=6\n"
        "[material]\nname=\"al7075-t6\"\n[path]\ngcode=\"p.ngc\"\n",
        "j.toml", job::MemorySource());
    ASSERT_TRUE(job) << job.error().text();
    const Facts program = of_program("G21\nM3 S1\nG0 X0 Y0 Z0\nG1 X1 F100\nG1 X2 A1\n");
    const Facts facts = describe(*job, &program, nullptr);
    const Json json = Json::parse(facts.json);
    EXPECT_EQ(json["kind"], "job");
    EXPECT_EQ(json["stock"]["box_mm"][1][2], 3.0);
    EXPECT_EQ(json["cutters"][0]["kind"], "ball");
    EXPECT_EQ(json["material"]["name"], "al7075-t6");
    EXPECT_EQ(json["program"]["moves"], 2);
    EXPECT_EQ(json["program"]["path_mm"], 2.0);
    EXPECT_FALSE(json["warnings"].empty());
    EXPECT_FALSE(json.contains("part"));
    EXPECT_FALSE(json.contains("passes"));
}

// A ball of radius 3 in passes 2 mm apart: cusps of 3 - sqrt(8).
TEST(Facts, of_a_job_tell_the_cusps_between_its_passes) {
    const auto job = job::parse_job(
        "[stock]\nbox_mm=[[0,0,0],[40,40,9]]\n[cutter]\nkind=\"ball\"\ndiameter_mm=6\n"
        "[material]\nname=\"al7075-t6\"\n[path]\ngcode=\"p.ngc\"\n",
        "j.toml", job::MemorySource());
    ASSERT_TRUE(job) << job.error().text();
    std::vector<motion::Move> moves;
    for (int n = 0; n < 10; ++n) {
        motion::Move move;
        move.start.tip_mm = {0, 2.0 * n, 5};
        move.end.tip_mm = {40, 2.0 * n, 5};
        moves.push_back(move);
    }
    const Facts facts = describe(*job, nullptr, nullptr, moves);
    const Json passes = Json::parse(facts.json)["passes"];
    EXPECT_NEAR(passes["sidestep_mm"].get<double>(), 2, 1e-9);
    EXPECT_NEAR(passes["scallop_mm"].get<double>(), 3 - std::sqrt(8.0), 1e-9);
    EXPECT_NE(
        aligned(facts.lines).find("2 mm aside over 100 % of the feed path, cusps of 0.172 mm on a plane"),
        std::string::npos)
        << aligned(facts.lines);
}

}  // namespace
}  // namespace tribo::report
