// SPDX-License-Identifier: MIT
#include "protocol/live_message.hpp"

#include <limits>

#include "files/json/json.hpp"

namespace tribo::protocol {
namespace {

// Not a number where it is none: check_live_command() refuses that.
double number_of(const files::Json& json) {
    return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

// What the operation brings along.
Result<void> read_argument(const LiveOperation& operation, const files::Json& json, LiveCommand& command) {
    const auto value = json.find(operation.key);
    const bool given = value != json.end();
    switch (operation.argument) {
        case LiveArgument::nothing:
            return {};
        case LiveArgument::setting: {
            const auto key = json.find("key");
            if (key != json.end() && key->is_string()) command.word = key->get<std::string>();
            [[fallthrough]];
        }
        case LiveArgument::number:
            command.value = number_of(given ? *value : files::Json());
            return {};
        case LiveArgument::flag:
            if (!given || !value->is_boolean()) return live_operation_needs(operation, "true or false");
            command.on = value->get<bool>();
            return {};
        case LiveArgument::word:
            if (!given || !value->is_string()) return live_operation_needs(operation, "a word");
            command.word = value->get<std::string>();
            return {};
        case LiveArgument::place: {
            const auto down = json.find("down");
            command.on = down != json.end() && down->is_boolean() && down->get<bool>();
            if (!command.on) return {};
            if (!given || !value->is_array() || value->size() != 3)
                return live_operation_needs(operation, "three numbers");
            command.position_mm = {number_of((*value)[0]), number_of((*value)[1]), number_of((*value)[2])};
            return {};
        }
    }
    return {};
}

}  // namespace

Result<LiveCommand> parse_live_command(std::string_view text) {
    const files::Json json = files::parse(text);
    if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
        return fail("the message is no JSON object with an op", "send {\"op\": \"play\"}");
    const auto operation = find_live_operation(json["op"].get<std::string>());
    if (!operation) return std::unexpected(operation.error());
    LiveCommand command;
    command.op = operation->op;
    if (auto read = read_argument(*operation, json, command); !read) return std::unexpected(read.error());
    if (auto good = check_live_command(*operation, command); !good) return std::unexpected(good.error());
    return command;
}

namespace {

files::Json lines_of(const Warnings& warnings) {
    files::Json lines = files::Json::array();
    for (const Warning& warning : warnings) lines.push_back(warning.message());
    return lines;
}

}  // namespace

std::string live_server_info(const LiveServerInfo& info) {
    files::Json json;
    json["op"] = "serverInfo";
    json["version"] = info.version;
    json["warnings"] = lines_of(info.warnings);
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

std::string live_refusal(const Error& error) {
    files::Json json;
    json["op"] = "refused";
    json["why"] = error.cause;
    json["remedy"] = error.remedy;
    return files::dump(json);
}

std::string live_files(const std::optional<Error>& wrong, const Warnings& warnings) {
    files::Json json;
    json["op"] = "files";
    json["warnings"] = lines_of(warnings);
    json["wrong"] = nullptr;
    if (wrong) {
        json["wrong"] = {{"file", wrong->file},
                         {"line", wrong->line},
                         {"column", wrong->column},
                         {"why", wrong->cause},
                         {"remedy", wrong->remedy}};
    }
    return files::dump(json);
}

std::string live_lost() {
    return R"({"op":"lost"})";
}

}  // namespace tribo::protocol
