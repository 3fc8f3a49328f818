// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/cycles.hpp"

#include <algorithm>
#include <cmath>

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

class Run {
  public:
    Run(Command& command, State& state, Output& output)
        : command_(command), state_(state), output_(output), axis_(axes_of(state.plane)[2]) {}

    Result<void> run() {
        if (auto done = read_words(); !done) return done;
        if (repeats_ == 0) return {};
        Cycle& cycle = state_.cycle;
        const double origin = state_.origin_mm()[axis_];
        // In G91, R is relative to the start of the cycle, and Z to R.
        const double retract = *cycle.retract_mm + (state_.incremental ? *cycle.initial_mm : origin);
        const double depth = *cycle.depth_mm + (state_.incremental ? retract : origin);
        if (depth > retract) {
            return output_.refuse(command_.line(), cycle_column(),
                                  std::string("the cycle's bottom lies above its retract level R"),
                                  "correct R or the depth; in G91 the depth counts from R downwards");
        }
        retract_ = retract;
        depth_ = depth;
        clear_ = state_.retract_to_r ? retract : std::max(retract, *cycle.initial_mm);
        if (auto counted = check_pecks(); !counted) return counted;
        note_return_level();

        const auto target = target_of(command_, state_, output_);
        if (!target) return std::unexpected(target.error());
        Vec3 place = target->tip_mm;
        const Vec3 step = state_.incremental ? place - state_.tip_mm : Vec3{};
        if (state_.tip_mm[axis_] < retract_) {
            if (auto moved = go(MoveKind::rapid, retract_); !moved) return moved;
        }
        for (int i = 0; i < repeats_; ++i) {
            place[axis_] = state_.tip_mm[axis_];
            if (i > 0) {
                for (const int in_plane : {axes_of(state_.plane)[0], axes_of(state_.plane)[1]}) {
                    place[in_plane] += step[in_plane];
                }
            }
            if (auto moved = append_straight(MoveKind::rapid, place, command_, state_, output_); !moved) {
                return moved;
            }
            if (auto moved = go(MoveKind::rapid, retract_); !moved) return moved;
            if (auto done = bottom_and_back(); !done) return done;
            if (auto moved = go(MoveKind::rapid, clear_); !moved) return moved;
        }
        return {};
    }

