// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <utility>

#include "base/math.hpp"
#include "job/toml/machine_file.hpp"
#include "job/toml/sections.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kMachineKeys{
    "rapid_mm_per_min"sv, "acceleration_mm_per_s2"sv, "based_on"sv, "axes"sv, "limits_mm"sv,
    "stock_mm"sv,         "tool_length_mm"sv};
constexpr std::array kAxisKeys{"word"sv,     "carries"sv,   "direction"sv,  "pivot_mm"sv,         "zero_mm"sv,
                               "zero_deg"sv, "limits_mm"sv, "limits_deg"sv, "speed_deg_per_min"sv};
constexpr std::array kAxisWords{"X"sv, "Y"sv, "Z"sv, "A"sv, "B"sv, "C"sv};
constexpr std::array kCarriedWords{"part"sv, "tool"sv};

constexpr Limit kAxisSpeed{"speed of a rotary axis",
                           "deg/min",
                           {1, 1e7},
                           "`speed_deg_per_min`",
                           "A table of a lathe turns a few thousand times a minute; nobody mills at that."};

motion::MachineAxis* find_axis(motion::Machine& machine, char word) {
    for (auto* side : {&machine.part_side, &machine.tool_side}) {
        for (motion::MachineAxis& axis : *side) {
            if (axis.word == word) return &axis;
        }
    }
    return nullptr;
}

// The place of a new axis at the end of the side that it belongs to.
motion::MachineAxis* add_axis(TomlSection& section, motion::Machine& machine, char word) {
    for (const std::string_view key : {"carries"sv, "direction"sv}) {
        if (!section.has(key)) section.missing(key);
    }
    auto& side =
        section.word("carries", kCarriedWords).value_or(0) == 0 ? machine.part_side : machine.tool_side;
    side.push_back({.word = word});
    return &side.back();
}

// One of [[machine.axes]]: a new axis, or what is different about one that the machine has.
void read_axis(TomlFile& file, const toml::table& table, motion::Machine& machine, bool may_change) {
    TomlSection section(file, table, "an axis", kAxisKeys);
    if (!section.has("word")) section.missing("word");
    const auto index = section.word("word", kAxisWords);
    if (!index || !file.ok()) return;
    const char word = kAxisWords[*index][0];
    motion::MachineAxis* axis = find_axis(machine, word);
    if (axis != nullptr && !may_change) {
        section.fail("word", "the machine has two axes " + std::string(1, word),
                     "give each axis its own word");
    } else if (axis != nullptr && section.has("carries")) {
        section.fail("carries", "what carries what is settled by the machine that this one is based on",
                     "remove it, or describe all axes");
    }
    if (axis == nullptr) axis = add_axis(section, machine, word);
    const bool turns = axis->turns();
    for (const std::string_view key :
         {turns ? "zero_mm"sv : "zero_deg"sv, turns ? "limits_mm"sv : "limits_deg"sv}) {
        if (section.has(key)) {
            section.fail(key, "'" + std::string(key) + "' does not fit the axis " + std::string(1, word),
                         turns ? "write degrees, as zero_deg and limits_deg"
                               : "write millimetres, as zero_mm and limits_mm");
        }
    }
    if (section.has("speed_deg_per_min") && !turns) {
        section.fail("speed_deg_per_min", "a linear axis does not turn", "remove it");
    }
    if (const auto speed = section.number("speed_deg_per_min", kAxisSpeed); speed && turns)
        axis->max_speed = *speed * math::kRadPerDeg / 60;
    if (section.has("pivot_mm") && !turns) {
        section.fail("pivot_mm", "a linear axis has no pivot", "remove it");
    }
    const Vec3 direction = section.point("direction", kLimits.direction).value_or(axis->direction);
    if (!(length(direction) > 0)) section.fail("direction", "'direction' has no length", "try [1, 0, 0]");
    axis->direction = normalized(direction);
    axis->pivot_mm = section.point("pivot_mm").value_or(axis->pivot_mm);
    const double unit = turns ? math::kRadPerDeg : 1;
    const Limit& limit = turns ? kLimits.axis_limit : kLimits.coordinate;
    const std::string_view limits_key = turns ? "limits_deg"sv : "limits_mm"sv;
    if (const auto zero = section.number(turns ? "zero_deg"sv : "zero_mm"sv, limit))
        axis->zero = unit * *zero;
    const auto limits = section.numbers(limits_key, limit);
    if (!limits) return;
    if (limits->size() != 2 || !((*limits)[0] < (*limits)[1])) {
        section.fail(limits_key, "'" + std::string(limits_key) + "' is not a lower and an upper limit",
                     turns ? "try [-100, 50]" : "try [0, 400]");
        return;
    }
    axis->min = unit * (*limits)[0];
    axis->max = unit * (*limits)[1];
}

