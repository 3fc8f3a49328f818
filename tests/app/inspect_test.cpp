// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/run/program.hpp"
#include "places.hpp"

namespace tribo::test {
namespace {

using Json = nlohmann::json;

const std::string kExamples = std::string(TRIBO_SOURCE_DIR) + "/examples/";

TEST(Inspect, says_what_the_examples_hold) {
    const Outcome plate = run_tribo({"inspect", kExamples + "plate/plate.nc", "--json"});
    ASSERT_EQ(plate.code, 0) << plate.err;
    const Json program = Json::parse(plate.out);
    for (const char* key :
         {"schema", "kind", "moves", "path_mm", "rapid_mm", "bounds_mm", "tools", "rotary", "warnings"}) {
        EXPECT_TRUE(program.contains(key)) << key;
    }
    const Outcome bowl = run_tribo({"inspect", "bowl/bowl.toml", "--json"}, kExamples);
    ASSERT_EQ(bowl.code, 0) << bowl.err;
    const Json job = Json::parse(bowl.out);
    EXPECT_EQ(job["kind"], "job");
    EXPECT_GT(job["program"]["path_mm"].get<double>(), 1000);
    EXPECT_EQ(job["part"]["kind"], "model");
    const Outcome surface = run_tribo({"inspect", kExamples + "bowl/bowl.wrl"});
    ASSERT_EQ(surface.code, 0) << surface.err;
    EXPECT_NE(surface.out.find("triangles"), std::string::npos);
}

TEST(Inspect, points_at_the_line_that_is_wrong) {
    const Scratch scratch;
    scratch.put("p.ngc", "G21\nG0 X0 Y0 Z0\nG1 X1 F100 Q\n");
    const Outcome program = run_tribo({"inspect", "p.ngc"}, scratch.path());
    EXPECT_EQ(program.code, 2);
    EXPECT_TRUE(program.err.starts_with("p.ngc:3:")) << program.err;
    scratch.put("j.toml", "[stock]\nbox_mmm = 3\n");
    const Outcome job = run_tribo({"inspect", "j.toml"}, scratch.path());
    EXPECT_EQ(job.code, 2);
    EXPECT_EQ(job.err, "j.toml:2:1: error: unknown key 'box_mmm' in [stock]; try 'box_mm'\n");
    scratch.put("x.dat", "dear diary");
    EXPECT_EQ(run_tribo({"inspect", "x.dat"}, scratch.path()).code, 2);
    scratch.put("empty.stl", "");
    EXPECT_EQ(run_tribo({"inspect", "empty.stl"}, scratch.path()).code, 2);
}

TEST(Inspect, fits_the_modes_of_a_frequency_response) {
    const Scratch scratch;
    // 100 Hz, damping 5 %, 200 N/mm, from 1 to 200 Hz.
    std::string csv = "frequency_hz,re_mm_per_n,im_mm_per_n\n", flat = csv;
    for (int hz = 1; hz <= 200; ++hz) {
        const double r = hz / 100.0, re = 1 - r * r, im = 0.1 * r, size = 200 * (re * re + im * im);
        csv += std::to_string(hz) + "," + std::to_string(re / size) + "," + std::to_string(-im / size) + "\n";
        flat += std::to_string(hz) + ",0.001,0\n";
    }
    scratch.put("tap.csv", csv);
    scratch.put("flat.csv", flat);
    const Outcome tap = run_tribo({"inspect", "tap.csv", "--json"}, scratch.path());
    ASSERT_EQ(tap.code, 0) << tap.err;
    const Json response = Json::parse(tap.out);
    EXPECT_EQ(response["kind"], "frequency response");
    EXPECT_EQ(response["points"], 200);
    ASSERT_EQ(response["modes"].size(), 1u);
    EXPECT_NEAR(response["modes"][0]["frequency_hz"], 100, 1e-2);
    EXPECT_NEAR(response["modes"][0]["damping_ratio"], 0.05, 1e-4);
    EXPECT_NEAR(response["modes"][0]["stiffness_n_per_mm"], 200, 0.2);
    EXPECT_LT(response["residual"], 1e-3);
    const Outcome text = run_tribo({"inspect", "tap.csv"}, scratch.path());
    EXPECT_NE(text.out.find("mode      100 Hz, damping 5 %, 200 N/mm"), std::string::npos) << text.out;
    const Outcome none = run_tribo({"inspect", "flat.csv"}, scratch.path());
    EXPECT_EQ(none.code, 0) << none.err;
    EXPECT_NE(none.out.find("flat.csv:1: warning: no mode stands out"), std::string::npos) << none.out;
}

TEST(Inspect, shows_all_refusals_at_once) {
    const Scratch scratch;
    scratch.put("p.ngc", "G21\nG0 X0 Y0 Z0\nG888 I5\nG1 X1 F100\nG999\nG1 R5\n");
    const Outcome program = run_tribo({"inspect", "p.ngc", "--json"}, scratch.path());
    EXPECT_EQ(program.code, 2);
    EXPECT_EQ(program.out, "");
    for (const char* place : {"p.ngc:3:1: error: ", "p.ngc:5:1: error: ", "p.ngc:6:4: error: "}) {
        EXPECT_NE(program.err.find(place), std::string::npos) << program.err;
    }
    // A missing feed is no fault of the program, and hides none.
    scratch.put("q.ngc", "G21\nG0 X0 Y0 Z0\nG1 X1\nG888 I5\n");
    const Outcome other = run_tribo({"inspect", "q.ngc"}, scratch.path());
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.err.find("q.ngc:4:1: error: "), std::string::npos) << other.err;
    EXPECT_EQ(other.err.find("before any F"), std::string::npos) << other.err;
}

TEST(Inspect, reads_a_program_without_a_feed_and_says_so) {
    const Scratch scratch;
    scratch.put("p.ngc", "G21\nM3 S1\nG0 X0 Y0 Z0\nG1 X10\n");
    const Outcome outcome = run_tribo({"inspect", "p.ngc"}, scratch.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("p.ngc:4: warning: no feed"), std::string::npos) << outcome.out;
}

TEST(Inspect, draws_what_it_found) {
    const Scratch scratch;
    for (const char* file : {"plate/plate.nc", "bowl/bowl.wrl", "bowl/bowl.toml"}) {
        const Outcome outcome = run_tribo({"inspect", kExamples + file, "--picture", scratch / "p.png"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const std::string png = scratch.get("p.png");
        EXPECT_TRUE(png.starts_with("\x89PNG")) << file;
        EXPECT_GT(png.size(), 5000u) << file;
    }
    const Outcome refused = run_tribo({"inspect", kExamples + "plate/plate.nc", "--picture", "/dev/full"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.err.find("No space left"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace tribo::test
