// SPDX-License-Identifier: MIT
// The way of a tool in a pocket with any contour and islands, where a cycle leaves it to its control: rings
// from the inside outwards, depth by depth. Pure geometry, mm.
#pragma once

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "readers/control/area.hpp"
#include "readers/control/pocket.hpp"

namespace tribo::readers::control {

// Closes the contour by a line where its ends are hardly apart; false where they are more.
bool close_ring(Ring& ring);

struct AreaMilling {
    PocketDepths depths;
    double radius = 0;                           // of the tool
    double infeed = 0, step = 0, allowance = 0;  // step: from ring to ring
    double feed = 0, plunge = 0;                 // mm/min
    bool clockwise = false, along_edge = false;  // along its edge only
};

// The rings from the inside outwards, none where the tool does not fit; nothing where they are too many to be
// laid.
std::optional<std::vector<Ring>> rings_of(const Area& area, const AreaMilling& milling);
// Number of rings at all depths.
double ring_count(const std::vector<Ring>& rings, const AreaMilling& milling);

// `from`: where the tool is.
Result<void> mill_area(const Area& area, const std::vector<Ring>& rings, const AreaMilling& milling,
                       Vec3 from, const PocketMove& go);

}  // namespace tribo::readers::control
