// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/compensation.hpp"

#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "base/text/limit_text.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/moves.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::gcode {
namespace {

// Directions that differ by less than this count as straight, rad.
constexpr double kStraightRad = 1e-6;
constexpr double kSameEndMm = 1e-7;

class Corner {
  public:
    Corner(State& state, Output& output) : state_(state), comp_(state.compensation), output_(output) {
        const auto axes = axes_of(comp_.plane);
        u_ = axes[0];
        v_ = axes[1];
        w_ = axes[2];
    }

    Result<void> take(const motion::Move& programmed) {
        if (!comp_.is_of_text) return follow(programmed);
        comp_.programmed.push_back(programmed);
        const auto done = follow(programmed);
        if (!done && does_not_fit_) return mill_as_programmed(done.error());
        if (!done) return done;
        return comp_.programmed.size() < kMostKept ? done : decide();
    }

    Result<void> hand_out_all() {
        for (const motion::Move& move : comp_.waiting) {
            if (auto done = give(move); !done) return done;
        }
        comp_.waiting.clear();
        return {};
    }

    // The radius of the comment fits so far: it is the one that is meant.
    Result<void> decide() {
        if (!comp_.is_of_text) return {};
        const int tool = static_cast<int>(comp_.number);
        if (comp_.has_begun && output_.first(Note::compensation_of_text, tool)) {
            output_.warn(comp_.line, code_text('G', comp_.code) + ": the path is moved aside by " +
                                         mm_text(std::abs(comp_.left_mm)) + ", the radius that line " +
                                         std::to_string(output_.notes.line_of(tool)) + " gives tool " +
                                         std::to_string(tool) +
                                         "; if the control corrects the wear alone, give that comment the "
                                         "words WEAR COMP");
        }
        comp_.is_of_text = false;
        comp_.programmed.clear();
        for (const motion::Move& move : std::exchange(comp_.compensated, {})) {
            if (auto done = hand_out(move, state_, output_); !done) return done;
        }
        return {};
    }

  private:
    // The radius of the comment does not fit: the program holds the path of the tool's centre, and D the
    // wear.
    Result<void> mill_as_programmed(const Error& why) {
        const int tool = static_cast<int>(comp_.number);
        output_.wear_tools.insert(tool);
        if (output_.first(Note::compensation_of_wear, tool)) {
            output_.warn(comp_.line, code_text('G', comp_.code) + ": " + why.cause + " (line " +
                                         std::to_string(why.line) +
                                         "), so D is taken to correct the wear of tool " +
                                         std::to_string(tool) + " alone, and the programmed path is milled");
        }
        std::vector<motion::Move> moves = std::exchange(comp_.programmed, {});
        moves.front().start.tip_mm = in_space(comp_.at, moves.front().start.tip_mm[w_]);
        comp_.is_of_text = comp_.has_begun = false;
        comp_.left_mm = 0;
        comp_.compensated.clear();
        comp_.waiting.clear();
        for (const motion::Move& move : moves) {
            if (auto done = hand_out(move, state_, output_); !done) return done;
        }
        return {};
    }

    Result<void> follow(const motion::Move& programmed) {
        const Point from = in_plane(programmed.start.tip_mm), to = in_plane(programmed.end.tip_mm);
        if (programmed.kind == motion::MoveKind::dwell || (!programmed.arc && from == to)) {
            return stay(programmed);
        }
        if (programmed.quadratic) {
            return refuse(programmed, "splines are not compensated for the cutter's radius",
                          "write G40 before it");
        }
        Element contour{from, to, {}, 0};
        if (programmed.arc) {
            contour.centre = in_plane(programmed.arc->centre_mm);
            contour.turn_rad = programmed.arc->turn_rad * (programmed.arc->normal[w_] < 0 ? -1 : 1);
        }
        auto moved = offset(contour, comp_.left_mm);
        if (!moved) {
            return refuse_radius(programmed,
                                 "the arc's radius " + mm_text(distance(contour.start, contour.centre)) +
                                     " is not larger than the cutter's, " + mm_text(std::abs(comp_.left_mm)),
                                 "take a smaller cutter or round the corner more");
        }
        if (!comp_.has_begun) return enter(programmed, contour, *moved);
        return join(programmed, contour, *moved);
    }

