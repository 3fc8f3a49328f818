// SPDX-License-Identifier: MIT
// Tilted planes and tool tip control: PLANE, CYCL DEF 19, FUNCTION.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr int kAnglesParameter = 120;

// A frame turned about the fixed axes: x, then y, then z; degrees.
motion::WorkFrame spatial_frame(double a, double b, double c) {
    return motion::WorkFrame{}
        .turned({0, 0, 1}, c * math::kRadPerDeg)
        .turned({0, 1, 0}, b * math::kRadPerDeg)
        .turned({1, 0, 0}, a * math::kRadPerDeg);
}

// The frame whose x runs along `x` as far as that lies in the plane, normal to `z`; none if they span none.
std::optional<motion::WorkFrame> frame_along(Vec3 x, Vec3 z) {
    if (!(length(z) > 1e-6)) return std::nullopt;
    motion::WorkFrame frame;
    frame.z = normalized(z);
    const Vec3 along = x - dot(x, frame.z) * frame.z;
    if (!(length(along) > 1e-6)) return std::nullopt;
    frame.x = normalized(along);
    frame.y = cross(frame.z, frame.x);
    return frame;
}

// The value of a word of a block; 0 where it is missing.
double value_of(const std::vector<Item>& items, std::string_view name) {
    for (const Item& item : items) {
        if (item.name == name) return item.value.value_or(0);
    }
    return 0;
}

// P1X+0 P1Y+0 ..: a word P, its number, a word X.
std::array<Vec3, 3> three_points(const std::vector<Item>& items) {
    std::array<Vec3, 3> points;
    for (std::size_t i = 0; i + 1 < items.size(); ++i) {
        if (items[i].name != "P" || !items[i].value) continue;
        const double number = *items[i].value;
        const std::size_t axis =
            items[i + 1].name.size() == 1 ? std::string_view("XYZ").find(items[i + 1].name[0]) : 3;
        if (number < 1 || number > 3 || axis > 2) continue;
        points[static_cast<std::size_t>(number) - 1][static_cast<int>(axis)] = items[i + 1].value.value_or(0);
    }
    return points;
}

}  // namespace

