// SPDX-License-Identifier: MIT
// The readers of tool libraries by the text they are written in; readers/tables/tool_table.hpp chooses among
// them. docs/tools.md lists what of each library is read. Any thread; allocates.
#pragma once

#include <string>
#include <string_view>

#include "readers/text/document.hpp"
#include "readers/tools/library/library_tools.hpp"

namespace tribo::readers {

inline constexpr double kMmPerInch = 25.4;

Result<ToolTable> read_json_library(std::string_view bytes, const std::string& source_name);
// DIN 4000 (the classes 81 and 82), and properties of ISO 13399 by their codes.
Result<ToolTable> read_xml_library(std::string_view bytes, const std::string& source_name);
// A CSV or tab-separated export of Fusion or HSM: columns named tool_diameter, tool_type, ...
Result<ToolTable> read_csv_library(std::string_view bytes, const std::string& source_name);
// True if the first line has such columns.
bool is_csv_library(std::string_view bytes);

}  // namespace tribo::readers
