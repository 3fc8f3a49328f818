// SPDX-License-Identifier: MIT
#include "protocol/live_command.hpp"

#include <cmath>
#include <utility>

#include "base/text/decimal.hpp"
#include "base/text/json_writer.hpp"
#include "base/text/limit_text.hpp"

namespace tribo::protocol {
namespace {

// "a, b": the names of a table.
template <class Table>
std::string names_of(const Table& table, auto name) {
    std::string names;
    for (const auto& entry : table) names += (names.empty() ? "" : ", ") + std::string(entry.*name);
    return names;
}

Result<void> check_range(std::string cause, const Limit& limit, double value) {
    if (limit.range.contains(value)) return {};
    return fail(std::move(cause), range_remedy(limit));
}

Result<void> check_setting(const LiveCommand& command) {
    if (command.word.empty() || !std::isfinite(command.value))
        return fail("'set' needs a key and a number", "give them as key and value");
    for (const LiveNumber& n : kLiveNumbers) {
        if (n.key != command.word) continue;
        return check_range("'" + command.word + "' is out of range", n.limit, command.value);
    }
    return fail("'" + command.word + "' cannot be set",
                "the keys are " + names_of(kLiveNumbers, &LiveNumber::key));
}

}  // namespace

Result<LiveOperation> find_live_operation(std::string_view name) {
    for (const LiveOperation& known : kLiveOperations) {
        if (known.name == name) return known;
    }
    return fail("'" + std::string(name) + "' is not known",
                "the operations are " + names_of(kLiveOperations, &LiveOperation::name));
}

Result<void> check_live_command(const LiveOperation& operation, const LiveCommand& command) {
    const Vec3& p = command.position_mm;
    switch (operation.argument) {
        case LiveArgument::number:
            if (!std::isfinite(command.value)) return live_operation_needs(operation, "a number");
            return check_range("'" + std::string(operation.name) + "' is out of range",
                               operation.op == LiveOp::speed ? kLimits.play_speed : kLimits.program_time,
                               command.value);
        case LiveArgument::place:
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                return live_operation_needs(operation, "three numbers");
            for (const double place : {p.x, p.y, p.z}) {
                if (auto good = check_range("'" + std::string(operation.name) + "' is out of range",
                                            kLimits.coordinate, place);
                    !good)
                    return good;
            }
            break;
        case LiveArgument::setting:
            return check_setting(command);
        default:
            break;
    }
    if (operation.op == LiveOp::mode && command.word != "cut" && command.word != "inspect")
        return fail("'" + command.word + "' is no mode", "the modes are cut and inspect");
    return {};
}

std::unexpected<Error> live_operation_needs(const LiveOperation& operation, const char* what) {
    return fail("'" + std::string(operation.name) + "' needs " + what,
                std::string("give it as ") + operation.key);
}

std::string live_settings(const LiveSettings& settings) {
    JsonWriter json;
    json.begin_object().set("op", "settings");
    for (const LiveNumber& n : kLiveNumbers) json.set(n.key, settings.*n.member);
    json.set("material", settings.material);
    json.set("mode", settings.cut_mode ? "cut" : "inspect");
    json.set("force", settings.cutting_force).set("stopped", settings.stopped);
    json.set("has_spread", settings.has_spread).set("cases", settings.cases ? settings.case_count : 0);
    json.end_object();
    return json.text();
}

}  // namespace tribo::protocol