  private:
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
        if (*depth) cycle.depth_mm = **depth;
        command_.hide("XYZ"[axis_]);
        if (auto done = read_length('R', cycle.retract_mm); !done) return done;
        if (pecks() || cycle.tenths == 760) {
            if (auto done = read_length('Q', cycle.peck_mm); !done) return done;
        }
        if (cycle.tenths != 810 && cycle.tenths != 850) {
            if (auto done = read_dwell(); !done) return done;
        }
        if (auto done = read_repeats(); !done) return done;
        if (repeats_ == 0) return {};
        if (!cycle.retract_mm) return refuse_missing("R", "write the level at which the feed begins");
        if (!cycle.depth_mm) {
            return refuse_missing(axis_ == 2 ? "Z" : axis_ == 1 ? "Y" : "X", "write the depth");
        }
        if (pecks() && !(cycle.peck_mm && *cycle.peck_mm > 0)) {
            return refuse_missing("Q above 0", "write the depth of one peck as Q");
        }
        return {};
    }

    Result<void> read_dwell() {
        const Word* word = command_.use('P');
        if (word == nullptr) return {};
        const bool in_seconds = output_.options.dialect == GcodeDialect::linuxcnc;
        const double seconds = in_seconds ? word->value : word->value / 1000;
        if (auto good = in_range(kLimits.dwell, seconds, command_, *word, output_); !good) return good;
        state_.cycle.dwell_s = seconds;
        return {};
    }

    // L, or K on a Fanuc control. 0 only stores the words of the cycle.
    Result<void> read_repeats() {
        const bool is_fanuc = output_.options.dialect == GcodeDialect::fanuc;
        const Word* word = command_.use('L');
        if (word == nullptr && is_fanuc) word = command_.use('K');
        if (word == nullptr) return {};
        const bool fits = word->value == std::floor(word->value) && word->value <= kMostRepeats &&
                          word->value >= (is_fanuc ? 0 : 1);
        if (!fits) {
            return output_.refuse(command_.line(), word->column,
                                  "the cycle's repeats are not a whole number from 1 to 100000",
                                  std::string("correct ") + word->letter);
        }
        repeats_ = static_cast<int>(word->value);
        return {};
    }

    bool pecks() const { return state_.cycle.tenths == 730 || state_.cycle.tenths == 830; }

    Result<void> check_pecks() const {
        if (!pecks() || (retract_ - depth_) / *state_.cycle.peck_mm <= kMostPecks) return {};
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

    // Moves from the retract level to the bottom, and back as far as the cycle returns at feed.
    Result<void> bottom_and_back() {
        if (pecks()) {
            const double peck = *state_.cycle.peck_mm;
            for (int i = 1; retract_ - i * peck > depth_; ++i) {
                const double ground = retract_ - i * peck;
                if (auto moved = go(MoveKind::feed, ground); !moved) return moved;
                if (state_.cycle.tenths == 830) {
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

std::unexpected<Error> refuse_unmodelled(const Command& command, const State& state, const Output& output) {
    const auto code = command.g(GGroup::motion);
    const int column = code ? code->column : 1;
    if (state.cycle.tenths == 870) {
        return output.refuse(
            command.line(), column,
            "G87 (back boring) cuts upwards with the back of its tool, which is not modelled",
            "let the CAM system write it as G0 and G1 moves, or leave it out");
    }
    return output.refuse(command.line(), column, "G76 is a thread on a lathe in the LinuxCNC dialect",
                         "state the Fanuc dialect if it is fine boring, or give a milling program");
}

}  // namespace

bool repeats_cycle(const Command& command, const State& state) {
    if (state.motion != MotionMode::cycle) return false;
    return command.has_any("XYZ") || command.g(GGroup::motion).has_value();
}

void begin_cycle(Code code, State& state) {
    if (state.motion != MotionMode::cycle) state.cycle = {};
    state.cycle.tenths = code.tenths;
    state.motion = MotionMode::cycle;
}

Result<void> run_cycle(Command& command, State& state, Output& output) {
    const bool is_fanuc = output.options.dialect == GcodeDialect::fanuc;
    if (state.cycle.tenths == 870 || (state.cycle.tenths == 760 && !is_fanuc)) {
        return refuse_unmodelled(command, state, output);
    }
    if (state.feed_mode == FeedMode::inverse_time) {
        return output.refuse(command.line(),
                             command.g(GGroup::motion) ? command.g(GGroup::motion)->column : 1,
                             "a canned cycle in inverse time (G93) has no feed", "write G94 and F before it");
    }
    if (auto known = require_start(command, state, output); !known) return known;
    if (!state.cycle.initial_mm) state.cycle.initial_mm = state.tip_mm[axes_of(state.plane)[2]];
    const bool turns_left = state.cycle.tenths == 740;
    if ((turns_left || state.cycle.tenths == 840) && !is_fanuc &&
        state.spindle != (turns_left ? Spindle::counter_clockwise : Spindle::clockwise)) {
        return output.refuse(command.line(),
                             command.g(GGroup::motion) ? command.g(GGroup::motion)->column : 1,
                             turns_left ? "G74 taps a left thread, but the spindle does not turn left"
                                        : "G84 taps a right thread, but the spindle does not turn right",
                             turns_left ? "write M4 before it" : "write M3 before it");
    }
    if (state.cycle.tenths == 760 && output.first(Note::bore_shift)) {
        output.warn(command.line(),
                    "G76: the shift Q off the wall, whose direction the machine knows, is left out");
    }
    if (state.cycle.tenths == 880 && output.first(Note::bore_by_hand)) {
        output.warn(command.line(), "G88: drawing the tool out by hand is taken as a rapid");
    }
    return Run(command, state, output).run();
}

}  // namespace tribo::readers::gcode
