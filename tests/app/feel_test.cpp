// SPDX-License-Identifier: MIT
// `tribo feel` from outside: what the trace holds, what is refused.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/run/program.hpp"
#include "app/run/small_inputs.hpp"

namespace tribo::test {
namespace {

namespace fs = std::filesystem;

// Down onto the floor of the slot, 0.3 mm into it, along it, and off.
constexpr const char* kStroke =
    "t_s,x_mm,y_mm,z_mm\n0,12,10,1\n0.2,12,10,-2.3\n0.4,18,10,-2.3\n0.5,18,10,1\n";

struct Row {
    double t_s, x, y, z, fx, fy, fz;
    int contact;
};

class Feel : public ::testing::Test {
  protected:
    Feel() : folder_(scratch_.path()) {
        put("slot.toml", kSlotJob);
        put("slot.nc", kSlotProgram);
        put("stroke.csv", kStroke);
    }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    std::string text_of(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
        return text.str();
    }
    Outcome feel(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"feel",       "slot.toml", "--stroke",
                                           "stroke.csv", "--out",     "trace.csv"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tribo(arguments, folder_.string());
    }
    std::vector<Row> trace() const {
        std::ifstream file(folder_ / "trace.csv");
        std::string line;
        std::getline(file, line);
        EXPECT_EQ(line, "t_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n,contact");
        std::vector<Row> rows;
        while (std::getline(file, line)) {
            Row r{};
            EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%d", &r.t_s, &r.x, &r.y, &r.z,
                                  &r.fx, &r.fy, &r.fz, &r.contact),
                      8)
                << line;
            rows.push_back(r);
        }
        return rows;
    }
    Scratch scratch_;
    fs::path folder_;
};

