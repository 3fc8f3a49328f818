// SPDX-License-Identifier: MIT
// Any lines of comments, with changes of the tool between them, give tools within their ranges.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/limits.hpp"
#include "readers/text/text_lines.hpp"
#include "readers/tools/tool_notes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 14;
    if (size > largest) return 0;
    readers::TextLines lines({reinterpret_cast<const char*>(data), size});
    readers::ToolNotes notes;
    motion::Move move;
    while (const auto line = lines.next()) {
        if (line->starts_with("M6")) {
            move.tool = static_cast<int>(line->size()) - 2;
            notes.change(move.tool);
        } else if (*line == "G1" || *line == "G81") {
            move.end.tip_mm = *line == "G1" ? Vec3{1, 0, 0} : Vec3{0, 0, -1};
            notes.cut(move);
        } else {
            notes.read(*line, lines.number());
        }
    }
    for (const double unit_mm : {1.0, 25.4}) {
        Warnings warnings;
        for (const motion::DeclaredTool& tool : notes.tools(unit_mm, "fuzz.nc", warnings)) {
            if (!kLimits.cutter_diameter.range.contains(tool.diameter_mm)) std::abort();
            if (!(tool.corner_mm >= 0 && 2 * tool.corner_mm <= tool.diameter_mm)) std::abort();
            if (tool.flutes < 0 || tool.flutes > 64 || tool.line < 1) std::abort();
        }
        for (const Warning& warning : warnings) {
            if (warning.text.empty()) std::abort();
        }
    }
    return 0;
}
