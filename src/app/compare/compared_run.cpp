// SPDX-License-Identifier: MIT
#include "app/compare/compared_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/render/part_deviation.hpp"
#include "app/render/render_sinks.hpp"
#include "field/contour/contour_refine.hpp"
#include "files/disk_source.hpp"
#include "files/machine_limits.hpp"
#include "files/memory.hpp"
#include "job/input_kind.hpp"
#include "job/listening.hpp"
#include "session/audit/row_loads.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/chatter/steady_bending.hpp"
#include "session/chatter/surface_recorder.hpp"
#include "session/cut/job_stock.hpp"
#include "session/cut/mill_warnings.hpp"
#include "session/cut/stock_faces.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// A longer sound is left out: its file would be larger than a gigabyte.
constexpr double kLongestSoundS = 3600;
constexpr double kMegabyte = 1e6;

std::string set_up(const PreparedJob& prepared) {
    const std::size_t cutters = prepared.setup.cutters.size();
    return std::string(prepared.material.name) + ", " + std::to_string(cutters) +
           (cutters == 1 ? " cutter" : " cutters");
}

void take_totals(const session::MillTotals& t, double cell_mm, ComparedRun& run) {
    constexpr double kMetres = 1e-3;
    run.total("duration_s") = t.duration_s;
    run.total("cutting_s") = t.cutting_s;
    run.total("path_mm") = t.path_mm;
    run.total("removed_mm3") = t.removed_mm3;
    run.total("remaining_mm3") = t.remaining_mm3;
    run.total("mean_force_n") = t.mean_force_n;
    run.total("peak_force_n") = t.peak_force_n;
    run.total("peak_torque_nm") = kMetres * t.peak_torque_nmm;
    run.total("peak_power_w") = t.peak_power_w;
    run.total("work_j") = t.work_j;
    run.total("collisions") = static_cast<double>(t.collisions.size());
    run.total("resolution_mm") = cell_mm;
}

FileResult<std::optional<SoundFile>> open_sound(const PreparedJob& prepared, const Box3& blank,
                                                double duration_s, const std::string& path,
                                                ComparedRun& run) {
    if (duration_s > kLongestSoundS) {
        run.missing.push_back("the sound: the program lasts longer than an hour");
        return std::optional<SoundFile>();
    }
    SoundFileOptions options;
    options.track = prepared.track;
    options.format.bits = prepared.job.sound.bits;
    options.format.sample_rate_hz = options.track.sample_rate_hz;
    job::apply(job::listening_to(prepared.job, blank), options.track);
    auto file = SoundFile::create(path, options, duration_s);
    if (!file) return std::unexpected(file.error());
    return std::optional<SoundFile>(*std::move(file));
}

FileResult<void> measure(PreparedJob& prepared, std::optional<surface::ToothTraces> traces,
                         const ParallelFor& parallel, ComparedRun& run) {
    if (!prepared.part) return {};
    surface::FormError form_error;
    if (traces) form_error = surface::FormError(*std::move(traces), run.session->stock(), parallel);
    auto designed = surface::DesignedSurface::make(std::move(prepared.part->mesh));
    if (!designed) {
        Error error = designed.error();
        error.file = prepared.job.part->path;
        return std::unexpected(FileFailure(error));
    }
    const surface::DeviationReport d = part_deviation(*run.session, *designed, form_error, parallel);
    run.total("gouge_max_mm") = d.gouge.mm;
    run.total("rest_max_mm") = d.rest.mm;
    run.total("scallop_max_mm") = d.scallop.mm;
    return {};
}

void append(const Warnings& more, Warnings& warnings) {
    warnings.insert(warnings.end(), more.begin(), more.end());
}

}  // namespace

std::string_view name_of(RunKind kind) {
    switch (kind) {
        case RunKind::job:
            return "job";
        case RunKind::program:
            return "program";
        case RunKind::folder:
            break;
    }
    return "render folder";
}

std::optional<double>& ComparedRun::total(std::string_view key) {
    const auto found = std::ranges::find(kTotals, key, &TotalWords::key);
    return totals.at(static_cast<std::size_t>(found - kTotals.begin()));
}

void ComparedRun::total_rows() {
    const auto raise = [](std::optional<double>& most, const std::optional<double>& value) {
        if (value && !(most && *most >= *value)) most = value;
    };
    for (const session::ComparedRow& row : rows) {
        raise(total("multiplier_max"), row.multiplier);
        raise(total("load_ratio_max"), row.load_ratio);
    }
}

int ComparedRun::line_at(Vec3 surface_mm) const {
    if (!session) return 0;
    const auto move = session->move_at(surface_mm);
    return move ? session->setup().moves[*move].line : 0;
}

