// SPDX-License-Identifier: MIT
#include "io/job_toml.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/job_sections.hpp"

namespace tribo::io {
namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t kLargestJobBytes = std::uint64_t{4} << 20;
constexpr std::array kJobKeys{"part"sv, "stock"sv,      "cutter"sv, "holder"sv,  "material"sv, "process"sv,
                              "path"sv, "engagement"sv, "sound"sv,  "haptics"sv, "fixture"sv,  "machine"sv};

// The one table under `key`, empty where it is absent.
const toml::table* only_table(TomlSection& job, std::string_view key) {
    const std::vector<const toml::table*> tables = job.tables(key);
    if (tables.size() > 1) {
        job.fail(key, "there may be only one [" + std::string(key) + "]", "remove the others");
    }
    return tables.empty() ? nullptr : tables.front();
}

void read_all(TomlSection& root, formats::Job& job) {
    if (const auto* table = only_table(root, "part")) job.part = read_part(root.file(), *table);
    if (const auto* table = only_table(root, "stock")) {
        job.stock = read_solid(root.file(), *table, "[stock]");
    } else {
        root.missing("stock");
    }
    job.cutters = read_cutters(root);
    if (const auto* table = only_table(root, "material")) {
        job.material = read_material(root.file(), *table);
    } else {
        root.missing("material");
    }
    if (const auto* table = only_table(root, "path")) {
        job.path = read_path(root.file(), *table);
    } else {
        root.missing("path");
    }
    if (const auto* table = only_table(root, "process")) job.process = read_process(root.file(), *table);
    if (const auto* table = only_table(root, "engagement")) {
        job.engagement = read_engagement(root.file(), *table);
    }
    for (const toml::table* table : root.tables("fixture")) {
        job.fixtures.push_back(read_solid(root.file(), *table, "[[fixture]]"));
    }
    if (const auto* table = only_table(root, "sound")) job.sound = read_sound(root.file(), *table);
    if (const auto* table = only_table(root, "haptics")) job.haptics = read_haptics(root.file(), *table);
}

// [machine] is a table, or the name of a file that holds such a table.
FileResult<void> read_machine_or_file(TomlSection& root, const toml::table& table, formats::Job& job) {
    const toml::node* node = table.get("machine");
    if (!node) return {};
    if (!node->is_string()) {
        if (const auto* inside = only_table(root, "machine")) {
            job.machine = read_machine(root.file(), *inside, "[machine]");
        }
        return {};
    }
    const std::optional<std::string> path = root.path("machine");
    if (!path || !root.file().ok()) return {};
    const FileResult<std::string> text = read_file(*path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    const Result<toml::table> parsed = parse_toml(*text, *path);
    if (!parsed) return std::unexpected(Failure(parsed.error()));
    TomlFile file(*path);
    job.machine = read_machine(file, *parsed, "");
    if (!file.ok()) root.file().fail(file.error());
    return {};
}

}  // namespace

FileResult<formats::Job> parse_job(std::string_view text, const std::string& name) {
    const Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) return std::unexpected(Failure(parsed.error()));
    TomlFile file(name);
    formats::Job job;
    job.file = name;
    if (parsed->empty()) {
        return std::unexpected(Failure(
            {name, 1, 1, "the job is empty", "write at least [stock], [cutter], [material] and [path]"}));
    }
    TomlSection root(file, *parsed, "", kJobKeys);
    read_all(root, job);
    if (auto machine = read_machine_or_file(root, *parsed, job); !machine) {
        return std::unexpected(std::move(machine).error());
    }
    if (!file.ok()) return std::unexpected(Failure(file.error()));
    return job;
}

FileResult<formats::Job> read_job(const std::string& path) {
    const FileResult<std::string> text = read_file(path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    return parse_job(*text, path);
}

}  // namespace tribo::io
