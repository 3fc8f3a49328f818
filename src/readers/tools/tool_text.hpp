// SPDX-License-Identifier: MIT
// What a line of text says about a tool: comments of CAM systems, messages of programs, names of tools. The
// forms are listed in docs/tools.md. Any thread; allocates.
#pragma once

#include <optional>
#include <string_view>

#include "readers/tools/tool_shape.hpp"

namespace tribo::readers {

// A length as it stands in the text.
struct StatedLength {
    double value = 0;
    double unit_mm = 0;  // 0: the text states no unit

    double mm(double unit_of_program_mm) const {
        return value * (unit_mm > 0 ? unit_mm : unit_of_program_mm);
    }
};

struct ToolText {
    std::optional<int> number;
    // The number is that of `TOOL - 5`, which CAM systems may count otherwise than the program does.
    bool is_number_of_library = false;
    ToolShape shape = ToolShape::unstated;
    bool names_tool = false;  // by a noun such as mill or drill, or as "tool diameter"
    // The diameter is what the control's radius compensation uses: `T1 D=10`, `CONTROL COMP`. CAM systems
    // that write other forms often compensate themselves and leave wear to the control.
    bool is_for_compensation = false;
    bool is_bare_size = false;                     // a number and nothing else
    bool asks_for_size = false;                    // "Tool Size" and no number: the next line is the size
    std::optional<StatedLength> diameter, corner;  // > 0, >= 0
    std::optional<double> angle_deg;  // `TAPER=118deg`, `60 degree`; its meaning depends on the shape
    bool is_taper_key = false;        // the angle stands behind TAPER
    double height = 0;                // of the cone of CutViewer's TOOL/MILL, in the unit of the program
    int flutes = 0;                   // 0: not stated

    // True if the text is about a tool: it has a number or a noun, and a diameter.
    bool describes_tool() const { return diameter && (number || names_tool); }
};

// Never fails: a text that is about something else gives nothing. `is_name`: it is the name of a tool.
ToolText read_tool_text(std::string_view text, bool is_name = false);

}  // namespace tribo::readers