    // Hands out the move, or keeps it until the radius is certain.
    Result<void> give(const motion::Move& move) {
        if (!comp_.is_of_text) return hand_out(move, state_, output_);
        if (move.kind == motion::MoveKind::feed) output_.notes.cut(move);
        comp_.compensated.push_back(move);
        return {};
    }
    Point in_plane(Vec3 p) const { return {p[u_], p[v_]}; }
    Vec3 in_space(Point p, double w) const {
        Vec3 q;
        q[u_] = p.u;
        q[v_] = p.v;
        q[w_] = w;
        return q;
    }
    std::unexpected<Error> refuse(const motion::Move& move, std::string cause, std::string remedy) const {
        return output_.refuse(move.line, 1, std::move(cause), std::move(remedy));
    }
    // The contour leaves no room for the radius.
    std::unexpected<Error> refuse_radius(const motion::Move& move, std::string cause, std::string remedy) {
        does_not_fit_ = true;
        return refuse(move, std::move(cause), std::move(remedy));
    }

    // A dwell, or a move along the tool: it happens at the later end of the last contour move.
    Result<void> stay(const motion::Move& programmed) {
        motion::Move move = programmed;
        const Point here = comp_.has_begun ? comp_.last.end : comp_.at;
        move.start.tip_mm = in_space(here, programmed.start.tip_mm[w_]);
        move.end.tip_mm = in_space(here, programmed.end.tip_mm[w_]);
        if (comp_.waiting.empty()) return give(move);
        if (comp_.waiting.size() > kMostWaiting) {
            return refuse(programmed, "more than 1000 blocks without motion in the plane of compensation",
                          "write G40 before them");
        }
        comp_.waiting.push_back(move);
        return {};
    }

    // Returns the move along the compensated element, with the words of the programmed move.
    motion::Move along(const Element& element, const motion::Move& programmed) const {
        motion::Move move = programmed;
        move.start.tip_mm = in_space(element.start, programmed.start.tip_mm[w_]);
        move.end.tip_mm = in_space(element.end, programmed.end.tip_mm[w_]);
        move.duration_s = 0;  // the time was that of the programmed length
        move.arc.reset();
        if (element.is_arc()) {
            motion::Arc arc;
            arc.centre_mm = in_space(element.centre, move.start.tip_mm[w_]);
            arc.normal = {0, 0, 0};
            arc.normal[w_] = element.turn_rad > 0 ? 1 : -1;
            arc.turn_rad = std::abs(element.turn_rad);
            move.arc = arc;
        }
        return move;
    }

    Result<void> enter(const motion::Move& programmed, const Element& contour, const Element& moved) {
        const double radius = std::abs(comp_.left_mm);
        if (contour.is_arc()) {
            const auto into = arc_into(comp_.at, moved);
            if (!into) {
                return refuse_radius(programmed,
                                     "no arc leads from the start to the offset of this arc's end",
                                     "begin compensation on a straight move");
            }
            comp_.last = *into;
            comp_.waiting.assign(1, along(*into, programmed));
        } else {
            if (contour.length() <= radius) {
                return refuse_radius(programmed,
                                     "the entry into compensation is " + mm_text(contour.length()) +
                                         " long, not longer than the cutter's radius of " + mm_text(radius),
                                     "start farther away");
            }
            Element entry = moved;
            comp_.last = moved;
            entry.start = comp_.at;
            comp_.waiting.assign(1, along(entry, programmed));
        }
        comp_.has_begun = true;
        comp_.is_entry = !contour.is_arc();
        comp_.direction = contour.end_direction();
        comp_.curvature_per_mm = contour.curvature_per_mm();
        return {};
    }