// PLANE SPATIAL, EULER, VECTOR, RELATIV, PROJECTED, POINTS and AXIAL: the plane of the following blocks, with
// the tool normal to it.
Result<void> Interpreter::plane(LineReader& in) {
    const int column = in.column();
    enum { spatial, euler, vector, relative, projected, points, axial, reset } kind;
    if (in.take("SPATIAL")) {
        kind = spatial;
    } else if (in.take("EULER")) {
        kind = euler;
    } else if (in.take("VECTOR")) {
        kind = vector;
    } else if (in.take("RELATIV") || in.take("RELATIVE")) {
        kind = relative;
    } else if (in.take("PROJECTED")) {
        kind = projected;
    } else if (in.take("POINTS")) {
        kind = points;
    } else if (in.take("AXIAL") || in.take("AXIALE")) {
        kind = axial;
    } else if (in.take("RESET")) {
        kind = reset;
    } else {
        return in.refuse(column, "this way to give a plane is not read",
                         "write PLANE SPATIAL, EULER, PROJECTED, VECTOR, POINTS, RELATIV or AXIAL");
    }
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    const auto has = [&](std::string_view name) {
        return std::any_of(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
    };
    if (kind == axial) return tilt_by_axes(items, has("MOVE"), column);
    const auto value = [&](std::string_view name) { return value_of(items, name); };
    const auto rad = [&](std::string_view name) { return value(name) * math::kRadPerDeg; };
    motion::WorkFrame turned;
    if (kind == spatial) {
        turned = spatial_frame(value("SPA"), value("SPB"), value("SPC"));
    } else if (kind == relative) {  // about an axis of the plane in force
        turned =
            plane_.turned({1, 0, 0}, rad("SPA")).turned({0, 1, 0}, rad("SPB")).turned({0, 0, 1}, rad("SPC"));
    } else if (kind == euler) {
        turned = turned.turned({0, 0, 1}, rad("EULPR"))
                     .turned({1, 0, 0}, rad("EULNU"))
                     .turned({0, 0, 1}, rad("EULROT"));
    } else if (kind != reset) {
        Vec3 x{value("BX"), value("BY"), value("BZ")}, z{value("NX"), value("NY"), value("NZ")};
        if (kind == projected) {
            x = turned.turned({0, 1, 0}, rad("PROPR")).x;
            z = cross(x, turned.turned({1, 0, 0}, rad("PROMIN")).y);
            note_projection();
        } else if (kind == points) {
            const auto [first, second, third] = three_points(items);
            x = second - first;
            z = cross(x, third - first);
        }
        const auto found = frame_along(x, z);
        if (!found) {
            return in.refuse(column, "these words do not span a plane",
                             "correct the vectors, points or angles of PLANE");
        }
        turned = kind == projected ? found->turned({0, 0, 1}, rad("ROT") + rad("PROROT")) : *found;
    }
    return tilt(turned, kind == reset, has("MOVE"), column);
}

void Interpreter::note_projection() {
    if (!path_.first(kProjection)) return;
    path_.warn(line_.number,
               "PLANE PROJECTED: X turned about Y by PROPR and Y turned about X by PROMIN are taken as the "
               "directions of the plane");
}

// PLANE AXIAL B+45: the rotary axes stand there; the plane is normal to the tool, and its x and y are those
// of the machine.
Result<void> Interpreter::tilt_by_axes(const std::vector<Item>& items, bool keeps_tip, int column) {
    Vec3 to_rad = path_.rotary_rad();
    bool turns = false;
    for (const Item& item : items) {
        const bool adds = item.name.size() == 2 && item.name[0] == 'I';
        const std::size_t k = item.name.size() == 1 || adds ? std::string_view("ABC").find(item.name.back())
                                                            : std::string_view::npos;
        if (k > 2 || !item.value) continue;
        if (auto good = path_.in_range(kLimits.rotary_angle, *item.value, place(item.column)); !good)
            return good;
        if (path_.machine && !path_.machine->has_axis(item.name.back())) {
            if (*item.value == 0) continue;
            return path_.refuse(
                place(item.column),
                "the machine " + path_.machine->machine().name + " has no axis " + item.name.back(),
                "name the machine that the program is written for");
        }
        turns = turns || *item.value != 0;
        const int axis = static_cast<int>(k);
        to_rad[axis] = *item.value * math::kRadPerDeg + (adds ? to_rad[axis] : 0);
    }
    if (!path_.machine) {
        if (!turns) return tilt({}, false, keeps_tip, column);
        return path_.refuse(place(column), "PLANE AXIAL turns the axes of a machine, and none is named",
                            "name the machine (--machine), or write PLANE SPATIAL");
    }
    const motion::Kinematics& kinematics = path_.machine->kinematics();
    motion::WorkFrame turned;
    turned.x = kinematics.direction({1, 0, 0}, to_rad);
    turned.y = kinematics.direction({0, 1, 0}, to_rad);
    turned.z = kinematics.direction({0, 0, 1}, to_rad);
    return tilt(turned, false, keeps_tip, column, to_rad);
}

// Makes the plane that of the following blocks. Its frame has no place yet.
Result<void> Interpreter::tilt(motion::WorkFrame turned, bool resets, bool keeps_tip, int column,
                               const std::optional<Vec3>& to_rad) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    if (!plane_.is_tilted()) untilted_shift_mm_ = shift_mm_;
    turned.origin_mm = resets ? Vec3{} : path_.frame.origin_mm;
    plane_ = turned;
    shift_mm_ = resets ? untilted_shift_mm_ : Vec3{};
    const motion::WorkFrame frame = frame_in_plane();
    pole_.reset();
    if (!path_.tilt(frame, keeps_tip, line_.number, to_rad)) {
        return path_.refuse(place(column),
                            "the machine " + path_.machine->machine().name + " cannot turn its tool there",
                            "name the machine that the program is written for");
    }
    // The control sets Q120 to Q122 to the angles of the axes, for a block that turns them.
    for (int k = 0; k < 3; ++k) {
        if (path_.machine) {
            parameters_.set(kAnglesParameter + k, path_.rotary_rad()[k] * math::kDegPerRad);
        } else {
            parameters_.set(kAnglesParameter + k, 0);
        }
    }
    return {};
}

