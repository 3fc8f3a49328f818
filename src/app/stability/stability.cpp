// SPDX-License-Identifier: MIT
#include "app/stability/stability.hpp"

#include <algorithm>
#include <cstdio>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/stability/stability_outputs.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/machine_limits.hpp"
#include "job/loader.hpp"
#include "job/toml/job_toml.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

FileResult<void> load(const StabilityCall& call, StabilityAnswer& answer) {
    const files::DiskSource disk;
    auto job = job::read_job(disk, call.job);
    if (!job) return std::unexpected(job.error());
    auto program = job::read_and_complete(disk, *job, files::machine_limits());
    if (!program) return std::unexpected(program.error());
    answer.warnings = program->warnings;
    auto cut = session::steady_cut(*job, *program, answer.warnings);
    if (!cut) return std::unexpected(FileFailure(cut.error()));
    answer.cut = *std::move(cut);
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
    const double deepest = call.depths ? call.depths->most_mm : cut.cutter.length_mm;
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

Result<void> compute(const StabilityCall& call, StabilityAnswer& answer) {
    const session::SteadyCut& cut = answer.cut;
    answer.points = call.at;
    std::vector<double> speeds = call.limit_rpm;
    if (call.at.empty() && call.limit_rpm.empty()) {
        answer.points.push_back({cut.spindle_rpm, cut.axial_depth_mm});
        speeds.push_back(cut.spindle_rpm);
    }
    for (const StabilityPoint& p : answer.points)
        if (auto good = check_speed(call, cut, p.spindle_rpm, p.axial_depth_mm); !good) return good;
    if (call.wants_chart()) speeds.push_back(cut.spindle_rpm);
    for (const double rpm : speeds)
        if (auto good = check_speed(call, cut, rpm, cut.cutter.length_mm); !good) return good;
    if (call.wants_chart()) speeds.pop_back();
    std::optional<dynamics::ChartRange> range;
    if (call.wants_chart()) {
        auto found = chart_range(call, cut);
        if (!found) return std::unexpected(found.error());
        range = *found;
    }
    for (StabilityPoint& p : answer.points) p.stability = cut.at(p.spindle_rpm, p.axial_depth_mm);
    for (const double rpm : speeds) {
        if (interrupted()) return {};
        answer.limits.push_back({rpm, cut.limit(rpm)});
    }
    if (!range) return {};
    const ParallelFor parallel = parallel_for_over(available_threads());
    Progress progress;
    auto chart = dynamics::stability_chart(
        *range, [&](double rpm, double depth_mm) { return cut.at(rpm, depth_mm); }, parallel,
        [&](double fraction) {
            progress.update("chart", fraction);
            return !interrupted();
        });
    if (interrupted()) return {};
    auto advice = session::advise(cut, chart, parallel);
    answer.chart = {*range, std::move(chart), std::move(advice)};
    return {};
}

}  // namespace

int stability(const StabilityCall& call) {
    StabilityAnswer answer;
    if (auto loaded = load(call, answer); !loaded) return report(loaded.error());
    std::optional<files::OutputFolder> folder;
    if (!call.out.empty()) {
        auto opened = files::OutputFolder::open(call.out, is_chart_file);
        if (!opened) return report(opened.error());
        folder.emplace(*std::move(opened));
        if (auto good = check_output_folder(*folder); !good) return report(good.error());
    }
    report(answer.warnings);
    if (auto done = compute(call, answer); !done) return report(done.error());
    if (interrupted()) return interrupted_exit_code();
    if (folder) {
        if (auto done = write_chart(call, answer, *folder); !done) return report(done.error());
        if (auto done = folder->commit(); !done) return report(done.error());
    }
    if (call.json) {
        std::fputs(stability_json(answer).c_str(), stdout);
    } else {
        print(call, answer);
        if (folder) std::printf("files: %s\n", printable(folder->path()).c_str());
    }
    return std::fflush(stdout) == 0
               ? kDone
               : report(files::system_failure("standard output", "write", errno).error());
}

}  // namespace tribo::app
