// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/cycles.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/motion.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

using motion::MoveKind;

// G73 lifts the drill by this much, and G83 continues at feed at this distance from the bottom, mm (LinuxCNC:
// 0.01 inch).
constexpr double kChipBreakMm = 0.254;
constexpr double kMostRepeats = 100'000;
constexpr double kMostPecks = 100'000;
constexpr double kRounding = 1e-9;  // of sums of pecks, mm

class Run {
  public:
    Run(Command& command, State& state, Output& output)
        : command_(command), state_(state), output_(output), axis_(axes_of(state.plane)[2]) {}

    Result<void> run() {
        const auto ready = prepare();
        if (!ready) return std::unexpected(ready.error());
        if (!*ready) return {};
        const auto target = target_of(command_, state_, output_);
        if (!target) return std::unexpected(target.error());
        Vec3 place = target->tip_mm;
        const Vec3 step = state_.incremental ? place - state_.tip_mm : Vec3{};
        // LinuxCNC lifts the tool first; a Fanuc control goes to the hole at the height where the tool is.
        if (output_.options.dialect == GcodeDialect::linuxcnc && state_.tip_mm[axis_] < retract_) {
            if (auto moved = go(MoveKind::rapid, retract_); !moved) return moved;
        }
        for (int i = 0; i < repeats_; ++i) {
            if (i > 0 && state_.frame.is_polar && state_.incremental) {
                const auto next = target_of(command_, state_, output_);
                if (!next) return std::unexpected(next.error());
                place = next->tip_mm;
            } else if (i > 0) {
                for (const int in_plane : {axes_of(state_.plane)[0], axes_of(state_.plane)[1]}) {
                    place[in_plane] += step[in_plane];
                }
            }
            if (auto done = hole(place); !done) return done;
        }
        return {};
    }

    // G70: holes on a circle about the centre, from the angle J on. G71: on an arc, at steps of K degrees.
    // G72: on a line through it, at steps of I. The centre is X Y, or where the tool stands (Haas).
    Result<void> run_pattern(Code code) {
        const Word* size = command_.use('I');
        const Word* first = command_.use('J');
        const Word* step_word = command_.use('K');
        const Word* count = command_.use('L');
        command_.hide('L');
        const double size_mm = size == nullptr ? 0 : size->value * state_.unit_mm;
        if (size == nullptr || !kLimits.coordinate.range.contains(size_mm) || count == nullptr ||
            !(count->value >= 1 && count->value <= kMostRepeats) ||
            count->value != std::floor(count->value)) {
            return output_.refuse(
                command_.line(), code.column,
                code_text('G', code.tenths) + " without its size I and its number of holes L", "write both");
        }
        for (const Word* angle : {first, step_word}) {
            if (angle == nullptr) continue;
            if (auto good = in_range(kLimits.rotary_angle, angle->value, command_, *angle, output_); !good)
                return good;
        }
        const auto ready = prepare();
        if (!ready) return std::unexpected(ready.error());
        if (!*ready) return {};
        const auto target = target_of(command_, state_, output_);
        if (!target) return std::unexpected(target.error());
        const auto axes = axes_of(state_.plane);
        const double begin = first == nullptr ? 0 : first->value;
        const bool is_circle = code.tenths == 700, is_line = code.tenths == 720;
        const double step = is_circle ? 360 / count->value : step_word == nullptr ? 0 : step_word->value;
        for (double i = 0; i < count->value; ++i) {
            double sine = 0, cosine = 0;
            math::sincos((begin + (is_line ? 0 : i * step)) * math::kRadPerDeg, sine, cosine);
            Vec3 offset;
            offset[axes[0]] = (is_line ? i : 1) * size_mm * cosine;
            offset[axes[1]] = (is_line ? i : 1) * size_mm * sine;
            if (auto done = hole(target->tip_mm + state_.frame.placed_offset(offset)); !done) return done;
        }
        return {};
    }

