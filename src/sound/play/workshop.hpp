// SPDX-License-Identifier: MIT
// What stands around a cut, by choice: machine, chips and room, and how loud each is.
#pragma once

#include <cstddef>

#include "sound/play/soundtrack.hpp"

namespace tribo::sound {

inline constexpr double kLargestLevelDb = 60;

// Levels in dB against what the machine, the material and the room have, within +-kLargestLevelDb.
struct Workshop {
    std::size_t machine = 0, room = 0;  // in machines() and rooms(); 0: none
    ChipMaterial chips = ChipMaterial::none;
    double cut_db = 0;      // noise of the cutting power
    double spindle_db = 0;  // the machine's own sound
    double chips_db = 0, room_db = 0;
};

// Whether everything that is chosen exists, and levels are in range.
bool is_valid(const Workshop& workshop);

// Sets machine, chips (but for a learned colour, which stays) and room of a track.
void furnish(const Workshop& workshop, SoundtrackOptions& options);

}  // namespace tribo::sound
