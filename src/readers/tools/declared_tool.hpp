// SPDX-License-Identifier: MIT
// A tool as milling takes it, from the words and sizes of comments and libraries. Any thread; allocates.
#pragma once

#include <string>

#include "motion/path/program.hpp"
#include "readers/tools/tool_shape.hpp"

namespace tribo::readers {

// Sizes in mm and degrees; 0: not stated.
struct ToolSizes {
    ToolShape shape = ToolShape::unstated;
    double diameter_mm = 0;  // of the largest cutting edge
    double corner_mm = 0;
    double tip_mm = 0;     // diameter of a flat tip
    double point_deg = 0;  // full angle of a point
    double taper_deg = 0;  // of the side to the axis
    double side_mm = 0;    // radius of the side
    double edge_mm = 0;    // length of the cutting edges
    double neck_mm = 0;    // diameter above the edges
    int flutes = 0;
};

// Fills the tool's shape: kind, diameter, corner, angles, edges. What is assumed, or milled in another shape
// than stated, is added to the remark. Returns false where no such cutter exists (no diameter, a corner too
// large); the remark then says why.
bool set_shape(motion::DeclaredTool& tool, ToolSizes sizes, std::string& remark);

}  // namespace tribo::readers