  private:
    // Reads the words of the cycle and finds its levels. False: there is nothing to drill.
    Result<bool> prepare() {
        if (auto done = read_words(); !done) return std::unexpected(done.error());
        if (repeats_ == 0) {  // the words are kept for later, and the tool stays
            for (const char letter : {'X', 'Y', 'Z'}) command_.use(letter);
            return false;
        }
        const auto starts = find_start();
        if (!starts || !*starts) return starts;
        Cycle& cycle = state_.cycle;
        if (!cycle.initial_mm) cycle.initial_mm = state_.tip_mm[axis_];
        const double origin = state_.origin_mm()[axis_];
        // An increment R counts from the start of the cycle, an increment Z from R.
        const double retract = !cycle.retract_mm ? *cycle.initial_mm
                               : is_increment(cycle.retract_is_increment)
                                   ? *cycle.initial_mm + scale() * *cycle.retract_mm
                                   : origin + level(*cycle.retract_mm);
        const double depth = is_increment(cycle.depth_is_increment) ? retract + scale() * *cycle.depth_mm
                                                                    : origin + level(*cycle.depth_mm);
        if (depth > retract && cycle.tenths == 870) {
            return output_.refuse(
                command_.line(), cycle_column(),
                "G87 (back boring) cuts upwards with the back of its tool, which is not modelled",
                "let the CAM system write it as G0 and G1 moves, or leave it out");
        }
        if (depth > retract) {
            return output_.refuse(command_.line(), cycle_column(),
                                  std::string("the cycle's bottom lies above its retract level R"),
                                  "correct R or the depth; in G91 the depth counts from R downwards");
        }
        if (depth == retract && output_.first(Note::no_depth)) {
            output_.warn(command_.line(),
                         "the bottom of the cycle is its retract level R: its holes have no depth");
        }
        retract_ = retract;
        depth_ = depth;
        clear_ = state_.retract_to_r ? retract : std::max(retract, *cycle.initial_mm);
        if (auto counted = check_pecks(); !counted) return std::unexpected(counted.error());
        note_return_level();
        return true;
    }

    // Moves to the place at the height of the tip, drills there and returns.
    Result<void> hole(Vec3 place) {
        place[axis_] = state_.tip_mm[axis_];
        if (auto moved = append_straight(MoveKind::rapid, place, command_, state_, output_); !moved) {
            return moved;
        }
        if (auto moved = go(MoveKind::rapid, retract_); !moved) return moved;
        if (auto done = bottom_and_back(); !done) return done;
        return go(MoveKind::rapid, clear_);
    }

    // Finds where the tool stands. After a move to a place that only the machine knows the cycle begins above
    // its hole, at R; false where even the hole is not known: then it is left out.
    Result<bool> find_start() {
        if (!state_.has_lost_tip()) {
            if (auto known = require_start(command_, state_, output_); !known) {
                return std::unexpected(known.error());
            }
            return true;
        }
        output_.leave_out(command_.line(), state_.lost_line);
        const auto target = target_of(command_, state_, output_);
        if (!target) return std::unexpected(target.error());
        state_.tip_mm = target->tip_mm;
        state_.known = target->known;
        const auto depth_axis = static_cast<std::size_t>(axis_);
        if (state_.known[depth_axis] == Known::lost && state_.cycle.retract_mm &&
            !is_increment(state_.cycle.retract_is_increment)) {
            state_.tip_mm[axis_] = level(*state_.cycle.retract_mm) + state_.origin_mm()[axis_];
            state_.known[depth_axis] = Known::yes;
        }
        return state_.knows_tip();
    }

    // LinuxCNC reads a stored Z or R by the mode of each block, Fanuc by that in which it was written.
    bool is_increment(bool was_written_so) const {
        return output_.options.dialect == GcodeDialect::linuxcnc ? state_.incremental : was_written_so;
    }
    double level(double written) const { return state_.frame.placed_level(written, axis_); }
    double scale() const { return state_.frame.scale[axis_]; }