    Result<void> join(const motion::Move& programmed, const Element& contour, Element moved) {
        const bool from_entry = std::exchange(comp_.is_entry, false);
        const double side = comp_.left_mm < 0 ? -1 : 1;
        const double turn = turn_at_corner(contour);
        if (std::abs(turn) < kStraightRad) {
            moved.set_start(comp_.last.end);
        } else if (side * turn < 0) {
            if (auto done = hand_out_all(); !done) return done;
            if (auto done = turn_about(contour.start, moved.start, turn, programmed); !done) return done;
        } else if (from_entry && output_.options.dialect == GcodeDialect::fanuc) {
            // Square to the start of the block behind it, whose whole length is then cut.
            end_last_at(moved.start);
        } else if (auto done = cut_off(programmed, moved); !done) {
            return done;
        }
        if (auto done = hand_out_all(); !done) return done;
        comp_.waiting.assign(1, along(moved, programmed));
        comp_.last = moved;
        comp_.direction = contour.end_direction();
        comp_.curvature_per_mm = contour.curvature_per_mm();
        return {};
    }

    // If the path reverses, the side on which it continues decides the sign of the turn; a path back along
    // the same line goes round the corner.
    double turn_at_corner(const Element& contour) const {
        const double turn = turn_between(comp_.direction, contour.start_direction());
        if (math::kPi - std::abs(turn) >= kStraightRad) return turn;
        const double to_right = comp_.curvature_per_mm + contour.curvature_per_mm();
        const bool is_same = std::abs(to_right) < 1e-9;
        const bool turns_left = is_same ? comp_.left_mm < 0 : to_right < 0;
        return turns_left ? math::kPi : -math::kPi;
    }

    // At an outside corner.
    Result<void> turn_about(Point corner, Point to, double turn, const motion::Move& programmed) {
        Element arc{comp_.last.end, to, corner, turn};
        motion::Move move = programmed;
        move.end.tip_mm[w_] = move.start.tip_mm[w_];
        if (distance(arc.start, arc.end) <= kSameEndMm && std::abs(turn) < 1) return {};
        return give(along(arc, move));
    }

    // At an inside corner.
    Result<void> cut_off(const motion::Move& programmed, Element& moved) {
        const auto meets = meeting(comp_.last, moved);
        if (!meets) {
            return refuse_radius(
                programmed,
                "the cutter of " + mm_text(2 * std::abs(comp_.left_mm)) +
                    " diameter does not fit into the inside corner at the start of this block "
                    "without gouging line " +
                    std::to_string(comp_.waiting.front().line) + " or this one",
                "take a smaller cutter or leave out moves that are too short for it");
        }
        comp_.last.set_end(*meets);
        end_last_at(*meets);
        moved.set_start(*meets);
        return {};
    }

    // The last move, and those along the tool axis after it.
    void end_last_at(Point to) {
        motion::Move& first = comp_.waiting.front();
        first.end.tip_mm = in_space(to, first.end.tip_mm[w_]);
        if (first.arc) first.arc->turn_rad = std::abs(comp_.last.turn_rad);
        for (std::size_t i = 1; i < comp_.waiting.size(); ++i) {
            motion::Move& move = comp_.waiting[i];
            move.start.tip_mm = in_space(to, move.start.tip_mm[w_]);
            move.end.tip_mm = in_space(to, move.end.tip_mm[w_]);
        }
    }

    static constexpr std::size_t kMostWaiting = 1000, kMostKept = 10'000;

