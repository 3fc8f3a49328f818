// SPDX-License-Identifier: MIT
// The texts of the live view (docs/live-protocol.md): commands from a page, news to it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/vec3.hpp"

namespace tribo::protocol {

enum class LiveOp {
    play,
    pause,
    speed,  // value: seconds of the program per second
    seek,   // value: time, s
    resync,
    finger,  // position_mm, on: whether there is a hand
    mode,    // word: cut or inspect
    force,   // on: whether the cutting force is felt
    stop,
    release,
    set,      // word: a key of kLiveNumbers, value
    material  // word: its name, not looked up
};

struct LiveCommand {
    LiveOp op = LiveOp::pause;
    double value = 0;
    bool on = false;
    Vec3 position_mm;
    std::string word = {};
};

// What a page may set, and within which bounds.
struct LiveSettings {
    double feed_percent = 100, spindle_percent = 100;  // overrides
    double helix_deg = 30;
    double force_scale = 0.01;  // newtons at the hand per newton at the tool
    double jnd = 0.5;           // worst error of the force table
    std::string material;
    bool cut_mode = true, cutting_force = true, stopped = false;
    bool operator==(const LiveSettings&) const = default;
};
struct LiveNumber {
    std::string_view key;
    double LiveSettings::* member;
    double least, most;
};
inline constexpr std::array kLiveNumbers{
    LiveNumber{"feed_percent", &LiveSettings::feed_percent, 10, 300},
    LiveNumber{"spindle_percent", &LiveSettings::spindle_percent, 10, 300},
    LiveNumber{"helix_deg", &LiveSettings::helix_deg, 0, 60},
    LiveNumber{"force_scale", &LiveSettings::force_scale, 1e-6, 1},
    LiveNumber{"jnd", &LiveSettings::jnd, 0.1, 10},
};

// Refuses what is no command, saying why in words for the page.
Result<LiveCommand> parse_live_command(std::string_view text);

struct LiveServerInfo {
    std::string version;
    std::string job;  // empty: there is none, and no materials and no device
    Warnings warnings;
    std::vector<std::string> materials;
    std::string device;
    double max_force_n = 0, rate_hz = 0;
    bool arm = false;               // motors move a person's hand
    std::string audio = "browser";  // who sounds: browser, native or off
    std::string resume;             // the token with which this client may come back
    bool resumed = false;           // it came back
};

// What a page is told first.
std::string live_server_info(const LiveServerInfo& info);
// What is set now.
std::string live_settings(const LiveSettings& settings);
// That a command was refused.
std::string live_refusal(const Error& error);
// That frames were dropped: the page asks for all of them with resync.
std::string live_lost();

}  // namespace tribo::protocol
