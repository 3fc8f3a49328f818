// SPDX-License-Identifier: MIT
// `tribo compare` from outside: numbers, files, exit codes, refusals.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/run/benchmark_slot.hpp"
#include "app/run/program.hpp"

namespace tribo::test {
namespace {

constexpr const char* kSlot = "G21 G90 M3 S8000 F1600\nG0 X-8 Y20 Z5\nZ-1\nG1 X20\nX48\nG0 Z5\nM30\n";
constexpr const char* kFaster = "G21 G90 M3 S8000 F3200\nG0 X-8 Y20 Z5\nZ-1\nG1 X20\nX48\nG0 Z5\nM30\n";
constexpr const char* kDeeper = "G21 G90 M3 S8000 F1600\nG0 X-8 Y20 Z5\nZ-1.5\nG1 X20\nX48\nG0 Z5\nM30\n";
// The same slot cut from the other side, in one line.
constexpr const char* kBack = "G21 G90 M3 S8000 F1600\nG0 X48 Y20 Z5\nZ-1\nG1 X-8\nG0 Z5\nM30\n";
// The preparation of a measured head takes longer than the cut.
constexpr const char* kNoHead = "[sound]\nmode = \"pan\"\n";
constexpr double kWidthMm = 10, kLengthMm = 40;

class CompareVerb : public testing::Test {
  protected:
    void put(const std::string& name, const std::string& program, const std::string& more = "") const {
        scratch.put(name + ".nc", program);
        std::string job = kBenchmarkSlot;
        job.replace(job.find("slot.nc"), 7, name + ".nc");
        scratch.put(name + ".toml", job + more + kNoHead);
    }
    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "compare");
        return run_tribo(arguments, scratch.path());
    }
    nlohmann::json compare(const std::string& a, const std::string& b) const {
        std::vector<std::string> arguments{a, b, "--out", "out"};
        if (a.ends_with(".toml") || b.ends_with(".toml"))
            arguments.insert(arguments.end(), {"--resolution", "0.25"});
        const Outcome done = run(arguments);
        EXPECT_EQ(done.code, 0) << done.err;
        return nlohmann::json::parse(scratch.get("out/compare.json"), nullptr, false);
    }
    void render(const std::string& name) const {
        const Outcome done =
            run_tribo({"render", name + ".toml", "--out", name, "--resolution", "0.25"}, scratch.path());
        ASSERT_EQ(done.code, 0) << done.err;
    }
    // The cells of the CSV file whose columns begin with `prefix`.
    std::vector<std::string> cells(const std::string& prefix) const {
        std::istringstream text(scratch.get("out/compare.csv"));
        std::string line, cell;
        std::vector<std::string> names, found;
        while (std::getline(text, line)) {
            std::istringstream row(line + ",");
            for (std::size_t n = 0; std::getline(row, cell, ','); ++n) {
                if (names.size() <= n) {
                    names.push_back(cell);
                } else if (names[n].starts_with(prefix) && cell != names[n]) {
                    found.push_back(cell);
                }
            }
        }
        return found;
    }
    Scratch scratch;
};

TEST_F(CompareVerb, of_a_job_with_itself_differs_by_exactly_nothing) {
    put("a", kSlot, benchmark_mode("1, 0, 0"));
    const auto json = compare("a.toml", "a.toml");
    EXPECT_GT(json["difference"].size(), 10u);
    for (const auto& [key, value] : json["difference"].items()) EXPECT_EQ(value, 0) << key;
    EXPECT_TRUE(json["largest"].empty());
    EXPECT_EQ(json["part"]["only_a_mm3"], 0);
    EXPECT_EQ(json["part"]["only_b_mm3"], 0);
    EXPECT_FALSE(json["part"].contains("b_leaves_more"));
    EXPECT_FALSE(json["part"].contains("b_cuts_deeper"));
    EXPECT_TRUE(json["set_up"].empty());
    EXPECT_EQ(json["joined"]["by"], "line");
    EXPECT_GT(json["a"]["multiplier_max"], 0);
    const auto differences = cells("difference_");
    EXPECT_GE(differences.size(), 18u);
    for (const std::string& cell : differences) EXPECT_EQ(cell, "0");
}

