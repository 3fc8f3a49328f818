// SPDX-License-Identifier: MIT
#include "app/render/program_flags.hpp"

#include <filesystem>
#include <functional>

#include "app/options.hpp"
#include "app/outputs.hpp"
#include "base/text/file_names.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/files.hpp"
#include "job/toml/job_writer.hpp"
#include "job/words/stock_words.hpp"
#include "job/words/tool_words.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "/dev/stdin";

// The flag and its text, before what is wrong with it.
Error with_flag(const char* flag, const std::string& text, const Error& error) {
    return {"", 0, 0, std::string(flag) + " '" + text + "': " + error.cause, error.remedy};
}

bool is_table(const std::string& text) {
    const std::string_view extension = extension_of(text);
    return extension == ".tbl" || extension == ".csv" || extension == ".json" || extension == ".tools" ||
           extension == ".fctb" || extension == ".xml";
}

Result<void> read_tools(const ProgramFlags& flags, job::ProgramInputs& inputs) {
    constexpr const char* flag = "--tool";
    const auto refuse = [&](const std::string& text, std::string cause, std::string remedy) {
        return std::unexpected(with_flag(flag, text, {"", 0, 0, std::move(cause), std::move(remedy)}));
    };
    for (const std::string& text : flags.tools) {
        if (is_table(text)) {
            if (!inputs.tool_table.empty()) return refuse(text, "a second tool table", "name one");
            inputs.tool_table = text;
            continue;
        }
        const auto cutter = job::parse_tool_words(text);
        if (!cutter) return std::unexpected(with_flag(flag, text, cutter.error()));
        for (const milling::Cutter& other : inputs.cutters) {
            if (cutter->number == 0 || other.number == 0) {
                return refuse(text, "one of several tools has no number",
                              "write T and the number by which the program calls it, as in 'T1 " +
                                  job::tool_words(inputs.cutters.front()) + "'");
            }
            if (other.number == cutter->number)
                return refuse(text, "two tools have the same number", "give each its own");
        }
        inputs.cutters.push_back(*cutter);
    }
    return {};
}

}  // namespace

CLI::Option* add_job(CLI::App& verb, std::string& job, const std::string& description, ProgramFlags& flags,
                     const char* name) {
    const std::function<std::string(std::string)> standard_input = [](const std::string& file) {
        return file == "-" ? std::string(kStandardInput) : file;
    };
    CLI::Option* option = verb.add_option(name, job, description)->transform(standard_input);
    const CLI::Validator says_something(
        [](const std::string& text) {
            return std::string(text.empty() ? "is empty; leave it out, or write a value" : "");
        },
        "");
    const std::string group = "For a program in place of a job (what is absent is assumed)";
    verb.add_option("--tool", flags.tools,
                    "A tool in words: \"flat 6\", \"T2 ball 8 flutes 3\", \"bull 10 corner 1\"; or a tool "
                    "table (.tbl, .csv, .json, .tools, .fctb, .xml); may be repeated")
        ->allow_extra_args(false)
        ->type_name("TOOL")
        ->group(group);
    verb.add_option("--stock", flags.stock,
                    "\"80 60 20\" (size), \"0 0 -20 80 60 0\" (two corners), or a model; mm")
        ->check(says_something)
        ->type_name("STOCK")
        ->group(group);
    verb.add_option("--material", flags.material, "Of the stock: al7075-t6, steel ... (docs/job.md)")
        ->check(says_something)
        ->type_name("NAME")
        ->group(group);
    verb.add_option("--machine", flags.machine, "For rotary words of G-code (docs/machines.md)")
        ->check(says_something)
        ->type_name("NAME|F.toml")
        ->group(group);
    verb.add_option("--dialect", flags.dialect,
                    "linuxcnc, fanuc, siemens, heidenhain or num; else told by the text")
        ->check(one_of({readers::kDialectWords.begin(), readers::kDialectWords.end()}))
        ->type_name("NAME")
        ->group(group);
    verb.add_option("--spindle-rpm", flags.spindle_rpm, "Where the program has no S word")
        ->check(within(kLimits.spindle_speed))
        ->type_name("RPM")
        ->group(group);
    verb.add_option("--feed-mm-per-min", flags.feed_mm_per_min, "Where the program has no F word")
        ->check(within(kLimits.feed))
        ->type_name("FEED")
        ->group(group);
    verb.add_option("--job-out", flags.job_out, "Write the job that stands for this call")
        ->check(says_something)
        ->type_name("F.toml")
        ->group(group);
    return option;
}

