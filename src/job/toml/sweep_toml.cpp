// SPDX-License-Identifier: MIT
#include "job/toml/sweep_toml.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/decimal.hpp"
#include "job/toml/toml_section.hpp"
#include "sweep/sobol_sequence.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

static_assert(2 * kMostSampledAxes <= sweep::kMostSobolDimensions);

constexpr std::array kRootKeys{"base"sv,    "programs"sv, "compute"sv, "resolution_mm"sv,
                               "until_s"sv, "axes"sv,     "sample"sv};
constexpr std::array kSampleKeys{"design"sv, "n"sv};
constexpr std::array kDesigns{"grid"sv, "sobol"sv};                           // as sweep::Design
constexpr std::array kResults{"summary"sv, "audit"sv, "stability"sv};         // as SweepResult
constexpr std::array kRangeKeys{"from"sv, "to"sv, "step"sv, "count"sv};       // of an axis
constexpr std::array kDistributions{"uniform"sv, "normal"sv, "lognormal"sv};  // as DistributionKind

constexpr const char* kAxisForms =
    "write [1, 2, 3], {from=1, to=3, step=0.5}, {from=1, to=3, count=5}, {uniform=[1, 3]}, "
    "{normal=[mean, deviation]} or {lognormal=[median, spread]}";

struct FoundAxis {
    sweep::Axis axis;
    toml::source_region where;
};

class AxisReader {
  public:
    AxisReader(TomlFile& file, std::vector<FoundAxis>& axes) : file_(file), axes_(axes) {}

    // Dotted keys without quotes are tables in tables.
    void read(const toml::table& table, const std::string& prefix) {
        for (const auto& [key, node] : table) {
            const std::string name = prefix + std::string(key.str());
            const toml::table* below = node.as_table();
            if (below != nullptr && !is_axis(*below)) {
                read(*below, name + ".");
            } else {
                axes_.push_back({axis(name, node), node.source()});
            }
        }
    }

  private:
    static bool is_axis(const toml::table& table) {
        return std::ranges::any_of(table, [](const auto& entry) {
            const std::string_view key = entry.first.str();
            return std::ranges::count(kRangeKeys, key) + std::ranges::count(kDistributions, key) > 0 &&
                   !entry.second.is_table();
        });
    }

    void fail(const toml::node& node, const std::string& cause, const std::string& remedy = kAxisForms) {
        file_.fail(node.source(), cause, remedy);
    }

    sweep::Axis axis(const std::string& key, const toml::node& node) {
        sweep::Axis axis{key};
        if (const toml::array* array = node.as_array()) {
            for (const toml::node& element : *array) add_value(axis, element);
            if (array->empty()) fail(node, "axis '" + key + "' has no values");
        } else if (const toml::table* table = node.as_table()) {
            read_table(axis, *table);
        } else {
            add_value(axis, node);
        }
        if (axis.values.size() > kMostAxisValues)
            fail(node, "axis '" + key + "' has " + std::to_string(axis.values.size()) + " values",
                 "give at most " + std::to_string(kMostAxisValues));
        return axis;
    }

    void add_value(sweep::Axis& axis, const toml::node& node) {
        if (const auto number = node.value<double>(); number && node.is_number()) {
            if (!std::isfinite(*number)) return fail(node, "axis '" + axis.key + "' has a value without end");
            axis.values.emplace_back(*number);
        } else if (node.is_string()) {
            axis.values.emplace_back(*node.value<std::string>());
        } else if (node.is_boolean()) {
            axis.values.emplace_back(*node.value<bool>());
        } else {
            fail(node, "a value of axis '" + axis.key + "' is no number, text, true or false");
        }
    }

    void read_table(sweep::Axis& axis, const toml::table& table) {
        for (std::size_t kind = 0; kind < kDistributions.size(); ++kind) {
            if (!table.contains(kDistributions[kind])) continue;
            TomlSection section(file_, table, "axis " + axis.key, {&kDistributions[kind], 1});
            const auto numbers = section.numbers(kDistributions[kind], kAnyNumber);
            if (!numbers) return;
            if (numbers->size() != 2)
                return section.fail(kDistributions[kind], "a distribution has two numbers", kAxisForms);
            const double a = (*numbers)[0], b = (*numbers)[1];
            axis.distribution = {static_cast<sweep::DistributionKind>(kind), a, b};
            const bool good = kind == 0 ? a < b : b > 0 && (kind == 1 || a > 0);
            if (!good)
                section.fail(kDistributions[kind], "this is no distribution",
                             kind == 0   ? "write the smaller number first"
                             : kind == 1 ? "give a standard deviation above 0"
                                         : "give a median and a spread above 0");
            return;
        }
        read_range(axis, table);
    }

    void read_range(sweep::Axis& axis, const toml::table& table) {
        TomlSection section(file_, table, "axis " + axis.key, kRangeKeys);
        const double from = section.required_number("from", kAnyNumber),
                     to = section.required_number("to", kAnyNumber);
        const auto step = section.number("step", kAnyNumber), count = section.number("count", kAnyNumber);
        if (!file_.ok()) return;
        if (step.has_value() == count.has_value())
            return section.fail("from", "a range has either a step or a count", kAxisForms);
        // A last value that rounding puts a little beyond the end still belongs to the range.
        constexpr double kRounding = 1e-9;
        const double steps = step ? (to - from) / *step + kRounding : *count - 1;
        if (!(steps >= 0) || !(steps < static_cast<double>(kMostAxisValues)) ||
            (count && *count != std::floor(*count)))
            return section.fail(step ? "step" : "count", "the range has no values, or too many",
                                "let the step lead from 'from' to 'to' in at most " +
                                    std::to_string(kMostAxisValues) + " values, or give a whole count");
        const auto last = static_cast<std::size_t>(steps);
        for (std::size_t n = 0; n <= last; ++n) {
            const double share = last == 0 ? 0 : static_cast<double>(n) / static_cast<double>(last);
            axis.values.emplace_back(step ? from + static_cast<double>(n) * *step
                                          : from + share * (to - from));
        }
    }

