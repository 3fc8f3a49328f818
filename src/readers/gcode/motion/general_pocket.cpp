// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/general_pocket.hpp"

#include <cmath>
#include <utility>

#include "readers/control/path.hpp"
#include "readers/gcode/motion/corners.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr double kMostPocketRings = 10'000;
// The way of a centre along the contour itself lies within it by this, mm.
constexpr double kWithinMm = 1e-6;

std::unexpected<Error> refuse(const OpenPocket& pocket, const Output& output, std::string cause,
                              std::string remedy) {
    return output.refuse(pocket.line, pocket.column, "G150 " + std::move(cause), std::move(remedy));
}

// A length of the block in mm; none if it has no such word.
Result<std::optional<double>> length_of(char letter, Command& command, const State& state,
                                        const Output& output) {
    const Word* word = command.use(letter);
    command.hide(letter);
    if (word == nullptr) return std::nullopt;
    const double mm = word->value * state.unit_mm;
    if (auto good = in_range(kLimits.coordinate, mm, command, *word, output); !good)
        return std::unexpected(good.error());
    return mm;
}

// The radius of the tool beside G41 and G42; without them the contour is that of its centre.
double corner_radius(Command& command, const State& state, Output& output) {
    const Word* number = command.use('D');
    if (!command.side_of_pocket()) return kWithinMm;
    const int offset = number == nullptr ? state.tool() : static_cast<int>(number->value);
    if (const auto known = output.tool_diameter_mm(offset, state.unit_mm); known && *known > 0)
        return *known / 2;
    if (const auto stated = output.notes.stated_diameter_mm(offset, state.unit_mm)) return *stated / 2;
    if (output.first(Note::pocket_radius, offset)) {
        output.warn(command.line(), "G150: nothing states the diameter of tool " + std::to_string(offset) +
                                        ": 6 mm are taken; give the tool to the job, or write a comment like "
                                        "(T1 D=10.)");
    }
    return control::kAssumedRadiusMm;
}

}  // namespace

Result<void> begin_pocket(Command& command, State& state, Flow& flow, Output& output) {
    const int line = command.line();
    OpenPocket pocket;
    pocket.line = line;
    pocket.column = command.g(GGroup::pocket)->column;
    if (state.compensation.is_on && state.compensation.left_mm != 0) {
        return refuse(pocket, output, "while cutter compensation is on", "write G40 before it");
    }
    if (state.plane != Plane::xy || state.incremental || state.tilt || !state.frame.is_plain()) {
        return refuse(pocket, output, "in increments, another plane, or turned coordinates",
                      "write G90 and G17, and end G16, G51, G51.1 and G68 before it");
    }
    std::optional<double> words[6];
    for (std::size_t i = 0; i < 6; ++i) {
        const auto word = length_of("ZRQIJK"[i], command, state, output);
        if (!word) return std::unexpected(word.error());
        words[i] = *word;
    }
    const auto [bottom, retract, infeed, step_x, step_y, finish] = words;
    const Word* number = command.use('P');
    const auto step = step_x ? step_x : step_y;
    if (number == nullptr || !bottom || !infeed || *infeed == 0 || !step || *step == 0) {
        return refuse(pocket, output, "lacks P, Z, Q, or one of I and J",
                      "write the contour's program, the depth, the infeed and the step");
    }
    if (state.has_lost_tip()) {
        output.leave_out(line, state.lost_line);
        command.use_rest();
        return {};
    }
    if (auto known = require_start(command, state, output); !known) return known;
    const auto target = target_of(command, state, output);
    if (!target) return std::unexpected(target.error());
    const double origin = state.origin_mm().z;
    const double near = retract ? origin + *retract : state.tip_mm.z;
    pocket.milling.depths = {near, near, near, origin + *bottom};
    pocket.milling.infeed = std::abs(*infeed);
    pocket.milling.step = std::abs(*step);
    pocket.milling.allowance = std::abs(finish.value_or(0));
    pocket.milling.radius = corner_radius(command, state, output);
    pocket.milling.clockwise = command.side_of_pocket() == 420;
    pocket.like = new_move(motion::MoveKind::feed, command, state);
    if (auto fed = set_feed(pocket.like, command, state, output); !fed) return fed;
    note_spindle(command, state, output);
    pocket.milling.feed = pocket.milling.plunge = pocket.like.feed_mm_per_min;
    if (!(near > origin + *bottom)) {
        return refuse(pocket, output, "has its depth above R", "correct Z or R");
    }
    for (const Vec3 place : {Vec3{target->tip_mm.x, target->tip_mm.y, state.tip_mm.z},
                             Vec3{target->tip_mm.x, target->tip_mm.y, near}}) {
        const auto moved = append_straight(motion::MoveKind::rapid, place, command, state, output);
        if (!moved) return moved;
    }
    pocket.start_mm = state.tip_mm;
    pocket.depth = flow.depth();
    const auto is_line = flow.has_lines(*number, line);
    if (!is_line) return std::unexpected(is_line.error());
    auto called =
        *is_line ? flow.call_lines(*number, nullptr, 1, line, "G150") : flow.call_program(*number, 1, line);
    // A program that is sought in a file beside: nothing was called.
    if (called && flow.depth() > pocket.depth) state.pocket = std::move(pocket);
    return called;
}

