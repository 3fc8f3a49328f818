// SPDX-License-Identifier: MIT
#include "io/live_message.hpp"

#include <array>
#include <cmath>

#include "io/json.hpp"

namespace tribo::io {
namespace {

struct Operation {
    std::string_view name;
    LiveOp op;
    const char* value;  // the key of its number; null: it has none
};
constexpr std::array kOperations{
    Operation{"play", LiveOp::play, nullptr},     Operation{"pause", LiveOp::pause, nullptr},
    Operation{"speed", LiveOp::speed, "value"},   Operation{"seek", LiveOp::seek, "t_s"},
    Operation{"resync", LiveOp::resync, nullptr},
};

}  // namespace

Result<LiveCommand> parse_live_command(std::string_view text) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
        return fail("the message is no JSON object with an op", "send {\"op\": \"play\"}");
    const auto name = json["op"].get<std::string>();
    for (const Operation& known : kOperations) {
        if (known.name != name) continue;
        LiveCommand command{known.op, 0};
        if (known.value == nullptr) return command;
        const auto value = json.find(known.value);
        if (value == json.end() || !value->is_number() || !std::isfinite(value->get<double>()))
            return fail("'" + name + "' needs a number", std::string("give it as ") + known.value);
        command.value = value->get<double>();
        return command;
    }
    return fail("'" + name + "' is not known", "the operations are play, pause, speed, seek and resync");
}

std::string live_server_info(const std::string& version, const std::string& job, const Warnings& warnings) {
    Json json;
    json["op"] = "serverInfo";
    json["version"] = version;
    json["job"] = job;
    json["warnings"] = Json::array();
    for (const Warning& warning : warnings) json["warnings"].push_back(warning.message());
    return dump(json);
}

std::string live_refusal(const Error& error) {
    Json json;
    json["op"] = "refused";
    json["why"] = error.cause;
    json["remedy"] = error.remedy;
    return dump(json);
}

std::string live_lost() {
    return R"({"op":"lost"})";
}

}  // namespace tribo::io
