// SPDX-License-Identifier: MIT
// `tribo stability` from outside: the benchmark of the literature, frames, refusals.
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "app/run/benchmark_slot.hpp"
#include "app/run/program.hpp"

namespace tribo::test {
namespace {

constexpr const char* kEngagement = "[engagement]\nentry_deg = 0\nexit_deg = 180\naxial_depth_mm = 1\n";

class StabilityVerb : public testing::Test {
  protected:
    Outcome run(const std::string& more, std::vector<std::string> flags,
                const std::string& program = "G21 G90 M3 F1600\nG0 X-8 Y10 Z-1\nG1 X48\nM30\n") const {
        scratch.put("slot.nc", program);
        scratch.put("job.toml", kBenchmarkSlot + more);
        flags.insert(flags.begin(), {"stability", "job.toml"});
        return run_tribo(flags, scratch.path());
    }
    nlohmann::json answer(
        const std::string& more, std::vector<std::string> flags,
        const std::string& program = "G21 G90 M3 F1600\nG0 X-8 Y10 Z-1\nG1 X48\nM30\n") const {
        flags.push_back("--json");
        const Outcome outcome = run(more, flags, program);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out, nullptr, false);
    }
    Scratch scratch;
};

TEST_F(StabilityVerb, gives_the_benchmark_in_the_order_of_the_call) {
    const auto json = answer(kEngagement + benchmark_mode("1, 0, 0"),
                             {"--at", "5000:0.5", "--at", "5000:0.2", "--limit", "9000", "--limit", "8000"});
    EXPECT_EQ(json["schema"], "tribo.stability/1");
    ASSERT_EQ(json["points"].size(), 2u);
    EXPECT_NEAR(json["points"][0]["multiplier"], 1.07397559, 2e-7);
    EXPECT_NEAR(json["points"][1]["multiplier"], 0.81974278, 2e-7);
    EXPECT_EQ(json["points"][0]["kind"], "quasi-periodic");
    EXPECT_EQ(json["points"][1]["kind"], "stable");
    EXPECT_NEAR(json["points"][0]["period_s"], 0.006, 1e-12);
    ASSERT_EQ(json["limits"].size(), 2u);
    EXPECT_NEAR(json["limits"][0]["limit_mm"], 3.0090, 3e-3);
    EXPECT_NEAR(json["limits"][1]["limit_mm"], 0.6764, 7e-4);
    EXPECT_EQ(json["modes"].size(), 1u);
}

TEST_F(StabilityVerb, turns_the_modes_into_the_frame_of_the_feed) {
    const auto along_x = answer(kEngagement + benchmark_mode("1, 0, 0"), {"--at", "5000:0.5"});
    const auto along_y = answer(kEngagement + benchmark_mode("0, 3, 0", "part"), {"--at", "5000:0.5"},
                                "G21 G90 M3 F1600\nG0 X10 Y-8 Z-1\nG1 Y48\nM30\n");
    EXPECT_NEAR(along_y["points"][0]["multiplier"], along_x["points"][0]["multiplier"], 1e-8);
    EXPECT_NEAR(along_y["modes"][0]["direction"][0], 1, 1e-12);
    EXPECT_EQ(along_y["modes"][0]["on"], "part");
    // Square to the feed half of a slot is another cut.
    const std::string half = "[engagement]\nentry_deg = 0\nexit_deg = 90\naxial_depth_mm = 1\n";
    const auto across = answer(half + benchmark_mode("0, 1, 0"), {"--at", "5000:0.5"});
    const auto along = answer(half + benchmark_mode("1, 0, 0"), {"--at", "5000:0.5"});
    EXPECT_GT(std::abs(across["points"][0]["multiplier"].get<double>() -
                       along["points"][0]["multiplier"].get<double>()),
              1e-3);
}

TEST_F(StabilityVerb, asks_for_the_job_itself_without_flags) {
    const Outcome outcome = run(kEngagement + benchmark_mode("1, 0, 0"), {});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("8000 rpm, 1 mm: chatter at 969.0 Hz (quasi-periodic)"), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("8000 rpm: stable up to 0.6764 mm deep"), std::string::npos) << outcome.out;
}