FileResult<bool> is_program(const std::string& name) {
    std::error_code error;
    if (fs::is_directory(name, error)) return false;
    auto kind = job::kind_of_input(files::DiskSource(files::Pipes::read), name);
    if (!kind) return std::unexpected(kind.error());
    return kind->program.has_value();
}

FileResult<ComparedInput> open_input(const std::string& name, const ProgramFlags& flags,
                                     std::optional<double> resolution_mm) {
    std::error_code error;
    if (fs::is_directory(name, error)) return ComparedInput{name, {}};
    constexpr int kSoundHz = 48000;
    auto prepared = prepare_job(name, flags, session::MillOptions{resolution_mm, {}}, kSoundHz);
    if (!prepared) return std::unexpected(prepared.error());
    return ComparedInput{name, *std::move(prepared)};
}

FileResult<std::optional<ComparedRun>> mill_run(ComparedInput input, const std::string& sound_file,
                                                const ParallelFor& parallel, const char* stage) {
    PreparedJob prepared = *std::move(input.prepared);
    const bool steady = session::bends_steadily(prepared.job), bends = prepared.job.can_vibrate();
    // Both parts stay in memory.
    const double budget_mb = 0.5 * static_cast<double>(files::default_memory_budget_bytes()) / kMegabyte;
    const RunOutputs made{true, true, true,
                          steady || bends ? session::SurfaceRecorder::estimated_bytes(prepared.setup) : 0};
    if (auto fits = check_memory(input.name, prepared.setup, prepared.part, made, budget_mb); !fits)
        return std::unexpected(FileFailure(fits.error()));

    ComparedRun run;
    run.name = input.name;
    run.kind = prepared.is_program ? RunKind::program : RunKind::job;
    run.what = set_up(prepared);
    run.warnings = std::move(prepared.warnings);
    run.record = session::stock_record(prepared.setup);
    const double cell_mm = prepared.setup.cell_mm;
    const Box3 blank = prepared.setup.blank->bounds_mm();
    const session::LoadModel loads(prepared.setup, session::cut_limits(prepared.job, prepared.setup));

    std::optional<Progress> progress(std::in_place);
    const auto update = [&](double fraction) {
        progress->update(stage, fraction);
        return !interrupted();
    };
    run.session = std::make_unique<session::MillSession>(std::move(prepared.setup), parallel, update);
    const session::MillSetup& setup = run.session->setup();
    auto sound = open_sound(prepared, blank, run.session->duration_s(), sound_file, run);
    if (!sound) return std::unexpected(sound.error());

    const auto take = [&](const milling::CutRow& row, const milling::RowForce& force,
                          const session::RowChatter* chatter) {
        std::optional<double> multiplier;
        if (chatter != nullptr && chatter->stability) multiplier = chatter->stability->multiplier;
        session::RowLoads load = loads.loads(row, force.peaks, force.chip_mm);
        if (multiplier) loads.add_multiplier(row.cutter, *multiplier, load);
        run.rows.push_back(
            session::compared_row(row, force, multiplier, *std::ranges::max_element(load.ratio)));
        const bool vibrates = chatter != nullptr && chatter->vibration;
        if (*sound)
            (*sound)->add(row, force, setup.cutters[row.cutter].flutes,
                          vibrates ? &*chatter->vibration : nullptr);
    };
    std::optional<session::ProgramChatter> chatter;
    std::optional<session::SteadyBending> bending;
    if (bends) {
        chatter.emplace(setup, session::ProgramChatter::Options{true, true}, parallel,
                        [&](const milling::CutRow& row, const milling::RowForce& force,
                            const session::RowChatter& of_row) { take(row, force, &of_row); });
    } else if (steady) {
        bending.emplace(setup);
    }
    session::MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        if (chatter) {
            chatter->add(row, force);
        } else {
            if (bending) bending->add(row);
            take(row, force, nullptr);
        }
    };
    sinks.progress = update;
    if (!run.session->run(sinks)) return std::optional<ComparedRun>();
    if (chatter) chatter->finish();
    progress.reset();

    const session::MillTotals& totals = run.session->totals();
    if (*sound) {
        if (auto done = (*sound)->finish(totals.duration_s); !done) return std::unexpected(done.error());
        run.sound = (*sound)->for_report();
    }
    take_totals(totals, cell_mm, run);
    run.total_rows();
    append(session::warnings_of(totals, input.name, prepared.job.path.file), run.warnings);
    std::optional<surface::ToothTraces> traces;
    if (chatter) traces = chatter->take_surface();
    if (bending) traces = bending->take();
    run.mesh = field::fine_contour(run.session->stock(), parallel);
    run.untouched = session::untouched_triangles(
        run.mesh, session::vertices_on_blank(run.mesh, run.session->stock().blank(), parallel));
    if (auto done = measure(prepared, std::move(traces), parallel, run); !done)
        return std::unexpected(done.error());
    return std::optional<ComparedRun>(std::move(run));
}

}  // namespace tribo::app
