// SPDX-License-Identifier: MIT
// A random cut for tests: any cutter, a motion, a stock that may have been cut before. Sizes go with the
// cutter's diameter, and so does the grid: a case takes some hundredths of a second.
#pragma once

#include <cstdint>
#include <string>

#include "session/cut/mill_session.hpp"

namespace tribo::session {

enum class CutMotion { slot, ramp, plunge, turning_slot, pivot, fan, arc, bore };
// Whether the tool's axis turns.
bool turns(CutMotion motion);
enum class CutStock { box, plate, stepped };

struct RandomCut {
    MillSetup setup;
    CutMotion motion = CutMotion::slot;
    CutStock stock = CutStock::box;
    std::string words;  // what it is, for a message
};

// The same cut for the same seed.
RandomCut random_cut(std::uint64_t seed);

}  // namespace tribo::session