    State& state_;
    Compensation& comp_;
    Output& output_;
    int u_ = 0, v_ = 1, w_ = 2;
    bool does_not_fit_ = false;
};

std::unexpected<Error> refuse_meanwhile(const Command& command, char letter, Code code, const State& state,
                                        const Output& output) {
    return output.refuse(command.line(), code.column,
                         code_text(letter, code.tenths) +
                             " does not go with the cutter compensation that line " +
                             std::to_string(state.compensation.line) + " has switched on",
                         "write G40 before it");
}

// True if the code in force stands again, with the same offset.
bool repeats_compensation(Command& command, const State& state) {
    const auto side = command.g(GGroup::cutter_side);
    if (!side || side->tenths != state.compensation.code) return false;
    return !command.has('D') || command.use('D')->value == state.compensation.number;
}

// On a Fanuc control D holds from its block on.
bool has_modal_number(const State& state, const Output& output) {
    return output.options.dialect == GcodeDialect::fanuc && state.offset_number.has_value();
}

// D of the block or an earlier one, else the tool in the spindle.
double offset_number(Command& command, const State& state, const Output& output) {
    if (const Word* word = command.use('D')) return word->value;
    return has_modal_number(state, output) ? *state.offset_number : state.tool();
}

// Returns the diameter of the cutter that D or the tool in the spindle has; 0 where nothing states it.
Result<double> compensated_diameter(Command& command, Code code, const State& state, Output& output) {
    const Word* word = command.use('D');
    const int column = word == nullptr ? code.column : word->column;
    const int kind = code.tenths % 10;
    // On a Fanuc control G41.1 without D turns the spindle along the path.
    const bool is_direction = kind == 1 && word == nullptr && output.options.dialect == GcodeDialect::fanuc;
    if (kind > 1 || is_direction) {
        for (const char letter : {'I', 'J', 'K'}) command.use(letter);
        if (output.first(Note::compensation_in_space)) {
            output.warn(command.line(),
                        code_text('G', code.tenths) +
                            ": neither compensation in space nor a spindle turned along the path is "
                            "read; the programmed path is milled");
        }
        return 0.0;
    }
    if (kind == 1) {
        if (word != nullptr) return word->value * state.unit_mm;
        return output.refuse(command.line(), column,
                             code_text('G', code.tenths) + " without the cutter's diameter", "add it as D");
    }
    const double number = offset_number(command, state, output);
    if (!(number >= 0 && number <= kLimits.tool_number.range.max) || number != std::floor(number)) {
        return output.refuse(command.line(), column, "D is not the number of a tool", "correct D");
    }
    // D0 means no compensation, by convention.
    const bool is_tool = word == nullptr && !has_modal_number(state, output);
    if (number == 0 && !is_tool) return 0.0;
    const auto diameter_mm = output.tool_diameter_mm(static_cast<int>(number), state.unit_mm);
    if (diameter_mm) return *diameter_mm;
    if (output.first(Note::compensation_unknown, static_cast<int>(number))) {
        output.warn(
            command.line(),
            code_text('G', code.tenths) + ": " + output.notes.no_diameter_text(static_cast<int>(number)) +
                ", so the programmed path is milled as it stands; give the tool to the job, or write the "
                "comment " +
                output.notes.diameter_comment(static_cast<int>(number)));
    }
    return 0.0;
}

}  // namespace

Result<void> end_compensation(State& state, Output& output) {
    Compensation& comp = state.compensation;
    if (!comp.is_on) return {};
    if (auto done = Corner(state, output).hand_out_all(); !done) return done;
    if (auto done = Corner(state, output).decide(); !done) return done;
    if (comp.has_begun) {
        const auto axes = axes_of(comp.plane);
        Vec3 at = state.tip_mm;
        at[axes[0]] = comp.last.end.u;
        at[axes[1]] = comp.last.end.v;
        state.left_at_mm = at;
    }
    comp = {};
    return {};
}

