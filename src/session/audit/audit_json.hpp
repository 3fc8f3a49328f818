// SPDX-License-Identifier: MIT
// An audit as text and as numbers, for files and for the module of the page.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "session/audit/verdict.hpp"

namespace tribo::session {

// One JSON object: verdict, loads over limits, tools with their limits, worst lines, collisions. Absent
// values have no key. docs/audit.md lists the keys.
std::string audit_json(const Audit& audit, const Verdict& verdict, const AuditFacts& facts,
                       const LoadModel& model, const MillSession& session);

// The numbers of a line: line, start s, duration s, tool number, spindle rpm, feed mm, feed s, cutting s,
// removed mm3; the largest of each load in the order of LoadKind; its ratio to the limit, likewise (0: no
// limit); rubbing s, plunge deg, jump N, entries, collisions.
inline constexpr std::size_t kAuditColumns = 9 + 2 * kLoadKinds + 5;
void append_audit_line(const LoadTally& line, const MillSetup& setup, std::vector<double>& numbers);

}  // namespace tribo::session
