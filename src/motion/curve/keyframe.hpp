// SPDX-License-Identifier: MIT
// A pose that a motion passes through, as a keyframe table gives it.
#pragma once

#include "motion/path/program.hpp"

namespace tribo::motion {

struct Keyframe {
    ToolPose pose;
    double weight = 1;           // > 0; a larger one pulls the rational motion between its keyframes nearer
    double feed_mm_per_min = 0;  // on the way to this keyframe; 0: the keyframe says nothing
    int line = 0;                // of the source, from 1; 0: from no file

    bool operator==(const Keyframe&) const = default;
};

}  // namespace tribo::motion