    int cycle_column() const {
        const auto code = command_.g(GGroup::motion);
        return code ? code->column : column_of_any(command_, "XYZR");
    }

    std::unexpected<Error> refuse_missing(const char* word, const char* remedy) const {
        return output_.refuse(command_.line(), cycle_column(),
                              code_text('G', state_.cycle.tenths) + " without " + word, remedy);
    }

    Result<void> read_length(char letter, std::optional<double>& length) {
        const Word* word = command_.use(letter);
        if (word == nullptr) return {};
        const double value = word->value * state_.unit_mm;
        if (auto good = in_range(kLimits.coordinate, value, command_, *word, output_); !good) return good;
        length = value;
        return {};
    }

    Result<void> read_words() {
        Cycle& cycle = state_.cycle;
        // The word of the cycle axis is the depth, not a target of the tip.
        const auto depth = coordinate_mm(command_, axis_, state_, output_);
        if (!depth) return std::unexpected(depth.error());
        if (*depth) {
            cycle.depth_mm = *depth;
            cycle.depth_is_increment = state_.incremental;
        }
        command_.hide("XYZ"[axis_]);
        if (command_.has_any("R")) cycle.retract_is_increment = state_.incremental;
        if (auto done = read_length('R', cycle.retract_mm); !done) return done;
        if (may_peck() || cycle.tenths == 760 || cycle.tenths == 870) {
            if (auto done = read_length('Q', cycle.peck_mm); !done) return done;
        }
        if (auto done = read_words_of_fanuc(); !done) return done;
        if (cycle.tenths != 810 && cycle.tenths != 850) {
            if (auto done = read_dwell(); !done) return done;
        }
        if (auto done = read_repeats(); !done) return done;
        if (repeats_ == 0) return {};
        if (!cycle.retract_mm) {
            if (output_.options.dialect == GcodeDialect::linuxcnc)
                return refuse_missing("R", "write the level at which the feed begins");
            if (output_.first(Note::no_retract)) {
                output_.warn(command_.line(), code_text('G', cycle.tenths) +
                                                  " without R: the feed begins where the tool stands");
            }
        }
        if (!cycle.depth_mm) {
            return refuse_missing(axis_ == 2 ? "Z" : axis_ == 1 ? "Y" : "X", "write the depth");
        }
        if (may_peck() && !pecks() && output_.first(Note::whole_peck)) {
            output_.warn(command_.line(),
                         code_text('G', cycle.tenths) +
                             " without a depth of its pecks (Q): the hole is drilled in one");
        }
        return {};
    }

    // Haas: I J K of pecks that grow shorter, J of a tap that returns faster. Fanuc: I J of a boring bar's
    // shift.
    Result<void> read_words_of_fanuc() {
        if (output_.options.dialect != GcodeDialect::fanuc) return {};
        Cycle& cycle = state_.cycle;
        if (may_peck() && command_.has_any("I")) {
            if (auto done = read_length('I', cycle.first_peck_mm); !done) return done;
            if (auto done = read_length('J', cycle.peck_step_mm); !done) return done;
            if (auto done = read_length('K', cycle.least_peck_mm); !done) return done;
        }
        const bool is_tap = cycle.tenths == 740 || cycle.tenths == 840;
        if (is_tap && command_.use('J') != nullptr && output_.first(Note::tap_return)) {
            output_.warn(command_.line(),
                         "the faster return of a tap (J) is left out: it returns at its feed");
        }
        if (cycle.tenths == 760 || cycle.tenths == 870) {
            command_.use('I');
            command_.use('J');
        }
        return {};
    }

    Result<void> read_dwell() {
        const Word* word = command_.use('P');
        if (word == nullptr) return {};
        const double seconds = dwell_s(*word, output_);
        if (auto good = in_range(kLimits.dwell, seconds, command_, *word, output_); !good) return good;
        state_.cycle.dwell_s = seconds;
        return {};
    }

