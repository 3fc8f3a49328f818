// SPDX-License-Identifier: MIT
#include <array>

#include "job/toml/sections.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kCutterKeys{"number"sv,    "kind"sv,      "diameter_mm"sv, "corner_mm"sv,  "flutes"sv,
                                 "helix_deg"sv, "length_mm"sv, "runout_mm"sv,   "runout_deg"sv, "pitch_deg"sv,
                                 "holder"sv,    "core_mm"sv,   "stickout_mm"sv, "shank_mm"sv,   "neck_mm"sv,
                                 "reach_mm"sv,  "body"sv};
constexpr std::array kBodyWords{"carbide"sv, "hss"sv};  // in the order of CutterBody
constexpr std::array kHolderKeys{"diameter_mm"sv, "length_mm"sv};
constexpr std::size_t kMostHolderSteps = 100;  // each is followed through every move

// Steps from the bottom up: [[holder]] tables with one step each, or one [holder] whose keys are lists.
std::vector<milling::HolderStep> read_holder(TomlSection& owner) {
    std::vector<milling::HolderStep> steps;
    for (const toml::table* table : owner.tables("holder")) {
        TomlSection holder(owner.file(), *table, "[holder]", kHolderKeys);
        for (const std::string_view key : kHolderKeys) {
            if (!holder.has(key)) holder.missing(key);
        }
        const auto diameters = holder.numbers("diameter_mm", kLimits.holder);
        const auto lengths = holder.numbers("length_mm", kLimits.holder);
        if (!diameters || !lengths) continue;
        if (diameters->size() != lengths->size()) {
            holder.fail("length_mm",
                        "a holder of " + std::to_string(diameters->size()) + " diameters has " +
                            std::to_string(lengths->size()) + " lengths",
                        "give each step one of both, from the bottom up");
            continue;
        }
        if (steps.size() + diameters->size() > kMostHolderSteps) {
            holder.fail("diameter_mm",
                        "a holder of " + std::to_string(steps.size() + diameters->size()) +
                            " steps, more than " + std::to_string(kMostHolderSteps),
                        "join steps that differ little");
            continue;
        }
        for (std::size_t i = 0; i < diameters->size(); ++i) steps.push_back({(*diameters)[i], (*lengths)[i]});
    }
    return steps;
}

// milling::check names the key that is wrong; the message goes to the line of that key.
void check_cutter(TomlSection& section, const milling::Cutter& cutter) {
    const Result<void> checked = milling::check(cutter);
    if (checked || !section.file().ok()) return;
    std::string_view culprit = "kind";
    std::size_t earliest = std::string::npos;
    for (const std::string_view key : kCutterKeys) {
        const std::size_t at = checked.error().cause.find(key);
        if (at < earliest && key != "kind" && key != "number") {
            earliest = at;
            culprit = key;
        }
    }
    section.fail(culprit, checked.error().cause, checked.error().remedy);
}

milling::Cutter read_cutter(TomlFile& file, const toml::table& table, const std::string& label) {
    TomlSection section(file, table, label, kCutterKeys);
    milling::Cutter cutter;
    cutter.number = section.integer("number", kLimits.tool_number).value_or(0);
    if (!section.has("kind")) section.missing("kind");
    cutter.kind = static_cast<milling::CutterKind>(section.word("kind", kCutterKindWords).value_or(0));
    cutter.diameter_mm = section.required_number("diameter_mm", kLimits.cutter_diameter);
    if (cutter.kind == milling::CutterKind::bull) {
        cutter.corner_mm = section.required_number("corner_mm", kLimits.corner_radius);
    } else if (section.has("corner_mm")) {
        section.fail("corner_mm",
                     "a " + std::string(kCutterKindWords[static_cast<std::size_t>(cutter.kind)]) +
                         " cutter has no 'corner_mm'",
                     "remove it or write kind = \"bull\"");
    }
    cutter.flutes = section.integer("flutes", kLimits.flutes).value_or(cutter.flutes);
    cutter.helix_deg = section.number("helix_deg", kLimits.helix).value_or(cutter.helix_deg);
    cutter.core_mm = section.number("core_mm", kLimits.core_diameter).value_or(0);
    cutter.length_mm = section.number("length_mm", kLimits.cutting_length).value_or(cutter.length_mm);
    cutter.runout_mm = section.number("runout_mm", kLimits.runout).value_or(0);
    cutter.runout_deg = section.number("runout_deg", kLimits.runout_angle).value_or(0);
    cutter.pitch_deg = section.numbers("pitch_deg", kLimits.pitch).value_or(std::vector<double>());
    cutter.stickout_mm = section.number("stickout_mm", kLimits.stickout).value_or(0);
    cutter.shank_mm = section.number("shank_mm", kLimits.shank_diameter).value_or(0);
    cutter.neck_mm = section.number("neck_mm", kLimits.shank_diameter).value_or(0);
    cutter.reach_mm = section.number("reach_mm", kLimits.stickout).value_or(0);
    cutter.body = static_cast<milling::CutterBody>(section.word("body", kBodyWords).value_or(0));
    cutter.holder = read_holder(section);
    check_cutter(section, cutter);
    return cutter;
}

}  // namespace

std::vector<milling::Cutter> read_cutters(TomlSection& job) {
    const std::vector<const toml::table*> tables = job.tables("cutter");
    const std::string label = tables.size() > 1 ? "[[cutter]]" : "[cutter]";
    std::vector<milling::Cutter> cutters;
    for (const toml::table* table : tables) {
        const milling::Cutter cutter = read_cutter(job.file(), *table, label);
        if (tables.size() > 1 && cutter.number == 0) {
            job.file().fail(table->source(), "one of several cutters has no 'number'",
                            "add number = T, the tool number by which the program calls it");
        }
        for (const milling::Cutter& other : cutters) {
            if (other.number != cutter.number || cutter.number == 0) continue;
            job.file().fail(table->get("number")->source(),
                            "two cutters have the number " + std::to_string(cutter.number),
                            "give each its own");
        }
        cutters.push_back(cutter);
    }
    const std::vector<milling::HolderStep> common = read_holder(job);
    for (milling::Cutter& cutter : cutters) {
        if (cutter.holder.empty()) cutter.holder = common;
    }
    return cutters;
}

}  // namespace tribo::job
