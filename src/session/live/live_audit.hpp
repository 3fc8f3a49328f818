// SPDX-License-Identifier: MIT
// The audit of a cut that is still being milled: of its rows so far, with the changes of the viewer.
#pragma once

#include <string>
#include <vector>

#include "session/live/live_mill.hpp"

namespace tribo::session {

struct LiveAudit {
    // As audit_json(), of the program up to `duration_s`. The multipliers of rows that are not computed yet
    // are left out.
    std::string json;
    std::vector<double> lines;  // kAuditColumns per line, in the order of time
};

// Times are those of the program without overrides. Takes about a microsecond per row, and ten where forces
// are changed. The mill must have limits (LiveExtras).
LiveAudit audit_of(const LiveMill& mill, const ParallelFor& parallel);

}  // namespace tribo::session
