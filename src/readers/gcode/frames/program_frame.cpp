// SPDX-License-Identifier: MIT
#include "readers/gcode/frames/program_frame.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/frames/tilted_plane.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/gcode/motion/compensation.hpp"
#include "readers/gcode/motion/moves.hpp"

namespace tribo::readers::gcode {
namespace {

// Scales from here on count thousandths: controls read P2000 as 2, and nobody enlarges a part a hundred
// times.
constexpr double kThousandths = 100;
constexpr double kSmallestScale = 1e-3;

Vec3 turned_in(Plane plane, Vec3 v, double degrees) {
    if (degrees == 0) return v;
    double sine = 0, cosine = 0;
    math::sincos(degrees * math::kRadPerDeg, sine, cosine);
    const auto axes = axes_of(plane);
    const double first = v[axes[0]], second = v[axes[1]];
    v[axes[0]] = cosine * first - sine * second;
    v[axes[1]] = sine * first + cosine * second;
    return v;
}

// Reads the words of a centre; an axis without one has it where the tip is.
Result<Vec3> read_centre(Command& command, State& state, Output& output) {
    Vec3 centre = state.frame.written(state.tip_mm - state.origin_mm());
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) centre[axis] = **word;
    }
    command.hide_axes();
    return centre;
}

Result<void> begin_turn(Command& command, State& state, Output& output, Code code) {
    const Word* angle = command.use('R');
    if (angle == nullptr) {
        return output.refuse(command.line(), code.column, "G68 without an angle R in degrees", "write R");
    }
    if (auto good = in_range(kLimits.rotary_angle, angle->value, command, *angle, output); !good) return good;
    state.frame.turn_deg = 0;
    auto centre = read_centre(command, state, output);
    if (!centre) return std::unexpected(centre.error());
    const auto axes = axes_of(state.plane);
    for (int i = 0; i < 2; ++i) {  // Mach3 writes the centre as A and B
        const Word* word = command.use("AB"[i]);
        if (word == nullptr) continue;
        command.hide(word->letter);
        const double place_mm = word->value * state.unit_mm;
        if (auto good = in_range(kLimits.coordinate, place_mm, command, *word, output); !good) return good;
        (*centre)[axes[static_cast<std::size_t>(i)]] = place_mm;
        if (output.first(Note::plane_centre)) {
            output.warn(command.line(), "A and B of G68 are taken as the centre of its rotation (Mach3)");
        }
    }
    state.frame.turn_centre_mm = *centre;
    state.frame.turn_deg = angle->value;
    state.frame.turn_plane = state.plane;
    return {};
}

Result<double> read_scale(const Word& word, const Command& command, Output& output) {
    const bool counts_thousandths = std::abs(word.value) >= kThousandths;
    const double scale = counts_thousandths ? word.value / 1000 : word.value;
    if (!(std::abs(scale) >= kSmallestScale) || std::abs(scale) > kThousandths) {
        return output.refuse(command.line(), word.column,
                             "the scale is smaller than 0.001 or larger than 100",
                             std::string("correct ") + word.letter);
    }
    if (output.first(Note::scale)) {
        output.warn(command.line(), std::string("G51: ") + word.letter + " is taken as " +
                                        (counts_thousandths ? "thousandths" : "the factor itself"));
    }
    return scale;
}

Result<void> begin_scale(Command& command, State& state, Output& output, Code code) {
    Vec3 scale{1, 1, 1};
    bool is_given = false;
    for (int axis = 0; axis < 3; ++axis) {
        const Word* word = command.has('P') ? command.use('P') : command.use("IJK"[axis]);
        if (word == nullptr) continue;
        const auto factor = read_scale(*word, command, output);
        if (!factor) return std::unexpected(factor.error());
        scale[axis] = *factor;
        is_given = true;
    }
    for (const char letter : {'I', 'J', 'K'}) command.hide(letter);  // no axis of the tool (G43.5)
    if (!is_given) {
        return output.refuse(command.line(), code.column, "G51 without its scale",
                             "write it as P, or for each axis as I, J and K");
    }
    state.frame.scale = {1, 1, 1};
    const auto centre = read_centre(command, state, output);
    if (!centre) return std::unexpected(centre.error());
    state.frame.scale_centre_mm = *centre;
    state.frame.scale = scale;
    return {};
}