TEST_F(Feel, pushes_back_from_the_floor_of_a_slot_by_stiffness_times_depth) {
    const Outcome run = feel({"--device", "playback", "--stats", "stats.json"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::vector<Row> rows = trace();
    ASSERT_EQ(rows.size(), 501U);
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const Row& r = rows[n];
        EXPECT_NEAR(r.t_s, 1e-3 * static_cast<double>(n), 1e-9);
        const double depth = std::max(0.0, -2 - r.z);
        EXPECT_NEAR(r.fz, 0.5 * depth, 1e-3) << n;
        EXPECT_NEAR(r.fx, 0, 1e-3) << n;
        EXPECT_NEAR(r.fy, 0, 1e-3) << n;
        if (depth > 1e-3) {
            EXPECT_EQ(r.contact, 1) << n;
        } else if (r.z > -2) {
            EXPECT_EQ(r.contact, 0) << n;
        }
    }
    const auto stats = nlohmann::json::parse(text_of("stats.json"));
    EXPECT_EQ(stats["ticks"], 501);
    EXPECT_EQ(stats["rate_hz"], 1000);
    EXPECT_NEAR(stats["max_force_n"].get<double>(), 0.15, 1e-3);
    for (const char* times : {"cpu_us", "wall_us", "empty_cpu_us", "empty_wall_us"}) {
        for (const char* key : {"p50", "p99", "p999", "max"}) EXPECT_GE(stats[times][key].get<double>(), 0);
    }
    EXPECT_TRUE(stats.contains("late"));
    EXPECT_TRUE(stats["faults"].empty());
}

TEST_F(Feel, lets_the_simulated_hand_yield) {
    ASSERT_EQ(feel({"--rate", "4000", "--stiffness", "1"}).code, 0);
    const std::vector<Row> rows = trace();
    ASSERT_EQ(rows.size(), 2001U);
    for (const Row& r : rows) {
        if (r.contact == 1) {
            // Where the hand leaves, what sampling gave too much is withheld.
            EXPECT_NEAR(r.fz, -2 - r.z, 0.05);
        }
        // Wall and hand share the way by their stiffness, 1 and 0.3 N/mm, once the tap is over.
        if (r.t_s > 0.37 && r.t_s < 0.4) {
            EXPECT_NEAR(r.fz, 0.3 * 0.3 / 1.3, 2e-3) << r.t_s;
        }
    }
}

TEST_F(Feel, gives_the_same_trace_twice) {
    ASSERT_EQ(feel({"--threads", "2"}).code, 0);
    const std::string first = text_of("trace.csv");
    ASSERT_EQ(feel({"--threads", "1"}).code, 0);
    EXPECT_EQ(text_of("trace.csv"), first);
}

// A point has no finger around it; without the flag the finger has 8 mm.
TEST_F(Feel, refuses_a_finger_without_a_radius) {
    put("slot.toml", std::string(kSlotJob) + "[haptics]\nprobe = \"cylinder\"\n");
    const Outcome point = feel({"--probe-mm", "0"});
    EXPECT_EQ(point.code, 2);
    EXPECT_TRUE(point.err.starts_with("slot.toml: error: --probe-mm 0 is a point")) << point.err;
    EXPECT_EQ(feel({}).code, 0);
    EXPECT_EQ(feel({"--probe-mm", "3"}).code, 0);
    put("slot.toml", kSlotJob);
    EXPECT_EQ(feel({"--probe-mm", "0"}).code, 0);
}

// A probe at the tip, while the slot is cut in steady feed: over whole turns the trace has the mean force of
// forces.csv, scaled, in the stock's frame (the feed is +x). 6000 rpm: a turn is 10 ticks.
TEST_F(Feel, gives_the_cutting_force_of_the_program_at_the_time_of_the_stroke) {
    put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,-5,10,-2\n2.6666666,35,10,-2\n");
    const Outcome run =
        feel({"--mode", "cut", "--device", "playback", "--texture", "off", "--bake", "cut.bake"});
    ASSERT_EQ(run.code, 0) << run.err;
    ASSERT_EQ(
        run_tribo({"render", "slot.toml", "--out", "out", "--only", "summary,forces"}, folder_.string()).code,
        0);
    std::ifstream forces(folder_ / "out" / "forces.csv");
    std::string line;
    double mean[3] = {0, 0, 0};
    while (std::getline(forces, line)) {
        double v[16] = {};
        std::istringstream fields(line);
        std::string field;
        for (double& value : v) {
            if (std::getline(fields, field, ',')) value = std::atof(field.c_str());
        }
        if (v[0] > 1.25 && v[0] < 1.3) std::copy(v + 13, v + 16, mean);  // in the middle of the slot
    }
    ASSERT_NE(mean[0], 0);
    const std::vector<Row> rows = trace();
    double sum[3] = {0, 0, 0};
    for (std::size_t n = 1200; n < 1400; ++n) {
        sum[0] += rows[n].fx / 200;
        sum[1] += rows[n].fy / 200;
        sum[2] += rows[n].fz / 200;
        EXPECT_EQ(rows[n].contact, 1);
    }
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(sum[axis], 0.01 * mean[axis], 0.02 * std::abs(0.01 * mean[1])) << axis;
    // Before the cutter meets the stock nothing is felt.
    EXPECT_EQ(rows[50].contact, 0);
    EXPECT_EQ(rows[50].fy, 0);
    // The same again from the file.
    const std::string first = text_of("trace.csv");
    const Outcome again =
        feel({"--mode", "cut", "--device", "playback", "--texture", "off", "--bake", "cut.bake"});
    ASSERT_EQ(again.code, 0);
    EXPECT_NE(again.out.find("as baked"), std::string::npos) << again.out;
    EXPECT_EQ(text_of("trace.csv"), first);
    // Of another job it is not used.
    put("slot.toml", std::string(kSlotJob) + "[haptics]\nforce_scale = 0.02\n");
    const Outcome other =
        feel({"--mode", "cut", "--device", "playback", "--texture", "off", "--bake", "cut.bake"});
    ASSERT_EQ(other.code, 0);
    EXPECT_EQ(other.out.find("as baked"), std::string::npos);
    EXPECT_NE(other.err.find("baked again"), std::string::npos) << other.err;
    EXPECT_NEAR(trace()[1300].fy, 2 * rows[1300].fy, 1e-5);
}

// A table that a full disk or a kill has cut short costs a warning and a new table.
TEST_F(Feel, bakes_again_what_was_cut_short) {
    put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,-5,10,-2\n0.1,-4,10,-2\n");
    const std::vector<std::string> call{"--mode",    "cut", "--device", "playback",
                                        "--texture", "off", "--bake",   "cut.bake"};
    ASSERT_EQ(feel(call).code, 0);
    const std::string whole = text_of("cut.bake");
    ASSERT_GT(whole.size(), 200U);
    for (const std::size_t left : {whole.size() - 1, whole.size() / 2, std::size_t{64}, std::size_t{5}}) {
        put("cut.bake", whole.substr(0, left));
        const Outcome run = feel(call);
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_NE(run.err.find("cut.bake: warning: "), std::string::npos) << run.err;
        EXPECT_EQ(text_of("cut.bake"), whole) << left;
    }
}

TEST_F(Feel, refuses_to_bake_over_what_is_no_table) {
    // Before anything else: the stroke is missing too.
    fs::remove(folder_ / "stroke.csv");
    put("notes.txt", "Remember the milk.\n");
    const Outcome run = feel({"--mode", "cut", "--bake", "notes.txt"});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("notes.txt: error: this is not a baked force table"), std::string::npos)
        << run.err;
    EXPECT_EQ(text_of("notes.txt"), "Remember the milk.\n");
    EXPECT_EQ(feel({"--mode", "cut", "--bake", "."}).code, 2);
}

