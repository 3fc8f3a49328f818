// SPDX-License-Identifier: MIT
#include "app/compare/compare.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "app/compare/compare_outputs.hpp"
#include "app/compare/compared_run.hpp"
#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "base/text/printable.hpp"
#include "files/output_folder.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

using Inputs = std::array<ComparedInput, 2>;

// Loads both. Flags of a program go to those that are programs.
FileResult<Inputs> open_inputs(const CompareCall& call) {
    if (!call.program.job_out.empty())
        return std::unexpected(FileFailure({"", 0, 0, "--job-out does not say for which of the two runs",
                                            "write the jobs by tribo render, one by one"}));
    Inputs inputs;
    bool takes_flags = false, takes_resolution = false;
    for (std::size_t n = 0; n < inputs.size(); ++n) {
        const std::string& name = n == 0 ? call.a : call.b;
        const auto program = is_program(name);
        if (!program) return std::unexpected(program.error());
        auto input = open_input(name, *program ? call.program : ProgramFlags(), call.resolution_mm);
        if (!input) return std::unexpected(input.error());
        takes_flags = takes_flags || *program;
        takes_resolution = takes_resolution || input->prepared;
        inputs[n] = *std::move(input);
    }
    if (!takes_flags) {
        const auto good = refuse_flags(call.program, call.a, "neither run is one", "leave it out");
        if (!good) return std::unexpected(FileFailure(good.error()));
    }
    if (call.resolution_mm && !takes_resolution)
        return std::unexpected(FileFailure(
            {call.a, 0, 0, "--resolution is for a run that is milled, and both are render folders",
             "leave it out"}));
    return inputs;
}

// One spacing for both, the finer one, so that a difference is one of the runs and not of their grids.
void share_resolution(Inputs& inputs) {
    if (!inputs[0].prepared || !inputs[1].prepared) return;
    double& a = inputs[0].prepared->setup.cell_mm;
    double& b = inputs[1].prepared->setup.cell_mm;
    a = b = std::min(a, b);
}

FileResult<std::optional<ComparedRun>> run_of(Inputs& inputs, std::size_t n, const std::string& sound_file,
                                              const ParallelFor& parallel) {
    const ComparedInput& other = inputs[1 - n];
    if (inputs[n].prepared)
        return mill_run(std::move(inputs[n]), sound_file, parallel, n == 0 ? "milling A" : "milling B");
    std::optional<double> cell_mm;
    if (other.prepared) cell_mm = other.prepared->setup.cell_mm;
    auto run = read_run(inputs[n].name, cell_mm, parallel);
    if (!run) return std::unexpected(run.error());
    return std::optional<ComparedRun>(*std::move(run));
}

// Refuses to replace a folder that a run is read from, or begins with.
Result<void> check_sources(const Inputs& inputs, const files::OutputFolder& folder) {
    for (const ComparedInput& input : inputs) {
        std::error_code error;
        std::vector<std::string> sources{std::filesystem::weakly_canonical(input.name, error).string()};
        if (input.prepared) sources = input.prepared->stock_folders;
        if (std::ranges::find(sources, folder.path()) != sources.end())
            return fail_at(folder.name(), 0, 0, "a run is read from this folder, which would be replaced",
                           "name another folder");
    }
    return {};
}

FileResult<void> write(const files::OutputFolder& folder, Comparison& comparison, const std::string& json) {
    if (auto done = files::write_file(folder.file("compare.json"), json); !done) return done;
    if (auto done = files::write_file(folder.file("compare.csv"), compare_csv(comparison)); !done)
        return done;
    return files::write_file(folder.file("compare.html"), compare_html(comparison));
}

}  // namespace

int compare(const CompareCall& call) {
    auto inputs = open_inputs(call);
    if (!inputs) return report(inputs.error());
    share_resolution(*inputs);
    auto folder = files::OutputFolder::open(call.out, is_compare_file);
    if (!folder) return report(folder.error());
    if (auto good = check_sources(*inputs, *folder); !good) return report(good.error());
    if (auto good = check_output_folder(*folder); !good) return report(good.error());

    const ParallelFor parallel = parallel_for_over(available_threads());
    auto a = run_of(*inputs, 0, folder->file("sound_a.wav"), parallel);
    if (!a) return report(a.error());
    if (!*a) return interrupted_exit_code();
    auto b = run_of(*inputs, 1, folder->file("sound_b.wav"), parallel);
    if (!b) return report(b.error());
    if (!*b) return interrupted_exit_code();
    report((*a)->warnings);
    report((*b)->warnings);

    auto cuts = session::join((*a)->rows, (*b)->rows, call.by);
    if (!cuts) {
        Error error = cuts.error();
        error.file = call.b;
        return report(error);
    }
    Comparison comparison{**std::move(a), **std::move(b), *std::move(cuts), {}, {}};
    comparison.parts = compare_parts(comparison.a, comparison.b, parallel);
    comparison.set_up = compare_set_up(comparison.a, comparison.b);
    if (interrupted()) return interrupted_exit_code();
    const std::string json = compare_json(comparison);
    if (auto done = write(*folder, comparison, json); !done) return report(done.error());
    if (auto done = folder->commit(); !done) return report(done.error());
    if (call.json) {
        std::fputs(json.c_str(), stdout);
    } else {
        print(comparison);
        std::printf("%-16s %s\n", "files", printable(folder->path()).c_str());
    }
    if (std::fflush(stdout) != 0)
        return report(files::system_failure("standard output", "write", errno).error());
    return kDone;
}

}  // namespace tribo::app
