// SPDX-License-Identifier: MIT
// Tool tables: LinuxCNC's tool.tbl (T1 P1 D6 Z50.2 ;comment), CSV with a header, and libraries of CAM systems
// (tools/library/libraries.hpp). Any thread; allocates.
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
    // Different numbers; diameter, corner, flutes, length if given. A single tool of a library that gives no
    // numbers has the number 0.
    std::vector<motion::DeclaredTool> tools;
    Warnings warnings;
};

// A CSV table begins with a line of column names: number, diameter_mm (both required), corner_mm, flutes,
// length_mm (from the spindle nose to the tip). Libraries are told by their content: JSON of Fusion and
// FreeCAD, XML of DIN 4000 and ISO 13399, CSV of Fusion and HSM. Any other text is read as tool.tbl; the
// comment of a line may state shape, corner and flutes.
Result<ToolTable> read_tool_table(std::string_view bytes, const ToolTableOptions& options = {});

// True for a file that read_tool_table() is for, by its name (.tbl, .fctb, .tools, .json, .xml), a CSV file
// by its columns.
bool is_tool_table(std::string_view bytes, std::string_view name);

}  // namespace tribo::readers
