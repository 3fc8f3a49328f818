// SPDX-License-Identifier: MIT
// The texts of page/, built into the library (CMakeLists.txt makes the source from report_page.cpp.in).
#pragma once

#include <string_view>

namespace tribo::report {

extern const std::string_view kReportPage;  // with {{marks}} to be replaced
extern const std::string_view kReportStyle;
extern const std::string_view kReportScript;
extern const std::string_view kReportView;        // the part in 3D
extern const std::string_view kReportComparison;  // the page of a comparison, with {{marks}}
extern const std::string_view kReportCompare;     // its script

}  // namespace tribo::report