void limit_linear_axes(motion::Machine& machine, const Box3& box) {
    for (int k = 0; k < 3; ++k) {
        motion::MachineAxis& axis = *find_axis(machine, "XYZ"[k]);
        axis.min = box.min[k];
        axis.max = box.max[k];
    }
}

// The keys of a machine on top of the one named `base` (none where empty).
JobMachine read_table(TomlFile& file, const toml::table& table, const std::string& label, std::string base) {
    TomlSection section(file, table, label, kMachineKeys);
    JobMachine result;
    result.rapid_mm_per_min =
        section.number("rapid_mm_per_min", kLimits.rapid).value_or(result.rapid_mm_per_min);
    result.acceleration_mm_per_s2 =
        section.number_or_zero("acceleration_mm_per_s2", kLimits.acceleration).value_or(0);
    if (const auto named = section.text("based_on")) {
        if (!base.empty() && base != *named) {
            section.fail("based_on",
                         "[path] names the machine '" + base + "', and this one is based on '" + *named + "'",
                         "keep one of the two");
        }
        base = *named;
    }
    motion::Machine machine;
    machine.name = label.empty() ? file.name() : "described in " + file.name();
    if (!base.empty()) {
        Result<motion::Machine> named = motion::named_machine(base);
        if (!named) {
            section.fail("based_on", named.error().cause, named.error().remedy);
            return result;
        }
        machine = *std::move(named);
    }
    const std::vector<const toml::table*> axes = section.tables("axes");
    for (const toml::table* axis : axes) read_axis(file, *axis, machine, !base.empty());
    const auto limits = section.box("limits_mm");
    const auto stock = section.point("stock_mm");
    const auto tool = section.number("tool_length_mm", kLimits.tool_length);
    if (axes.empty() && base.empty()) {
        for (const std::string_view key : {"limits_mm"sv, "stock_mm"sv, "tool_length_mm"sv}) {
            if (section.has(key)) {
                section.fail(key, "'" + std::string(key) + "' belongs to a machine with axes",
                             "name one in [path] (machine = \"xyzac-trt\"), or describe its axes");
            }
        }
        return result;
    }
    motion::add_linear_axes(machine);
    if (limits) limit_linear_axes(machine, *limits);
    machine.stock_mm = stock.value_or(machine.stock_mm);
    machine.tool_length_mm = tool;
    if (!file.ok()) return result;
    if (const Result<void> good = motion::check(machine); !good) {
        section.fail("axes", good.error().cause, good.error().remedy);
    }
    result.kinematics = std::move(machine);
    return result;
}

FileResult<JobMachine> read_machine_file(const FileSource& files, const std::string& path, std::string base) {
    const FileResult<std::string> text = files.read(path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    const Result<toml::table> parsed = parse_toml(*text, path);
    if (!parsed) return std::unexpected(FileFailure(parsed.error()));
    TomlFile file(path);
    JobMachine machine = read_table(file, *parsed, "", std::move(base));
    if (!file.ok()) return std::unexpected(FileFailure(file.error()));
    return machine;
}

}  // namespace

FileResult<JobMachine> read_machine(TomlSection& job, const JobPath& path, const FileSource& files) {
    if (!job.file().ok()) return JobMachine{};
    const bool in_file = is_machine_file(path.machine);
    if (in_file && job.has("machine")) {
        job.fail("machine", "[path] names the machine of a file, and the job has a machine of its own",
                 "keep one of the two");
        return JobMachine{};
    }
    if (in_file) return read_machine_file(files, path.machine, "");
    if (job.has_text("machine")) {
        const auto file = job.path("machine");
        return file ? read_machine_file(files, *file, path.machine) : JobMachine{};
    }
    const toml::table empty;
    const toml::table* table = job.only_table("machine");
    return read_table(job.file(), table != nullptr ? *table : empty, "[machine]", path.machine);
}

FileResult<JobMachine> read_machine_named(const FileSource& files, const std::string& name_or_file) {
    if (is_machine_file(name_or_file)) return read_machine_file(files, name_or_file, "");
    Result<motion::Machine> named = motion::named_machine(name_or_file);
    if (!named) return std::unexpected(FileFailure(named.error()));
    JobMachine machine;
    machine.kinematics = *std::move(named);
    return machine;
}

}  // namespace tribo::job
