// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/circular_pocket.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr double kMostRings = 10'000;
constexpr double kSameMm = 1e-9;

class Pocket {
  public:
    Pocket(Command& command, State& state, Output& output, Code code)
        : command_(command), state_(state), output_(output), code_(code), axes_(axes_of(state.plane)) {}

    Result<void> run() {
        if (auto read = read_words(); !read) return read;
        if (state_.has_lost_tip()) {
            output_.leave_out(command_.line(), state_.lost_line);
            command_.use('Z');
            return {};
        }
        if (auto known = require_start(command_, state_, output_); !known) return known;
        const auto target = target_of(command_, state_, output_);
        if (!target) return std::unexpected(target.error());
        const double depth = target->tip_mm[axes_[2]] - state_.tip_mm[axes_[2]];
        if (target->tip_mm[axes_[0]] != state_.tip_mm[axes_[0]] ||
            target->tip_mm[axes_[1]] != state_.tip_mm[axes_[1]]) {
            return refuse(name() + " begins at another place than where the tool stands",
                          "move to the middle of the pocket before it");
        }
        centre_ = state_.tip_mm;
        const double height = centre_[axes_[2]];
        for (double pass = 1; pass <= passes_; ++pass) {
            // L repeats the increment of G91; without it the depth is reached at once.
            const double level = height + (state_.incremental ? pass * depth : depth);
            if (auto done = at_level(level); !done) return done;
        }
        return {};
    }

  private:
    std::string name() const { return code_text('G', code_.tenths); }
    std::unexpected<Error> refuse(std::string cause, std::string remedy) const {
        return output_.refuse(command_.line(), code_.column, std::move(cause), std::move(remedy));
    }

    Result<double> length(char letter) {
        const Word* word = command_.use(letter);
        command_.hide(letter);
        if (word == nullptr) return 0.0;
        const double mm = std::abs(word->value) * state_.unit_mm;
        if (auto good = in_range(kLimits.coordinate, mm, command_, *word, output_); !good)
            return std::unexpected(good.error());
        return mm;
    }

    Result<void> read_words() {
        double* sizes[] = {&first_, &last_, &step_};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto size = length("IKQ"[i]);
            if (!size) return std::unexpected(size.error());
            *sizes[i] = *size;
        }
        const Word* times = command_.use('L');
        command_.hide('L');
        if (times != nullptr) passes_ = std::floor(times->value);
        const Word* number = command_.use('D');
        const double offset =
            number == nullptr ? state_.offset_number.value_or(state_.tool()) : number->value;
        // I, K and Q are sizes of the pocket, so that any text about the tool counts.
        const int tool = static_cast<int>(offset);
        auto diameter =
            offset == 0 ? std::optional<double>(0) : output_.tool_diameter_mm(tool, state_.unit_mm);
        if (!diameter) diameter = output_.notes.stated_diameter_mm(tool, state_.unit_mm);
        if (!diameter && output_.first(Note::compensation_unknown)) {
            output_.warn(command_.line(), name() +
                                              ": nothing states the diameter of the tool: its circles are "
                                              "taken for those of the tool's centre");
        }
        const double radius = diameter.value_or(0) / 2;
        if (last_ == 0) last_ = first_;
        if (step_ == 0) step_ = std::max(last_ - first_, 0.0);
        first_ -= radius;
        last_ -= radius;
        // The first circle is the tool's own, or smaller.
        const bool is_within_tool = radius > 0 && first_ <= kSameMm && last_ > kSameMm && step_ > 0;
        if (is_within_tool) {
            if (first_ < -kSameMm && output_.first(Note::pocket_within_tool)) {
                output_.warn(command_.line(),
                             name() +
                                 ": I is smaller than the tool's radius, where a control may "
                                 "stop: the first circle is the next one that is larger");
            }
            first_ = std::min(first_ + step_ * (std::floor(-first_ / step_) + 1), last_);
        }
        const double rings = step_ > 0 ? (last_ - first_) / step_ : 0;
        if (!(first_ > kSameMm) || !(last_ >= first_) || !(rings + 1 <= kMostRings) ||
            !(passes_ >= 1 && passes_ * (rings + 1) <= kMostRings)) {
            return refuse(
                name() + " without a radius I larger than the tool's, or with sizes that do not fit",
                "write I, and with K and Q a larger radius and the step to it");
        }
        if (output_.first(Note::round_pocket)) {
            output_.warn(command_.line(),
                         name() +
                             ": the tool enters its circles from the middle to the right, by "
                             "half circles; the control may begin elsewhere");
        }
        return {};
    }

    // Turns by an angle about a centre at a distance from the middle, to the right of it.
    Result<void> turn(double from_middle, double half_turns) {
        motion::Move move = new_move(motion::MoveKind::feed, command_, state_);
        motion::Arc arc;
        arc.centre_mm = state_.tip_mm;
        arc.centre_mm[axes_[0]] = centre_[axes_[0]] + from_middle;
        arc.centre_mm[axes_[1]] = centre_[axes_[1]];
        arc.normal = {0, 0, 0};
        arc.normal[axes_[2]] = code_.tenths == 120 ? -1 : 1;
        arc.turn_rad = half_turns * math::kPi;
        if (half_turns == 1)
            move.end.tip_mm[axes_[0]] = 2 * arc.centre_mm[axes_[0]] - move.start.tip_mm[axes_[0]];
        move.arc = arc;
        if (auto fed = set_feed(move, command_, state_, output_); !fed) return fed;
        note_spindle(command_, state_, output_);
        state_.tip_mm = move.end.tip_mm;
        return append(move, state_, output_);
    }

    // Down in the middle, circle by circle outwards, and back to the middle.
    Result<void> at_level(double level) {
        Vec3 down = state_.tip_mm;
        down[axes_[2]] = level;
        if (auto done = append_straight(motion::MoveKind::feed, down, command_, state_, output_); !done)
            return done;
        double radius = first_;
        if (auto done = turn(radius / 2, 1); !done) return done;
        for (;;) {
            if (auto done = turn(0, 2); !done) return done;
            if (!(radius < last_ - kSameMm)) break;
            // Two half circles lead to the next one.
            const double next = std::min(radius + step_, last_), left = (radius + next) / 2;
            if (auto done = turn((radius - left) / 2, 1); !done) return done;
            if (auto done = turn((next - left) / 2, 1); !done) return done;
            radius = next;
        }
        return turn(radius / 2, 1);
    }

    Command& command_;
    State& state_;
    Output& output_;
    Code code_;
    std::array<int, 3> axes_;
    Vec3 centre_;
    double first_ = 0, last_ = 0, step_ = 0, passes_ = 1;
};

}  // namespace

Result<void> mill_round_pocket(Command& command, State& state, Output& output, Code code) {
    if (state.compensation.is_on && state.compensation.left_mm != 0) {
        return output.refuse(command.line(), code.column,
                             code_text('G', code.tenths) + " while cutter compensation is on",
                             "write G40 before it");
    }
    if (!state.frame.is_plain()) {
        return output.refuse(
            command.line(), code.column,
            code_text('G', code.tenths) + " in coordinates that are turned, scaled, mirrored or polar",
            "end G16, G51, G51.1 and G68 before it");
    }
    return Pocket(command, state, output, code).run();
}

}  // namespace tribo::readers::gcode
