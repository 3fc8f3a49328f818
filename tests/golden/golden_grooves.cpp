// SPDX-License-Identifier: MIT
#include "golden/golden_grooves.hpp"

#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::golden {

session::MillSetup grooves() {
    session::MillSetup s;
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 6;
    cutter.length_mm = 20;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    const Box3 blank{{0, 0, -6}, {20, 16, 0}};
    s.blank = std::make_unique<field::BoxShape>(blank);
    s.blank_volume_mm3 = blank.volume();
    s.cell_mm = 0.5;
    for (int n = 0; n < 5; ++n) {
        motion::Move move;
        move.feed_mm_per_min = 3000;
        move.start.tip_mm = {-4, 5 + 1.5 * n, -1};
        move.end.tip_mm = {24, 5 + 1.5 * n, -1.05};
        s.moves.push_back(move);
        s.cutter_of_move.push_back(0);
        s.rpm_of_move.push_back(6000);
    }
    return s;
}

}  // namespace tribo::golden