Result<void> check_compensation(Command& command, State& state, Output& output) {
    if (!state.compensation.is_on) return {};
    const auto side = command.g(GGroup::cutter_side);
    if (side && side->tenths == 400) return end_compensation(state, output);
    // Without a radius nothing is offset, so that nothing is in the way.
    if (state.compensation.left_mm == 0) return side ? end_compensation(state, output) : Result<void>{};
    if (side && !repeats_compensation(command, state))
        return refuse_meanwhile(command, 'G', *side, state, output);
    if (const auto code = command.g(GGroup::plane)) {
        const int plane = state.plane == Plane::xy ? 170 : state.plane == Plane::zx ? 180 : 190;
        if (code->tenths != plane) return refuse_meanwhile(command, 'G', *code, state, output);
    }
    if (const auto code = command.g(GGroup::units)) {
        const bool is_inch = code->tenths == 200 || code->tenths == 700;
        if (is_inch != (state.unit_mm != 1)) return refuse_meanwhile(command, 'G', *code, state, output);
    }
    if (const auto code = command.g(GGroup::work_offset)) {
        const bool is_same = state.active_work < 6 && code->tenths == 540 + 10 * state.active_work;
        if (!is_same) return refuse_meanwhile(command, 'G', *code, state, output);
    }
    if (const auto code = command.g(GGroup::non_modal); code && code->tenths != 40) {
        return refuse_meanwhile(command, 'G', *code, state, output);
    }
    if (const auto code = command.g(GGroup::motion); code && code->tenths > 30) {
        return refuse_meanwhile(command, 'G', *code, state, output);
    }
    if (const auto code = command.m(MGroup::tool))
        return refuse_meanwhile(command, 'M', *code, state, output);
    return {};
}

Result<void> begin_compensation(Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::cutter_side);
    if (!code || code->tenths == 400) return {};
    if (state.compensation.is_on && repeats_compensation(command, state)) {
        command.use('D');
        return {};
    }
    const auto found = compensated_diameter(command, *code, state, output);
    if (!found) return std::unexpected(found.error());
    const double diameter_mm = *found;
    if (!kLimits.offset_diameter.range.contains(diameter_mm)) {
        const Word* word = command.use('D');
        return output.refuse(
            command.line(), word == nullptr ? code->column : word->column,
            out_of_range(kLimits.offset_diameter, diameter_mm),
            range_remedy(kLimits.offset_diameter) + "; use the other side for a negative one");
    }
    if (diameter_mm != 0 && !state.knows_tip()) {
        if (auto known = require_start(command, state, output); !known) return known;
    }
    Compensation& comp = state.compensation;
    comp = {};
    comp.is_on = true;
    comp.code = code->tenths;
    comp.line = command.line();
    comp.plane = state.plane;
    const bool is_left = (code->tenths / 10 == 41) != state.frame.is_mirrored(state.plane);
    comp.left_mm = (is_left ? 0.5 : -0.5) * diameter_mm;
    const auto axes = axes_of(state.plane);
    const Vec3 at = state.left_at_mm.value_or(state.tip_mm);
    comp.at = {at[axes[0]], at[axes[1]]};
    comp.number = offset_number(command, state, output);
    const bool is_stated = code->tenths % 10 == 1;
    comp.is_of_text = diameter_mm != 0 && !is_stated &&
                      output.is_diameter_of_text(static_cast<int>(comp.number), state.unit_mm);
    if (comp.is_of_text && output.wear_tools.contains(static_cast<int>(comp.number))) {
        comp.is_of_text = false;
        comp.left_mm = 0;
    }
    state.left_at_mm.reset();
    return {};
}

Result<void> leave_compensation(motion::Move move, State& state, Output& output) {
    if (move.kind == motion::MoveKind::dwell) {
        move.start.tip_mm = move.end.tip_mm = *state.left_at_mm;
        return hand_out(move, state, output);
    }
    const Vec3 from = *std::exchange(state.left_at_mm, std::nullopt);
    if (move.arc || move.quadratic) {
        return output.refuse(move.line, 1, "a curve cannot lead out of cutter compensation",
                             "write a straight move after G40");
    }
    move.start.tip_mm = from;
    return hand_out(move, state, output);
}

Result<void> compensate(const motion::Move& programmed, State& state, Output& output) {
    if (state.rotary.turns()) {
        return output.refuse(programmed.line, 1,
                             "rotary axes turn while cutter compensation is on, which has no plane then",
                             "write G40 before it");
    }
    if (state.compensation.left_mm == 0) return hand_out(programmed, state, output);
    return Corner(state, output).take(programmed);
}

}  // namespace tribo::readers::gcode
