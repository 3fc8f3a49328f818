// SPDX-License-Identifier: MIT
// The commands of a page (docs/live-protocol.md) and the settings that they change: what there is, and within
// which bounds.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "base/limits.hpp"
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
    cases,   // on: whether bands come from cases
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

// The number of cases from which bands come unless told.
inline constexpr std::size_t kBandCases = 40;

// What a page may set, and within which bounds.
struct LiveSettings {
    double feed_percent = 100, spindle_percent = 100;  // overrides
    double helix_deg = 30;
    double force_scale = 0.01;  // newtons at the hand per newton at the tool
    double jnd = 0.5;           // worst error of the force table
    std::string material;
    bool cut_mode = true, cutting_force = true, stopped = false;
    // The job knows something with a spread only. A page cannot set it.
    bool has_spread = false;
    // Bands come from cases of what has a spread. A page cannot set their number.
    bool cases = false;
    std::size_t case_count = kBandCases;
    bool operator==(const LiveSettings&) const = default;
};
struct LiveNumber {
    std::string_view key;
    double LiveSettings::* member;
    Limit limit;
};
inline constexpr std::array kLiveNumbers{
    LiveNumber{"feed_percent", &LiveSettings::feed_percent, kLimits.override_percent},
    LiveNumber{"spindle_percent", &LiveSettings::spindle_percent, kLimits.override_percent},
    LiveNumber{"helix_deg", &LiveSettings::helix_deg, kLimits.helix},
    LiveNumber{"force_scale", &LiveSettings::force_scale, kLimits.force_scale},
    LiveNumber{"jnd", &LiveSettings::jnd, kLimits.table_error},
};

// What an operation brings along, under which key: a number, a flag or a word; a place and whether it is
// down; the key of kLiveNumbers and its number.
enum class LiveArgument { nothing, number, flag, word, place, setting };
struct LiveOperation {
    std::string_view name;
    LiveOp op;
    LiveArgument argument;
    const char* key = "value";
};
inline constexpr std::array kLiveOperations{
    LiveOperation{"play", LiveOp::play, LiveArgument::nothing},
    LiveOperation{"pause", LiveOp::pause, LiveArgument::nothing},
    LiveOperation{"speed", LiveOp::speed, LiveArgument::number},
    LiveOperation{"seek", LiveOp::seek, LiveArgument::number, "t_s"},
    LiveOperation{"resync", LiveOp::resync, LiveArgument::nothing},
    LiveOperation{"finger", LiveOp::finger, LiveArgument::place, "position_mm"},
    LiveOperation{"mode", LiveOp::mode, LiveArgument::word},
    LiveOperation{"force", LiveOp::force, LiveArgument::flag},
    LiveOperation{"cases", LiveOp::cases, LiveArgument::flag},
    LiveOperation{"stop", LiveOp::stop, LiveArgument::nothing},
    LiveOperation{"release", LiveOp::release, LiveArgument::nothing},
    LiveOperation{"set", LiveOp::set, LiveArgument::setting},
    LiveOperation{"material", LiveOp::material, LiveArgument::word},
};

// Refused: the name is of no operation.
Result<LiveOperation> find_live_operation(std::string_view name);

// Refuses numbers that are not finite or out of range, and words that are no key and no mode. Whether there
// is such a material is not looked up.
Result<void> check_live_command(const LiveOperation& operation, const LiveCommand& command);

// That an operation came without `what` it needs.
std::unexpected<Error> live_operation_needs(const LiveOperation& operation, const char* what);

// What is set now, as the text that a page is told.
std::string live_settings(const LiveSettings& settings);

}  // namespace tribo::protocol
