// SPDX-License-Identifier: MIT
#include "readers/gcode/motion/parallel_axes.hpp"

#include <algorithm>
#include <string>

#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr char kLetters[] = "UVW";
constexpr char kMain[] = "XYZ";

std::string cause_of_refusal(const Command& command, const State& state, Output& output) {
    if (!output.writes_axis(1)) return "an increment of a lathe, in a program without Y";
    if (command.has('X') && command.has('Y') && command.has('U') && command.has('V')) {
        return "the other end of a hot wire, in a block with X Y U V";
    }
    if (state.motion != MotionMode::rapid && state.motion != MotionMode::line) {
        return "an axis of an arc, a spline or a cycle";
    }
    const bool is_turned = !state.frame.is_plain() || state.tilt || state.cylinder ||
                           state.rotary.tip_control || state.rotary.vectors || state.active().turn_deg != 0;
    return is_turned ? "an axis beside turned, scaled, tilted or rolled coordinates" : "";
}

std::string means(const Word& word, const std::string& cause) {
    return std::string(1, word.letter) + " would be " + cause + ": that is not read";
}

std::string taken_as(int axis) {
    const std::string letter(1, kLetters[axis]);
    return letter + " is taken as an axis parallel to " + kMain[axis] +
           ": the tip stands at the sum of both, and " + letter + " starts at 0";
}

}  // namespace

bool has_parallel_move(const Command& command, const State& state) {
    return std::ranges::any_of(command.block().words, [&](const Word& word) {
        const bool is_parallel = word.letter >= 'U' && word.letter <= 'W' && command.has(word.letter);
        return is_parallel && (word.value != 0 || state.parallel.at_mm[word.letter - 'U'] != 0);
    });
}

Result<Vec3> move_parallel_axes(Command& command, State& state, Output& output) {
    Vec3 way_mm;
    for (int axis = 0; axis < 3; ++axis) {
        const Word* word = command.use(kLetters[axis]);
        if (word == nullptr) continue;
        const std::string cause = cause_of_refusal(command, state, output);
        // A word that is 0 in a program without such axes moves nothing, whatever it means.
        if (!cause.empty() && word->value == 0 && state.parallel.at_mm == Vec3{}) continue;
        if (!cause.empty()) {
            return output.refuse(command.line(), word->column, means(*word, cause),
                                 "let the CAM system write the path with X, Y and Z");
        }
        const auto written = length_mm(command, word->letter, state, output);
        if (!written) return std::unexpected(written.error());
        double& place = state.parallel.at_mm[axis];
        const double to = (state.incremental ? place : state.parallel.zero_mm[axis]) + **written;
        way_mm[axis] = to - place;
        place = to;
        if (output.first(Note::parallel_axis, word->letter)) output.warn(command.line(), taken_as(axis));
    }
    return way_mm;
}

Result<void> preset_parallel_axes(Command& command, State& state, Output& output) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto written = length_mm(command, kLetters[axis], state, output);
        if (!written) return std::unexpected(written.error());
        if (*written) state.parallel.zero_mm[axis] = state.parallel.at_mm[axis] - **written;
    }
    return {};
}

void home_parallel_axes(Command& command, State& state) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!command.has(kLetters[axis])) continue;
        state.parallel.at_mm[axis] = state.parallel.zero_mm[axis] = 0;
        command.hide(kLetters[axis]);
    }
}

}  // namespace tribo::readers::gcode
