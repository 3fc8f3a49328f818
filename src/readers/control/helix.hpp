// SPDX-License-Identifier: MIT
// Helices between two half circles that touch them, as thread milling cycles describe them. Pure geometry,
// mm.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/control/pocket.hpp"

namespace tribo::readers::control {

struct Helix {
    Vec3 centre;                   // in the plane
    double radius = 0, lead = 0;   // of the helix, and of the half circles
    double turns = 0;              // of the helix
    double from_z = 0, to_z = 0;   // its heights
    double feed = 0;               // mm/min
    std::optional<double> plunge;  // mm/min, down to from_z; none: a rapid
    double way = 1;                // -1: clockwise
    bool is_outside = false;       // about a bolt: the half circles begin and end beside it
};

// `from`: where the tool is. It goes beside the helix at its height, then down. Returns where it ends.
Result<Vec3> mill_helix(const Helix& helix, Vec3 from, const PocketMove& go);

}  // namespace tribo::readers::control
