// SPDX-License-Identifier: MIT
// Poles and circles.
#include <cmath>

#include "base/math.hpp"
#include "readers/gcode/motion/arc.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/length_unit.hpp"

namespace tribo::readers::heidenhain {
namespace {

// Coordinates that differ by less count as one when the plane of a circle is sought, mm.
constexpr double kFlatMm = 1e-3;

}  // namespace

// CC X Y sets the pole; CC alone sets it to the position of the tip. Two axes name its plane.
Result<void> Interpreter::pole(LineReader& in) {
    const auto words = read_words(in, "CC");
    if (!words) return std::unexpected(words.error());
    bool has[3];
    for (std::size_t k = 0; k < 3; ++k) has[k] = words->axis[k] || words->increment[k];
    gcode::Plane plane = gcode::Plane::xy;
    if (has[2]) {
        if (!has[0] && !has[1] && pole_plane_ == gcode::Plane::xy) {
            return in.refuse(words->first_column, "a pole needs two axes: X Y, Y Z or Z X",
                             "write CC with two of X, Y and Z");
        }
        if (has[0] != has[1]) plane = has[0] ? gcode::Plane::zx : gcode::Plane::yz;
        if (!has[0] && !has[1]) plane = pole_plane_;
    }
    Vec3 pole = words->items.empty() ? here() : pole_.value_or(here());
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (words->axis[i]) pole[k] = *words->axis[i];
        if (words->increment[i]) pole[k] = here()[k] + *words->increment[i];
    }
    pole_ = pole;
    pole_plane_ = plane;
    pole_has_plane_ = !(has[0] && has[1] && has[2]);
    return {};
}

// After CC X Y Z the plane is that in which start, end and pole lie. Where they lie on one line it is that of
// the move before.
Result<void> Interpreter::find_plane(Vec3 to, int column) {
    if (pole_has_plane_) return {};
    const Vec3 from = here() - *pole_, end = to - *pole_;
    constexpr gcode::Plane planes[] = {gcode::Plane::yz, gcode::Plane::zx, gcode::Plane::xy};
    std::optional<gcode::Plane> found;
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        if (std::abs(from[k]) > kFlatMm || std::abs(end[k]) > kFlatMm) continue;
        ++count;
        if (!found || std::abs(tangent_[k]) < 1e-6) found = planes[k];
    }
    if (!found) {
        return path_.refuse(place(column), "start, end and pole of the circle lie in no plane of the axes",
                            "write CC with two of X, Y and Z");
    }
    if (count > 1 && path_.first(kCirclePlane)) {
        path_.warn(line_.number,
                   "CC names three axes, and the circle may lie in several planes: that of the "
                   "move before is taken");
    }
    pole_plane_ = *found;
    pole_has_plane_ = true;
    return {};
}

// True if start, end and pole share X or Y.
bool Interpreter::lies_flat(Vec3 to) const {
    const Vec3 from = here() - *pole_, end = to - *pole_;
    return (std::abs(from.x) < kFlatMm && std::abs(end.x) < kFlatMm) ||
           (std::abs(from.y) < kFlatMm && std::abs(end.y) < kFlatMm);
}

Result<void> Interpreter::circle(LineReader& in) {
    const auto words = read_words(in, "C");
    if (!words) return std::unexpected(words.error());
    if (!pole_) return in.refuse(words->first_column, "a circle without a centre", "write CC before it");
    if (words->direction == 0) return in.refuse(words->first_column, "a circle without DR+ or DR-", "add it");
    const auto has = has_start(*words, false);
    if (!has) return std::unexpected(has.error());
    if (!*has) return {};
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    // A start in the pole: the circle stands on the plane, about the last coordinate of the pole along its
    // normal.
    const auto axes = gcode::axes_of(pole_plane_);
    const Vec3 from = here() - *pole_;
    if (math::hypot(from[axes[0]], from[axes[1]]) < kFlatMm) pole_has_plane_ = false;
    if (auto done = find_plane(*to, words->first_column); !done) return done;
    if (auto done = refuse_uneven_scale(words->first_column); !done) return done;
    const auto about_pole = [&] {
        gcode::ArcEnds ends;
        ends.plane = pole_plane_;
        ends.clockwise = turning(words->direction, pole_plane_) < 0;
        ends.start_mm = here();
        ends.end_mm = *to;
        return gcode::arc_about_centre(ends, *pole_, unit_mm_);
    };
    auto arc = about_pole();
    const bool rises = words->axis[2] || words->increment[2];
    if (!arc && pole_plane_ == gcode::Plane::xy && rises && lies_flat(*to)) {
        // NX writes CC X Y also for circles on X Y, about the Z of the CC before.
        pole_has_plane_ = false;
        if (auto done = find_plane(*to, words->first_column); !done) return done;
        if (path_.first(kPoleOfBefore)) {
            path_.warn(line_.number, "the circle fits only about the Z of an earlier CC: it is taken so");
        }
        arc = about_pole();
    }
    if (!arc)
        return in.refuse(words->first_column, arc.error().cause, "correct the end, or the centre in CC");
    return travel(*words, *to, *arc, path_.rotary_rad());
}