Result<job::ProgramInputs> program_inputs(const ProgramFlags& flags) {
    job::ProgramInputs inputs;
    if (auto read = read_tools(flags, inputs); !read) return std::unexpected(read.error());
    if (!flags.stock.empty()) {
        auto stock = job::parse_stock_words(flags.stock);
        if (!stock) return std::unexpected(with_flag("--stock", flags.stock, stock.error()));
        inputs.stock = *std::move(stock);
    }
    if (!flags.material.empty()) {
        const auto known = milling::find_material(flags.material);
        if (!known) return std::unexpected(with_flag("--material", flags.material, known.error()));
        inputs.material = flags.material;
    }
    inputs.machine = flags.machine;
    inputs.dialect = readers::dialect_of(flags.dialect);
    inputs.process = {flags.spindle_rpm.value_or(0), flags.feed_mm_per_min.value_or(0)};
    return inputs;
}

Result<void> refuse_flags(const ProgramFlags& flags, const std::string& file, const std::string& is_what,
                          const std::string& remedy) {
    const std::pair<const char*, bool> given[] = {
        {"--tool", !flags.tools.empty()},        {"--stock", !flags.stock.empty()},
        {"--material", !flags.material.empty()}, {"--machine", !flags.machine.empty()},
        {"--dialect", !flags.dialect.empty()},   {"--spindle-rpm", flags.spindle_rpm.has_value()},
        {"--job-out", !flags.job_out.empty()},   {"--feed-mm-per-min", flags.feed_mm_per_min.has_value()},
    };
    for (const auto& [flag, is_given] : given) {
        if (is_given)
            return fail_at(file, 0, 0, std::string(flag) + " belongs to a program, and " + is_what, remedy);
    }
    return {};
}

FileResult<void> write_job_out(const ProgramFlags& flags, const job::LoadedJob& loaded,
                               std::vector<std::string> outputs) {
    if (flags.job_out.empty()) return {};
    const auto refuse = [&](std::string cause, std::string remedy) {
        return std::unexpected(FileFailure(
            with_flag("--job-out", flags.job_out, {"", 0, 0, std::move(cause), std::move(remedy)})));
    };
    std::error_code error;
    const std::string& program = loaded.job.path.file;
    if (program == kStandardInput || !fs::is_regular_file(program, error))
        return refuse("a job cannot name " + program + ", which is no file",
                      "save the program to a file first");
    if (extension_of(flags.job_out) != ".toml")
        return refuse("a job is named .toml", "try " + flags.job_out + ".toml");
    const fs::path folder = fs::weakly_canonical(fs::absolute(flags.job_out, error).parent_path(), error);
    std::string odd;
    const std::string text = job::job_text(loaded, [&](const std::string& file) {
        std::string name = files::relative_to(folder.string(), file);
        if (printable(name) != name) odd = name;
        return name;
    });
    if (!odd.empty())
        return refuse("a job cannot name " + odd + ": not all of it is text", "rename it first");
    outputs.push_back(flags.job_out);
    if (auto checked = check_outputs(outputs); !checked) return checked;
    if (fs::exists(flags.job_out, error)) {
        const auto older = files::read_file(flags.job_out, files::kLargestInputBytes, files::Pipes::refuse);
        if (!older) return std::unexpected(older.error());
        if (*older == text) return {};
        return refuse("is there already, and says something else", "remove it, or name another file");
    }
    return files::write_file(flags.job_out, text);
}

}  // namespace tribo::app
