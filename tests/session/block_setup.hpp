// SPDX-License-Identifier: MIT
// Cuts through a block of aluminium, set up without a job file.
#pragma once

#include <memory>

#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/path.hpp"
#include "session/cut/mill_setup.hpp"

namespace tribo::session {

// The block and its cutter, without a cut.
inline MillSetup block_setup(const Box3& blank, const milling::Cutter& cutter, double cell_mm) {
    MillSetup setup;
    setup.cutters = {cutter};
    setup.coefficients = milling::find_material("al7075-t6")->coefficients;
    setup.blank = std::make_unique<field::BoxShape>(blank);
    setup.blank_volume_mm3 = blank.volume();
    setup.cell_mm = cell_mm;
    return setup;
}

inline motion::Move straight_cut(const Vec3& from_mm, const Vec3& to_mm, double feed_mm_per_min) {
    motion::Move move;
    move.start.tip_mm = from_mm;
    move.end.tip_mm = to_mm;
    move.feed_mm_per_min = feed_mm_per_min;
    return move;
}

inline void add_cut(MillSetup& setup, const motion::Move& cut, double rpm = 6000) {
    setup.moves.push_back(cut);
    setup.cutter_of_move.push_back(0);
    setup.rpm_of_move.push_back(rpm);
}

// In pieces no longer than that, as a live view divides its moves.
inline void add_cut_in_pieces(MillSetup& setup, const motion::Move& cut, double longest_mm,
                              double rpm = 6000) {
    for (const motion::Move& piece : motion::in_pieces(cut, longest_mm)) add_cut(setup, piece, rpm);
}

}  // namespace tribo::session