TEST_F(CompareVerb, of_render_folders_with_themselves_differs_by_exactly_nothing) {
    put("a", kSlot);
    render("a");
    const auto json = compare("a", "a");
    EXPECT_GT(json["difference"].size(), 8u);
    for (const auto& [key, value] : json["difference"].items()) EXPECT_EQ(value, 0) << key;
    EXPECT_EQ(json["part"]["only_a_mm3"], 0);
    EXPECT_FALSE(json["part"].contains("b_leaves_more"));
    EXPECT_FALSE(json["part"].contains("b_cuts_deeper"));
    EXPECT_EQ(json["a"]["kind"], "render folder");
    for (const std::string& cell : cells("difference_")) EXPECT_TRUE(cell == "0" || cell.empty()) << cell;
}

TEST_F(CompareVerb, of_another_feed_is_of_time_and_force_and_of_no_part) {
    put("a", kSlot);
    put("b", kFaster);
    const auto json = compare("a.toml", "b.toml");
    EXPECT_EQ(json["joined"]["by"], "line");
    EXPECT_EQ(json["joined"]["rows"], 2);
    EXPECT_EQ(json["difference"]["removed_mm3"], 0);
    EXPECT_EQ(json["part"]["only_a_mm3"], 0);
    EXPECT_NEAR(json["b"]["cutting_s"].get<double>(), 0.5 * json["a"]["cutting_s"].get<double>(), 1e-6);
    // Without edge coefficients force is in proportion to the feed.
    EXPECT_NEAR(json["b"]["peak_force_n"].get<double>(), 2 * json["a"]["peak_force_n"].get<double>(),
                1e-3 * json["b"]["peak_force_n"].get<double>());
    EXPECT_EQ(json["largest"][0]["quantity"], "peak_fxy_n");
    for (const char* file : {"compare.html", "compare.csv", "sound_a.wav", "sound_b.wav"})
        EXPECT_TRUE(std::filesystem::exists(scratch.path() + "/out/" + file)) << file;
}

TEST_F(CompareVerb, of_another_depth_names_volume_and_place_of_the_parts) {
    put("a", kSlot);
    put("b", kDeeper);
    const auto json = compare("a.toml", "b.toml");
    const double mm3 = 0.5 * kWidthMm * kLengthMm;
    EXPECT_NEAR(json["part"]["only_a_mm3"].get<double>(), mm3, 0.01 * mm3);
    EXPECT_EQ(json["part"]["only_b_mm3"], 0);
    EXPECT_NEAR(json["difference"]["removed_mm3"].get<double>(), mm3, 0.01 * mm3);
    const auto& deeper = json["part"]["b_cuts_deeper"];
    EXPECT_NEAR(deeper["mm"].get<double>(), -0.5, 1e-5);
    EXPECT_NEAR(deeper["on_b_mm"][2].get<double>(), -1.5, 1e-5);
    EXPECT_TRUE(deeper["line_b"] == 4 || deeper["line_b"] == 5);
    EXPECT_EQ(json["set_up"].size(), 1u);
    EXPECT_EQ(json["set_up"][0], "The paths of the moves differ.");
}

TEST_F(CompareVerb, joins_another_order_by_volume_and_finds_the_same_part) {
    put("a", kSlot);
    put("b", kBack);
    const auto json = compare("a.toml", "b.toml");
    EXPECT_EQ(json["joined"]["by"], "removed volume");
    EXPECT_LT(json["part"]["only_a_mm3"].get<double>(), 0.01);
    EXPECT_LT(json["part"]["only_b_mm3"].get<double>(), 0.01);
}

