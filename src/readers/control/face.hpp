// SPDX-License-Identifier: MIT
// Lines over a face, depth by depth, as face milling cycles describe them. Pure geometry, mm.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "readers/control/pocket.hpp"

namespace tribo::readers::control {

enum class FaceWay {
    back_and_forth,  // from line to line at its end
    one_way,         // back above the face
    spiral           // rings, from the outside inwards
};

struct Face {
    PocketDepths depths;
    Vec3 corner;                   // in the plane
    double length = 0, width = 0;  // from the corner; negative: to the other side
    double angle_rad = 0;          // turns the face about the corner
    bool along_width = false;      // the lines run along the width
    FaceWay way = FaceWay::back_and_forth;
    double start_over = 0, over = 0;   // of the lines beyond the edges: at the first start, else
    double step = 0;                   // at most, from line to line
    std::optional<double> lines;       // their number where the cycle states it
    double infeed = 0;                 // at most; 0: all at once
    double left = 0;                   // on the floor, for one finishing pass
    double lift = 0;                   // one_way: above the line that was milled
    double feed = 0, finish_feed = 0;  // mm/min
    std::optional<double> between;     // mm/min, from line to line; none: a rapid
};

// Number of lines, or of rings, at all depths.
double line_count(const Face& face);

// `from`: where the tool is.
Result<void> mill_face(const Face& face, Vec3 from, const PocketMove& go);

}  // namespace tribo::readers::control
