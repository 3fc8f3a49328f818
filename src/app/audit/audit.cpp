// SPDX-License-Identifier: MIT
#include "app/audit/audit.hpp"

#include <algorithm>
#include <cstdio>

#include "app/audit/audit_outputs.hpp"
#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/render/part_deviation.hpp"
#include "app/uncertain_flag.hpp"
#include "base/text/printable.hpp"
#include "files/output_folder.hpp"
#include "session/chatter/probability.hpp"
#include "session/chatter/steady_bending.hpp"
#include "session/cut/mill_warnings.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

// The error of the finished part, as far as the job has a design, and what its teeth left is recorded.
FileResult<void> measure_part(PreparedJob& loaded, const session::MillSession& session,
                              const surface::FormError& form_error, const ParallelFor& parallel,
                              AuditAnswer& answer) {
    if (!form_error.empty()) {
        const surface::FormError::Extremes& e = form_error.extremes();
        answer.facts.left_mm = e.left_mm;
        answer.facts.overcut_mm = e.overcut_mm;
        answer.facts.left_line = e.left_line;
        answer.facts.overcut_line = e.overcut_line;
    }
    if (!loaded.part) return {};
    auto designed = surface::DesignedSurface::make(std::move(loaded.part->mesh));
    if (!designed) {
        Error error = designed.error();
        error.file = loaded.job.part->path;
        return std::unexpected(FileFailure(error));
    }
    const surface::DeviationReport d = part_deviation(session, *designed, form_error, parallel, true);
    answer.errors.emplace(session, d);
    answer.errors->describe(answer.audit);
    answer.facts.gouge_mm = d.gouge.mm;
    answer.facts.gouge_line = answer.errors->gouge_line();
    answer.rest_mm = d.rest.mm;
    answer.scallop_mm = d.scallop.mm;
    return {};
}

void append(const Warnings& more, Warnings& warnings) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

bool is_over(const AuditAnswer& answer, const session::MillSession& session, double ratio) {
    if (!session.totals().collisions.empty()) return true;
    const auto over = [&](const session::PeakLoad& peak) { return peak.ratio > ratio; };
    return std::ranges::any_of(
               answer.audit.tools,
               [&](const session::LoadTally& tool) { return std::ranges::any_of(tool.peaks, over); }) ||
           std::ranges::any_of(answer.verdict.findings,
                               [&](const session::Finding& f) { return f.ratio && f.ratio->value > ratio; });
}

}  // namespace

