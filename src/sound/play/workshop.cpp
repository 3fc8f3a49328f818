// SPDX-License-Identifier: MIT
#include "sound/play/workshop.hpp"

#include "base/math.hpp"

namespace tribo::sound {
namespace {

double gain_of(double db) {
    return math::pow(10, db / 20);
}

}  // namespace

bool is_valid(const Workshop& w) {
    bool valid = w.machine < machines().size() && w.room < rooms().size() && w.chips <= ChipMaterial::nickel;
    for (const double db : {w.cut_db, w.spindle_db, w.chips_db, w.room_db}) {
        valid = valid && db >= -kLargestLevelDb && db <= kLargestLevelDb;
    }
    return valid;
}

void apply(const Workshop& workshop, SoundtrackOptions& options) {
    options.machine = machines()[workshop.machine];
    options.machine.sound_share *= gain_of(2 * workshop.cut_db);
    options.machine.spindle.pa *= gain_of(workshop.spindle_db);
    options.chips.material = workshop.chips;
    options.chips.level = gain_of(workshop.chips_db);
    options.room = rooms()[workshop.room];
    options.room.level *= gain_of(workshop.room_db);
}

}  // namespace tribo::sound