TEST_F(Feel, lets_the_cut_fade_with_the_distance_from_the_cutter) {
    const auto force_at = [&](double y) {
        put("stroke.csv",
            "t_s,x_mm,y_mm,z_mm\n0,15," + std::to_string(y) + ",1\n2,15," + std::to_string(y) + ",1\n");
        EXPECT_EQ(feel({"--mode", "cut", "--device", "playback", "--texture", "off"}).code, 0);
        double most = 0;
        for (const Row& r : trace()) most = std::max(most, std::hypot(r.fx, r.fy, r.fz));
        return most;
    };
    // The cutter's side is 3 mm from its axis at y = 10: in full to 2 mm from there, not at all from 10 mm
    // on.
    const double near = force_at(14), further = force_at(18), away = force_at(23.5);
    EXPECT_GT(near, 1);
    EXPECT_GT(further, 0.1);
    EXPECT_LT(further, 0.8 * near);
    EXPECT_EQ(away, 0);
}

// Beside the cutting force the part itself is felt, as it stands at that moment: in the middle of the slot to
// be, 0.5 mm under the top, the top pushes back until the cutter comes, and then nothing.
TEST_F(Feel, touches_the_part_while_it_is_cut) {
    put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,20,10,0.2\n0.2,20,10,-0.5\n2.6,20,10,-0.5\n");
    put("slot.toml", std::string(kSlotJob) + "[haptics]\nforce_scale = 1e-9\n");
    for (const char* clock : {"", "--real-time"}) {
        std::vector<std::string> flags{"--mode", "cut", "--device", "playback", "--texture", "off"};
        if (*clock != 0) flags.emplace_back(clock);
        const Outcome run = feel(flags);
        ASSERT_EQ(run.code, 0) << run.err;
        // The cutter's rim comes to x = 20 when its axis is at 17, 22 mm on: 1.467 s at 15 mm/s.
        double most_rise = 0, last = 0;
        for (const Row& r : trace()) {
            if (r.t_s > 0.3 && r.t_s < 1.2) {
                EXPECT_NEAR(r.fz, 0.25, 1e-3) << r.t_s << clock;
            }
            if (r.t_s > 2.2) {
                EXPECT_NEAR(std::hypot(r.fx, r.fy, r.fz), 0, 1e-6) << r.t_s << clock;
            }
            const double force = std::hypot(r.fx, r.fy, r.fz);
            if (r.t_s > 0.3) most_rise = std::max(most_rise, force - last);
            last = force;
        }
        EXPECT_LT(most_rise, 1e-3) << clock;
    }
}

// A model instead of a job: the surface as it was read, here an open sheet at z = -2.
TEST_F(Feel, touches_a_surface_that_was_only_read) {
    put("sheet.obj", "v 0 0 -2\nv 30 0 -2\nv 30 20 -2\nv 0 20 -2\nf 1 2 3 4\n");
    const auto feel_sheet = [&](const std::string& mode) {
        return run_tribo({"feel", "sheet.obj", "--stroke", "stroke.csv", "--out", "trace.csv", "--device",
                          "playback", "--mode", mode},
                         folder_.string());
    };
    const Outcome run = feel_sheet("inspect");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("the surface is open"), std::string::npos) << run.err;
    for (const Row& r : trace()) {
        EXPECT_NEAR(r.fz, 0.5 * std::max(0.0, -2 - r.z), 1e-3) << r.t_s;
        EXPECT_NEAR(std::hypot(r.fx, r.fy), 0, 1e-3) << r.t_s;
    }
    EXPECT_EQ(feel_sheet("cut").code, 2);
}

