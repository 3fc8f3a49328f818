// SPDX-License-Identifier: MIT
#include "app/sweep/sweep_cases.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/interrupt.hpp"
#include "app/sweep/case_run.hpp"
#include "base/text/decimal.hpp"
#include "files/machine_limits.hpp"
#include "job/input_kind.hpp"
#include "job/toml/sweep_toml.hpp"

namespace tribo::app {
namespace {

// Files of programs in a folder, by their names. Others are left out by the kind of their content.
FileResult<std::vector<sweep::Value>> programs_in(const std::string& folder, const SweepFiles& files) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (entry.is_regular_file(error)) names.push_back(entry.path().string());
    }
    if (error) return files::system_failure(folder, "read", error.value());
    std::ranges::sort(names);
    std::vector<sweep::Value> programs;
    for (const std::string& name : names) {
        const auto kind = job::kind_of_input(files, name);
        if (kind && kind->program) programs.emplace_back(name);
    }
    if (programs.empty())
        return std::unexpected(FileFailure(
            {folder, 0, 0, "there is no program in this folder", "name the folder that holds the programs"}));
    return programs;
}

std::string text_of(const sweep::Value& value) {
    if (const double* number = std::get_if<double>(&value)) return format_decimal(*number);
    if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    return "'" + std::get<std::string>(value) + "'";
}

}  // namespace

FileResult<SweepCases> SweepCases::open(const std::string& file) {
    SweepCases cases;
    auto text = cases.files_->read(file, std::uint64_t{1} << 20);
    if (!text) return std::unexpected(text.error());
    auto sweep = job::parse_sweep(*text, file);
    if (!sweep) return std::unexpected(FileFailure(sweep.error()));
    cases.sweep_ = *std::move(sweep);
    if (const std::string& folder = cases.sweep_.programs; !folder.empty()) {
        auto programs = programs_in(folder, *cases.files_);
        if (!programs) return std::unexpected(programs.error());
        auto& axes = cases.sweep_.plan.axes;
        axes.insert(axes.begin(), sweep::Axis{job::kProgramAxis, *std::move(programs), {}});
    }
    std::string all = std::string(TRIBO_VERSION) + "\n" + *text;
    for (const sweep::Axis& axis : cases.plan().axes)
        for (const sweep::Value& value : axis.values) all += "\n" + text_of(value);
    cases.digest_ = digest_of(all);
    return cases;
}

std::vector<job::JobChange> SweepCases::changes(const std::vector<sweep::Value>& values,
                                                std::string& program) const {
    std::vector<job::JobChange> changes;
    for (std::size_t n = 0; n < values.size(); ++n) {
        const std::string& key = plan().axes[n].key;
        if (key == job::kProgramAxis) {
            program = std::get<std::string>(values[n]);
        } else {
            changes.push_back({key, values[n]});
        }
    }
    return changes;
}

FileResult<job::LoadedJob> SweepCases::load(const std::vector<sweep::Value>& values, double memory_bytes) {
    std::string program;
    job::LoadOptions options = files::machine_limits(static_cast<std::uint64_t>(memory_bytes));
    options.changes = changes(values, program);
    if (sweep_.base.empty()) return job::load_job(*files_, program, options);
    if (!program.empty()) {
        const auto kind = job::kind_of_input(*files_, program);
        if (!kind) return std::unexpected(kind.error());
        const char* key = kind->program == job::PathKind::apt         ? "path.apt"
                          : kind->program == job::PathKind::keyframes ? "path.keyframes"
                                                                      : "path.gcode";
        options.changes.push_back({key, std::filesystem::absolute(program).string()});
    }
    return job::load_job(*files_, sweep_.base, options);
}

const std::string& SweepCases::files_digest(const std::vector<sweep::Value>& values) {
    std::string texts;
    for (const sweep::Value& value : values)
        if (const auto* text = std::get_if<std::string>(&value)) texts += *text + '\n';
    const auto [known, is_new] = files_digests_.try_emplace(texts);
    if (!is_new) return known->second;
    // The same in every process, whichever case it meets first: with the numbers of certain cases, until a
    // job can be loaded. One that is refused has read what it needs to say why.
    constexpr std::uint64_t kTries = 16;
    const std::uint64_t count = plan().cases();
    files_->begin_digest();
    for (std::uint64_t n = 0; n < std::min(kTries, count); ++n) {
        std::vector<sweep::Value> tried = plan().values(n * (count / std::min(kTries, count)));
        for (std::size_t axis = 0; axis < tried.size(); ++axis)
            if (std::holds_alternative<std::string>(values[axis])) tried[axis] = values[axis];
        if (load(tried, 0)) break;
    }
    known->second = files_->digest();
    return known->second;
}

CaseId SweepCases::id(std::uint64_t number) {
    const std::vector<sweep::Value> values = plan().values(number);
    std::string all = std::string(TRIBO_VERSION) + '\n' + files_digest(values);
    for (const job::SweepResult result : sweep_.compute)
        all += '\n' + std::to_string(static_cast<int>(result));
    all += '\n' + (sweep_.resolution_mm ? format_decimal(*sweep_.resolution_mm) : "");
    all += '\n' + (sweep_.until_s ? format_decimal(*sweep_.until_s) : "");
    for (std::size_t n = 0; n < values.size(); ++n) {
        // A program counts by its bytes, wherever it lies.
        if (plan().axes[n].key == job::kProgramAxis) continue;
        all += '\n' + plan().axes[n].key + '=' + text_of(values[n]);
    }
    return digest_of(all);
}

CaseResult SweepCases::run(std::uint64_t number, double memory_bytes) {
    CaseResult result;
    result.id = id(number);
    auto loaded = load(plan().values(number), memory_bytes);
    if (!loaded) {
        result.error = loaded.error().text();
        return result;
    }
    if (auto done = run_case(sweep_, *std::move(loaded), memory_bytes, result.values); !done)
        result.error = done.error().text();
    return result;
}

}  // namespace tribo::app