    static constexpr Limit kAnyNumber{"number of an axis", "", {-1e300, 1e300}, "", ""};

    TomlFile& file_;
    std::vector<FoundAxis>& axes_;
};

void read_results(TomlSection& root, const toml::table& table, Sweep& sweep) {
    const toml::node* node = table.get("compute");
    std::vector<std::string> words;
    if (node == nullptr) {
        words = {"summary"};
    } else if (const toml::array* array = node->as_array()) {
        for (const toml::node& element : *array) words.push_back(element.value_or(std::string()));
    } else {
        words.push_back(node->value_or(std::string()));
    }
    for (const std::string& word : words) {
        const auto found = std::ranges::find(kResults, word);
        if (found == kResults.end())
            return root.fail("compute", "'" + word + "' cannot be computed",
                             "name some of \"summary\", \"audit\" and \"stability\"");
        const auto result = static_cast<SweepResult>(found - kResults.begin());
        if (std::ranges::count(sweep.compute, result) == 0) sweep.compute.push_back(result);
    }
    if (sweep.compute.empty()) root.fail("compute", "nothing is computed", "name \"summary\"");
}

void read_sample(TomlFile& file, const toml::table& table, Sweep& sweep) {
    TomlSection sample(file, table, "[sample]", kSampleKeys);
    if (const auto design = sample.word("design", kDesigns))
        sweep.plan.design = static_cast<sweep::Design>(*design);
    constexpr Limit kPoints{"number of points", "", {1, 4294967295.0}, "n", ""};
    const auto points = sample.number("n", kPoints);
    const bool sampled = sweep.plan.design == sweep::Design::sobol;
    if (sampled && !points) sample.missing("n");
    if (!sampled && points)
        sample.fail("n", "a grid has every combination, and no number of points",
                    "remove n, or write design = \"sobol\"");
    if (points && *points != std::floor(*points))
        sample.fail("n", "n is no whole number", "write a whole number of points");
    sweep.plan.points = static_cast<std::uint64_t>(points.value_or(0));
}

void check_plan(TomlSection& root, const std::vector<FoundAxis>& axes, const Sweep& sweep) {
    const bool sampled = sweep.plan.design == sweep::Design::sobol;
    for (const FoundAxis& found : axes) {
        if (!sampled && found.axis.distribution)
            root.file().fail(found.where, "a grid cannot go through a distribution",
                             "write design = \"sobol\" and n under [sample], or a list of values");
        if (found.axis.key == kProgramAxis)
            root.file().fail(found.where, "'program' is the axis of the folder `programs`",
                             "write programs = \"FOLDER\" instead, or change path.gcode");
    }
    if (sampled && axes.empty()) root.fail("sample", "there are no axes to sample", "add [axes]");
    if (sampled && axes.size() > kMostSampledAxes)
        root.fail("axes", "Sobol's points reach for " + std::to_string(kMostSampledAxes) + " axes",
                  "leave out those that matter least");
    if (sweep.plan.cases() > kMostSweepCases)
        root.fail("axes", "the sweep has more than " + std::to_string(kMostSweepCases) + " cases",
                  "let fewer axes change at once, or sample with design = \"sobol\"");
}

}  // namespace

Result<Sweep> parse_sweep(std::string_view text, const std::string& name) {
    const Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) return std::unexpected(parsed.error());
    TomlFile file(name);
    TomlSection root(file, *parsed, "", kRootKeys);
    Sweep sweep;
    sweep.file = name;
    sweep.base = root.path("base").value_or("");
    sweep.programs = root.path("programs").value_or("");
    if (sweep.base.empty() && sweep.programs.empty())
        root.fail("base", "the sweep has no job", "write base = \"JOB.toml\", or programs = \"FOLDER\"");
    read_results(root, *parsed, sweep);
    sweep.resolution_mm = root.number("resolution_mm", kLimits.resolution);
    sweep.until_s = root.number("until_s", kLimits.until);
    std::vector<FoundAxis> axes;
    if (const auto* table = root.only_table("axes")) AxisReader(file, axes).read(*table, "");
    if (sweep.base.empty() && !axes.empty())
        file.fail(axes.front().where, "programs without a job have no keys to change",
                  "write base = \"JOB.toml\" too; its program is replaced");
    // Tables are sorted by key; the order of the file decides which axis changes first.
    std::ranges::sort(axes, {}, [](const FoundAxis& found) {
        return std::pair(found.where.begin.line, found.where.begin.column);
    });
    for (const FoundAxis& found : axes) sweep.plan.axes.push_back(found.axis);
    if (const auto* table = root.only_table("sample")) read_sample(file, *table, sweep);
    if (file.ok()) check_plan(root, axes, sweep);
    if (!file.ok()) return std::unexpected(file.error());
    return sweep;
}

FileResult<Sweep> read_sweep(const FileSource& files, const std::string& path) {
    const FileResult<std::string> text = files.read(path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    auto sweep = parse_sweep(*text, path);
    if (!sweep) return std::unexpected(FileFailure(sweep.error()));
    return *std::move(sweep);
}

}  // namespace tribo::job