Result<void> Interpreter::circle_of_radius(LineReader& in) {
    const auto words = read_words(in, "CR");
    if (!words) return std::unexpected(words.error());
    if (!words->radius) return in.refuse(words->first_column, "CR without a radius R", "add it");
    if (words->direction == 0) return in.refuse(words->first_column, "CR without DR+ or DR-", "add it");
    const auto has = has_start(*words, false);
    if (!has) return std::unexpected(has.error());
    if (!*has) return {};
    const auto to = target(*words);
    if (!to) return std::unexpected(to.error());
    if (auto done = refuse_uneven_scale(words->first_column); !done) return done;
    gcode::ArcEnds ends;
    ends.clockwise = turning(words->direction, gcode::Plane::xy) < 0;
    ends.start_mm = here();
    ends.end_mm = *to;
    const auto arc = gcode::arc_of_radius(ends, *words->radius);
    if (!arc) return in.refuse(words->first_column, arc.error().cause, arc.error().remedy);
    return travel(*words, *to, *arc, path_.rotary_rad());
}

// CT and CTP: an arc to the end, tangent to the last element.
Result<void> Interpreter::tangent_circle(LineReader& in, bool polar) {
    const auto words = read_words(in, polar ? "CTP" : "CT");
    if (!words) return std::unexpected(words.error());
    const auto has = has_start(*words, polar);
    if (!has) return std::unexpected(has.error());
    if (!*has) return {};
    const Vec3 from = here(), along{tangent_.x, tangent_.y, 0};
    if (!(length(along) > 1e-9)) {
        return in.refuse(words->first_column, "CT with nothing before it to be tangent to",
                         "write L or C before it");
    }
    const auto to = polar ? polar_target(*words) : target(*words);
    if (!to) return std::unexpected(to.error());
    // The centre is on the normal of the tangent at the start, at equal distances from start and end.
    const Vec3 t = normalized(along), normal{-t.y, t.x, 0}, chord{to->x - from.x, to->y - from.y, 0};
    const double across = dot(chord, normal);
    if (std::abs(across) <= 1e-9 * length(chord)) {
        return in.refuse(words->first_column, "the end of CT lies straight ahead: no arc leads there",
                         "write L");
    }
    const double radius = squared_length(chord) / (2 * across);
    if (!kLimits.coordinate.range.contains(radius)) {
        return in.refuse(words->first_column, "the radius of CT is more than a kilometre", "write L");
    }
    gcode::ArcEnds ends;
    ends.clockwise = radius < 0;
    ends.start_mm = from;
    ends.end_mm = *to;
    const auto arc = gcode::arc_about_centre(ends, from + radius * normal, unit_mm_);
    if (!arc) return in.refuse(words->first_column, arc.error().cause, "correct the end");
    return travel(*words, *to, *arc, path_.rotary_rad());
}

// CP PA or IPA, with Z or IZ a helix of any number of turns.
Result<void> Interpreter::polar_circle(LineReader& in) {
    const auto words = read_words(in, "CP");
    if (!words) return std::unexpected(words.error());
    if (words->direction == 0) return in.refuse(words->first_column, "CP without DR+ or DR-", "add it");
    const auto has = has_start(*words, true);
    if (!has) return std::unexpected(has.error());
    if (!*has) return {};
    const auto to = polar_target(*words);
    if (!to) return std::unexpected(to.error());
    if (auto done = refuse_uneven_scale(words->first_column); !done) return done;
    const auto axes = gcode::axes_of(pole_plane_);
    const Vec3 from = here() - *pole_, end = *to - *pole_;
    const double start_radius = math::hypot(from[axes[0]], from[axes[1]]);
    if (!(start_radius > 1e-6)) {
        return in.refuse(words->first_column, "the arc starts in its pole", "correct CC");
    }
    const int direction = turning(words->direction, pole_plane_);
    const bool has_angle = words->polar_angle || words->polar_turn;
    double turn = has_angle ? words->polar_turn.value_or(0) * words->direction : 360;
    // Whole and half turns end at the same place either way.
    if (turn < 0 && std::fmod(turn, 180) == 0) {
        turn = -turn;
        if (path_.first(kOtherTurn))
            path_.warn(line_.number, "IPA and DR turn different ways to the same place: DR counts");
    }
    if (words->polar_angle) {
        const double start = math::atan2(from[axes[1]], from[axes[0]]) * math::kDegPerRad;
        const double stop = mirror_ == Vec3{1, 1, 1}
                                ? *words->polar_angle
                                : math::atan2(end[axes[1]], end[axes[0]]) * math::kDegPerRad;
        turn = (stop - start) * direction;
        turn -= 360 * std::floor(turn / 360);
        if (turn < 1e-9) turn += 360;
    }
    if (!(turn > 0))
        return in.refuse(words->first_column, "IPA and DR turn different ways", "correct a sign");
    motion::Arc arc;
    arc.centre_mm = *pole_;
    arc.centre_mm[axes[2]] = here()[axes[2]];
    arc.normal = {0, 0, 0};
    arc.normal[axes[2]] = direction;
    arc.turn_rad = turn * math::kRadPerDeg;
    return travel(*words, *to, arc, path_.rotary_rad());
}

// A circle in a frame with two scales would be an ellipse.
Result<void> Interpreter::refuse_uneven_scale(int column) const {
    if (scale_.x == scale_.y && scale_.y == scale_.z) return {};
    if (scale_.x == scale_.y && pole_plane_ == gcode::Plane::xy) return {};
    return path_.refuse(place(column), "a circle in a frame with different scales is none",
                        "write the same factor for both axes");
}

}  // namespace tribo::readers::heidenhain
