// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/corners.hpp"

#include <string>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

// Directions that differ by less than this count as straight, rad.
constexpr double kNoTurnRad = 1e-6;

constexpr const char* kRemedy = "let the CAM system write the corner as a move of its own";

// The move along another element in the plane, at the same height.
motion::Move along(const Element& element, const motion::Move& like, Plane plane) {
    const auto [u, v, w] = axes_of(plane);
    motion::Move move = like;
    move.start.tip_mm[u] = element.start.u;
    move.start.tip_mm[v] = element.start.v;
    move.end.tip_mm[u] = element.end.u;
    move.end.tip_mm[v] = element.end.v;
    move.duration_s = 0;  // the time was that of the programmed length
    move.arc.reset();
    if (!element.is_arc()) return move;
    motion::Arc arc;
    arc.centre_mm = move.start.tip_mm;
    arc.centre_mm[u] = element.centre.u;
    arc.centre_mm[v] = element.centre.v;
    arc.normal = {0, 0, 0};
    arc.normal[w] = element.turn_rad > 0 ? 1 : -1;
    arc.turn_rad = std::abs(element.turn_rad);
    move.arc = arc;
    return move;
}

// True for a feed move in the plane, and in it alone.
bool is_in_plane(const motion::Move& move, Plane plane) {
    const auto [u, v, w] = axes_of(plane);
    const bool is_flat = move.start.tip_mm[w] == move.end.tip_mm[w];
    const bool moves =
        move.arc || move.start.tip_mm[u] != move.end.tip_mm[u] || move.start.tip_mm[v] != move.end.tip_mm[v];
    return move.kind == motion::MoveKind::feed && !move.quadratic && is_flat && moves;
}

}  // namespace

Element element_of(const motion::Move& move, Plane plane) {
    const auto [u, v, w] = axes_of(plane);
    Element element{
        {move.start.tip_mm[u], move.start.tip_mm[v]}, {move.end.tip_mm[u], move.end.tip_mm[v]}, {}, 0};
    if (move.arc) {
        element.centre = {move.arc->centre_mm[u], move.arc->centre_mm[v]};
        element.turn_rad = move.arc->turn_rad * (move.arc->normal[w] < 0 ? -1 : 1);
    }
    return element;
}

Result<std::optional<CornerSize>> corner_of(Command& command, const State& state, const Output& output) {
    const Block& block = command.block();
    const auto code = command.g(GGroup::corner);
    const Word* word = code ? command.use('R') : block.corner ? &*block.corner : nullptr;
    if (code) command.hide('R');
    if (word == nullptr) {
        if (!code) return std::nullopt;
        return output.refuse(command.line(), code->column,
                             code_text('G', code->tenths) + " without the size R of its corner", "write R");
    }
    // As the path is, it may be scaled (G51).
    const auto scale = state.frame.scale_in(state.plane);
    if (!scale) {
        return output.refuse(command.line(), word->column,
                             "a corner is scaled differently along the axes of its plane (G51)",
                             "write it as moves, or take one scale");
    }
    const double size_mm = word->value * state.unit_mm * *scale;
    if (auto good = in_range(kLimits.coordinate, size_mm, command, *word, output); !good)
        return std::unexpected(good.error());
    if (size_mm == 0) return std::nullopt;
    if (size_mm < 0) {
        return output.refuse(command.line(), word->column, "the size of a corner is negative", "correct it");
    }
    return CornerSize{size_mm, code ? code->tenths == 390 : word->letter == 'C'};
}

Result<void> wait_for_corner(const motion::Move& move, CornerSize size, State& state, const Output& output) {
    if (!is_in_plane(move, state.plane) || state.rotary.turns()) {
        return output.refuse(move.line, 1, "a corner at the end of a move that leaves the plane", kRemedy);
    }
    state.corner = {move, size, state.plane};
    return {};
}

Result<void> check_no_corner_waits(const State& state, const Output& output, int line) {
    if (!state.corner) return {};
    return output.refuse(line, 1,
                         "the corner of line " + std::to_string(state.corner->move.line) +
                             " is not followed by a feed move in its plane",
                         kRemedy);
}

Result<void> join_at_corner(motion::Move next, State& state, Output& output,
                            const std::optional<CornerSize>& its_corner) {
    const WaitingCorner corner = *state.corner;
    if (!is_in_plane(next, corner.plane) || state.plane != corner.plane || state.rotary.turns()) {
        return check_no_corner_waits(state, output, next.line);
    }
    state.corner.reset();
    Element before = element_of(corner.move, corner.plane), after = element_of(next, corner.plane);
    const double turn = turn_between(before.end_direction(), after.start_direction());
    std::optional<Element> between;
    if (std::abs(turn) >= kNoTurnRad) {
        const double size = corner.size.mm;
        between = corner.size.is_chamfer ? chamfered(before, after, size) : rounded(before, after, size);
        if (!between) {
            return output.refuse(
                corner.move.line, 1,
                "the corner of " + short_decimal(size) + " mm does not fit between the moves beside it",
                "write a smaller one");
        }
    }
    if (auto done = append(along(before, corner.move, corner.plane), state, output); !done) return done;
    if (between) {
        if (auto done = append(along(*between, corner.move, corner.plane), state, output); !done) return done;
        next = along(after, next, corner.plane);
    }
    if (its_corner) return wait_for_corner(next, *its_corner, state, output);
    return append(next, state, output);
}

}  // namespace tribo::readers::gcode