Result<void> set_mirror(Command& command, State& state, Output& output, Code code) {
    const bool begins = code.tenths == 511 || code.tenths == 1010;
    if (begins && !command.has_any("XYZ")) {
        return output.refuse(command.line(), code.column,
                             code_text('G', code.tenths) + " without the place of its mirror",
                             "write X, Y or Z");
    }
    if (!begins && !command.has_any("XYZ")) state.frame.mirror_mm = {};
    for (int axis = 0; axis < 3; ++axis) {
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (*word) state.frame.mirror_mm[static_cast<std::size_t>(axis)] = begins ? *word : std::nullopt;
    }
    command.hide_axes();
    return {};
}

}  // namespace

bool ProgramFrame::is_plain() const {
    const bool mirrors = mirror_mm[0] || mirror_mm[1] || mirror_mm[2];
    return !is_polar && !mirrors && scale == Vec3{1, 1, 1} && turn_deg == 0;
}

Vec3 ProgramFrame::placed_offset(Vec3 offset) const {
    for (int axis = 0; axis < 3; ++axis) {
        offset[axis] *= scale[axis] * (mirror_mm[static_cast<std::size_t>(axis)] ? -1 : 1);
    }
    return turned_in(turn_plane, offset, placed_turn_deg());
}

Vec3 ProgramFrame::placed_direction(Vec3 direction) const {
    for (int axis = 0; axis < 3; ++axis) direction[axis] /= std::abs(scale[axis]);
    return placed_offset(direction);
}

double ProgramFrame::placed_level(double level, int axis) const {
    if (const auto mirror = mirror_mm[static_cast<std::size_t>(axis)]) level = 2 * *mirror - level;
    return scale_centre_mm[axis] + scale[axis] * (level - scale_centre_mm[axis]);
}

Vec3 ProgramFrame::placed(Vec3 written) const {
    const Vec3 centre = placed_unturned(turn_centre_mm);
    return centre + turned_in(turn_plane, placed_unturned(written) - centre, placed_turn_deg());
}

Vec3 ProgramFrame::placed_unturned(Vec3 written) const {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = placed_level(written[axis], axis);
    return p;
}

double ProgramFrame::placed_turn_deg() const {
    return is_mirrored(turn_plane) ? -turn_deg : turn_deg;
}

Vec3 ProgramFrame::written(Vec3 placed) const {
    const Vec3 centre = placed_unturned(turn_centre_mm);
    Vec3 p = centre + turned_in(turn_plane, placed - centre, -placed_turn_deg());
    for (int axis = 0; axis < 3; ++axis) {
        p[axis] = scale_centre_mm[axis] + (p[axis] - scale_centre_mm[axis]) / scale[axis];
        if (const auto mirror = mirror_mm[static_cast<std::size_t>(axis)]) p[axis] = 2 * *mirror - p[axis];
    }
    return p;
}

bool ProgramFrame::is_mirrored(Plane plane) const {
    bool mirrored = false;
    for (const int axis : {axes_of(plane)[0], axes_of(plane)[1]}) {
        if (mirror_mm[static_cast<std::size_t>(axis)]) mirrored = !mirrored;
        if (scale[axis] < 0) mirrored = !mirrored;
    }
    return mirrored;
}

std::optional<double> ProgramFrame::scale_in(Plane plane) const {
    const auto axes = axes_of(plane);
    const double first = std::abs(scale[axes[0]]), second = std::abs(scale[axes[1]]);
    if (first != second) return std::nullopt;
    return first;
}

