// SPDX-License-Identifier: MIT
// Keys of a material, messages of a page, and flags.
#include <gtest/gtest.h>

#include "app/limits/doors.hpp"
#include "app/run/program.hpp"
#include "material/material_json.hpp"
#include "protocol/live_message.hpp"

namespace tribo::test {
namespace {

Door material(const Limit& limit, const std::string& key) {
    return {&limit, "material: " + key, [=](double value) {
                std::string text = R"({"schema": "tribo.material/1")";
                for (const char* k : {"stiffness_n_per_mm", "viscosity_n_s_per_mm", "width_mm",
                                      "relief_slope", "gloss", "roughness", "pile", "highpass_hz"})
                    text += std::string(", \"") + k + "\": " + (key == k ? written(value) : "1");
                const auto read = material::parse_material(text + "}", "m.json");
                return read ? std::string() : read.error().text();
            }};
}

Door voice(const Limit& limit, const std::string& key) {
    return {&limit, "voice: " + key, [=](double value) {
                std::string text =
                    R"({"schema": "tribo.material/1", "stiffness_n_per_mm": 4, "viscosity_n_s_per_mm": 0.3,)"
                    R"( "voices": [{"reflection": [0.5])";
                for (const auto& [k, usual] :
                     {std::pair{"speed_mm_per_s", "100"}, std::pair{"force_n", "1"},
                      std::pair{"level_db", "-20"}, std::pair{"sample_rate_hz", "48000"}})
                    text += std::string(", \"") + k + "\": " + (key == k ? written(value) : usual);
                const auto read = material::parse_material(text + "}]}", "m.json");
                return read ? std::string() : read.error().text();
            }};
}

Door message(const Limit& limit, const std::string& before, const std::string& after) {
    return {&limit, before, [=](double value) {
                const auto read = protocol::parse_live_command(before + written(value) + after);
                return read ? std::string() : read.error().text();
            }};
}

Door setting(const Limit& limit, const std::string& key) {
    return message(limit, R"({"op":"set","key":")" + key + R"(","value":)", "}");
}

// A call of the program with "{}" where the value stands. What the program says about other things, such as a
// file that is missing, is no error of the value.
Door flag(const Limit& limit, const std::vector<std::string>& arguments, const std::string& name) {
    return {&limit, arguments[0] + " " + name, [=](double value) {
                std::vector<std::string> call = arguments;
                for (std::string& argument : call) {
                    const std::size_t at = argument.find("{}");
                    if (at != argument.npos) argument.replace(at, 2, written(value));
                }
                const Outcome run = run_tribo(call);
                EXPECT_EQ(run.code, 2) << run.err;  // a file is missing, if nothing else
                return run.err.find(name) != run.err.npos ? run.err : std::string();
            }};
}

}  // namespace

Doors material_doors() {
    const Limits& l = kLimits;
    return {
        material(l.sheet_stiffness, "stiffness_n_per_mm"),
        material(l.sheet_viscosity, "viscosity_n_s_per_mm"),
        material(l.material_width, "width_mm"),
        material(l.optical_share, "relief_slope"),
        material(l.optical_share, "gloss"),
        material(l.optical_share, "pile"),
        material(l.roughness, "roughness"),
        material(l.noted_highpass, "highpass_hz"),
        voice(l.finger_speed, "speed_mm_per_s"),
        voice(l.finger_force, "force_n"),
        voice(l.voice_level, "level_db"),
        voice(l.model_rate, "sample_rate_hz"),
    };
}

Doors live_doors() {
    const Limits& l = kLimits;
    return {
        setting(l.override_percent, "feed_percent"),
        setting(l.override_percent, "spindle_percent"),
        setting(l.helix, "helix_deg"),
        setting(l.force_scale, "force_scale"),
        setting(l.table_error, "jnd"),
        message(l.play_speed, R"({"op":"speed","value":)", "}"),
        message(l.program_time, R"({"op":"seek","t_s":)", "}"),
        message(l.coordinate, R"({"op":"finger","down":true,"position_mm":[0,)", ",0]}"),
    };
}

Doors flag_doors() {
    const Limits& l = kLimits;
    const std::vector<std::string> render{"render", "none.toml", "--out", "out"},
        program{"render", "none.nc", "--out", "out"}, live{"live", "none.toml"},
        feel{"feel", "none.toml", "--stroke", "none.csv", "--out", "trace.csv"},
        learn{"learn", "--recording", "100:none.wav", "--out", "m.json"},
        press{"press", "none.json", "--stroke", "none.csv", "--out", "out"},
        rub{"rub", "none.json", "--stroke", "none.csv", "--out", "out.wav"},
        stability{"stability", "none.toml"}, audit{"audit", "none.toml"},
        feed{"feed", "none.toml", "--out", "new.nc"},
        simulated{"stability", "none.toml", "--out", "out", "--simulate", "1000000:1"};
    const auto with = [](const Limit& limit, std::vector<std::string> call, const std::string& name) {
        call.push_back(name + "={}");
        return flag(limit, call, name);
    };
    // Of numbers with a colon between them.
    const auto of_two = [](const Limit& limit, std::vector<std::string> call, const std::string& name,
                           const std::string& words, const std::string& other_rule = "") {
        if (call.size() > 2 && call[call.size() - 2] == name) call.resize(call.size() - 2);
        call.push_back(name + "=" + words);
        Door door = flag(limit, call, name);
        door.name += " " + words;
        door.other_rule = other_rule;
        return door;
    };
    const auto worded = [&](const Limit& limit, const std::string& name, const std::string& words,
                            const std::string& other_rule = "") {
        std::vector<std::string> call = program;
        call.push_back(name + "=" + words);
        Door door = flag(limit, call, name);
        door.name += " " + words;
        door.other_rule = other_rule;
        return door;
    };
    return {
        with(l.resolution, render, "--resolution"),
        with(l.resolution, live, "--resolution"),
        with(l.resolution, feel, "--resolution"),
        with(l.until, render, "--until"),
        with(l.until, feel, "--until"),
        with(l.until, stability, "--t"),
        with(l.resolution, stability, "--resolution"),
        with(l.spindle_speed, stability, "--limit"),
        of_two(l.spindle_speed, stability, "--at", "{}:1"),
        of_two(l.axial_depth, stability, "--at", "8000:{}"),
        of_two(l.spindle_speed, stability, "--rpm", "{}:1000000:100000"),
        of_two(l.axial_depth, stability, "--depth", "1000:{}", "at most 1000 depths"),
        of_two(l.spindle_speed, simulated, "--simulate", "{}:1", "would last"),
        of_two(l.axial_depth, simulated, "--simulate", "8000:{}"),
        with(l.turns, simulated, "--turns"),
        with(l.memory, render, "--memory"),
        with(l.uncertain_cases, render, "--uncertain"),
        with(l.resolution, audit, "--resolution"),
        with(l.fail_ratio, audit, "--fail-over"),
        with(l.resolution, feed, "--resolution"),
        with(l.most_force, feed, "--force-n"),
        with(l.most_power, feed, "--power-w"),
        with(l.most_stress, feed, "--stress"),
        with(l.most_deflection, feed, "--deflection-mm"),
        with(l.edge, {"feed", "none.toml", "--out", "new.nc", "--unroll"}, "--split"),
        of_two(l.chip_limit, feed, "--chip-mm", "{}:10", "not below the largest"),
        of_two(l.chip_limit, feed, "--chip-mm", "0.000001:{}", "not below the largest"),
        with(l.spindle_speed, program, "--spindle-rpm"),
        with(l.feed, program, "--feed-mm-per-min"),
        worded(l.tool_number, "--tool", "T{} flat 6"),
        worded(l.cutter_diameter, "--tool", "flat {}"),
        worded(l.corner_radius, "--tool", "bull 1000 length 600 corner {}", "not between 0 and the radius"),
        worded(l.flutes, "--tool", "flat 6 flutes {}"),
        worded(l.helix, "--tool", "flat 6 helix {}"),
        worded(l.cutting_length, "--tool", "flat 6 length {}"),
        worded(l.core_diameter, "--tool", "flat 1000 core {}"),
        worded(l.edge, "--stock", "80 {} 20"),
        worded(l.edge, "--stock", "0 0 0 80 60 {}"),
        worded(l.coordinate, "--stock", "-999990 0 0 {} 60 20", "edge of a box"),
        with(l.servo_rate, feel, "--rate"),
        with(l.probe_radius, feel, "--probe-mm"),
        with(l.surface_stiffness, feel, "--stiffness"),
        with(l.friction, feel, "--friction"),
        with(l.friction, feel, "--friction-kinetic"),
        with(l.unit, feel, "--unit-mm"),
        with(l.model_scale, feel, "--scale"),
        with(l.arm_scale, feel, "--arm-scale"),
        with(l.arm_delay, feel, "--delay"),
        with(l.arm_delay, live, "--delay"),
        with(l.optical_share, learn, "--relief-slope"),
        with(l.optical_share, learn, "--gloss"),
        with(l.optical_share, learn, "--pile"),
        with(l.roughness, learn, "--roughness"),
        with(l.material_width, learn, "--width-mm"),
        with(l.sheet_stiffness, learn, "--stiffness"),
        with(l.sheet_viscosity, learn, "--viscosity"),
        with(l.learned_highpass, learn, "--highpass"),
        flag(l.finger_speed, {"learn", "--out", "m.json", "--recording={}:none.wav"}, "--recording"),
        flag(l.finger_force, {"learn", "--out", "m.json", "--recording=9@{}:none.wav"}, "--recording"),
        flag(l.coordinate, {"live", "none.toml", "--arm-at", "0", "{}", "0"}, "--arm-at"),
        with(l.contact_radius, press, "--radius-mm"),
        with(l.frame_rate, press, "--fps"),
        with(l.sample_rate, rub, "--sample-rate"),
    };
}

}  // namespace tribo::test
