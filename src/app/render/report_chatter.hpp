// SPDX-License-Identifier: MIT
// What the report says about the place of a program that chatters most.
#pragma once

#include "report/report_html.hpp"
#include "session/chatter/program_chatter.hpp"

namespace tribo::app {

// Chart, advice and vibration of the worst row, as a steady cut. Takes about a second. Without a row that has
// a multiplier, and where the spindle is too slow for a chart, the advice says so.
report::ReportChatter report_chatter(const session::ProgramChatter& chatter, const session::MillSetup& setup,
                                     const ParallelFor& parallel);

}  // namespace tribo::app