TEST_F(Feel, says_what_a_delay_leaves_of_the_stiffness) {
    const Outcome run = feel({"--delay", "6", "--stiffness", "5"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("at a delay of 6 ms and 1000 Hz: 3.08 stands in"), std::string::npos) << run.err;
}

// Four triangles about a corner, one turned over: a skin, in inches and twice as large.
TEST_F(Feel, touches_a_model_whose_triangles_do_not_agree_on_a_side) {
    put("soup.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\n");
    put("press.csv", "t_s,x_mm,y_mm,z_mm\n0,20,20,3\n0.3,20,20,-0.5\n0.5,20,20,-0.5\n");
    const Outcome run = run_tribo({"feel", "soup.obj", "--stroke", "press.csv", "--out", "trace.csv",
                                   "--device", "playback", "--unit-mm", "25.4", "--scale", "2"},
                                  folder_.string());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("as a skin of 0.144 mm"), std::string::npos) << run.err;
    const std::vector<Row> rows = trace();
    EXPECT_NEAR(rows.back().fz, 0.5 * (0.5 + 0.072), 2e-3);
}

TEST_F(Feel, refuses_flags_of_a_cut_for_a_model_and_says_where_it_is) {
    put("tetra.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    put("press.csv", "t_s,x_mm,y_mm,z_mm\n0,1,1,12\n0.1,1,1,5\n");
    const auto run = [&](std::vector<std::string> flags) {
        std::vector<std::string> call{"feel",  "tetra.obj", "--stroke", "press.csv",
                                      "--out", "trace.csv", "--device", "playback"};
        call.insert(call.end(), flags.begin(), flags.end());
        return run_tribo(call, folder_.string());
    };
    const Outcome good = run({});
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_NE(good.out.find("from (0, 0, 0) to (9, 9, 9) mm"), std::string::npos) << good.out;
    for (const std::vector<std::string>& flags :
         std::vector<std::vector<std::string>>{{"--until", "3"},
                                               {"--resolution", "0.1"},
                                               {"--texture", "off"},
                                               {"--bake", "x.bake"},
                                               {"--profile", "who.toml"},
                                               {"--scaling", "compressive"}}) {
        const Outcome refused = run(flags);
        EXPECT_EQ(refused.code, 2) << flags[0];
        EXPECT_NE(refused.err.find(flags[0] + " belongs to a cut"), std::string::npos) << refused.err;
    }
    EXPECT_NE(run({"--arm-scale", "3"}).err.find("--arm-scale says nothing without an arm"),
              std::string::npos);
}

TEST_F(Feel, says_which_devices_there_are) {
    const Outcome text = run_tribo({"devices"}, folder_.string());
    EXPECT_EQ(text.code, 0);
    for (const char* word :
         {"openhaptics", "forcedimension", "haply", "falcon", "simulated", "playback", "sound"})
        EXPECT_NE(text.out.find(word), std::string::npos) << word;
    const auto json = nlohmann::json::parse(run_tribo({"devices", "--json"}, folder_.string()).out);
    EXPECT_EQ(json["schema"], "tribo.devices/1");
    for (const auto& arm : json["haptic"]) {
        EXPECT_TRUE(arm["available"] == true || !arm["remedy"].get<std::string>().empty());
    }
}

TEST_F(Feel, refuses_what_it_cannot_feel) {
    EXPECT_EQ(feel({"--device", "glove"}).code, 2);
    EXPECT_EQ(feel({"--rate", "5"}).code, 2);
    EXPECT_EQ(feel({"--mode", "lick"}).code, 2);
    EXPECT_EQ(feel({"--stiffness", "-1"}).code, 2);
    EXPECT_EQ(feel({"--friction", "0.1", "--friction-kinetic", "0.2"}).code, 2);
    EXPECT_EQ(feel({"--unit-mm", "25.4"}).code, 2);
    EXPECT_EQ(feel({"--delay", "21"}).code, 2);
    const Outcome none = feel({"--source", "none.so"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("none.so"), std::string::npos) << none.err;
    put("stroke.csv", "t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,0,0,1\n");
    const Outcome run = feel({});
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("stroke.csv:1:1: error: the header has no column z_mm"), std::string::npos)
        << run.err;
    put("stroke.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,1\n900000,0,0,1\n");
    EXPECT_EQ(feel({}).code, 2);
    EXPECT_FALSE(fs::exists(folder_ / "trace.csv"));
}

}  // namespace
}  // namespace tribo::test
