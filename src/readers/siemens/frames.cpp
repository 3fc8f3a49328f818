// SPDX-License-Identifier: MIT
// Frames: work offsets, TRANS, ROT, SCALE, MIRROR, and the swivelled planes of CYCLE800.
#include <cmath>

#include "base/math.hpp"
#include "readers/siemens/interpreter.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr Range kScale{1e-3, 1e3};
constexpr double kParallel = 1e-9;  // sine of the angle between two directions

Vec3 unit(int axis) {
    Vec3 direction;
    direction[axis] = 1;
    return direction;
}

}  // namespace

motion::WorkFrame joined(const motion::WorkFrame& outer, const motion::WorkFrame& inner) {
    return {outer.in_stock(inner.origin_mm), outer.direction_in_stock(inner.x),
            outer.direction_in_stock(inner.y), outer.direction_in_stock(inner.z)};
}

motion::WorkFrame turned_by(motion::WorkFrame frame, const Vec3& rad) {
    for (const int k : {2, 1, 0}) {
        if (rad[k] != 0) frame = frame.turned(unit(k), rad[k]);
    }
    return frame;
}

motion::WorkFrame Interpreter::settable_frame() const {
    const auto found = offsets_.find(work_offset_);
    return found == offsets_.end() ? motion::WorkFrame{} : found->second;
}

motion::WorkFrame Interpreter::outer_frame() const {
    return joined(base_frame_, settable_frame());
}

void Interpreter::set_work_offset(int code) {
    work_offset_ = code;
    if (code <= 54 || code == 500 || offsets_.contains(code)) return;
    if (passed_over_.insert("G" + std::to_string(code)).second) {
        path_.warn(line_number(),
                   "G" + std::to_string(code) +
                       " is not placed by the program: its zero is taken at that of the stock");
    }
}

// Makes the frame of the modes that of the path. The tool does not move.
Result<void> Interpreter::set_frame(int line) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    const motion::WorkFrame frame = joined(joined(joined(outer_frame(), swivelled_), along_tool_), turned_);
    const bool turns = frame.x != path_.frame.x || frame.y != path_.frame.y || frame.z != path_.frame.z;
    const bool is_partly_known =
        !path_.knows_tip() &&
        (path_.known(0) == Known::yes || path_.known(1) == Known::yes || path_.known(2) == Known::yes);
    path_.frame = frame;
    if (turns && is_partly_known) path_.lose(line);
    if (turns) tangent_ = {};
    pole_.reset();
    return {};
}

// Multiplies the scale of an axis by a factor.
Result<void> Interpreter::take_scale(double& scale, double factor, Place where) const {
    if (!kScale.contains(factor) || !kScale.contains(std::abs(scale * factor))) {
        return path_.refuse(where, "the scale is out of range", "write a factor of 0.001 to 1000");
    }
    scale *= factor;
    return {};
}

// `frame` turned about the axes of coordinates that are scaled and mirrored within it.
Result<motion::WorkFrame> Interpreter::turned_within(const motion::WorkFrame& frame, const Vec3& scale,
                                                     Vec3 rad, Place where) const {
    // In mirrored coordinates a turn about an axis is one about its image, to the other side.
    const double mirrored = scale.x * scale.y * scale.z < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {
        const int first = (k + 1) % 3, second = (k + 2) % 3;
        if (rad[k] != 0 && std::abs(scale[first]) != std::abs(scale[second])) {
            return path_.refuse(where, "a turn of a frame with different scales is not read",
                                "write the same factor for the axes that turn");
        }
        rad[k] *= mirrored * (scale[k] < 0 ? -1 : 1);
    }
    return turned_by(frame, rad);
}

