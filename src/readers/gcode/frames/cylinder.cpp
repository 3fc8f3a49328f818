// SPDX-License-Identifier: MIT
#include "readers/gcode/frames/cylinder.hpp"

#include <cmath>
#include <string>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

// The arc in the unrolled plane, by its radius or its centre; none for a line.
Result<std::optional<motion::Arc>> unrolled_arc(Command& command, const State& state, Vec3 from, Vec3 to,
                                                const Output& output) {
    const Word* radius = command.use('R');
    const Word* centre[] = {command.use('I'), command.use('J'), command.use('K')};
    if (state.motion == MotionMode::line) return std::nullopt;
    ArcEnds ends;
    ends.clockwise = state.motion == MotionMode::arc_clockwise;
    ends.start_mm = from;
    ends.end_mm = to;
    const bool has_centre = centre[0] != nullptr || centre[1] != nullptr || centre[2] != nullptr;
    if (radius == nullptr && !has_centre) {
        return output.refuse(command.line(), 1, "an arc on a cylinder without radius or centre", "add R");
    }
    if (radius != nullptr) {
        if (auto good = in_range(kLimits.coordinate, radius->value * state.unit_mm, command, *radius, output);
            !good)
            return std::unexpected(good.error());
    }
    Vec3 about = from;
    for (int axis = 0; axis < 3; ++axis) {
        const Word* word = centre[axis];
        if (word == nullptr) continue;
        const double offset_mm = word->value * state.unit_mm;
        if (auto good = in_range(kLimits.coordinate, offset_mm, command, *word, output); !good)
            return std::unexpected(good.error());
        about[axis == state.cylinder->linear ? 0 : 1] += offset_mm;
    }
    const auto arc = radius != nullptr ? arc_of_radius(ends, radius->value * state.unit_mm)
                                       : arc_about_centre(ends, about, state.unit_mm);
    if (!arc) return output.refuse(command.line(), 1, arc.error().cause, "correct its end, R or its centre");
    return *arc;
}

}  // namespace

Result<void> switch_cylinder(Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::cylinder);
    if (!code) return {};
    if (state.compensation.is_on && state.compensation.left_mm != 0) {
        return output.refuse(command.line(), code->column,
                             code_text('G', code->tenths) + " while cutter compensation is on",
                             "write G40 before it");
    }
    for (int axis = 0; axis < 3; ++axis) {
        const Word* word = command.use("ABC"[axis]);
        if (word == nullptr) continue;
        command.hide(word->letter);
        state.cylinder.reset();
        if (word->value == 0) return {};
        const double radius_mm = std::abs(word->value) * state.unit_mm;
        if (auto good = in_range(kLimits.coordinate, radius_mm, command, *word, output); !good) return good;
        state.cylinder = Cylinder{axis, axis, radius_mm};
        if (output.machine) return {};
        output.program.has_rotary_words = true;
        if (output.program.first_rotary_line == 0) output.program.first_rotary_line = command.line();
        output.warn(command.line(), code_text('G', code->tenths) +
                                        " rolls the path about a rotary axis: the program needs a machine to "
                                        "be understood");
        return {};
    }
    return output.refuse(command.line(), code->column,
                         code_text('G', code->tenths) + " without the radius of its cylinder",
                         "write it as the word of the rotary axis: G7.1 A25");
}

Result<void> feed_on_cylinder(Command& command, State& state, Vec3 target, Output& output) {
    if (!output.machine) {  // the turn is left out, which was said
        for (const char letter : {'R', 'I', 'J', 'K'}) command.use(letter);
        return append_straight(motion::MoveKind::feed, target, command, state, output);
    }
    const Cylinder& cylinder = *state.cylinder;
    const int linear = cylinder.linear;
    RotaryState& rotary = state.rotary;
    const Vec3 start_rad = rotary.now_rad, end_rad = rotary.target_rad, start = state.tip_mm;
    // The unrolled plane: along the straight axis, and along the circumference.
    const Vec3 from{start[linear], start_rad[cylinder.rotary] * cylinder.radius_mm, 0};
    const Vec3 to{target[linear], end_rad[cylinder.rotary] * cylinder.radius_mm, 0};
    const auto arc = unrolled_arc(command, state, from, to, output);
    if (!arc) return std::unexpected(arc.error());
    const double chords = *arc ? chord_count(**arc, from) : 1;
    note_spindle(command, state, output);
    Vec3 before = from;
    for (double i = 1; i <= chords; ++i) {
        const double t = i / chords;
        Vec3 place = to;
        if (*arc && i < chords) {
            const double turn = (*arc)->normal.z * (*arc)->turn_rad * t;
            double sine = 0, cosine = 0;
            math::sincos(turn, sine, cosine);
            const Vec3 off = from - (*arc)->centre_mm;
            place = (*arc)->centre_mm + Vec3{cosine * off.x - sine * off.y, sine * off.x + cosine * off.y, 0};
        }
        motion::Move move = new_move(motion::MoveKind::feed, command, state);
        move.end.tip_mm = start + t * (target - start);
        move.end.tip_mm[linear] = place.x;
        if (auto fed = set_feed(move, command, state, output); !fed) return fed;
        rotary.target_rad = start_rad + t * (end_rad - start_rad);
        rotary.target_rad[cylinder.rotary] = place.y / cylinder.radius_mm;
        const Vec3 way = move.end.tip_mm - move.start.tip_mm;
        const double length = math::hypot(tribo::length(way), place.y - before.y);
        // F counts along the surface of the cylinder.
        if (state.feed_mode == FeedMode::inverse_time) move.duration_s /= chords;
        if (move.duration_s == 0 && length > 0) move.duration_s = 60 * length / move.feed_mm_per_min;
        before = place;
        state.tip_mm = move.end.tip_mm;
        const bool moves = move.start.tip_mm != move.end.tip_mm || rotary.turns();
        if (!moves) continue;
        if (auto done = append(move, state, output); !done) return done;
    }
    return {};
}

}  // namespace tribo::readers::gcode