    // L, or K on a Fanuc control. 0 only stores the words of the cycle.
    Result<void> read_repeats() {
        const bool is_fanuc = output_.options.dialect == GcodeDialect::fanuc;
        const Word* word = command_.use('L');
        const bool is_peck = may_peck() && state_.cycle.first_peck_mm;  // K of Haas: the shortest peck
        if (word == nullptr && is_fanuc && !is_peck) word = command_.use('K');
        if (word == nullptr) return {};
        const bool fits =
            word->value == std::floor(word->value) && word->value <= kMostRepeats && word->value >= 0;
        if (!fits) {
            return output_.refuse(command_.line(), word->column,
                                  "the cycle's repeats are not a whole number from 0 to 100000",
                                  std::string("correct ") + word->letter);
        }
        repeats_ = static_cast<int>(word->value);
        return {};
    }

    bool may_peck() const { return state_.cycle.tenths == 730 || state_.cycle.tenths == 830; }
    // The sign of Q does not count.
    // The length of the peck `i`, from 0.
    double peck_mm(int i) const {
        const Cycle& cycle = state_.cycle;
        if (!cycle.first_peck_mm) return std::abs(cycle.peck_mm.value_or(0));
        const double shorter = std::abs(*cycle.first_peck_mm) - i * std::abs(cycle.peck_step_mm.value_or(0));
        return std::max(shorter, least_peck_mm());
    }
    double least_peck_mm() const {
        const Cycle& cycle = state_.cycle;
        if (!cycle.first_peck_mm) return std::abs(cycle.peck_mm.value_or(0));
        const bool shrinks = cycle.peck_step_mm.value_or(0) != 0;
        return std::abs(shrinks ? cycle.least_peck_mm.value_or(0) : *cycle.first_peck_mm);
    }
    bool pecks() const { return may_peck() && peck_mm(0) > 0; }

    Result<void> check_pecks() const {
        if (pecks() && !(least_peck_mm() > 0)) {
            return output_.refuse(command_.line(), cycle_column(),
                                  "pecks that grow shorter (J) without the shortest (K)", "write K");
        }
        if (!pecks() || (retract_ - depth_) / least_peck_mm() <= kMostPecks) return {};
        return output_.refuse(command_.line(), cycle_column(), "the hole takes more than 100000 pecks",
                              "correct Q");
    }

    void note_return_level() {
        if (state_.return_level_stated || retract_ >= *state_.cycle.initial_mm) return;
        if (output_.first(Note::return_level)) {
            output_.warn(command_.line(), std::string("neither G98 nor G99 so far: cycles return to ") +
                                              (state_.retract_to_r ? "R (G99)" : "their first level (G98)"));
        }
    }

    Result<void> go(MoveKind kind, double level) {
        Vec3 to = state_.tip_mm;
        to[axis_] = level;
        return append_straight(kind, to, command_, state_, output_);
    }
    Result<void> wait() {
        const double seconds = state_.cycle.dwell_s.value_or(0);
        return dwell(seconds, command_, state_, output_);
    }

    // The tool leaves the hole when it has drilled this deep since it was last out of it.
    bool clears(double drilled_mm) const {
        const double depth = state_.clearing_depth_mm;
        return depth > 0 ? drilled_mm > depth - kRounding : state_.cycle.tenths == 830;
    }