Result<void> keep_in_pocket(const motion::Move& move, State& state, const Output& output) {
    if (move.kind == motion::MoveKind::dwell) return {};
    const bool is_flat = move.start.tip_mm.z == move.end.tip_mm.z;
    if (move.kind != motion::MoveKind::feed || move.quadratic || !is_flat) {
        return output.refuse(move.line, 1, "the contour of G150 has a rapid, or leaves its plane",
                             "write it with G1, G2 and G3 in X and Y");
    }
    state.pocket->contour.push_back(element_of(move, Plane::xy));
    return {};
}

Result<void> mill_pocket_of(State& state, const Flow& flow, Output& output) {
    if (!state.pocket || flow.depth() > state.pocket->depth) return {};
    OpenPocket pocket = *std::exchange(state.pocket, std::nullopt);
    state.tip_mm = pocket.start_mm;
    // The first element leads from the start to the contour.
    control::Ring ring = std::move(pocket.contour);
    if (!ring.empty()) ring.erase(ring.begin());
    if (!control::close_ring(ring)) {
        return refuse(pocket, output, "has a contour that is not closed", "end it where its first move ends");
    }
    const control::Area area({std::move(ring)});
    const auto go = [&](Vec3 to, std::optional<double> feed,
                        const std::optional<motion::Arc>& arc) -> Result<void> {
        motion::Move move = pocket.like;
        move.kind = feed ? motion::MoveKind::feed : motion::MoveKind::rapid;
        move.start.tip_mm = state.tip_mm;
        move.end.tip_mm = state.tip_mm = to;
        move.arc = arc;
        if (move.start.tip_mm == to && !arc) return {};
        return append(move, state, output);
    };
    // All of it but K, then K along the edge at the bottom.
    control::AreaMilling milling = pocket.milling;
    const bool finishes = milling.allowance > 0;
    for (const bool is_finish : {false, true}) {
        if (is_finish && !finishes) break;
        if (is_finish) {
            milling.allowance = milling.infeed = 0;
            milling.along_edge = true;
        }
        const auto rings = control::rings_of(area, milling);
        if (!rings || rings->empty() || control::ring_count(*rings, milling) > kMostPocketRings) {
            return refuse(
                pocket, output,
                rings && rings->empty() ? "does not let the tool in" : "needs more than 10000 rings",
                "take a smaller tool, or larger Q, I and J");
        }
        if (auto done = control::mill_area(area, *rings, milling, state.tip_mm, go); !done) return done;
    }
    if (output.first(Note::general_pocket)) {
        output.warn(
            pocket.line,
            "G150: the way of the tool is the control's own: rings from the inside outwards are taken");
    }
    return {};
}

}  // namespace tribo::readers::gcode
