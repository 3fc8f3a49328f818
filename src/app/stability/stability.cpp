// SPDX-License-Identifier: MIT
#include "app/stability/stability.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/render/render_job.hpp"
#include "app/stability/stability_outputs.hpp"
#include "app/uncertain_flag.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/machine_limits.hpp"
#include "job/loader.hpp"
#include "job/toml/job_toml.hpp"
#include "session/chatter/probability.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

// The cut of [engagement]: only the program is read.
FileResult<session::SteadyCut> prescribed_cut(const StabilityCall& call, job::Job& job, Warnings& warnings) {
    if (call.place.line || call.place.t_s) {
        const char* flag = call.place.line ? "--line" : "--t";
        return std::unexpected(FileFailure(Error{
            call.job, 0, 0, std::string(flag) + " names a cut, and the job prescribes one in [engagement]",
            std::string("leave ") + flag + " out, or remove [engagement]"}));
    }
    auto program = job::read_and_complete(files::DiskSource(), job, files::machine_limits());
    if (!program) return std::unexpected(program.error());
    warnings = program->warnings;
    auto cut = session::steady_cut(job, *program, warnings);
    if (!cut) return std::unexpected(FileFailure(cut.error()));
    return *std::move(cut);
}

// The cut of a place in the program: the job is milled.
FileResult<session::SteadyCut> milled_cut(const StabilityCall& call, const ParallelFor& parallel,
                                          std::vector<job::JobFrf>& frfs, Warnings& warnings) {
    const job::LoadOptions limits = files::machine_limits();
    auto loaded = load_job(call.job, {}, limits);
    if (!loaded) return std::unexpected(loaded.error());
    warnings = loaded->warnings;
    frfs = loaded->job.frfs;
    session::MillOptions options{call.resolution_mm, {}};
    options.memory_bytes = limits.memory_bytes;
    auto setup = session::prepare_mill(*loaded, options, warnings);
    if (!setup) return std::unexpected(FileFailure(setup.error()));
    if (auto fits = check_memory(call.job, *setup, {}, {}); !fits)
        return std::unexpected(FileFailure(fits.error()));
    Progress progress;
    auto cut = session::critical_row(*loaded, *std::move(setup), call.place, parallel, [&](double fraction) {
        progress.update("milling", fraction);
        return !interrupted();
    });
    if (!cut) return std::unexpected(FileFailure(cut.error()));
    return *std::move(cut);
}

FileResult<void> load(const StabilityCall& call, const ParallelFor& parallel, StabilityAnswer& answer) {
    auto job = job::read_job(files::DiskSource(), call.job);
    if (!job) return std::unexpected(job.error());
    if (auto good = session::check_modes(*job); !good) return std::unexpected(FileFailure(good.error()));
    auto cut = job->engagement ? prescribed_cut(call, *job, answer.warnings)
                               : milled_cut(call, parallel, answer.frfs, answer.warnings);
    if (!cut) return std::unexpected(cut.error());
    if (job->engagement) answer.frfs = job->frfs;
    answer.cut = *std::move(cut);
    if (answer.cut.variation.is_there()) answer.warnings.push_back({call.job, 0, session::kVariationWarning});
    return {};
}

Result<void> check_speed(const StabilityCall& call, const session::SteadyCut& cut, double rpm,
                         double depth_mm) {
    const double least = cut.least_rpm(depth_mm);
    if (rpm >= least) return {};
    char cause[160], remedy[80];
    std::snprintf(cause, sizeof cause,
                  "at %g rpm and %g mm the modes vibrate too often from tooth to tooth to be computed", rpm,
                  depth_mm);
    std::snprintf(remedy, sizeof remedy, "ask for at least %.4g rpm, or for less depth", 1.001 * least);
    return fail_at(call.job, 0, 0, cause, remedy);
}

// Refuses what would take too long.
Result<dynamics::ChartRange> chart_range(const StabilityCall& call, const session::SteadyCut& cut) {
    dynamics::ChartRange range = call.speeds ? *call.speeds : session::default_speeds(cut);
    const double deepest =
        std::max(call.depths ? call.depths->most_mm : cut.cutter.length_mm, cut.axial_depth_mm);
    if (auto good = check_speed(call, cut, range.from_rpm, deepest); !good)
        return std::unexpected(good.error());
    if (call.depths) {
        range.most_mm = call.depths->most_mm;
        range.step_mm = call.depths->step_mm;
    } else {
        session::add_default_depths(cut, range);
    }
    return range;
}

