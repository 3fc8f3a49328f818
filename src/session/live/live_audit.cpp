// SPDX-License-Identifier: MIT
#include "session/live/live_audit.hpp"

#include <algorithm>
#include <cassert>

#include "session/audit/audit_json.hpp"
#include "session/chatter/probability.hpp"
#include "session/live/chart_of_cut.hpp"

namespace tribo::session {
namespace {

// Rows whose forces are computed together.
constexpr std::size_t kRowsAtOnce = 1024;

std::optional<double> chatter_probability_at(const milling::CutRow& row, const MillSetup& setup,
                                             const CutChange& change) {
    return chatter_probability(changed_cut_of(row, setup, kRowBands, change),
                               change.uncertain_cases > 0 ? change.uncertain_cases : kCases);
}

}  // namespace

LiveAudit audit_of(const LiveMill& mill, const ParallelFor& parallel) {
    assert(mill.extras().limits);
    const MillSession& session = mill.session();
    const MillSetup& setup = session.setup();
    const CutChange& change = mill.change();
    LoadModel model(setup, *mill.extras().limits);
    if (change.coefficients) model.set_force_band(change.force_low_factor, change.force_high_factor);

    LiveAudit result;
    const auto keep = [&](const LoadTally& line) { append_audit_line(line, setup, result.lines); };
    Auditor auditor(model, session, keep, std::clamp(session.known_s(), 0.0, session.duration_s()));
    if (change.uncertain_cases > 0) auditor.use(ForceCases(setup, change.uncertain_cases, parallel, change));
    const std::span<const milling::CutRow> rows = mill.record().rows();
    std::optional<std::size_t> worst;
    double most = 0;
    for (std::size_t first = 0; first < rows.size(); first += kRowsAtOnce) {
        const auto some = rows.subspan(first, std::min(kRowsAtOnce, rows.size() - first));
        const auto forces = changed_forces(some, setup, change, some.size(), parallel);
        for (std::size_t n = 0; n < some.size(); ++n) {
            const std::optional<double> multiplier = mill.multiplier(first + n);
            if (multiplier.value_or(0) > most) {
                most = *multiplier;
                worst = first + n;
            }
            auditor.add(changed_row(some[n], change), forces[n], multiplier);
        }
    }
    const Audit audit = auditor.finish();
    AuditFacts facts;
    if (worst) facts.chatter_probability = chatter_probability_at(rows[*worst], setup, change);
    result.json = audit_json(audit, verdict(audit, model, session, facts), facts, model, session);
    return result;
}

}  // namespace tribo::session
