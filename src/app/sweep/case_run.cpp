// SPDX-License-Identifier: MIT
#include "app/sweep/case_run.hpp"

#include <algorithm>
#include <array>

#include "app/interrupt.hpp"
#include "app/render/part_deviation.hpp"
#include "app/render/render_job.hpp"
#include "session/audit/auditor.hpp"
#include "session/chatter/critical_row.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/chatter/steady_bending.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::app {
namespace {

using Results = std::vector<std::pair<std::string, double>>;

constexpr double kMegabyte = 1e6;

Result<void> interrupted_run() {
    return fail("the run was interrupted", "run the sweep again");
}

bool wants(const job::Sweep& sweep, job::SweepResult result) {
    return std::ranges::count(sweep.compute, result) > 0;
}

Result<session::MillSetup> prepare(const job::Sweep& sweep, const job::LoadedJob& loaded,
                                   double memory_bytes) {
    Warnings warnings;
    session::MillOptions options{sweep.resolution_mm, sweep.until_s};
    options.memory_bytes = static_cast<std::uint64_t>(memory_bytes);
    auto setup = session::prepare_mill(loaded, options, warnings);
    if (!setup) return setup;
    RunOutputs made;
    if (loaded.job.can_vibrate() || session::bends_steadily(loaded.job))
        made.chatter_bytes = session::SurfaceRecorder::estimated_bytes(*setup);
    const auto budget_mb = memory_bytes > 0 ? std::optional(memory_bytes / kMegabyte) : std::nullopt;
    if (auto fits = check_memory(loaded.job.file, *setup, loaded.part, made, budget_mb); !fits)
        return std::unexpected(fits.error());
    return setup;
}

Result<void> add_summary(const session::MillSession& session, const session::ProgramChatter* chatter,
                         std::optional<surface::ToothTraces> traces, job::LoadedJob& loaded,
                         Results& results) {
    const session::MillTotals& t = session.totals();
    results.insert(results.end(), {{"duration_s", t.duration_s},
                                   {"cutting_s", t.cutting_s},
                                   {"path_mm", t.path_mm},
                                   {"removed_mm3", t.removed_mm3},
                                   {"remaining_mm3", t.remaining_mm3},
                                   {"mean_force_n", t.mean_force_n},
                                   {"peak_force_n", t.peak_force_n},
                                   {"peak_torque_nm", 1e-3 * t.peak_torque_nmm},
                                   {"peak_power_w", t.peak_power_w},
                                   {"work_j", t.work_j},
                                   {"collisions", static_cast<double>(t.collisions.size())}});
    if (t.rows > 0) results.emplace_back("tooth_passing_hz", t.tooth_passing_hz);
    if (t.energy_balance) results.emplace_back("energy_balance", *t.energy_balance);
    if (chatter) {
        results.emplace_back("chatter_lines", static_cast<double>(chatter->totals().lines.size()));
        results.emplace_back("largest_displacement_mm", chatter->totals().largest_displacement_mm);
    }
    surface::FormError form_error;
    if (traces) form_error = surface::FormError(*std::move(traces), session.stock(), serial_for);
    if (!form_error.empty()) {
        results.emplace_back("bending_leaves_mm", form_error.extremes().left_mm);
        results.emplace_back("bending_overcuts_mm", form_error.extremes().overcut_mm);
    }
    if (!loaded.part) return {};
    const auto designed = surface::DesignedSurface::make(std::move(loaded.part->mesh));
    if (!designed) return std::unexpected(designed.error());
    const surface::DeviationReport d = part_deviation(session, *designed, form_error, serial_for);
    results.insert(
        results.end(),
        {{"gouge_max_mm", d.gouge.mm}, {"rest_max_mm", d.rest.mm}, {"scallop_max_mm", d.scallop.mm}});
    return {};
}

// In the order of session::LoadKind.
constexpr std::array<const char*, session::kLoadKinds> kRatioNames{
    "force_ratio",      "torque_ratio", "power_ratio",     "stress_ratio",
    "deflection_ratio", "chip_ratio",   "multiplier_ratio"};

// The largest loads of all tools and lines, and their share of the limits.
void add_loads(const session::Audit& audit, Results& results) {
    for (std::size_t kind = 0; kind < session::kLoadKinds; ++kind) {
        double value = 0, ratio = 0;
        for (const session::LoadTally& tool : audit.tools) {
            value = std::max(value, tool.peaks[kind].value);
            ratio = std::max(ratio, tool.peaks[kind].ratio);
        }
        const std::string key(session::kLoadWords[kind].key);
        const bool is_new = std::ranges::count(results, key, &Results::value_type::first) == 0;
        if (value > 0 && is_new) results.emplace_back(key, value);
        if (ratio > 0) results.emplace_back(kRatioNames[kind], ratio);
    }
    results.emplace_back("air_share", audit.air_share());
}

// Summary, audit or both, from one run.
Result<void> add_run(const job::Sweep& sweep, job::LoadedJob& loaded, double memory_bytes, Results& results) {
    auto setup = prepare(sweep, loaded, memory_bytes);
    if (!setup) return std::unexpected(setup.error());
    std::optional<session::LoadModel> model;
    if (wants(sweep, job::SweepResult::audit)) model.emplace(*setup, session::cut_limits(loaded.job, *setup));
    session::MillSession session(*std::move(setup), serial_for, [](double) { return !interrupted(); });
    session::MillSinks sinks;
    std::optional<session::Auditor> auditor;
    if (model) {
        auditor.emplace(*model, session, [](const session::LoadTally&) {});
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            auditor->add(row, force, {});
        };
    }
    std::optional<session::ProgramChatter> chatter;
    std::optional<session::SteadyBending> bending;
    if (loaded.job.can_vibrate()) {
        chatter.emplace(session.setup(), session::ProgramChatter::Options{false, true}, serial_for,
                        [&](const milling::CutRow& row, const milling::RowForce& force,
                            const session::RowChatter& of_row) {
                            const auto& stability = of_row.stability;
                            if (auditor)
                                auditor->add(row, force,
                                             stability ? std::optional(stability->multiplier) : std::nullopt);
                        });
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            chatter->add(row, force);
        };
    } else if (session::bends_steadily(loaded.job)) {
        bending.emplace(session.setup());
        sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
            bending->add(row);
            if (auditor) auditor->add(row, force, {});
        };
    }
    sinks.progress = [](double) { return !interrupted(); };
    if (!session.run(sinks)) return interrupted_run();
    if (chatter) chatter->finish();
    if (wants(sweep, job::SweepResult::summary)) {
        std::optional<surface::ToothTraces> traces;
        if (chatter) traces = chatter->take_surface();
        if (bending) traces = bending->take();
        if (auto done =
                add_summary(session, chatter ? &*chatter : nullptr, std::move(traces), loaded, results);
            !done)
            return done;
    }
    if (auditor) add_loads(auditor->finish(), results);
    return {};
}

