// SPDX-License-Identifier: MIT
#include "protocol/live_message.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "files/json/json.hpp"

namespace tribo::protocol {
namespace {

// What an operation brings along.
enum class With { nothing, number, flag, word, place, setting };

struct Operation {
    std::string_view name;
    LiveOp op;
    With with;
    const char* key = "value";  // of what it brings along
};
constexpr std::array kOperations{
    Operation{"play", LiveOp::play, With::nothing},
    Operation{"pause", LiveOp::pause, With::nothing},
    Operation{"speed", LiveOp::speed, With::number},
    Operation{"seek", LiveOp::seek, With::number, "t_s"},
    Operation{"resync", LiveOp::resync, With::nothing},
    Operation{"finger", LiveOp::finger, With::place, "position_mm"},
    Operation{"mode", LiveOp::mode, With::word},
    Operation{"force", LiveOp::force, With::flag},
    Operation{"stop", LiveOp::stop, With::nothing},
    Operation{"release", LiveOp::release, With::nothing},
    Operation{"set", LiveOp::set, With::setting},
    Operation{"material", LiveOp::material, With::word},
};

std::optional<double> finite(const files::Json& value) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) return std::nullopt;
    return value.get<double>();
}

std::optional<Vec3> place(const files::Json& value) {
    if (!value.is_array() || value.size() != 3) return std::nullopt;
    const auto x = finite(value[0]), y = finite(value[1]), z = finite(value[2]);
    if (!x || !y || !z) return std::nullopt;
    return Vec3{*x, *y, *z};
}

// The key and value of `set`.
Result<void> read_setting(const files::Json& json, LiveCommand& command) {
    const auto key = json.find("key"), value = json.find("value");
    const auto number = value == json.end() ? std::nullopt : finite(*value);
    if (key == json.end() || !key->is_string() || !number)
        return fail("'set' needs a key and a number", "give them as key and value");
    command.word = key->get<std::string>();
    command.value = *number;
    std::string known;
    for (const LiveNumber& n : kLiveNumbers) {
        if (n.key != command.word) {
            known += (known.empty() ? "" : ", ") + std::string(n.key);
            continue;
        }
        if (command.value >= n.least && command.value <= n.most) return {};
        char range[80];
        std::snprintf(range, sizeof range, "give a number from %g to %g", n.least, n.most);
        return fail("'" + command.word + "' is out of range", range);
    }
    return fail("'" + command.word + "' cannot be set", "the keys are " + known);
}

Result<void> read_value(const Operation& known, const files::Json& json, LiveCommand& command) {
    if (known.with == With::nothing) return {};
    if (known.with == With::setting) return read_setting(json, command);
    const auto value = json.find(known.key);
    const auto refuse = [&](const char* what) {
        return fail("'" + std::string(known.name) + "' needs " + what,
                    std::string("give it as ") + known.key);
    };
    if (known.with == With::number) {
        const auto number = value == json.end() ? std::nullopt : finite(*value);
        if (!number) return refuse("a number");
        command.value = *number;
    } else if (known.with == With::flag) {
        if (value == json.end() || !value->is_boolean()) return refuse("true or false");
        command.on = value->get<bool>();
    } else if (known.with == With::word) {
        if (value == json.end() || !value->is_string()) return refuse("a word");
        command.word = value->get<std::string>();
    } else {
        const auto down = json.find("down");
        command.on = down != json.end() && down->is_boolean() && down->get<bool>();
        const auto at = value == json.end() ? std::nullopt : place(*value);
        if (command.on && !at) return refuse("three numbers");
        command.position_mm = at.value_or(Vec3{});
    }
    return {};
}

}  // namespace

Result<LiveCommand> parse_live_command(std::string_view text) {
    const files::Json json = files::Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
        return fail("the message is no JSON object with an op", "send {\"op\": \"play\"}");
    const auto name = json["op"].get<std::string>();
    std::string known_names;
    for (const Operation& known : kOperations) {
        known_names += (known_names.empty() ? "" : ", ") + std::string(known.name);
        if (known.name != name) continue;
        LiveCommand command;
        command.op = known.op;
        if (auto read = read_value(known, json, command); !read) return std::unexpected(read.error());
        if (command.op == LiveOp::mode && command.word != "cut" && command.word != "inspect")
            return fail("'" + command.word + "' is no mode", "the modes are cut and inspect");
        return command;
    }
    return fail("'" + name + "' is not known", "the operations are " + known_names);
}

std::string live_server_info(const LiveServerInfo& info) {
    files::Json json;
    json["op"] = "serverInfo";
    json["version"] = info.version;
    json["warnings"] = files::Json::array();
    for (const Warning& warning : info.warnings) json["warnings"].push_back(warning.message());
    if (!info.job.empty()) {
        json["job"] = info.job;
        json["materials"] = info.materials;
        json["audio"] = info.audio;
        json["device"] = {{"name", info.device},
                          {"max_force_n", info.max_force_n},
                          {"rate_hz", info.rate_hz},
                          {"arm", info.arm}};
    }
    json["resume"] = info.resume;
    json["resumed"] = info.resumed;
    return files::dump(json);
}

std::string live_settings(const LiveSettings& settings) {
    files::Json json;
    json["op"] = "settings";
    for (const LiveNumber& n : kLiveNumbers) json[std::string(n.key)] = settings.*n.member;
    json["material"] = settings.material;
    json["mode"] = settings.cut_mode ? "cut" : "inspect";
    json["force"] = settings.cutting_force;
    json["stopped"] = settings.stopped;
    return files::dump(json);
}

std::string live_refusal(const Error& error) {
    files::Json json;
    json["op"] = "refused";
    json["why"] = error.cause;
    json["remedy"] = error.remedy;
    return files::dump(json);
}

std::string live_lost() {
    return R"({"op":"lost"})";
}

}  // namespace tribo::protocol
