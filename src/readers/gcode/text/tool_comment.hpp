// SPDX-License-Identifier: MIT
// The tool list that CAM systems write into comments: (T1 D=10. CR=0. - ZMIN=-6. - flat end mill).
#pragma once

#include <optional>
#include <string_view>

namespace tribo::readers::gcode {

struct ToolComment {
    int number = 0;
    double diameter = 0, corner = 0;  // in the unit of the program
};

// Returns the tool of a comment that starts with T, a number and D=, with an optional CR=. Returns none for
// other comments.
std::optional<ToolComment> tool_in_comment(std::string_view comment);

}  // namespace tribo::readers::gcode
