// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "base/text/limit_text.hpp"
#include "job/toml/sections.hpp"
#include "job/words/tool_words.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kCutterKeys{
    "number"sv,    "kind"sv,        "diameter_mm"sv, "corner_mm"sv,     "flutes"sv,    "helix_deg"sv,
    "length_mm"sv, "runout_mm"sv,   "runout_deg"sv,  "runout_spread"sv, "pitch_deg"sv, "holder"sv,
    "core_mm"sv,   "stickout_mm"sv, "shank_mm"sv,    "neck_mm"sv,       "reach_mm"sv,  "body"sv,
    "tip_mm"sv,    "point_deg"sv,   "taper_deg"sv,   "side_mm"sv,       "height_mm"sv, "profile"sv};
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

// The room names the key that is wrong; the message goes to the line of that key.
void report(TomlSection& section, const Result<void>& checked) {
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

std::string word_of(const milling::Cutter& cutter) {
    return std::string(kCutterKindWords[static_cast<std::size_t>(cutter.kind)]);
}

void read_kind(TomlSection& section, milling::Cutter& cutter) {
    if (section.has("kind")) {
        cutter.kind = static_cast<milling::CutterKind>(section.word("kind", kCutterKindWords).value_or(0));
    } else if (section.has("profile")) {
        cutter.kind = milling::CutterKind::profile;
    } else {
        section.missing("kind");
    }
    if (section.has("profile") && cutter.kind != milling::CutterKind::profile)
        section.fail("profile", "a " + word_of(cutter) + " cutter has no 'profile'",
                     "remove it or write kind = \"profile\"");
}

// The numbers and vertices that shape a cutter, and what follows from them.
void read_shape(TomlSection& section, milling::Cutter& cutter) {
    using milling::CutterKind;
    for (const milling::ShapeKey& key : milling::kShapeKeys) {
        if (milling::is_shape_key(cutter.kind, key.name)) {
            cutter.*key.value = cutter.kind == CutterKind::bull
                                    ? section.required_number(key.name, key.limit)
                                    : section.number(key.name, key.limit).value_or(0);
        } else if (section.has(key.name) && key.name != "neck_mm") {
            section.fail(key.name, "a " + word_of(cutter) + " cutter has no '" + std::string(key.name) + "'",
                         key.name == "corner_mm" && !cutter.has_profile()
                             ? "remove it or write kind = \"bull\""
                             : "remove it or write another kind");
        }
    }
    const auto length = section.number("length_mm", kLimits.cutting_length);
    if (!cutter.has_profile()) {
        cutter.length_mm = length.value_or(cutter.length_mm);
        return;
    }
    cutter.length_mm = milling::has_own_length(cutter.kind) ? 0 : length.value_or(0);
    const auto vertices =
        section.triples("profile", {kLimits.profile_coordinate, kLimits.profile_coordinate, kLimits.bulge},
                        "at most 200 vertices [[r, z], [r, z, bulge], ...]", 2);
    if (vertices)
        for (const auto& [r, z, bulge] : *vertices) cutter.profile.push_back({r, z, bulge});
    if (!section.file().ok()) return;
    report(section, milling::make_profile(cutter));
    if (length && section.file().ok() && std::abs(*length - cutter.length_mm) > 1e-6)
        section.fail("length_mm",
                     "the edges of this " + word_of(cutter) + " end " + plain_number(cutter.length_mm) +
                         " mm above the tip",
                     "leave length_mm out");
}

milling::Cutter read_cutter(TomlFile& file, const toml::table& table, const std::string& label) {
    TomlSection section(file, table, label, kCutterKeys);
    milling::Cutter cutter;
    cutter.number = section.integer("number", kLimits.tool_number).value_or(0);
    read_kind(section, cutter);
    if (cutter.kind != milling::CutterKind::profile) {
        cutter.diameter_mm = section.required_number("diameter_mm", kLimits.cutter_diameter);
    } else if (section.has("diameter_mm")) {
        section.fail("diameter_mm", "a profile says its diameter itself", "remove diameter_mm");
    }
    cutter.flutes = section.integer("flutes", kLimits.flutes).value_or(cutter.flutes);
    cutter.helix_deg =
        section.number("helix_deg", kLimits.helix).value_or(milling::usual_helix_deg(cutter.kind));
    cutter.core_mm = section.number("core_mm", kLimits.core_diameter).value_or(0);
    cutter.runout_mm = section.number("runout_mm", kLimits.runout).value_or(0);
    cutter.runout_spread = section.number("runout_spread", kLimits.spread).value_or(0);
    cutter.runout_deg = section.number("runout_deg", kLimits.runout_angle).value_or(0);
    cutter.pitch_deg = section.numbers("pitch_deg", kLimits.pitch).value_or(std::vector<double>());
    cutter.stickout_mm = section.number("stickout_mm", kLimits.stickout).value_or(0);
    cutter.shank_mm = section.number("shank_mm", kLimits.shank_diameter).value_or(0);
    cutter.neck_mm = section.number("neck_mm", kLimits.shank_diameter).value_or(0);
    cutter.reach_mm = section.number("reach_mm", kLimits.stickout).value_or(0);
    cutter.body = static_cast<milling::CutterBody>(section.word("body", kBodyWords).value_or(0));
    cutter.holder = read_holder(section);
    read_shape(section, cutter);
    report(section, milling::check(cutter));
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