int audit(const AuditCall& call) {
    session::MillOptions options{call.resolution_mm, {}};
    auto loaded = prepare_job(call.job, call.program, options);
    if (!loaded) return report(loaded.error());
    if (call.stable) {
        if (auto good = check_bends(loaded->job); !good) return report(good.error());
    }
    if (auto spread = check_uncertain(call.job, call.uncertain, session::has_spread(loaded->setup)); !spread)
        return report(spread.error());
    const auto cases = static_cast<std::size_t>(call.uncertain.value_or(session::kCases));
    const bool bends = loaded->job.can_vibrate(),
               records_surface = loaded->job.limits.tolerance_mm.has_value();
    const RunOutputs made{.chatter_bytes =
                              records_surface ? session::SurfaceRecorder::estimated_bytes(loaded->setup) : 0};
    if (auto fits = check_memory(call.job, loaded->setup, loaded->part, made); !fits)
        return report(fits.error());
    std::optional<files::OutputFolder> folder;
    std::optional<AuditCsv> csv;
    if (!call.out.empty()) {
        auto opened = files::OutputFolder::open(call.out, is_audit_file);
        if (!opened) return report(opened.error());
        folder.emplace(*std::move(opened));
        if (auto good = check_output_folder(*folder); !good) return report(good.error());
        if (std::ranges::find(loaded->stock_folders, folder->path()) != loaded->stock_folders.end())
            return report(Error{call.out, 0, 0,
                                "the job begins with the stock of this folder, which it would replace",
                                "name another folder"});
        auto file = AuditCsv::create(folder->file("audit.csv"), records_surface, loaded->part.has_value());
        if (!file) return report(file.error());
        csv.emplace(*std::move(file));
    }
    const session::LoadModel model(loaded->setup, session::cut_limits(loaded->job, loaded->setup));
    append(model.limits().assumptions, loaded->warnings);
    const bool steady = session::bends_steadily(loaded->job);
    if (steady) loaded->warnings.push_back(session::steady_bending_warning(call.job));
    report(loaded->warnings);

    const ParallelFor parallel = parallel_for_over(available_threads());
    std::optional<Progress> progress(std::in_place);
    const auto milling = [&](const char* stage) {
        return [&progress, stage](double fraction) {
            progress->update(stage, fraction);
            return !interrupted();
        };
    };
    session::MillSession session(std::move(loaded->setup), parallel, milling("earlier jobs"));
    session::Auditor auditor(model, session, [&](const session::LoadTally& line) {
        if (csv) csv->add(line, model, session.setup());
    });
    if (call.uncertain) auditor.use(session::ForceCases(session.setup(), cases, parallel));
    AuditAnswer answer(session.duration_s());
    answer.uncertain = call.uncertain;
    const auto take = [&](const milling::CutRow& row, const milling::RowForce& force,
                          std::optional<double> multiplier) {
        auditor.add(row, force, multiplier);
        const session::RowLoads loads = model.loads(row, force.peaks, force.chip_mm);
        answer.force_n.add(row.start_s, row.end_s, force.peaks.peak_force_n);
        answer.ratio.add(row.start_s, row.end_s, *std::ranges::max_element(loads.ratio));
    };
    session::MillSinks sinks;
    std::optional<session::ProgramChatter> chatter;
    std::optional<session::SteadyBending> bending;
    session::StableSpeedSearch speeds(session.setup());
    if (bends) {
        chatter.emplace(
            session.setup(), session::ProgramChatter::Options{false, records_surface}, parallel,
            [&](const milling::CutRow& row, const milling::RowForce& force,
                const session::RowChatter& of_row) {
                if (call.stable && of_row.stability) speeds.add(row, of_row.stability->multiplier);
                take(row, force,
                     of_row.stability ? std::optional(of_row.stability->multiplier) : std::nullopt);
            });
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            chatter->add(row, force);
        };
    } else {
        if (steady) bending.emplace(session.setup());
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            if (bending) bending->add(row);
            take(row, force, {});
        };
    }
    sinks.progress = milling("milling");
    if (!session.run(sinks)) return interrupted_exit_code();
    if (chatter) chatter->finish();
    answer.audit = auditor.finish();
    progress.reset();

    if (call.stable) answer.speeds = advise_speeds(speeds, *loaded, session.setup(), parallel);
    Warnings found = session::warnings_of(session.totals(), call.job, loaded->job.path.file);
    if (chatter) {
        append(session::warnings_of(chatter->totals(), loaded->job.path.file), found);
        answer.facts.chatter_probability = session::chatter_probability(*chatter, session.setup(), cases);
    }
    std::optional<surface::ToothTraces> traces;
    if (bending) {
        append(session::warnings_of(*bending, loaded->job.path.file), found);
        traces = bending->take();
    } else if (chatter && records_surface) {
        traces = chatter->take_surface();
    }
    report(found);
    answer.warnings = loaded->warnings;
    append(found, answer.warnings);
    surface::FormError form_error;
    if (traces) form_error = surface::FormError(*std::move(traces), session.stock(), parallel);
    if (auto done = measure_part(*loaded, session, form_error, parallel, answer); !done)
        return report(done.error());
    answer.verdict = session::verdict(answer.audit, model, session, answer.facts);
    if (interrupted()) return interrupted_exit_code();

    const std::string json = folder || call.json ? audit_json(call, answer, *loaded, model, session) : "";
    if (folder) {
        if (auto done = csv->finish(form_error, answer.errors); !done) return report(done.error());
        if (auto done = files::write_file(folder->file("audit.json"), json); !done)
            return report(done.error());
        const std::string page = audit_html(call, answer, *loaded, model, session);
        if (auto done = files::write_file(folder->file("audit.html"), page); !done)
            return report(done.error());
        if (auto done = folder->commit(); !done) return report(done.error());
    }
    if (call.json) {
        std::fputs(json.c_str(), stdout);
    } else {
        print(answer, model, session);
        if (folder) std::printf("%-16s %s\n", "files", printable(folder->path()).c_str());
    }
    if (std::fflush(stdout) != 0)
        return report(files::system_failure("standard output", "write", errno).error());
    return call.fail_over && is_over(answer, session, *call.fail_over) ? kOverLimit : kDone;
}

}  // namespace tribo::app
