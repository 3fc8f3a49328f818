// SPDX-License-Identifier: MIT
// `tribo stability JOB`: the flags.
#include "app/stability/stability.hpp"

#include <charconv>
#include <memory>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/options.hpp"
#include "app/uncertain_flag.hpp"
#include "app/verbs/verbs.hpp"
#include "base/limits.hpp"
#include "base/text/limit_text.hpp"

namespace tribo::app {
namespace {

// Numbers with colons between them: false if there are more or fewer.
bool read_numbers(std::string_view text, std::initializer_list<double*> values) {
    const char* at = text.data();
    const char* const end = at + text.size();
    bool first = true;
    for (double* value : values) {
        if (!first && (at == end || *at++ != ':')) return false;
        first = false;
        const auto [next, error] = std::from_chars(at, end, *value);
        if (error != std::errc()) return false;
        at = next;
    }
    return at == end;
}

// What is wrong with the value; empty: nothing.
std::string outside(const Limit& limit, double value) {
    return limit.range.contains(value) ? std::string()
                                       : out_of_range(limit, value) + "; " + range_remedy(limit);
}

std::string first_of(std::initializer_list<std::string> errors) {
    for (const std::string& error : errors)
        if (!error.empty()) return error;
    return {};
}

// These read a flag and return what is wrong with it.
std::string read_point(const std::string& text, StabilityPoint& point) {
    if (!read_numbers(text, {&point.spindle_rpm, &point.axial_depth_mm}))
        return "'" + text + "' is no speed and depth; write RPM:MM, as 8000:1.5";
    return first_of({outside(kLimits.spindle_speed, point.spindle_rpm),
                     outside(kLimits.axial_depth, point.axial_depth_mm)});
}

std::string read_speeds(const std::string& text, dynamics::ChartRange& range) {
    if (!read_numbers(text, {&range.from_rpm, &range.to_rpm, &range.step_rpm}))
        return "'" + text + "' is no range of speeds; write FROM:TO:STEP, as 5000:20000:100";
    const std::string error = first_of(
        {outside(kLimits.spindle_speed, range.from_rpm), outside(kLimits.spindle_speed, range.to_rpm)});
    if (!error.empty() || range.speeds_rpm()) return error;
    return "'" + text + "' is no range of speeds; write FROM:TO:STEP with FROM to TO and at most " +
           std::to_string(dynamics::kMostSpeeds) + " speeds";
}

std::string read_depths(const std::string& text, dynamics::ChartRange& range) {
    if (!read_numbers(text, {&range.most_mm, &range.step_mm}))
        return "'" + text + "' is no range of depths; write MAX:STEP, as 3:0.05";
    const std::string error =
        first_of({outside(kLimits.axial_depth, range.most_mm), outside(kLimits.axial_depth, range.step_mm)});
    if (!error.empty() || range.depths_mm()) return error;
    return "'" + text + "' is no range of depths; write MAX:STEP with a step of at most MAX and at most " +
           std::to_string(dynamics::kMostDepths) + " depths";
}

template <class Value>
CLI::Validator readable(std::string (*read)(const std::string&, Value&)) {
    return CLI::Validator(
        [read](const std::string& text) {
            Value value;
            return read(text, value);
        },
        "");
}

struct Flags {
    std::vector<std::string> at;
    std::string speeds, depths, simulate;
    int turns = 50;
};

constexpr double kLongestSimulationS = 60;  // a file of some 300 MB

Result<void> read_simulation(const Flags& flags, StabilityCall& call) {
    StabilityPoint point;
    read_point(flags.simulate, point);
    const session::Simulation simulation{point.spindle_rpm, point.axial_depth_mm, flags.turns};
    if (simulation.lasts_s() > kLongestSimulationS) {
        const auto fitting = static_cast<int>(kLongestSimulationS * point.spindle_rpm / 60);
        return fail(
            "--simulate would last " + plain_number(simulation.lasts_s()) + " s, and " +
                plain_number(kLongestSimulationS) + " s are the most",
            fitting > 0 ? "ask for at most --turns " + std::to_string(fitting) : "ask for a higher speed");
    }
    call.simulation = simulation;
    return {};
}

// What is checked already is read; the rest of the call is checked.
Result<void> complete(const Flags& flags, StabilityCall& call) {
    for (const std::string& text : flags.at) read_point(text, call.at.emplace_back());
    if (!flags.speeds.empty()) read_speeds(flags.speeds, call.speeds.emplace());
    if (!flags.depths.empty()) read_depths(flags.depths, call.depths.emplace());
    if (!flags.simulate.empty()) {
        if (auto good = read_simulation(flags, call); !good) return good;
        if (call.out.empty())
            return fail("--simulate writes vibration.csv, and no folder is named for it", "add --out DIR");
    }
    if (call.wants_chart()) return {};
    const auto without_chart = [](const std::string& flag) {
        return fail(flag + " is for a chart, and --at, --limit and --simulate ask for none",
                    "add --rpm FROM:TO:STEP, or leave " + flag + " out");
    };
    if (!call.out.empty() && !call.simulation) return without_chart("--out");
    if (call.depths) return without_chart("--depth");
    return {};
}

}  // namespace

void add_stability(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<StabilityCall>();
    const auto flags = std::make_shared<Flags>();
    CLI::App* verb = program.add_subcommand(
        "stability", "Say whether a cut chatters, from which depth on, and at which speeds it does not");
    verb->add_option("JOB", call->job, "Job file (TOML) with modes")->required();
    verb->add_option("--out", call->out, "Folder for the files; an older one of Tribo's is replaced whole")
        ->type_name("DIR");
    CLI::Option* line =
        verb->add_option("--line", call->place.line, "The cut of this line of the program, where it is worst")
            ->check(CLI::PositiveNumber)
            ->type_name("N");
    verb->add_option("--t", call->place.t_s, "The cut at this time of the program")
        ->check(within(kLimits.until))
        ->type_name("S")
        ->excludes(line);
    verb->add_option("--resolution", call->resolution_mm, "Spacing of the grid that finds the surface")
        ->check(within(kLimits.resolution))
        ->type_name("MM");
    verb->add_option("--rpm", flags->speeds, "Speeds of the chart")
        ->check(readable(read_speeds))
        ->type_name("FROM:TO:STEP");
    verb->add_option("--depth", flags->depths, "Axial depths of the chart, from one step to the largest, mm")
        ->check(readable(read_depths))
        ->type_name("MAX:STEP");
    verb->add_option("--at", flags->at, "Ask for this speed and axial depth; may be given often")
        ->check(readable(read_point))
        ->type_name("RPM:MM");
    verb->add_option("--limit", call->limit_rpm, "Ask for the stable depth at this speed; may be given often")
        ->check(within(kLimits.spindle_speed))
        ->type_name("RPM");
    CLI::Option* simulate =
        verb->add_option("--simulate", flags->simulate,
                         "Simulate this speed and axial depth in time, from rest, into vibration.csv")
            ->check(readable(read_point))
            ->type_name("RPM:MM");
    verb->add_option("--turns", flags->turns, "Turns of the spindle to simulate")
        ->check(within(kLimits.turns))
        ->needs(simulate)
        ->capture_default_str()
        ->type_name("N");
    add_uncertain(*verb, call->uncertain);
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->callback([call, flags, &exit_code] {
        const auto good = complete(*flags, *call);
        exit_code = good ? stability(*call) : report(good.error());
    });
}

}  // namespace tribo::app
