// SPDX-License-Identifier: MIT
#include "app/render/render.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/exit.hpp"
#include "app/interrupt.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/render/render_outputs.hpp"
#include "app/uncertain_flag.hpp"
#include "base/text/decimal.hpp"
#include "base/text/printable.hpp"
#include "files/disk_source.hpp"
#include "files/memory.hpp"
#include "session/chatter/steady_bending.hpp"
#include "session/chatter/steady_cut.hpp"
#include "session/cut/job_stock.hpp"
#include "session/cut/mill_warnings.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {
namespace {

constexpr double kMegabyte = 1e6;

report::Summary summary_of(const RenderCall& call, const PreparedJob& loaded,
                           const session::MillSession& session, const session::ChatterTotals* chatter,
                           const session::SteadyBending* bending) {
    const session::MillTotals& t = session.totals();
    report::Summary s;
    s.job = call.job;
    s.version = TRIBO_VERSION;
    s.duration_s = t.duration_s;
    s.cutting_s = t.cutting_s;
    s.path_mm = t.path_mm;
    s.removed_mm3 = t.removed_mm3;
    s.remaining_mm3 = t.remaining_mm3;
    if (t.rows > 0) s.tooth_passing_hz = t.tooth_passing_hz;
    s.work_j = t.work_j;
    s.energy_balance = t.energy_balance;
    s.resolution_mm = session.setup().cell_mm;
    s.stock_record = session::stock_record(session.setup());
    s.as_published = call.as_published;
    s.warnings = loaded.warnings;
    Warnings found = session::warnings_of(t, call.job, loaded.job.path.file);
    if (chatter != nullptr) {
        s.chatter.emplace();
        for (const session::ChatterLine& line : chatter->lines)
            s.chatter->push_back({line.line, line.t_s, line.multiplier, line.chatter_hz});
        s.largest_displacement_mm = chatter->largest_displacement_mm;
        const Warnings not_computed = session::warnings_of(*chatter, loaded.job.path.file);
        found.insert(found.end(), not_computed.begin(), not_computed.end());
    }
    if (bending != nullptr) {
        const Warnings not_kept = session::warnings_of(*bending, loaded.job.path.file);
        found.insert(found.end(), not_kept.begin(), not_kept.end());
    }
    report(found);
    s.warnings.insert(s.warnings.end(), found.begin(), found.end());
    for (const session::MillCollision& c : t.collisions) {
        s.collisions.push_back({c.line, c.t_s, milling::name(c.kind), c.tip_mm});
    }
    return s;
}

void print_chatter(const report::Summary& s) {
    const std::vector<report::SummaryChatter>& lines = *s.chatter;
    if (lines.empty()) {
        std::printf("%-16s none", "chatter");
    } else {
        const auto& worst = *std::ranges::max_element(lines, {}, &report::SummaryChatter::multiplier);
        std::printf("%-16s in %zu line%s, most in line %d: it grows by %.3g at %.1f Hz", "chatter",
                    lines.size(), lines.size() == 1 ? "" : "s", worst.line, worst.multiplier,
                    worst.chatter_hz);
    }
    std::printf("; the tool moves by %.3g mm at most\n", s.largest_displacement_mm.value_or(0));
}

// With one decimal; what is small keeps three digits.
std::string shown(double value) {
    if (value < 10) return format_digits(value, 3);
    char text[40];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

void print(const report::Summary& s, const files::OutputFolder& folder) {
    std::printf("%-16s %.1f s, cutting %.1f s\n", "time", s.duration_s, s.cutting_s);
    std::printf("%-16s %.1f mm\n", "path", s.path_mm);
    std::printf("%-16s %s mm3 of %s mm3\n", "removed", shown(s.removed_mm3).c_str(),
                shown(s.removed_mm3 + s.remaining_mm3).c_str());
    const report::ForceValue& peak = s.peak_force_n;
    std::printf("%-16s mean %s N, peak %s N", "force", shown(s.mean_force_n.value).c_str(),
                shown(peak.value).c_str());
    if (s.uncertain_cases) {
        std::printf(" (%s to %s N in 9 of 10 of %zu cases)\n", shown(peak.low).c_str(),
                    shown(peak.high).c_str(), *s.uncertain_cases);
    } else if (peak.value > 0) {
        std::printf(" (%.2g to %.2g times that)\n", peak.low / peak.value, peak.high / peak.value);
    } else {
        std::printf("\n");
    }
    std::printf("%-16s %s N m, %s W\n", "peak torque", shown(s.peak_torque_nm.value).c_str(),
                shown(s.peak_power_w.value).c_str());
    if (s.tooth_passing_hz) std::printf("%-16s %.1f Hz\n", "tooth passing", *s.tooth_passing_hz);
    if (s.chatter) print_chatter(s);
    if (s.form_error)
        std::printf("%-16s bending leaves %.3g mm and cuts %.3g mm too deep, waves of %.3g mm\n", "surface",
                    s.form_error->left_mm, s.form_error->overcut_mm, s.form_error->wave_mm);
    if (s.scallop_max_mm)
        std::printf("%-16s gouge %.3f mm, rest %.3f mm, scallop %.3f mm\n", "deviation", *s.gouge_max_mm,
                    *s.rest_max_mm, *s.scallop_max_mm);
    if (s.triangles)
        std::printf("%-16s %llu triangles\n", "part", static_cast<unsigned long long>(*s.triangles));
    std::printf("%-16s %zu collisions, %zu warnings\n", "findings", s.collisions.size(), s.warnings.size());
    std::printf("%-16s %.2f s, %.0f MB\n", "took", s.seconds, s.peak_memory_mb);
    std::printf("%-16s %s\n", "files", printable(folder.path()).c_str());
}

}  // namespace

int render(const RenderCall& call) {
    const auto begin = std::chrono::steady_clock::now();
    const auto sound_rate_hz = call.wants("sound") ? std::optional(call.sample_rate_hz) : std::nullopt;
    session::MillOptions options{call.resolution_mm, call.until_s};
    options.memory_bytes = static_cast<std::uint64_t>(call.memory_mb.value_or(0) * kMegabyte);
    auto loaded = prepare_job(call.job, call.program, options, sound_rate_hz);
    if (!loaded) return report(loaded.error());
    const bool steady = session::bends_steadily(loaded->job),
               records_surface = steady || loaded->job.can_vibrate();
    if (call.only.contains("surface") && !steady) {
        if (auto bends = session::check_modes(loaded->job); !bends) return report(bends.error());
    }
    if (auto spread = check_uncertain(call.job, call.uncertain, session::has_spread(loaded->setup)); !spread)
        return report(spread.error());
    const RunOutputs made{call.wants("mesh"), call.wants("report"), call.wants("sound"),
                          records_surface ? session::SurfaceRecorder::estimated_bytes(loaded->setup) : 0};
    if (steady) loaded->warnings.push_back(session::steady_bending_warning(call.job));
    if (auto fits = check_memory(call.job, loaded->setup, loaded->part, made, call.memory_mb); !fits)
        return report(fits.error());
    auto folder = files::OutputFolder::open(call.out, RenderOutputs::writes);
    if (!folder) return report(folder.error());
    const auto& sources = loaded->stock_folders;
    if (std::find(sources.begin(), sources.end(), folder->path()) != sources.end()) {
        return report(Error{call.out, 0, 0,
                            "the job begins with the stock of this folder, which it would replace",
                            "name another folder, or let [stock] from name the earlier job itself"});
    }
    if (auto checked = check_output_folder(*folder); !checked) return report(checked.error());
    report(loaded->warnings);

    const ParallelFor parallel = parallel_for_over(call.threads > 0 ? call.threads : available_threads());
    const Box3 blank = loaded->setup.blank->bounds_mm();
    std::optional<Progress> progress(std::in_place);
    const auto milling = [&](const char* stage) {
        return [&progress, stage](double fraction) {
            progress->update(stage, fraction);
            return !interrupted();
        };
    };
    session::MillSession session(std::move(loaded->setup), parallel, milling("earlier jobs"));
    RenderOutputs outputs(call, *loaded, *folder, parallel);
    if (auto open = outputs.open(session, blank); !open) return report(open.error());
    session::MillSinks sinks;
    std::optional<session::ProgramChatter> chatter;
    std::optional<session::SteadyBending> bending;
    if (loaded->job.can_vibrate()) {
        chatter.emplace(
            session.setup(),
            session::ProgramChatter::Options{call.wants("sound") && !call.as_published, true}, parallel,
            [&](const milling::CutRow& row, const milling::RowForce& force,
                const session::RowChatter& of_row) { outputs.add(row, force, session.setup(), &of_row); });
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            chatter->add(row, force);
        };
    } else if (outputs.needs_rows() || steady) {
        if (steady) bending.emplace(session.setup());
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            if (bending) bending->add(row);
            outputs.add(row, force, session.setup(), nullptr);
        };
    }
    sinks.progress = milling("milling");
    if (!session.run(sinks)) return interrupted_exit_code();
    if (chatter) chatter->finish();
    progress.reset();
    report::Summary summary = summary_of(call, *loaded, session, chatter ? &chatter->totals() : nullptr,
                                         bending ? &*bending : nullptr);
    // Only a job can be run again as it was.
    const std::string& record = loaded->is_program ? call.program.job_out : call.job;
    if (record.empty()) {
        summary.stock_record.reset();
    } else {
        summary.stock_record->job = files::relative_to(folder->path(), record);
    }
    std::optional<surface::ToothTraces> traces;
    if (chatter) traces = chatter->take_surface();
    if (bending) traces = bending->take();
    if (auto done = outputs.finish(session, chatter ? &*chatter : nullptr, std::move(traces), summary); !done)
        return report(done.error());
    if (interrupted()) return interrupted_exit_code();
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    summary.peak_memory_mb = static_cast<double>(files::peak_memory_bytes()) / kMegabyte;
    if (auto done = files::write_file(folder->file("summary.json"), report::summary_json(summary)); !done) {
        return report(done.error());
    }
    if (auto done = folder->commit(); !done) return report(done.error());
    print(summary, *folder);
    return kDone;
}

}  // namespace tribo::app