TEST_F(StabilityVerb, takes_the_engagement_from_the_program) {
    // A slot across the block is the slot of the notes, as the field sees it.
    const auto slot = answer(kEngagement + benchmark_mode("1, 0, 0"), {"--at", "8000:1", "--limit", "8000"});
    const auto milled = answer(benchmark_mode("1, 0, 0"), {"--at", "8000:1", "--limit", "8000"});
    EXPECT_NEAR(milled["points"][0]["multiplier"], slot["points"][0]["multiplier"], 2e-3);
    EXPECT_NEAR(milled["limits"][0]["limit_mm"], slot["limits"][0]["limit_mm"], 5e-3);
    EXPECT_EQ(slot["engagement"]["from"], "[engagement]");
    EXPECT_EQ(milled["engagement"]["from"], "program");
    EXPECT_EQ(milled["engagement"]["line"], 3);
    EXPECT_NEAR(milled["engagement"]["axial_depth_mm"], 1, 1e-3);
    EXPECT_NEAR(milled["engagement"]["entry_deg"], 0, 1);
    EXPECT_NEAR(milled["engagement"]["exit_deg"], 180, 1);
    const Outcome outcome = run(benchmark_mode("1, 0, 0"), {"--at", "8000:1"});
    EXPECT_NE(outcome.out.find("cut: line 3 of the program at "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("the most critical of "), std::string::npos) << outcome.out;
}

TEST_F(StabilityVerb, finds_the_worst_line_of_a_program_or_takes_the_one_that_is_named) {
    // A shallow slot, a deep one and a shallow one along y.
    const std::string program =
        "G21 G90 M3 F1600\nG0 X-8 Y8 Z-0.3\nG1 X48\nG0 Z5\nG0 X-8 Y20\nG0 Z-1.2\nG1 X48\nG0 Z5\n"
        "G0 X8 Y-8\nG0 Z-0.5\nG1 Y48\nM30\n";
    const std::string job = benchmark_mode("1, 0, 0");
    const std::vector<std::string> at{"--at", "8000:1"};
    const auto all = answer(job, at, program);
    EXPECT_EQ(all["engagement"]["line"], 7);
    EXPECT_NEAR(all["engagement"]["axial_depth_mm"], 1.2, 1e-3);
    const auto first = answer(job, {"--at", "8000:1", "--line", "3"}, program);
    EXPECT_EQ(first["engagement"]["line"], 3);
    EXPECT_NEAR(first["engagement"]["axial_depth_mm"], 0.3, 1e-3);
    // The same engagement at the same depth: the same answer.
    EXPECT_NEAR(first["points"][0]["multiplier"], all["points"][0]["multiplier"], 2e-3);
    const double t = all["engagement"]["t_s"];
    EXPECT_EQ(answer(job, {"--at", "8000:1", "--t", std::to_string(t + 1e-3)}, program)["engagement"]["line"],
              7);
    // Along y the mode lies across the feed.
    const auto along_y = answer(job, {"--at", "8000:1", "--line", "11"}, program);
    EXPECT_NEAR(std::abs(along_y["modes"][0]["direction"][1].get<double>()), 1, 1e-9);
}

TEST_F(StabilityVerb, keeps_the_bands_of_rounded_cutters) {
    // A slot with a ball is engaged from 0 to 180 degrees at each height; a second pass beside it is not.
    const auto with_ball = [&](const std::string& more, const std::string& program) {
        scratch.put("slot.nc", program);
        std::string rest = kBenchmarkSlot;
        rest.replace(rest.find("\"flat\""), 6, "\"ball\"");
        scratch.put("job.toml", rest + more + benchmark_mode("1, 0.3, 0.2"));
        const Outcome outcome = run_tribo(
            {"stability", "job.toml", "--json", "--at", "9000:1", "--at", "9000:2"}, scratch.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out, nullptr, false);
    };
    const std::string slot = "G21 G90 M3 F1600\nG0 X-8 Y10 Z-2\nG1 X48\nM30\n";
    const std::string two_deep = "[engagement]\nentry_deg = 0\nexit_deg = 180\naxial_depth_mm = 2\n";
    const auto known = with_ball(two_deep, slot), milled = with_ball("", slot);
    for (std::size_t n = 0; n < 2; ++n)
        EXPECT_NEAR(
            milled["points"][n]["multiplier"].get<double>() / known["points"][n]["multiplier"].get<double>(),
            1, 0.01);
    const auto beside =
        with_ball("", "G21 G90 M3 F1600\nG0 X-8 Y10 Z-2\nG1 X48\nG0 Z5\nG0 X-8 Y11 \nG0 Z-2\nG1 X48\nM30\n");
    EXPECT_GT(beside["engagement"]["bands"], 0);
}

// A job of its own: a carbide tool with a stick-out, and an alloy of the library.
std::string estimated_job(const std::string& cutter = "stickout_mm = 50\n", const std::string& more = "") {
    return "[stock]\nbox_mm = [[0, 0, -10], [40, 40, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 10\n"
           "flutes = 3\nlength_mm = 22\n" +
           cutter +
           "[material]\nname = \"al7075-t6\"\n[process]\nspindle_rpm = 8000\nfeed_mm_per_min = "
           "1600\n[path]\ngcode = \"slot.nc\"\n[dynamics]\nestimate = true\n" +
           more;
}

TEST_F(StabilityVerb, says_that_modes_are_estimated_and_how_likely_chatter_is) {
    scratch.put("slot.nc", "G21 G90 M3 F1600\nG0 X-8 Y10 Z-1\nG1 X48\nM30\n");
    scratch.put("job.toml", estimated_job("stickout_mm = 50\n", kEngagement));
    const auto run_with = [&](std::vector<std::string> flags) {
        flags.insert(flags.begin(), {"stability", "job.toml"});
        return run_tribo(flags, scratch.path());
    };
    const Outcome asked = run_with({"--json", "--at", "8000:0.01", "--at", "8000:1", "--at", "8000:20"});
    ASSERT_EQ(asked.code, 0) << asked.err;
    const auto json = nlohmann::json::parse(asked.out);
    ASSERT_FALSE(json["modes"].empty());
    for (const auto& mode : json["modes"]) {
        EXPECT_EQ(mode["from"], "estimate");
        EXPECT_EQ(mode["damping_ratio"], 0.02);
        EXPECT_EQ(mode["stiffness_spread"], 1);
        EXPECT_EQ(mode["frequency_spread"], 0.25);
    }
    EXPECT_EQ(json["points"][0]["probability"], 0);
    EXPECT_GT(json["points"][1]["probability"], 0);
    EXPECT_EQ(json["points"][2]["probability"], 1);
    EXPECT_NE(asked.err.find("the modes of the tool are estimated, not measured"), std::string::npos)
        << asked.err;
    EXPECT_NE(asked.err.find(
                  "0.8 to 1.25 times that frequency, 0.5 to 2 times that stiffness, damping 0.01 to 0.04"),
              std::string::npos)
        << asked.err;
    const Outcome charted = run_with({"--out", "chart", "--rpm", "6000:10000:1000", "--depth", "4:0.5"});
    ASSERT_EQ(charted.code, 0) << charted.err;
    EXPECT_NE(charted.out.find("modes of the tool: estimated"), std::string::npos) << charted.out;
    EXPECT_NE(charted.out.find("within the band it chatters in "), std::string::npos) << charted.out;
    EXPECT_NE(scratch.get("chart/stability.svg").find("modes estimated"), std::string::npos);
    EXPECT_NE(scratch.get("chart/stability.svg").find("50 to 75 %"), std::string::npos);
    const std::string csv = scratch.get("chart/stability.csv");
    EXPECT_TRUE(csv.starts_with("spindle_rpm,axial_depth_mm,multiplier,chatter_hz,kind,probability\n"));
    const auto summary = nlohmann::json::parse(scratch.get("chart/summary.json"));
    EXPECT_TRUE(summary["point"].contains("probability"));
    EXPECT_EQ(summary["modes"][0]["from"], "estimate");
    EXPECT_NE(summary["warnings"].dump().find("estimated, not measured"), std::string::npos);
    EXPECT_NE(summary["advice"].get<std::string>().find("within the band of modes and forces it chatters in"),
              std::string::npos);
}

TEST_F(StabilityVerb, has_a_probability_only_where_something_has_a_spread) {
    const auto known = answer(kEngagement + benchmark_mode("1, 0, 0"), {"--at", "8000:1"});
    EXPECT_FALSE(known["points"][0].contains("probability"));
    EXPECT_FALSE(known["modes"][0].contains("from"));
    const auto spread = answer(kEngagement + benchmark_mode("1, 0, 0") + "stiffness_spread = 0.5\n",
                               {"--at", "8000:0.6764", "--at", "8000:1"});
    // At the border half of the cases chatter.
    EXPECT_NEAR(spread["points"][0]["probability"], 0.5, 0.026);
    EXPECT_GT(spread["points"][1]["probability"], 0.8);
    EXPECT_NEAR(spread["points"][1]["multiplier"], known["points"][0]["multiplier"], 1e-9);
    EXPECT_EQ(spread["modes"][0]["stiffness_spread"], 0.5);
}

TEST_F(StabilityVerb, refuses_an_estimate_of_a_tool_without_a_stick_out) {
    scratch.put("slot.nc", "G21 G90 M3 F1600\nG0 X-8 Y10 Z-1\nG1 X48\nM30\n");
    scratch.put("job.toml", estimated_job(""));
    const Outcome outcome = run_tribo({"stability", "job.toml"}, scratch.path());
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(
        outcome.err.find("job.toml:3:1: error: [dynamics] estimates the modes of this cutter, and it has no "
                         "'stickout_mm'; add stickout_mm"),
        std::string::npos)
        << outcome.err;
}

// The fields of the lines of a CSV, without its header.
std::vector<std::vector<std::string>> table(const std::string& csv, const std::string& header) {
    EXPECT_TRUE(csv.starts_with(header + "\n")) << csv.substr(0, 80);
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv.substr(header.size() + 1));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

TEST_F(StabilityVerb, writes_the_chart_of_the_benchmark) {
    const Outcome outcome = run(kEngagement + benchmark_mode("1, 0, 0"),
                                {"--out", "chart", "--rpm", "5000:10000:500", "--depth", "3.5:0.1"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto points =
        table(scratch.get("chart/stability.csv"), "spindle_rpm,axial_depth_mm,multiplier,chatter_hz,kind");
    ASSERT_EQ(points.size(), 11u * 35u);
    ASSERT_EQ(points[4].size(), 5u);
    EXPECT_EQ(points[4][0] + " " + points[4][1], "5000 0.5");
    EXPECT_NEAR(std::stod(points[4][2]), 1.07397559, 2e-7);
    EXPECT_EQ(points[4][4], "quasi-periodic");
    EXPECT_EQ(points[1][4], "stable");
    const auto limits = table(scratch.get("chart/limits.csv"), "spindle_rpm,limit_mm,chatter_hz,kind");
    ASSERT_EQ(limits.size(), 11u);
    EXPECT_NEAR(std::stod(limits[8][1]), 3.0090, 3e-3);
    EXPECT_TRUE(scratch.get("chart/stability.png").starts_with("\x89PNG"));
    EXPECT_NE(scratch.get("chart/stability.svg").find("the job: 8000 rpm, 1 mm, chatters"),
              std::string::npos);
    const auto summary = nlohmann::json::parse(scratch.get("chart/summary.json"));
    EXPECT_EQ(summary["schema"], "tribo.stability-summary/1");
    EXPECT_NEAR(summary["limit"]["limit_mm"], 0.6764, 7e-4);
    EXPECT_EQ(summary["nearest_stable_rpm"], 8500);
    EXPECT_EQ(summary["chart"]["to_rpm"], 10'000);
    const std::string advice = summary["advice"];
    EXPECT_NE(
        advice.find("8000 rpm and 1 mm chatter at 969.0 Hz; nearest stable speed at this depth: 8500 rpm; "
                    "largest stable depth at this speed: 0.676 mm"),
        std::string::npos)
        << advice;
    EXPECT_NE(outcome.out.find("advice: " + advice), std::string::npos) << outcome.out;
}

TEST_F(StabilityVerb, chooses_the_range_of_a_chart_and_says_so) {
    const std::string job = kEngagement + benchmark_mode("1, 0, 0");
    const auto json = answer(job, {});
    EXPECT_LE(json["chart"]["from_rpm"], 4500);
    EXPECT_GE(json["chart"]["to_rpm"], 12'000);
    EXPECT_GE(json["chart"]["most_mm"], 2);
    EXPECT_TRUE(json["advice"].is_string());
    EXPECT_NE(run(job, {}).out.find("(--rpm asks for others)"), std::string::npos);
    // Points alone ask for no chart.
    EXPECT_FALSE(answer(job, {"--at", "5000:0.5"}).contains("chart"));
    EXPECT_TRUE(
        answer(job, {"--at", "5000:0.5", "--rpm", "5000:6000:500", "--depth", "1:0.5"}).contains("chart"));
}

TEST_F(StabilityVerb, replaces_its_own_folder_alone) {
    const std::string job = kEngagement + benchmark_mode("1, 0, 0");
    const std::vector<std::string> flags{"--rpm", "8000:9000:500", "--depth", "1:0.5", "--out", "chart"};
    ASSERT_EQ(run(job, flags).code, 0);
    const std::string before = scratch.get("chart/stability.csv");
    scratch.put("chart/mine.txt", "mine");
    ASSERT_EQ(run(job, flags).code, 0);
    EXPECT_EQ(scratch.get("chart/mine.txt"), "mine");
    EXPECT_EQ(scratch.get("chart/stability.csv"), before);
    std::filesystem::create_directory(scratch / "other");
    scratch.put("other/mine.txt", "mine");
    std::vector<std::string> there = flags;
    there.back() = "other";
    EXPECT_EQ(run(job, there).code, 2);
    EXPECT_FALSE(std::filesystem::exists(scratch / "other/stability.csv"));
}

// Rows of vibration.csv.
std::vector<std::array<double, 7>> vibration(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n");
    std::vector<std::array<double, 7>> rows;
    while (std::getline(lines, line)) {
        std::istringstream fields(line);
        for (double& value : rows.emplace_back()) {
            std::string field;
            std::getline(fields, field, ',');
            value = std::stod(field);
        }
    }
    return rows;
}

// What the file shows grows as the multiplier says: a vibration of one pair of multipliers obeys
// d(k + 1) = a d(k) + b d(k - 1) from tooth to tooth, and |mu|^2 = -b.
TEST_F(StabilityVerb, simulates_a_vibration_that_grows_by_its_multiplier) {
    const std::string job = kEngagement + benchmark_mode("1, 0, 0");
    for (const std::string depth : {"0.2", "0.5"}) {
        const auto json = answer(job, {"--at", "5000:" + depth, "--simulate", "5000:" + depth, "--turns",
                                       "16", "--out", "simulated"});
        EXPECT_EQ(json["simulation"]["turns"], 16);
        EXPECT_NEAR(json["simulation"]["feed_per_tooth_mm"], 0.1, 1e-12);
        const auto rows = vibration(scratch.get("simulated/vibration.csv"));
        constexpr std::size_t kTooth = 288;  // samples, at 5000 rpm and 48 kHz
        ASSERT_EQ(rows.size(), 32 * kTooth);
        double largest = 0, aa = 0, ab = 0, bb = 0, ac = 0, bc = 0;
        for (std::size_t n = 0; n < rows.size(); ++n) {
            EXPECT_NEAR(rows[n][0], static_cast<double>(n) / 48000, 1e-9);
            largest = std::max(largest, std::abs(rows[n][1]));
            EXPECT_EQ(rows[n][2], 0);
            if (n < 8 * kTooth) continue;
            const auto way = [&](std::size_t at) { return rows[at][1] - rows[at - kTooth][1]; };
            const double a = way(n - kTooth), b = way(n - 2 * kTooth), c = way(n);
            aa += a * a;
            ab += a * b;
            bb += b * b;
            ac += a * c;
            bc += b * c;
        }
        const double squared = (ab * ac - aa * bc) / (aa * bb - ab * ab);
        EXPECT_NEAR(std::sqrt(squared), json["points"][0]["multiplier"], 2e-3) << depth;
        EXPECT_NEAR(json["simulation"]["largest_displacement_mm"], largest, 1e-8);
    }
}

TEST_F(StabilityVerb, simulates_chatter_that_teeth_outside_the_cut_bound) {
    const auto json =
        answer(benchmark_mode("1, 0, 0"), {"--simulate", "8000:1", "--turns", "60", "--out", "simulated"});
    EXPECT_NEAR(json["simulation"]["feed_per_tooth_mm"], 0.1, 1e-6);
    EXPECT_FALSE(json["simulation"].contains("ended_s"));
    const auto rows = vibration(scratch.get("simulated/vibration.csv"));
    ASSERT_EQ(rows.size(), 60 * 360u);
    const auto largest = [&](std::size_t from, std::size_t to) {
        double mm = 0;
        for (std::size_t n = from; n < to; ++n) mm = std::max(mm, std::abs(rows[n][1]));
        return mm;
    };
    // More than the feed does, and no longer growing.
    EXPECT_GT(largest(20 * 360, 40 * 360), 0.1);
    EXPECT_NEAR(largest(40 * 360, 60 * 360), largest(20 * 360, 40 * 360), 0.02);
    EXPECT_NE(scratch.get("simulated/summary.json").find("\"simulation\""), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(scratch / "simulated/stability.csv"));
}

// Two soft modes far above their limit: no tool moves so.
TEST_F(StabilityVerb, ends_a_simulation_where_its_equations_end) {
    const Outcome outcome = run(kEngagement + benchmark_mode("1, 0, 0") + benchmark_mode("0, 1, 0"),
                                {"--simulate", "8000:1", "--turns", "60", "--out", "simulated"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("job.toml: warning: the simulation ends at 0."), std::string::npos)
        << outcome.err;
    const auto rows = vibration(scratch.get("simulated/vibration.csv"));
    ASSERT_LT(rows.size(), 60 * 360u);
    for (const auto& row : rows) ASSERT_LE(std::hypot(row[1], row[2]), 1);
    EXPECT_NE(scratch.get("simulated/summary.json").find("the simulation ends at"), std::string::npos);
}

// The benchmark's mode as a tap test would show it.
std::string tapped_benchmark() {
    std::string csv = "frequency_hz,re_mm_per_n,im_mm_per_n\n";
    for (int hz = 2; hz <= 3000; hz += 2) {
        const double r = hz / 922.0;
        const std::complex<double> h = 1.0 / (1340.0496480507 * std::complex<double>(1 - r * r, 0.022 * r));
        char line[100];
        std::snprintf(line, sizeof line, "%d,%.12g,%.12g\n", hz, h.real(), h.imag());
        csv += line;
    }
    return csv;
}

TEST_F(StabilityVerb, fits_the_modes_of_a_measured_response) {
    scratch.put("tap.csv", tapped_benchmark());
    const std::string frf = "[[frf]]\nfile = \"tap.csv\"\ndirection = [2, 0, 0]\n";
    const auto json = answer(kEngagement + frf, {"--at", "5000:0.5", "--limit", "9000"});
    EXPECT_NEAR(json["points"][0]["multiplier"], 1.07397559, 2e-7);
    EXPECT_NEAR(json["limits"][0]["limit_mm"], 3.0090, 3e-3);
    ASSERT_EQ(json["modes"].size(), 1u);
    EXPECT_NEAR(json["modes"][0]["frequency_hz"], 922, 1e-5);
    ASSERT_EQ(json["frf"].size(), 1u);
    EXPECT_EQ(json["frf"][0]["file"], "tap.csv");
    EXPECT_EQ(json["frf"][0]["band_hz"], nlohmann::json({2.0, 3000.0}));
    EXPECT_EQ(json["frf"][0]["modes"], 1);
    EXPECT_LT(json["frf"][0]["residual"], 1e-6);
    // The milled cut, for people, and as a file.
    const Outcome milled =
        run(frf, {"--line", "3", "--rpm", "8000:9000:500", "--depth", "1:0.5", "--out", "chart"});
    EXPECT_EQ(milled.code, 0) << milled.err;
    EXPECT_NE(milled.out.find("frf: tap.csv, 2 to 3000 Hz: 1 mode, residual "), std::string::npos)
        << milled.out;
    EXPECT_EQ(nlohmann::json::parse(scratch.get("chart/summary.json"))["frf"], json["frf"]);
    // It is an input of the run.
    scratch.put("chart/summary.json", tapped_benchmark());
    const Outcome over =
        run("[[frf]]\nfile = \"chart/summary.json\"\ndirection = [1, 0, 0]\n" + std::string(kEngagement),
            {"--rpm", "8000:9000:500", "--out", "chart"});
    EXPECT_EQ(over.code, 2);
    EXPECT_NE(over.err.find("is an input of this run"), std::string::npos) << over.err;
}

TEST_F(StabilityVerb, refuses_what_it_cannot_answer) {
    const std::string good = kEngagement + benchmark_mode("1, 0, 0");
    struct Case {
        std::string more;
        std::vector<std::string> flags;
        const char* fragment;
    };
    for (const Case& c : {
             Case{kEngagement, {}, "has no [[mode]] and no [[frf]]"},
             Case{benchmark_mode("1, 0, 0"), {"--line", "1"}, "slot.nc:1: error: this line cuts nothing"},
             Case{benchmark_mode("1, 0, 0"),
                  {"--t", "1000"},
                  "at 1000 s the edges along the cutter cut nothing"},
             Case{benchmark_mode("1, 0, 0"), {"--t", "1", "--line", "3"}, "--line"},
             Case{good, {"--line", "3"}, "the job prescribes one in [engagement]"},
             Case{good, {"--t", "1"}, "remove [engagement]"},
             Case{kEngagement + benchmark_mode("0, 0, 0"),
                  {},
                  "job.toml:26:13: error: 'direction' is no direction"},
             Case{kEngagement + std::string("[[mode]]\nfrequency_hz = 1\n"), {}, "'direction' is missing"},
             Case{kEngagement + benchmark_mode("1, 0, 0", "holder"), {}, "'on'"},
             Case{good, {"--at", "8000"}, "'8000' is no speed and depth; write RPM:MM"},
             Case{good, {"--at", "8000:-1"}, "the prescribed depth of -1 mm is out of range"},
             Case{good, {"--at", "8000:1e9"}, "keep the prescribed depth within 1e-4 to 1000 mm"},
             Case{good, {"--limit", "0"}, "--limit"},
             Case{good, {"--rpm", "8000"}, "'8000' is no range of speeds; write FROM:TO:STEP"},
             Case{good, {"--rpm", "9000:8000:10"}, "no range of speeds"},
             Case{good, {"--rpm", "8000:9000:0"}, "no range of speeds"},
             Case{good, {"--rpm", "8000:9000:-5"}, "no range of speeds"},
             Case{good, {"--rpm", "8000:9000:0.01"}, "at most 2000 speeds"},
             Case{good, {"--rpm", "8000:9000:10:1"}, "no range of speeds"},
             Case{good, {"--rpm", "nan:9000:10"}, "spindle speed"},
             Case{good, {"--depth", "1:2"}, "no range of depths; write MAX:STEP"},
             Case{good, {"--depth", "1:1e-9"}, "the prescribed depth of 1e-9 mm is out of range"},
             Case{good, {"--depth", "1:1e-4"}, "at most 1000 depths"},
             Case{good, {"--at", "8000:1", "--depth", "1:0.1"}, "--depth is for a chart"},
             Case{good, {"--limit", "8000", "--out", "x"}, "--out is for a chart"},
             Case{good, {"--simulate", "8000:1"}, "no folder is named for it; add --out DIR"},
             Case{good, {"--simulate", "8000", "--out", "x"}, "'8000' is no speed and depth"},
             Case{good, {"--simulate", "8000:1", "--out", "x", "--turns", "0"}, "--turns"},
             Case{good,
                  {"--simulate", "8000:1", "--out", "x", "--turns", "8001"},
                  "ask for at most --turns 8000"},
             Case{good, {"--turns", "3"}, "--turns requires --simulate"},
             Case{good, {"--at", "0.05:1"}, "the modes vibrate too often"},
             Case{good, {"--limit", "0.05"}, "ask for at least"},
             Case{good, {"--rpm", "1:100:1"}, "ask for at least"},
         }) {
        const Outcome outcome = run(c.more, c.flags);
        EXPECT_EQ(outcome.code, 2) << c.fragment;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(c.fragment), std::string::npos) << outcome.err;
    }
    const Outcome outcome = run(good, {}, "G21 G90 M3 F100\nG0 X5 Y5 Z5\nG1 Z-1\nM30\n");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("no feed move goes across the tool axis"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace tribo::test