Result<void> set_program_frame(Command& command, State& state, Output& output) {
    ProgramFrame& frame = state.frame;
    const auto polar = command.g(GGroup::polar), scaling = command.g(GGroup::scaling);
    const auto mirror = command.g(GGroup::mirror), rotation = command.g(GGroup::rotation);
    const auto to_plane = command.g(GGroup::tool_to_plane);
    const bool ends =
        rotation && (rotation->tenths == 690 || rotation->tenths == 691 || rotation->tenths == 2690);
    const bool changes = (polar && (polar->tenths == 160 || frame.is_polar)) ||
                         (scaling && (scaling->tenths == 510 || frame.scale != Vec3{1, 1, 1})) || mirror ||
                         (rotation && (!ends || frame.turn_deg != 0 || state.tilt)) || to_plane;
    if (!changes) return {};
    if (state.compensation.is_on && state.compensation.left_mm != 0) {
        return output.refuse(command.line(), 1,
                             "coordinates are turned, scaled or mirrored while cutter compensation is on",
                             "write G40 before it");
    }
    if (polar) {
        frame.is_polar = polar->tenths == 160;
        frame.radius_mm = frame.angle_deg = 0;
        frame.pole_mm = {};
    }
    if (mirror) {
        if (auto done = set_mirror(command, state, output, *mirror); !done) return done;
    }
    if (scaling && scaling->tenths == 500) frame.scale = {1, 1, 1};
    if (scaling && scaling->tenths == 510) {
        if (auto done = begin_scale(command, state, output, *scaling); !done) return done;
    }
    if (ends) {
        frame.turn_deg = 0;
        end_tilted_plane(state, output, command.line());
    } else if (rotation && begins_tilted_plane(command, *rotation)) {
        if (auto done = begin_tilted_plane(command, state, output, *rotation); !done) return done;
    } else if (rotation) {
        if (auto done = begin_turn(command, state, output, *rotation); !done) return done;
    }
    return to_plane ? turn_tool_to_plane(command, state, output, *to_plane) : Result<void>{};
}

Result<void> write_target(Command& command, State& state, Output& output, Vec3& written,
                          std::array<bool, 3>& known) {
    const auto axes = axes_of(state.plane);
    ProgramFrame& frame = state.frame;
    const int radial = axes[0], angular = axes[1];
    const bool goes_polar = frame.is_polar && (command.has("XYZ"[radial]) || command.has("XYZ"[angular]));
    for (int axis = 0; axis < 3; ++axis) {
        if (goes_polar && axis == angular) continue;
        const auto word = coordinate_mm(command, axis, state, output);
        if (!word) return std::unexpected(word.error());
        if (!*word) continue;
        const auto at = static_cast<std::size_t>(axis);
        if (goes_polar && axis == radial) {
            frame.radius_mm = **word;
            frame.pole_mm = state.incremental ? written : Vec3{};
        } else if (state.incremental) {
            written[axis] += **word;
        } else {
            written[axis] = **word;
            known[at] = true;
        }
    }
    if (!goes_polar) return {};
    // The angle counts from the first axis of the plane, in G91 from the last angle.
    if (const Word* angle = command.use("XYZ"[angular])) {
        if (auto good = in_range(kLimits.rotary_angle, angle->value, command, *angle, output); !good)
            return good;
        frame.angle_deg = state.incremental ? frame.angle_deg + angle->value : angle->value;
    }
    double sine = 0, cosine = 0;
    math::sincos(frame.angle_deg * math::kRadPerDeg, sine, cosine);
    written[radial] = frame.pole_mm[radial] + frame.radius_mm * cosine;
    written[angular] = frame.pole_mm[angular] + frame.radius_mm * sine;
    if (!state.incremental)
        known[static_cast<std::size_t>(radial)] = known[static_cast<std::size_t>(angular)] = true;
    return {};
}

}  // namespace tribo::readers::gcode
