// SPDX-License-Identifier: MIT
// A slot of known force: a straight tooth without edge coefficients, so that the tangential force over the
// depth is ktc times the chip.
#pragma once

#include "session/audit/verdict.hpp"
#include "session/block_setup.hpp"
#include "session/chatter/row_stability.hpp"

namespace tribo::session {

inline constexpr double kSlotKtc = 1000, kSlotDepth = 2, kSlotRpm = 6000;

// One tooth of 10 mm, 20 mm long, without helix: a chip of f = 0.1 mm at 600 mm/min and a largest force of
// ktc 2 mm 0.1 mm = 200 N.
inline MillSetup slot_setup(double feed_mm_per_min = 600) {
    milling::Cutter cutter{.number = 3, .diameter_mm = 10, .flutes = 1, .helix_deg = 0, .length_mm = 20};
    MillSetup setup = block_setup(Box3{{0, -20, -10}, {30, 20, 0}}, cutter, 0.5);
    setup.coefficients = {.ktc = kSlotKtc};
    setup.engagement = PrescribedEngagement{0, 3.14159265358979, kSlotDepth};
    motion::Move cut = straight_cut({-10, 0, -kSlotDepth}, {40, 0, -kSlotDepth}, feed_mm_per_min);
    cut.line = 7;
    add_cut(setup, cut, kSlotRpm);
    return setup;
}

struct AuditedCut {
    Audit audit;
    Verdict verdict;
    std::vector<LoadTally> lines;
};

// Multipliers are computed where the setup has modes. `cases`: of the bands; 0: those of the force.
inline AuditedCut audited(MillSetup setup, const job::JobLimits& limits, const AuditFacts& facts = {},
                          std::size_t cases = 0) {
    job::Job job;
    job.limits = limits;
    for (const std::vector<dynamics::Mode>& modes : setup.modes_of_cutter) job.modes = modes;
    const LoadModel model(setup, cut_limits(job, setup));
    MillSession session(std::move(setup), serial_for);
    AuditedCut result;
    Auditor auditor(model, session, [&](const LoadTally& line) { result.lines.push_back(line); });
    if (cases > 0) auditor.use(ForceCases(session.setup(), cases, serial_for));
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        std::optional<double> multiplier;
        if (!job.modes.empty()) multiplier = stability_of(row, session.setup())->multiplier;
        auditor.add(row, force, multiplier);
    };
    session.run(sinks);
    result.audit = auditor.finish();
    result.verdict = verdict(result.audit, model, session, facts);
    return result;
}

}  // namespace tribo::session
