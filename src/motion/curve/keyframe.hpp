// SPDX-License-Identifier: MIT
// A pose that a motion passes through, as in a keyframe table.
#pragma once

#include "motion/path/program.hpp"

namespace tribo::motion {

struct Keyframe {
    ToolPose pose;
    double weight = 1;           // > 0; a larger one pulls the rational motion between keyframes nearer
    double feed_mm_per_min = 0;  // on the way to this keyframe; 0: not given
    int line = 0;                // of the source, from 1; 0: not from a file

    bool operator==(const Keyframe&) const = default;
};

}  // namespace tribo::motion
