// SPDX-License-Identifier: MIT
// The modes of a tool without a measurement: a stepped beam on two joints.
#pragma once

#include <vector>

#include "dynamics/mode.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::dynamics {

// In which the true values lie in 9 of 10 cases: frequency times 0.8 to 1.25, stiffness times 0.5 to 2,
// damping 0.01 to 0.04.
inline constexpr ModeSpread kEstimateSpread{.frequency = 0.25, .damping = 1, .stiffness = 1};

// Of the six lowest bending modes the most flexible one at the tip, in x and in y, and the next one if its
// share of the static displacement is at least 0.3 of the first one's; ascending in frequency. The edges
// count as a bar of 0.8 of their diameter (Kops and Vo 1990). The holder is of steel, held on a rigid
// spindle; without a holder both joints are at the end of the stick-out. The cutter must have a stick-out and
// pass its check(). Takes less than a millisecond. Any thread; allocates.
std::vector<Mode> estimated_modes(const milling::Cutter& cutter);

}  // namespace tribo::dynamics
