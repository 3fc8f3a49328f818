// SPDX-License-Identifier: MIT
// Where the force of a cut acts on its tool.
#pragma once

#include "milling/engagement/engagement.hpp"

namespace tribo::milling {

// The height above the tip at which the force of an engagement acts: the mean of the heights in the cut,
// weighted by their angle. 0 on the bottom.
double load_height_mm(const Engagement& engagement);

}  // namespace tribo::milling
