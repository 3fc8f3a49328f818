// SPDX-License-Identifier: MIT
// Acoustic environment of a cut: machine, chips and room, with their levels.
#pragma once

#include <cstddef>

#include "base/limits.hpp"
#include "sound/play/soundtrack.hpp"

namespace tribo::sound {

inline constexpr double kLargestLevelDb = kLimits.level.range.max;

// Levels in dB relative to the defaults of machine, material and room, within +-kLargestLevelDb.
struct Workshop {
    std::size_t machine = 0, room = 0;  // in machines() and rooms(); 0: none
    ChipMaterial chips = ChipMaterial::none;
    double cut_db = 0;      // noise of the cutting power
    double spindle_db = 0;  // the machine's own sound
    double chips_db = 0, room_db = 0;
};

// Whether machine and room exist and all levels are in range.
bool is_valid(const Workshop& workshop);

// Sets machine, chips and room of a track. A learned spectrum of chips is kept.
void apply(const Workshop& workshop, SoundtrackOptions& options);

}  // namespace tribo::sound
