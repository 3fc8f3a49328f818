// SPDX-License-Identifier: MIT
// The set-up sheet of a report: what stands on the machine, its tools, and the files that say so.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/render/render_job.hpp"
#include "report/report_html.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::app {

// `file`: the job or program as called. `rows`: all of the cut.
std::vector<report::HtmlTable> report_sheet(const std::string& file, const PreparedJob& loaded,
                                            const session::MillSession& session,
                                            std::span<const report::ReportRow> rows);

}  // namespace tribo::app
