// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "golden/golden.hpp"
#include "readers/gcode/reader.hpp"
#include "session/audit/audit_json.hpp"
#include "session/chatter/row_stability.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::golden {

// Two tools that may chatter, limits of all kinds, a plunge and a collision with a fixture.
std::uint64_t audit() {
    constexpr std::string_view kProgram = R"(G21 G90 G17
T1 M6 S6000 M3
G0 X-16 Y-6 Z2
G1 Z-2 F900
X16
T2 M6 S9000
G0 X0 Y4 Z2
G1 Z-3 F200
G3 X6 Y4 I3 J0 F700
G0 Z-4
G1 X14 F500
)";
    job::LoadedJob loaded;
    auto program = readers::read_gcode(kProgram);
    if (!program) return 0;
    loaded.program = std::move(*program);
    milling::Cutter flat{.number = 1, .diameter_mm = 8, .length_mm = 20};
    milling::Cutter ball = flat;
    ball.number = 2;
    ball.kind = milling::CutterKind::ball;
    ball.diameter_mm = 6;
    ball.stickout_mm = 30;
    loaded.job.cutters = {flat, ball};
    loaded.job.material.name = "al7075-t6";
    loaded.job.modes = {{.frequency_hz = 1100, .damping_ratio = 0.02, .stiffness_n_per_mm = 8000}};
    loaded.job.limits.force_n = 60;
    loaded.job.limits.spindle = {{3000, 300, 1}, {9000, 400, 0.8}};
    loaded.job.limits.deflection_mm = 0.01;
    loaded.blank = job::box_solid({{-12, -12, -8}, {12, 12, 0}});
    loaded.fixtures.push_back(job::box_solid({{13, -20, -8}, {20, 20, 3}}));
    Warnings warnings;
    auto setup = session::prepare_mill(loaded, {0.5, {}}, warnings);
    if (!setup) return 0;
    session::LoadModel model(*setup, session::cut_limits(loaded.job, *setup));
    session::MillSession session(std::move(*setup), serial_for);
    std::vector<double> lines;
    session::Auditor auditor(model, session, [&](const session::LoadTally& line) {
        session::append_audit_line(line, session.setup(), lines);
    });
    session::MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        std::optional<double> multiplier;
        if (!row.engagement.bands.empty())
            if (const auto stability = session::stability_of(row, session.setup()))
                multiplier = stability->multiplier;
        auditor.add(row, force, multiplier);
    };
    if (!session.run(sinks)) return 0;
    const session::Audit audit = auditor.finish();
    if (audit.tools.size() != 2 || session.totals().collisions.empty()) return 0;
    const session::AuditFacts facts{.chatter_probability = 0.3, .gouge_mm = 0.01};
    const std::string text =
        session::audit_json(audit, session::verdict(audit, model, session, facts), facts, model, session);
    Hash hash;
    hash.add(std::string_view(text));
    hash.add(lines);
    return hash.value();
}

}  // namespace tribo::golden
