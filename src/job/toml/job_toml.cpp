// SPDX-License-Identifier: MIT
#include "job/toml/job_toml.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "job/job_files.hpp"
#include "job/toml/job_changes.hpp"
#include "job/toml/sections.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kJobKeys{"part"sv,    "stock"sv, "setup"sv,      "cutter"sv, "holder"sv,  "material"sv,
                              "process"sv, "path"sv,  "engagement"sv, "sound"sv,  "haptics"sv, "fixture"sv,
                              "machine"sv, "mode"sv,  "dynamics"sv,   "frf"sv,    "limits"sv};

void read_all(TomlSection& root, Job& job) {
    if (const auto* table = root.only_table("part")) job.part = read_part(root.file(), *table);
    if (const auto* table = root.only_table("stock")) {
        read_stock(root.file(), *table, job);
    }
    if (const auto* table = root.only_table("setup")) {
        job.setup = read_setup(root.file(), *table);
        if (!job.stock_from) {
            root.fail("setup", "[setup] belongs to a stock that an earlier job leaves",
                      "write from = \"FIRST.toml\" into [stock], or remove [setup]");
        }
    }
    job.cutters = read_cutters(root);
    if (const auto* table = root.only_table("material")) {
        job.material = read_material(root.file(), *table);
    } else {
        root.missing("material");
    }
    if (const auto* table = root.only_table("path")) {
        job.path = read_path(root.file(), *table);
    } else {
        root.missing("path");
    }
    // A program may bring stock and tools itself; keyframes hold neither.
    if (job.path.kind == PathKind::keyframes) {
        if (!root.has("stock")) root.missing("stock");
        if (!root.has("cutter")) root.missing("cutter");
    }
    if (const auto* table = root.only_table("process")) job.process = read_process(root.file(), *table);
    if (const auto* table = root.only_table("engagement")) {
        job.engagement = read_engagement(root.file(), *table);
    }
    for (const toml::table* table : root.tables("fixture")) {
        job.fixtures.push_back(read_solid(root.file(), *table, "[[fixture]]"));
    }
    for (const toml::table* table : root.tables("mode")) job.modes.push_back(read_mode(root.file(), *table));
    for (const toml::table* table : root.tables("frf")) job.frfs.push_back(read_frf(root.file(), *table));
    if (const auto* table = root.only_table("dynamics")) job.estimate = read_dynamics(root, *table, job);
    if (const auto* table = root.only_table("sound")) job.sound = read_sound(root.file(), *table);
    if (const auto* table = root.only_table("limits")) job.limits = read_limits(root.file(), *table);
    if (const auto* table = root.only_table("haptics")) job.haptics = read_haptics(root.file(), *table);
}

}  // namespace

FileResult<Job> parse_job(std::string_view text, const std::string& name, const FileSource& files,
                          std::span<const JobChange> changes) {
    Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) return std::unexpected(FileFailure(parsed.error()));
    TomlFile file(name);
    Job job;
    job.file = name;
    if (parsed->empty()) {
        return std::unexpected(FileFailure(
            {name, 1, 1, "the job is empty", "write at least [stock], [cutter], [material] and [path]"}));
    }
    if (auto changed = apply(changes, *parsed, name); !changed)
        return std::unexpected(FileFailure(changed.error()));
    TomlSection root(file, *parsed, "", kJobKeys);
    read_all(root, job);
    auto machine = read_machine(root, job.path, files);
    job.files = file.named();
    if (!machine) return std::unexpected(at_key(job, std::move(machine).error()));
    job.machine = *std::move(machine);
    if (!file.ok()) return std::unexpected(FileFailure(file.error()));
    return job;
}

FileResult<Job> read_job(const FileSource& files, const std::string& path,
                         std::span<const JobChange> changes) {
    const FileResult<std::string> text = files.read(path, kLargestJobBytes);
    if (!text) return std::unexpected(text.error());
    return parse_job(*text, path, files, changes);
}

}  // namespace tribo::job
