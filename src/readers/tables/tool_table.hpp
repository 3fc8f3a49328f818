// SPDX-License-Identifier: MIT
// Tool tables: LinuxCNC's tool.tbl (T1 P1 D6 Z50.2 ;comment) and CSV with a header. Any thread; allocates.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers {

struct ToolTableOptions {
    std::string source_name{};                 // used in messages
    LengthUnit unit = LengthUnit::millimetre;  // unit of tool.tbl, which does not state one; CSV is in mm
};

struct ToolTable {
    std::vector<motion::DeclaredTool> tools;  // different numbers; diameter, corner, flutes, length if given
    Warnings warnings;
};

// A CSV table begins with a line of column names: number, diameter_mm (both required), corner_mm, flutes,
// length_mm (from the spindle nose to the tip). Any other text is read as tool.tbl.
Result<ToolTable> read_tool_table(std::string_view bytes, const ToolTableOptions& options = {});

}  // namespace tribo::readers