Result<void> compute(const StabilityCall& call, const ParallelFor& parallel, StabilityAnswer& answer) {
    const session::SteadyCut& cut = answer.cut;
    answer.points = call.at;
    std::vector<double> speeds = call.limit_rpm;
    if (call.at.empty() && call.limit_rpm.empty() && !call.simulation) {
        answer.points.push_back({cut.spindle_rpm, cut.axial_depth_mm});
        speeds.push_back(cut.spindle_rpm);
    }
    for (const StabilityPoint& p : answer.points)
        if (auto good = check_speed(call, cut, p.spindle_rpm, p.axial_depth_mm); !good) return good;
    for (const double rpm : speeds)
        if (auto good = check_speed(call, cut, rpm, cut.cutter.length_mm); !good) return good;
    std::optional<dynamics::ChartRange> range;
    if (call.wants_chart()) {
        // For the advice.
        if (auto good = check_speed(call, cut, cut.spindle_rpm, cut.cutter.length_mm); !good) return good;
        auto found = chart_range(call, cut);
        if (!found) return std::unexpected(found.error());
        range = *found;
    }
    const std::size_t count = call.uncertain ? static_cast<std::size_t>(*call.uncertain) : session::kCases;
    const std::vector<session::SteadyCut> cases = session::cases_of(cut, count);
    if (auto spread = check_uncertain(call.job, call.uncertain, !cases.empty()); !spread) return spread;
    for (StabilityPoint& p : answer.points) {
        if (interrupted()) return {};
        p.stability = cut.at(p.spindle_rpm, p.axial_depth_mm);
        if (!cases.empty())
            p.probability = session::probability_of_chatter(cases, p.spindle_rpm, p.axial_depth_mm);
    }
    for (const double rpm : speeds) {
        if (interrupted()) return {};
        StabilityLimit& limit = answer.limits.emplace_back(rpm, cut.limit(rpm));
        if (call.uncertain && !cases.empty()) limit.band_mm = session::limit_band_mm(cases, rpm, parallel);
    }
    if (!range) return {};
    const auto stage = [](const char* name) {
        return [name, progress = std::make_shared<Progress>()](double fraction) {
            progress->update(name, fraction);
            return !interrupted();
        };
    };
    auto chart = dynamics::stability_chart(
        *range, [&](double rpm, double depth_mm) { return cut.at(rpm, depth_mm); }, parallel, stage("chart"));
    // Several bands take several times as long.
    session::add_probability(cut, chart, parallel, stage("probability"),
                             cut.bands.size() > 1 && !call.uncertain ? session::kFewCases : count);
    if (interrupted()) return {};
    auto advice = session::advise(cut, chart, parallel, count);
    answer.chart = {*range, std::move(chart), std::move(advice)};
    return {};
}

}  // namespace

int stability(const StabilityCall& call) {
    const ParallelFor parallel = parallel_for_over(available_threads());
    StabilityAnswer answer;
    auto loaded = load(call, parallel, answer);
    if (interrupted()) return interrupted_exit_code();
    if (!loaded) return report(loaded.error());
    std::optional<files::OutputFolder> folder;
    if (!call.out.empty()) {
        auto opened = files::OutputFolder::open(call.out, is_stability_file);
        if (!opened) return report(opened.error());
        folder.emplace(*std::move(opened));
        if (auto good = check_output_folder(*folder); !good) return report(good.error());
    }
    report(answer.warnings);
    if (auto done = compute(call, parallel, answer); !done) return report(done.error());
    if (interrupted()) return interrupted_exit_code();
    if (folder) {
        if (call.simulation) {
            if (auto done = write_vibration(call, answer, *folder); !done) return report(done.error());
            if (interrupted()) return interrupted_exit_code();
        }
        if (auto done = write_files(call, answer, *folder); !done) return report(done.error());
        if (auto done = folder->commit(); !done) return report(done.error());
    }
    if (call.json) {
        std::fputs(stability_json(call, answer).c_str(), stdout);
    } else {
        print(call, answer);
        if (folder) std::printf("files: %s\n", printable(folder->path()).c_str());
    }
    return std::fflush(stdout) == 0
               ? kDone
               : report(files::system_failure("standard output", "write", errno).error());
}

}  // namespace tribo::app
