// SPDX-License-Identifier: MIT
// audit.html: one file that opens offline and says whether a program's cutters live: the verdict, the set-up,
// the tools, loads along the program, and its worst lines with their text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/html_parts.hpp"

namespace tribo::report {

// A value over the time of the program: in equal steps, the largest of each.
struct AuditCurve {
    std::string title;
    double duration_s = 0;
    std::vector<double> values;  // >= 0
    double limit = 0;            // 0: none
};

struct AuditPage {
    std::string title, subtitle, verdict, version;
    bool is_bad = false;  // something is over a limit
    std::vector<std::string> findings, warnings;
    std::vector<std::pair<std::string, std::string>> facts;  // the set-up: name, text
    std::vector<HtmlTable> tables;
    std::vector<AuditCurve> curves;
};

std::string audit_page(const AuditPage& page);

}  // namespace tribo::report