TEST_F(CompareVerb, takes_a_job_and_its_render_as_the_same) {
    put("a", kSlot);
    render("a");
    const auto json = compare("a.toml", "a");
    EXPECT_NEAR(json["difference"]["peak_force_n"].get<double>(), 0, 1e-9);
    EXPECT_NEAR(json["difference"]["removed_mm3"].get<double>(), 0, 1e-9);
    // Along edges the mesh fills other shares of the cells than the exact part.
    const double least = 1e-4 * json["a"]["remaining_mm3"].get<double>();
    EXPECT_LT(json["part"]["only_a_mm3"].get<double>(), least);
    EXPECT_LT(json["part"]["only_b_mm3"].get<double>(), least);
    // The folder holds a mesh of single precision, and forces with five decimals.
    for (const char* side : {"b_cuts_deeper", "b_leaves_more"}) {
        const double mm = json["part"].contains(side) ? json["part"][side]["mm"].get<double>() : 0;
        EXPECT_LT(std::abs(mm), 1e-4) << side;
    }
    for (const auto& largest : json["largest"])
        EXPECT_LT(std::abs(largest["difference"].get<double>()), 1e-2) << largest;
}

TEST_F(CompareVerb, says_what_a_folder_lacks_and_compares_the_rest) {
    put("a", kSlot);
    put("b", kFaster);
    render("a");
    render("b");
    std::filesystem::remove(scratch.path() + "/b/machined.stl");
    std::filesystem::remove(scratch.path() + "/b/machined.glb");
    std::filesystem::remove(scratch.path() + "/b/sound.wav");
    const auto json = compare("a", "b");
    EXPECT_FALSE(json.contains("part"));
    EXPECT_LT(json["difference"]["cutting_s"].get<double>(), 0);
    const std::string lacks = json["b"]["missing"].dump();
    EXPECT_NE(lacks.find("no machined.stl"), std::string::npos) << lacks;
    EXPECT_NE(lacks.find("no sound.wav"), std::string::npos) << lacks;
    EXPECT_NE(scratch.get("out/compare.html").find("no sound.wav"), std::string::npos);
}

TEST_F(CompareVerb, refuses_what_it_cannot_compare_with_a_remedy) {
    put("a", kSlot);
    put("b", kBack);
    std::filesystem::create_directory(scratch.path() + "/empty");
    const auto refuses = [&](std::vector<std::string> arguments, const std::string& text) {
        const Outcome refused = run(std::move(arguments));
        EXPECT_EQ(refused.code, 2) << refused.err;
        EXPECT_NE(refused.err.find(text), std::string::npos) << refused.err;
        EXPECT_FALSE(std::filesystem::exists(scratch.path() + "/out"));
    };
    refuses({"a.toml", "empty", "--out", "out"},
            "empty: error: is no folder that tribo render wrote; name a");
    refuses({"a.toml", "none.toml", "--out", "out"}, "none.toml");
    refuses({"a.toml", "b.toml", "--out", "out", "--tool", "flat 6"}, "--tool belongs to a program");
    refuses({"a.toml", "b.toml", "--out", "out", "--by", "line"}, "do not cut in the same lines");
    refuses({"a.toml", "b.toml", "--out", "out", "--by", "angle"}, "--by");
    refuses({"a.toml", "--out", "out"}, "B");
    refuses({"a.nc", "b.nc", "--out", "out", "--job-out", "j.toml"}, "--job-out does not say");
    render("a");
    refuses({"a", "a", "--out", "out", "--resolution", "0.2"}, "--resolution is for a run that is milled");
    refuses({"a", "b.toml", "--out", "a"}, "a: error: a run is read from this folder");
    EXPECT_TRUE(std::filesystem::exists(scratch.path() + "/a/summary.json"));
    scratch.put("a/forces.csv", "t_s,line\n0,1\n");
    refuses({"a", "b.toml", "--out", "out"}, "a/forces.csv:1");
    scratch.put("a/summary.json", "{");
    refuses({"a", "b.toml", "--out", "out"}, "a/summary.json: error: is no summary of a render");
}

TEST_F(CompareVerb, gives_the_flags_of_a_program_to_the_one_that_is_a_program) {
    put("a", kSlot);
    const Outcome done = run({"a.toml", "a.nc", "--out", "out", "--resolution", "0.25", "--tool", "flat 10",
                              "--stock", "0 0 -10 40 40 0", "--json"});
    ASSERT_EQ(done.code, 0) << done.err;
    const auto json = nlohmann::json::parse(done.out, nullptr, false);
    EXPECT_EQ(json["b"]["kind"], "program");
    EXPECT_NEAR(json["difference"]["removed_mm3"].get<double>(), 0, 1e-6);
}

}  // namespace
}  // namespace tribo::test