// TRANS, ROT, SCALE and MIRROR delete what was before them; ATRANS, AROT, ASCALE and AMIRROR add to it. G58
// and G59 shift the axes beside them.
Result<void> Interpreter::transform(const Words& words) {
    const bool shifts_axes = words.frame[0] == 'G';
    const bool adds = words.frame[0] == 'A' || shifts_axes;
    const std::string kind = shifts_axes ? "TRANS" : adds ? words.frame.substr(1) : words.frame;
    if (!adds) {
        turned_ = {};
        absolute_shift_ = {};
        scale_ = {1, 1, 1};
    }
    for (const auto& word : words.linear) {
        if (!word) continue;
        const Limit& limit = kind == "ROT" ? kLimits.rotary_angle : kLimits.coordinate;
        const double value = kind == "TRANS" ? word->value * unit_mm_ : word->value;
        if (auto good = path_.in_range(limit, value, place(word->column)); !good) return good;
    }
    for (const auto& word : words.parallel) {
        if (!word || word->value == 0) continue;
        return path_.refuse(place(word->column), words.frame + " of U, V or W is not read",
                            "write their coordinates in the blocks");
    }
    if (words.has_rotary() && kind == "TRANS" && (words.rotary[0] ? words.rotary[0]->value : 0) == 0 &&
        (words.rotary[1] ? words.rotary[1]->value : 0) == 0 &&
        (words.rotary[2] ? words.rotary[2]->value : 0) == 0) {
        // nothing to shift
    } else if (words.has_rotary()) {
        return path_.refuse(place(words.first_column), words.frame + " of a rotary axis is not read",
                            "write the angles in the blocks");
    }
    if (kind == "ROT") {
        if (auto done = turn_frame(words); !done) return done;
        return set_frame(line_number());
    }
    if (shifts_axes) {
        shift_axes(words);
        return set_frame(line_number());
    }
    Vec3 shift;
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.linear[static_cast<std::size_t>(k)];
        if (!word) continue;
        if (kind == "TRANS") shift[k] = word->value * unit_mm_;
        if (kind == "MIRROR") scale_[k] = -scale_[k];
        if (kind != "SCALE") continue;
        if (auto done = take_scale(scale_[k], word->value, place(word->column)); !done) return done;
    }
    if (kind == "TRANS") turned_ = turned_.shifted(in_frame(shift));
    if (!adds) absolute_shift_ = turned_.origin_mm;
    return set_frame(line_number());
}

// G58 replaces what TRANS has shifted, G59 what ATRANS has added, in the axes that it names.
void Interpreter::shift_axes(const Words& words) {
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.linear[static_cast<std::size_t>(k)];
        if (!word) continue;
        const double shift = word->value * unit_mm_;
        if (words.frame == "G58") {
            turned_.origin_mm[k] += shift - absolute_shift_[k];
            absolute_shift_[k] = shift;
        } else {
            turned_.origin_mm[k] = absolute_shift_[k] + shift;
        }
    }
}

