// SPDX-License-Identifier: MIT
// `tribo audit` from outside: verdict, files, exit codes, refusals.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/run/benchmark_slot.hpp"
#include "app/run/program.hpp"

namespace tribo::test {
namespace {

constexpr const char* kSlots =
    "G21 G90 M3 S8000 F1600\nG0 X-8 Y20 Z5\nZ-1\nG1 X20\nX48 F2400\nG0 Z5\nY35\nX-8\nZ-0.5\nG1 X48\nM30\n";

class AuditVerb : public testing::Test {
  protected:
    Outcome run(const std::string& more, std::vector<std::string> flags, const char* verb = "audit") const {
        scratch.put("slot.nc", program);
        scratch.put("job.toml", job + more);
        flags.insert(flags.begin(), {verb, "job.toml"});
        return run_tribo(flags, scratch.path());
    }
    // Rows of a CSV file by the name of their column.
    std::vector<std::map<std::string, std::string>> rows(const std::string& file) const {
        std::istringstream text(scratch.get(file));
        std::string line, cell;
        std::vector<std::string> names;
        std::vector<std::map<std::string, std::string>> all;
        while (std::getline(text, line)) {
            std::istringstream cells(line);
            std::vector<std::string> values;
            while (std::getline(cells, cell, ',')) values.push_back(cell);
            if (names.empty()) {
                names = values;
                continue;
            }
            std::map<std::string, std::string>& row = all.emplace_back();
            for (std::size_t n = 0; n < names.size(); ++n) row[names[n]] = values.at(n);
        }
        return all;
    }
    Scratch scratch;
    std::string program = kSlots, job = kBenchmarkSlot;
};

TEST_F(AuditVerb, writes_the_same_peaks_as_render_line_by_line) {
    ASSERT_EQ(run("", {"--out", "audit"}).code, 0);
    ASSERT_EQ(run("", {"--out", "render", "--only", "forces"}, "render").code, 0);
    std::map<std::string, double> torque, xy;
    for (auto& row : rows("render/forces.csv")) {
        torque[row["line"]] = std::max(torque[row["line"]], std::abs(std::stod(row["peak_torque_nm"])));
        xy[row["line"]] = std::max(xy[row["line"]], std::stod(row["peak_fxy_n"]));
    }
    std::size_t cutting = 0;
    for (auto& row : rows("audit/audit.csv")) {
        if (!torque.contains(row["line"])) {
            EXPECT_EQ(std::stod(row["cutting_s"]), 0) << row["line"];
            continue;
        }
        ++cutting;
        EXPECT_NEAR(std::stod(row["peak_torque_nm"]), torque[row["line"]], 1e-3 * torque[row["line"]]);
        // A straight flute without axial coefficient pushes across the axis alone.
        EXPECT_NEAR(std::stod(row["peak_force_n"]), xy[row["line"]], 1e-3 * xy[row["line"]]);
    }
    EXPECT_EQ(cutting, torque.size());
    EXPECT_EQ(cutting, 3u);
}

TEST_F(AuditVerb, says_verdict_limits_and_their_sources_in_json) {
    const Outcome outcome = run("[limits]\nforce_n = 50\n", {"--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_EQ(json["schema"], "tribo.audit/1");
    EXPECT_EQ(json["verdict"]["outcome"], "over");
    EXPECT_TRUE(json["verdict"]["sentence"].get<std::string>().starts_with("No: line 5, "));
    const auto& tool = json["tools"][0];
    EXPECT_EQ(tool["limits"]["peak_force_n"]["value"], 50);
    EXPECT_EQ(tool["limits"]["peak_force_n"]["from"], "[limits] of the job");
    EXPECT_TRUE(tool["limits"]["stress_n_per_mm2"]["rule_of_thumb"]);
    EXPECT_NE(tool["limits"]["stress_n_per_mm2"]["from"].get<std::string>().find("carbide"),
              std::string::npos);
    EXPECT_EQ(tool["peak_force_n"]["line"], 5);
    EXPECT_EQ(json["worst"][0]["line"], 5);
    EXPECT_GT(json["air_share"], 0);
}

TEST_F(AuditVerb, exits_with_4_only_if_it_is_asked_to) {
    const std::string limit = "[limits]\nforce_n = 50\n";
    EXPECT_EQ(run(limit, {}).code, 0);
    EXPECT_EQ(run(limit, {"--fail-over", "1"}).code, 4);
    EXPECT_EQ(run(limit, {"--fail-over", "5"}).code, 0);
}

TEST_F(AuditVerb, writes_a_page_with_the_text_of_the_worst_line) {
    ASSERT_EQ(run("[limits]\nforce_n = 50\n", {"--out", "audit"}).code, 0);
    const std::string page = scratch.get("audit/audit.html");
    EXPECT_NE(page.find("X48 F2400"), std::string::npos);
    EXPECT_NE(page.find("the force is too large"), std::string::npos);
    EXPECT_EQ(page.find("http"), page.find("http-equiv"));  // it loads nothing
}

TEST_F(AuditVerb, finds_chatter_where_the_tool_bends) {
    const Outcome chatters = run(benchmark_mode("1, 0, 0"), {});
    EXPECT_EQ(chatters.code, 0) << chatters.err;
    EXPECT_NE(chatters.out.find("the cut chatters"), std::string::npos) << chatters.out;
}

TEST_F(AuditVerb, holds_the_bending_of_the_tool_against_the_tolerance) {
    // Climb milling along the edge of the block: 3 mm wide, with a helix, as an edge that leaves has no chip.
    job.replace(job.find("helix_deg = 0"), 13, "helix_deg = 40");
    program = "G21 G90 M3 S8000 F1600\nG0 X48 Y-2 Z5\nZ-3\nG1 X-8\nM30\n";
    const Outcome fine = run("[limits]\ntolerance_mm = 1\n", {"--json"});
    EXPECT_EQ(fine.code, 0) << fine.err;
    EXPECT_NE(fine.err.find("bends as a beam and does not vibrate"), std::string::npos) << fine.err;
    const auto json = nlohmann::json::parse(fine.out, nullptr, false);
    const double leaves = json["bending_leaves_mm"], overcuts = json["bending_overcuts_mm"];
    const double most = std::max(leaves, overcuts);
    EXPECT_GT(most, 1e-5);
    // The tip yields at most by the deflection under the largest force.
    EXPECT_LE(most, json["tools"][0]["deflection_mm"]["value"].get<double>());
    const Outcome over = run("[limits]\ntolerance_mm = " + std::to_string(0.3 * most) + "\n", {});
    EXPECT_NE(over.out.find("times the tolerance"), std::string::npos) << over.out;
    ASSERT_EQ(
        run("[limits]\ntolerance_mm = 1\n", {"--out", "render", "--only", "summary,surface"}, "render").code,
        0);
    const auto summary = nlohmann::json::parse(scratch.get("render/summary.json"), nullptr, false);
    EXPECT_NEAR(summary["form_error"]["left_max_mm"].get<double>(), leaves, 1e-9);
    EXPECT_GT(rows("render/surface.csv").size(), 10u);
    ASSERT_EQ(run("[limits]\ntolerance_mm = 1\n", {"--out", "audit"}).code, 0);
    double left = 0, overcut = 0;
    for (auto& row : rows("audit/audit.csv")) {
        left = std::max(left, std::stod(row.at("bending_leaves_mm")));
        overcut = std::max(overcut, std::stod(row.at("bending_overcuts_mm")));
        if (row["line"] == "4") continue;
        EXPECT_EQ(row["bending_leaves_mm"] + row["bending_overcuts_mm"], "00");
    }
    EXPECT_NEAR(left, leaves, 1e-3 * most);
    EXPECT_NEAR(overcut, overcuts, 1e-3 * most);
}

// The first slot is 0.2 mm deeper than the design, the second 0.3 mm above it.
TEST_F(AuditVerb, names_the_line_that_cut_into_the_design) {
    scratch.put("design.obj", "v 2 2 -0.8\nv 38 2 -0.8\nv 38 38 -0.8\nv 2 38 -0.8\nf 1 2 3 4\n");
    const std::string part = "[part]\nsurface = \"design.obj\"\n[limits]\ntolerance_mm = 0.1\n";
    const Outcome outcome = run(part, {"--resolution", "1", "--out", "audit"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("the part has a gouge of 0.2 mm"), std::string::npos) << outcome.out;
    const auto json = nlohmann::json::parse(scratch.get("audit/audit.json"), nullptr, false);
    EXPECT_NEAR(json["gouge_max_mm"].get<double>(), 0.2, 1e-6);
    // Lines 4 and 5 are one slot: two feeds.
    ASSERT_EQ(json["gouges"].size(), 2u);
    for (auto& row : rows("audit/audit.csv")) {
        const bool deep = row["line"] == "4" || row["line"] == "5";
        EXPECT_NEAR(std::stod(row.at("gouge_mm")), deep ? 0.2 : 0, 1e-4) << row["line"];
        EXPECT_EQ(row.at("scallop_mm"), "0") << row["line"];
    }
    EXPECT_NEAR(json["tools"][0]["gouge_mm"].get<double>(), 0.2, 1e-6);
    EXPECT_NE(scratch.get("audit/audit.html").find("Gouges"), std::string::npos);
}

TEST_F(AuditVerb, takes_a_program_alone) {
    scratch.put("slot.nc", kSlots);
    const Outcome outcome = run_tribo({"audit", "slot.nc", "--tool", "flat 10 length 20"}, scratch.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("true forces"), std::string::npos);
    EXPECT_NE(outcome.err.find("has no stickout_mm"), std::string::npos) << outcome.err;
}

TEST_F(AuditVerb, refuses_wrong_limits_and_leaves_nothing) {
    const Outcome outcome = run("[limits]\nforce_n = -1\n", {"--out", "audit"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("job.toml:"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() + "/audit"));
}

}  // namespace
}  // namespace tribo::test
