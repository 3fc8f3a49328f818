// SPDX-License-Identifier: MIT
// The frequency at which a vibration with a known multiplier moves most.
#pragma once

#include "dynamics/eigenvalue/largest_eigenvalue.hpp"
#include "dynamics/eigenvalue/period_step.hpp"

namespace tribo::dynamics {

// A multiplier fixes its frequency but for whole waves in a period: the vibration is a sum of harmonics
// e^(s_n t), s_n = (log multiplier + 2 pi i n) / period_s. Each is the answer of the modes to that harmonic
// of the force. Returns the frequency of the one with the largest displacement, Hz; without a force that of
// the one that the modes answer most. Up to twice `fastest_hz`, the highest natural frequency. Any thread;
// allocates.
double chatter_line_hz(const PeriodStep& step, const Eigenpair& vibration, double period_s,
                       double fastest_hz);

}  // namespace tribo::dynamics