    // Moves from the retract level to the bottom, and back as far as the cycle returns at feed.
    Result<void> bottom_and_back() {
        if (pecks()) {
            double ground = retract_, cleared = retract_;
            for (int i = 0;; ++i) {
                // Equal pecks count from the level R on, so that their errors do not add up.
                ground = state_.cycle.first_peck_mm ? ground - peck_mm(i) : retract_ - (i + 1) * peck_mm(i);
                if (!(ground > depth_)) break;
                if (auto moved = go(MoveKind::feed, ground); !moved) return moved;
                if (clears(cleared - ground)) {
                    cleared = ground;
                    if (auto moved = go(MoveKind::rapid, retract_); !moved) return moved;
                }
                const double above = std::min(ground + kChipBreakMm, retract_);
                if (auto moved = go(MoveKind::rapid, above); !moved) return moved;
            }
        }
        if (auto moved = go(MoveKind::feed, depth_); !moved) return moved;
        if (auto waited = wait(); !waited) return waited;
        switch (state_.cycle.tenths) {
            case 740:  // taps reverse their rotation on the way out
            case 840:
            case 890:
                return go(MoveKind::feed,
                          output_.options.dialect == GcodeDialect::linuxcnc ? clear_ : retract_);
            case 850:
                return go(MoveKind::feed, retract_);
            default:
                return {};
        }
    }

    Command& command_;
    State& state_;
    Output& output_;
    int axis_;
    int repeats_ = 1;
    double retract_ = 0, depth_ = 0, clear_ = 0;  // levels in the frame of the tip, mm
};

// LinuxCNC's thread on a lathe has words that fine boring does not have.
bool is_thread(const Command& command, const Output& output) {
    return output.options.dialect == GcodeDialect::linuxcnc && command.has_g(GGroup::motion, 760) &&
           command.has_any("IJKH");
}

void note_cycle(const Command& command, const State& state, Output& output) {
    const int tenths = state.cycle.tenths;
    const bool turns_left = tenths == 740;
    const bool is_tap = turns_left || tenths == 840;
    const Spindle needed = turns_left ? Spindle::counter_clockwise : Spindle::clockwise;
    const bool checks_spindle = output.options.dialect == GcodeDialect::linuxcnc;
    if (is_tap && checks_spindle && state.spindle != needed && output.first(Note::wrong_spindle, tenths)) {
        output.warn(command.line(),
                    turns_left ? "G74 taps a left thread, but the spindle does not turn left (M4)"
                               : "G84 taps a right thread, but the spindle does not turn right (M3)");
    }
    if (tenths == 760 && output.first(Note::bore_shift)) {
        output.warn(command.line(),
                    "G76: the shift Q off the wall, whose direction the machine knows, is left out");
    }
    if ((tenths == 870 || tenths == 880) && output.first(Note::bore_by_hand, tenths)) {
        output.warn(command.line(),
                    code_text('G', tenths) + ": drawing the tool out by hand is taken as a rapid");
    }
}

}  // namespace

bool repeats_cycle(const Command& command, const State& state) {
    if (command.g(GGroup::hole_pattern)) return true;
    if (state.motion != MotionMode::cycle) return false;
    return command.has_any("XYZ") || command.g(GGroup::motion).has_value();
}

void begin_cycle(Code code, State& state) {
    if (state.motion != MotionMode::cycle) state.cycle = {};
    state.cycle.tenths = code.tenths;
    state.motion = MotionMode::cycle;
}

Result<void> run_cycle(Command& command, State& state, Output& output) {
    const auto code = command.g(GGroup::motion), pattern = command.g(GGroup::hole_pattern);
    const int column = code ? code->column : 1;
    if (pattern && state.motion != MotionMode::cycle) {
        return output.refuse(command.line(), pattern->column,
                             code_text('G', pattern->tenths) + " (a pattern of holes) without a cycle",
                             "write G81 or its like before it, with L0 where it is not to drill there");
    }
    if (is_thread(command, output)) {
        return output.refuse(command.line(), column, "G76 is a thread on a lathe in the LinuxCNC dialect",
                             "state the Fanuc dialect if it is fine boring, or give a milling program");
    }
    if (state.feed_mode == FeedMode::inverse_time) {
        return output.refuse(command.line(), column, "a canned cycle in inverse time (G93) has no feed",
                             "write G94 and F before it");
    }
    note_cycle(command, state, output);
    Run run(command, state, output);
    return pattern ? run.run_pattern(*pattern) : run.run();
}

}  // namespace tribo::readers::gcode