// TOROT: the axes turn so that Z lies along the tool and X stays in the plane of the old X and Z; TOFRAME:
// and their zero is at the tip. TOROTOF, TOFRAMEOF: as before.
Result<void> Interpreter::frame_along_tool(const Words& words) {
    along_tool_ = {};
    if (words.tool_frame.ends_with("OF")) return set_frame(line_number());
    if (path_.machine && !path_.tip_control) {
        return path_.refuse(place(words.first_column), words.tool_frame + " without TRAORI is not read",
                            "write CYCLE800, or TRAORI before it");
    }
    if (auto done = set_frame(line_number()); !done) return done;
    const motion::WorkFrame before = path_.frame, outer = joined(outer_frame(), swivelled_);
    motion::WorkFrame total;
    total.z = path_.axis_in_stock();
    const Vec3 x = cross(before.y, total.z);
    // A tool along Y leaves X where it was.
    total.x = length(x) < kParallel ? before.x : (dot(x, before.x) < 0 ? -1 : 1) * normalized(x);
    total.y = cross(total.z, total.x);
    const auto turned = [&](Vec3 unit) {
        return outer.direction_from_stock(total.direction_in_stock(turned_.direction_from_stock(unit)));
    };
    along_tool_ = {{}, turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
    if (words.tool_frame.starts_with("TOFRAME")) {
        if (!path_.knows_tip()) {
            return path_.refuse(place(words.first_column), "TOFRAME where only the machine knows the place",
                                "write X, Y and Z with G0 before it");
        }
        const Vec3 tip = outer.from_stock(before.in_stock(path_.tip()));
        along_tool_.origin_mm = tip - along_tool_.direction_in_stock(turned_.origin_mm);
    }
    return set_frame(line_number());
}

// ROT X Y Z, and RPL in the plane.
Result<void> Interpreter::turn_frame(const Words& words) {
    Vec3 rad;
    for (int k = 0; k < 3; ++k) {
        const auto& word = words.linear[static_cast<std::size_t>(k)];
        if (word) rad[k] = word->value * math::kRadPerDeg;
    }
    if (words.plane_turn) {
        if (auto good = path_.in_range(kLimits.rotary_angle, *words.plane_turn, place(words.first_column));
            !good)
            return good;
        rad[axes()[2]] = *words.plane_turn * math::kRadPerDeg;
    }
    const auto turned = turned_within(turned_, scale_, rad, place(words.first_column));
    if (!turned) return std::unexpected(turned.error());
    turned_ = *turned;
    return {};
}

// CYCLE800(_FR, _TC, _ST, _MODE, _X0, _Y0, _Z0, _A, _B, _C, _X1, _Y1, _Z1, _DIR, _FR_I): a plane, with the
// tool normal to it.
Result<void> Interpreter::swivel(const Call& call) {
    const Place where{call.line, call.column};
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    const bool resets = call.given.size() < 4 && !call.has(3);
    if (path_.rolled()) return path_.refuse(where, "CYCLE800 on a cylinder", "write TRAFOOF before it");
    const bool adds = static_cast<long long>(call.at(2)) % 10 == 1;
    const int mode = static_cast<int>(std::clamp(call.at(3), 0.0, 255.0));
    Vec3 before, after, angle;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        before[k] = call.at(4 + i) * unit_mm_;
        angle[k] = call.at(7 + i);
        after[k] = call.at(10 + i) * unit_mm_;
        if (auto good = path_.in_range(kLimits.coordinate, before[k], where); !good) return good;
        if (auto good = path_.in_range(kLimits.coordinate, after[k], where); !good) return good;
        if (auto good = path_.in_range(kLimits.rotary_angle, angle[k], where); !good) return good;
        angle[k] *= math::kRadPerDeg;
    }
    motion::WorkFrame plane = adds ? joined(joined(swivelled_, along_tool_), turned_) : motion::WorkFrame{};
    if (resets) {
        plane = {};
    } else {
        plane = plane.shifted(before);
        if (mode / 64 == 0) {  // about one axis after the other; two bits name each
            for (int k = 0; k < 3; ++k) {
                const int axis = (mode >> (2 * k)) & 3;
                if (axis == 0 && angle[k] != 0) {
                    return path_.refuse(where, "the swivel mode of CYCLE800 names no axis for an angle",
                                        "write for example 57: about X, Y and Z");
                }
                if (axis != 0 && angle[k] != 0) plane = plane.turned(unit(axis - 1), angle[k]);
            }
        } else if (mode / 64 == 1) {  // solid angles: about Z, then Y
            plane = plane.turned(unit(2), angle.x).turned(unit(1), angle.y);
        } else {
            return path_.refuse(where,
                                mode / 64 == 3
                                    ? "CYCLE800 by the angles of the machine's own axes is not read"
                                    : "CYCLE800 by projected angles is not read",
                                "write the swivel mode 57 with angles about X, Y and Z");
        }
        plane = plane.shifted(after);
    }
    swivelled_ = plane;
    along_tool_ = turned_ = {};
    absolute_shift_ = {};
    scale_ = {1, 1, 1};
    pole_.reset();
    tangent_ = {};
    const bool retracts = !resets && call.at(0) >= 1;
    if (!path_.tilt(joined(outer_frame(), swivelled_), false, line_number())) {
        return path_.refuse(where,
                            "the machine " + path_.machine->machine().name + " cannot turn its tool there",
                            "name the machine that the program is written for");
    }
    if (retracts && path_.knows_tip()) {
        path_.put(path_.tip(), {path_.known(0), path_.known(1), Known::lost}, line_number());
    }
    return {};
}

}  // namespace tribo::readers::siemens
