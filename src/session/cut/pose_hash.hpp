// SPDX-License-Identifier: MIT
// A pose of the tool in the hash of a cut.
#pragma once

#include "base/hash.hpp"
#include "motion/path/program.hpp"

namespace tribo::session {

inline void add(Hash& hash, const motion::ToolPose& pose) {
    hash.add(pose.tip_mm);
    hash.add(pose.axis);
}

}  // namespace tribo::session
