// SPDX-License-Identifier: MIT
#include "readers/gcode/frames/polar_words.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::readers::gcode {

Result<void> place_polar_words(Block& block, const State& state, const Output& output) {
    if (!block.polar_radius && !block.polar_angle) return {};
    const int column = (block.polar_radius ? block.polar_radius : block.polar_angle)->column;
    bool incremental = state.incremental;
    double unit_mm = state.unit_mm;
    for (const Word& word : block.words) {
        if (word.letter == 'X' || word.letter == 'Y') {
            return output.refuse(block.line, word.column, "X or Y beside the polar words @ and ^",
                                 "write the point in one of the two ways");
        }
        if (word.letter != 'G') continue;
        if (word.value == 90 || word.value == 91) incremental = word.value == 91;
        if (word.value == 20 || word.value == 21)
            unit_mm = mm_per(word.value == 20 ? LengthUnit::inch : LengthUnit::millimetre);
    }
    const bool counts_from_tip = incremental || !block.polar_radius || !block.polar_angle;
    const bool is_lost = state.known[0] == Known::lost || state.known[1] == Known::lost;
    if (counts_from_tip && is_lost) {
        return output.refuse(block.line, column,
                             "polar words count from an X or Y that line " + std::to_string(state.lost_line) +
                                 " moved to a place that only the machine knows",
                             "add a move with X and Y before it");
    }
    const Vec3 tip = state.frame.written(state.tip_mm - state.origin_mm()) / unit_mm;
    double radius = math::hypot(tip.x, tip.y), angle_rad = math::atan2(tip.y, tip.x);
    if (incremental && radius == 0) {
        return output.refuse(block.line, column, "polar words in G91 begin at the zero of X and Y",
                             "write this block in G90: there the tool has no angle to count from");
    }
    if (block.polar_radius) radius = block.polar_radius->value + (incremental ? radius : 0);
    if (block.polar_angle)
        angle_rad = block.polar_angle->value * math::kRadPerDeg + (incremental ? angle_rad : 0);
    Vec3 written{radius * math::cos(angle_rad), radius * math::sin(angle_rad), 0};
    if (incremental) written -= tip;
    block.words.push_back({'X', written.x, column});
    block.words.push_back({'Y', written.y, column});
    return {};
}

}  // namespace tribo::readers::gcode