Result<session::SteadyCut> steady_cut(const job::Sweep& sweep, const job::LoadedJob& loaded,
                                      double memory_bytes) {
    if (auto good = session::check_modes(loaded.job); !good) return std::unexpected(good.error());
    if (loaded.job.engagement) {
        Warnings warnings;
        return session::steady_cut(loaded.job, loaded.program, warnings);
    }
    auto setup = prepare(sweep, loaded, memory_bytes);
    if (!setup) return std::unexpected(setup.error());
    return session::critical_row(loaded, *std::move(setup), {}, serial_for,
                                 [](double) { return !interrupted(); });
}

Result<void> add_stability(const job::Sweep& sweep, const job::LoadedJob& loaded, double memory_bytes,
                           Results& results) {
    const auto cut = steady_cut(sweep, loaded, memory_bytes);
    if (!cut) return std::unexpected(cut.error());
    if (interrupted()) return interrupted_run();
    if (cut->spindle_rpm < cut->least_rpm(cut->axial_depth_mm))
        return fail("the modes vibrate too often from tooth to tooth to be computed",
                    "ask for a higher speed");
    const dynamics::Stability stability = cut->at(cut->spindle_rpm, cut->axial_depth_mm);
    results.emplace_back("multiplier", stability.multiplier);
    results.emplace_back("chatter_hz", stability.chatter_hz);
    if (cut->spindle_rpm < cut->least_rpm(cut->cutter.length_mm)) return {};
    if (const auto depth_mm = cut->limit(cut->spindle_rpm).depth_mm)
        results.emplace_back("stable_depth_mm", *depth_mm);
    return {};
}

}  // namespace

Result<void> run_case(const job::Sweep& sweep, job::LoadedJob loaded, double memory_bytes, Results& results) {
    if (wants(sweep, job::SweepResult::stability)) {
        if (auto done = add_stability(sweep, loaded, memory_bytes, results); !done) return done;
    }
    if (wants(sweep, job::SweepResult::summary) || wants(sweep, job::SweepResult::audit))
        return add_run(sweep, loaded, memory_bytes, results);
    return {};
}

}  // namespace tribo::app