// CYCL DEF 19.1 A+0 B+45 C+0: like PLANE SPATIAL STAY; 19.1 without angles resets.
Result<void> Interpreter::working_plane(LineReader& in) {
    const int column = in.column();
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    double angle_deg[3]{};
    bool turns = false;
    for (const Item& item : items) {
        const std::size_t axis = item.name.size() == 1 ? std::string_view("ABC").find(item.name[0]) : 3;
        if (axis < 3 && item.value) {
            if (auto good = in.in_range(kLimits.rotary_angle, *item.value, item.column); !good) return good;
            angle_deg[axis] = *item.value;
            turns = turns || *item.value != 0;
        } else if (axis >= 3 && item.name != "F" && item.name != "FMAX" && item.name != "ABST" &&
                   item.name != "SETUP" && item.name != "DIST" && item.name != "SET" && item.name != "UP") {
            return in.refuse(item.column, "only A, B and C are read here", "write for example A+0 B+45 C+0");
        }
    }
    return tilt(spatial_frame(angle_deg[0], angle_deg[1], angle_deg[2]), !turns, false, column);
}

// FUNCTION TCPM ..., FUNCTION RESET TCPM, and functions without effect on the path.
Result<void> Interpreter::machine_function(LineReader& in) {
    const int column = in.column();
    const bool off = in.take("RESET");
    if (in.take("TCPM")) {
        if (auto done = close_contour(); !done) return done;
        contour_.leave();
        if (!off && !path_.machine) path_.note_machine_needed(line_.number, "tool tip control (TCPM)");
        path_.switch_tip_control(!off, line_.number);
        return skip_continuation();
    }
    if (off) return pass_over("FUNCTION RESET");
    if (in.take("MODE")) {
        if (in.take("MILL")) return {};
        if (in.take("SET")) return pass_over("FUNCTION MODE SET");
        return in.refuse(column, "only FUNCTION MODE MILL is read", "turning and grinding are not read");
    }
    if (in.take("FEED")) return skip_continuation();
    if (in.take("DWELL")) {
        std::vector<Item> items;
        if (auto done = all_items(in, items); !done) return done;
        if (auto done = close_contour(); !done) return done;
        for (const Item& item : items) {
            if (item.name.starts_with("TIME") && item.value) return path_.dwell(*item.value, place(column));
            if (item.name == "REV" && item.value && path_.spindle_rpm > 0) {
                return path_.dwell(60 * *item.value / path_.spindle_rpm, place(column));
            }
        }
        return {};
    }
    for (const std::string_view word : {"PARAXCOMP", "PARAXMODE", "POLARKIN", "TURNDATA", "CORRDATA"}) {
        if (in.take(word)) {
            // Switched off, shown alone, or corrections of the tool, which is measured right.
            for (const std::string_view idle : {"OFF", "RESET", "DISPLAY", "TCS"}) {
                if (in.take(idle))
                    return pass_over("FUNCTION " + std::string(word) + " " + std::string(idle));
            }
            return in.refuse(column, "FUNCTION " + std::string(word) + " is not read",
                             "write the path without it");
        }
    }
    for (const std::string_view word :
         {"S", "COUNT", "DCM", "AFC", "LIFTOFF", "PROG", "FILE", "REPORT", "DRESS"}) {
        if (in.take(word)) return pass_over("FUNCTION " + std::string(word));
    }
    return in.refuse(column, "this FUNCTION is not read", "write FUNCTION TCPM or FUNCTION RESET TCPM");
}

}  // namespace tribo::readers::heidenhain
