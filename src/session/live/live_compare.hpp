// SPDX-License-Identifier: MIT
// The rows of a cut that is shown, for a comparison with another one (session/compare/compared_rows.hpp).
#pragma once

#include <vector>

#include "session/compare/compared_rows.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {

// The rows so far, with the changes of the viewer, in the order of time. Times are those of the program
// without overrides. Multipliers that are not computed yet are absent, and so are tool loads without limits
// (LiveExtras). Takes about a microsecond per row, and ten where forces are changed.
std::vector<ComparedRow> compared_rows(const LiveMill& mill, const ParallelFor& parallel);

}  // namespace tribo::session
