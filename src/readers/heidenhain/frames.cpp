// SPDX-License-Identifier: MIT
// Datum shift, rotation, mirror and scale: CYCL DEF 7, 8, 10, 11 and 26, TRANS.
#include <algorithm>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr std::string_view kAxes = "XYZ";
constexpr Range kScale{1e-3, 1e3};

}  // namespace

// CYCL DEF 7.1 X+10 (datum shift, one axis per line), CYCL DEF 7.1 #2 (a row of the datum table) and
// CYCL DEF 10.1 ROT+30. Part 0 is the title.
Result<void> Interpreter::set_datum(LineReader& in, int part) {
    if (in.take('#')) {
        const int column = in.column();
        const auto row = in.number();
        if (!row) return std::unexpected(row.error());
        const int number = static_cast<int>(std::clamp(row->value_or(0), -1e6, 1e6));
        if (datum_row_ && *datum_row_ != number) {
            return in.refuse(column, "a second row of the datum table, which is not at hand",
                             "write the shift with X, Y and Z");
        }
        if (!datum_row_) {
            path_.warn(line_.number,
                       "row " + std::to_string(number) +
                           " of the datum table is not at hand: it is taken to be the stock's zero");
        }
        datum_row_ = number;
        return {};
    }
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    if (auto done = close_contour(); !done) return done;
    for (const Item& item : items) {
        const std::size_t axis = item.name.empty() ? 3 : kAxes.find(item.name.back());
        if (item.value && (item.name == "A" || item.name == "B" || item.name == "C") && *item.value == 0) {
            continue;
        }
        if (item.name == "ROT" && item.value) {
            rotation_deg_ = *item.value;
        } else if (item.name == "IROT" && item.value) {
            rotation_deg_ += *item.value;
        } else if (axis < 3 && item.value && item.name.size() == 1) {
            shift_mm_[static_cast<int>(axis)] = *item.value * unit_mm_;
        } else if (axis < 3 && item.value && item.name.size() == 2 && item.name[0] == 'I') {
            shift_mm_[static_cast<int>(axis)] += *item.value * unit_mm_;
        } else if (item.value || part > 0) {
            return in.refuse(item.column, "only X, Y, Z and ROT with a number are read here",
                             "write the shift with X, Y and Z");
        }
    }
    set_frame();
    return {};
}

// CYCL DEF 8.1 X Y: these axes are mirrored, the others no longer.
Result<void> Interpreter::mirror(LineReader& in) {
    std::vector<Item> items;
    const int column = in.column();
    if (auto done = all_items(in, items); !done) return done;
    if (auto done = close_contour(); !done) return done;
    Vec3 mirror{1, 1, 1};
    for (const Item& item : items) {
        const std::size_t axis = item.name.size() == 1 ? kAxes.find(item.name[0]) : std::string_view::npos;
        if (axis >= 2) {
            return in.refuse(column, "a mirror of " + item.name + " is not read", "mirror X or Y");
        }
        mirror[static_cast<int>(axis)] = -1;
    }
    mirror_ = mirror;
    set_frame();
    return {};
}

// CYCL DEF 11.1 SCL 0.5, and CYCL DEF 26.1 X 1.4 Y 0.6 CCX+15 CCY+20.
Result<void> Interpreter::set_scale(LineReader& in, int number) {
    std::vector<Item> items;
    const int column = in.column();
    if (auto done = all_items(in, items); !done) return done;
    if (auto done = close_contour(); !done) return done;
    Vec3 scale = number == 26 ? scale_ : Vec3{1, 1, 1}, centre = number == 26 ? scale_centre_mm_ : Vec3{};
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        if (!item.value) continue;
        const bool is_centre = item.name.size() == 3 && item.name.starts_with("CC");
        const std::size_t axis =
            item.name.size() == 1 || is_centre ? kAxes.find(item.name.back()) : std::string_view::npos;
        if (is_centre && axis < 3) {
            centre[static_cast<int>(axis)] = *item.value * unit_mm_;
            continue;
        }
        if (!kScale.contains(*item.value)) {
            return in.refuse(item.column, "the scale is out of range", "write a factor of 0.001 to 1000");
        }
        if (axis < 3 && number == 26) {
            scale[static_cast<int>(axis)] = *item.value;
        } else if ((item.name == "SCL" || item.name.empty()) && number == 11) {
            scale = {*item.value, *item.value, *item.value};
        } else {
            return in.refuse(column, "'" + item.name + "' does not belong into a scale", "write SCL 0.5");
        }
    }
    scale_ = scale;
    scale_centre_mm_ = centre;
    set_frame();
    return {};
}

// TRANS DATUM AXIS X+10 Y+5, TRANS MIRROR AXIS X, TRANS ROTATION ROT+30, TRANS SCALE SCL0.5; RESET ends each.
Result<void> Interpreter::transform(LineReader& in) {
    if (in.take("DATUM")) {
        if (in.take("RESET")) {
            if (auto done = close_contour(); !done) return done;
            shift_mm_ = {};
            set_frame();
            return {};
        }
        if (in.take("AXIS")) return set_datum(in, 1);
        return in.refuse(in.column(), "only TRANS DATUM AXIS is read", "write the axes' shifts");
    }
    if (in.take("MIRROR")) {
        if (!in.take("RESET")) in.take("AXIS");
        return mirror(in);
    }
    if (in.take("ROTATION")) {
        if (!in.take("RESET")) return set_datum(in, 1);
        if (auto done = close_contour(); !done) return done;
        rotation_deg_ = 0;
        set_frame();
        return {};
    }
    if (in.take("SCALE")) {
        in.take("RESET");
        return set_scale(in, 11);
    }
    return in.refuse(in.column(), "only TRANS DATUM, MIRROR, ROTATION and SCALE are read",
                     "write it with CYCL DEF 7");
}

// Sets the frame in force. The tool does not move.
// A rotation in a mirrored frame turns the other way: what it gives is mirrored.
motion::WorkFrame Interpreter::frame_in_plane() const {
    const double turn_deg = mirror_.x * mirror_.y < 0 ? -rotation_deg_ : rotation_deg_;
    return plane_.shifted(shift_mm_).turned({0, 0, 1}, turn_deg * math::kRadPerDeg);
}

void Interpreter::set_frame() {
    contour_.leave();
    path_.frame = frame_in_plane();
    pole_.reset();
}

}  // namespace tribo::readers::heidenhain
