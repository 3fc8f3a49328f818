// SPDX-License-Identifier: MIT
// `tribo stability JOB`: the flags.
#include "app/stability/stability.hpp"

#include <charconv>
#include <memory>
#include <string>
#include <vector>

#include "app/exit.hpp"
#include "app/options.hpp"
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

bool read_point(const std::string& text, StabilityPoint& point) {
    return read_numbers(text, {&point.spindle_rpm, &point.axial_depth_mm}) &&
           kLimits.spindle_speed.range.contains(point.spindle_rpm) &&
           kLimits.axial_depth.range.contains(point.axial_depth_mm);
}

bool read_speeds(const std::string& text, dynamics::ChartRange& range) {
    return read_numbers(text, {&range.from_rpm, &range.to_rpm, &range.step_rpm}) &&
           kLimits.spindle_speed.range.contains(range.from_rpm) &&
           kLimits.spindle_speed.range.contains(range.to_rpm) && range.speeds_rpm();
}

bool read_depths(const std::string& text, dynamics::ChartRange& range) {
    return read_numbers(text, {&range.most_mm, &range.step_mm}) &&
           kLimits.axial_depth.range.contains(range.most_mm) &&
           kLimits.axial_depth.range.contains(range.step_mm) && range.depths_mm();
}

// The message, or nothing if the text can be read.
CLI::Validator readable(const std::function<bool(const std::string&)>& reads, const std::string& what) {
    return CLI::Validator(
        [=](const std::string& text) { return reads(text) ? std::string() : "'" + text + "' is " + what; },
        "");
}

struct Flags {
    std::vector<std::string> at;
    std::string speeds, depths, simulate;
    int turns = 50;
};

constexpr int kMostTurns = 1'000'000;
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
        ->check(readable(
            [](const std::string& text) {
                dynamics::ChartRange range;
                return read_speeds(text, range);
            },
            "no range of speeds; write FROM:TO:STEP, as 5000:20000:100, within the ranges of docs/limits.md "
            "and with at most " +
                std::to_string(dynamics::kMostSpeeds) + " speeds"))
        ->type_name("FROM:TO:STEP");
    verb->add_option("--depth", flags->depths, "Axial depths of the chart, from one step to the largest, mm")
        ->check(readable(
            [](const std::string& text) {
                dynamics::ChartRange range;
                return read_depths(text, range);
            },
            "no range of depths; write MAX:STEP, as 3:0.05, within the ranges of docs/limits.md and with at "
            "most " +
                std::to_string(dynamics::kMostDepths) + " depths"))
        ->type_name("MAX:STEP");
    const CLI::Validator speed_and_depth = readable(
        [](const std::string& text) {
            StabilityPoint point;
            return read_point(text, point);
        },
        "no speed and depth; write RPM:MM, as 8000:1.5, within the ranges of docs/limits.md");
    verb->add_option("--at", flags->at, "Ask for this speed and axial depth; may be given often")
        ->check(speed_and_depth)
        ->type_name("RPM:MM");
    verb->add_option("--limit", call->limit_rpm, "Ask for the stable depth at this speed; may be given often")
        ->check(within(kLimits.spindle_speed))
        ->type_name("RPM");
    CLI::Option* simulate =
        verb->add_option("--simulate", flags->simulate,
                         "Simulate this speed and axial depth in time, from rest, into vibration.csv")
            ->check(speed_and_depth)
            ->type_name("RPM:MM");
    verb->add_option("--turns", flags->turns, "Turns of the spindle to simulate")
        ->check(CLI::Range(1, kMostTurns))
        ->needs(simulate)
        ->capture_default_str()
        ->type_name("N");
    verb->add_flag("--json", call->json, "Print one JSON object");
    verb->callback([call, flags, &exit_code] {
        const auto good = complete(*flags, *call);
        exit_code = good ? stability(*call) : report(good.error());
    });
}

}  // namespace tribo::app
