// SPDX-License-Identifier: MIT
// Shapes of tools as people and CAM systems name them, in several languages. Any thread.
#pragma once

#include <string_view>

namespace tribo::readers {

enum class ToolShape {
    unstated,
    flat,
    ball,
    bull,
    face,
    taper,
    v,
    chamfer,
    countersink,
    drill,
    spot_drill,
    centre_drill,
    engraver,
    dovetail,
    lens,
    barrel,
    lollipop,
    thread,
    slot,
    corner_rounding,
    form,
    reamer,
    tap,
    boring,
    counterbore,
    probe,
    turning,
};

struct ShapeWords {
    ToolShape shape = ToolShape::unstated;
    bool names_tool = false;  // by a noun such as mill, cutter, drill; not by an adjective alone
};

// Finds the shape in a text of folded().
ShapeWords shape_in(std::string_view folded_text);

// True for a single word that names a tool, such as MILL, DRILL or SCHAFTFRAESER.
bool is_noun_of_tool(std::string_view folded_word);

// Returns the English name, for messages: "spot drill".
std::string_view name_of(ToolShape shape);

}  // namespace tribo::readers
