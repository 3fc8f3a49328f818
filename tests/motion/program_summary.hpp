// SPDX-License-Identifier: MIT
// The summary of a whole program.
#pragma once

#include "motion/path/summary.hpp"

namespace tribo::motion::testing {

inline ProgramSummary summary_of(const Program& program, double rapid_mm_per_min = 10'000) {
    ProgramMeter meter;
    for (const Move& move : program.moves) meter.add(move);
    return meter.summary(rapid_mm_per_min);
}

}  // namespace tribo::motion::testing
