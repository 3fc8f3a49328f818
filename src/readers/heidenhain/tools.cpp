// SPDX-License-Identifier: MIT
// BLK FORM, TOOL DEF and TOOL CALL.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kSame = 1e-9;

}  // namespace

// BLK FORM 0.1 Z X Y Z and BLK FORM 0.2 X Y Z: two corners.
Result<void> Interpreter::blank_form(LineReader& in) {
    if (!in.take("FORM")) return in.refuse(in.column(), "BLK without FORM", "write BLK FORM 0.1");
    if (in.take("CYLINDER") || in.take("ROTATION") || in.take("FILE")) {
        if (path_.first(kCylinder)) {
            path_.warn(line_.number, "this BLK FORM is no box: the stock is taken from the job");
        }
        return skip_continuation();
    }
    const int column = in.column();
    const auto which = in.number();
    if (!which) return std::unexpected(which.error());
    const bool first = *which && std::abs(**which - 0.1) < kSame;
    if (!first && !(*which && std::abs(**which - 0.2) < kSame)) {
        return in.refuse(column, "BLK FORM without 0.1 or 0.2",
                         "write the lower corner as 0.1, the upper as 0.2");
    }
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    std::optional<double> corner[3];
    for (const Item& item : items) {
        const std::size_t axis = std::string_view("XYZ").find(item.name);
        const std::size_t increment = item.name.size() == 2 && item.name[0] == 'I'
                                          ? std::string_view("XYZ").find(item.name[1])
                                          : std::string::npos;
        if (item.name.size() == 1 && axis < 3 && !item.value) continue;  // the tool axis
        if (item.value && item.name.size() == 1 && axis < 3) {
            corner[axis] = *item.value * unit_mm_;
        } else if (item.value && increment < 3 && blank_min_) {
            corner[increment] = (*blank_min_)[static_cast<int>(increment)] + *item.value * unit_mm_;
        } else {
            return in.refuse(item.column, item.name + " does not belong into BLK FORM", "write X, Y and Z");
        }
    }
    if (!corner[0] || !corner[1] || !corner[2]) {
        return in.refuse(column, "BLK FORM without all of X, Y and Z",
                         "write the corner's three coordinates");
    }
    const Vec3 point{*corner[0], *corner[1], *corner[2]};
    if (first) {
        blank_min_ = point;
        return {};
    }
    if (!blank_min_) return in.refuse(column, "BLK FORM 0.2 without 0.1", "write the lower corner before it");
    Box3 box;
    box.include(*blank_min_);
    box.include(point);
    if (!(box.volume() > 0)) {
        path_.warn(line_.number, "BLK FORM has no volume: the stock is taken from the job");
        return {};
    }
    path_.program.stock = motion::DeclaredStock{box, line_.number};
    return {};
}

// TOOL DEF 1 L+0 R+5
Result<void> Interpreter::define_tool(LineReader& in) {
    if (!in.take("DEF")) return in.refuse(in.column(), "TOOL without CALL or DEF", "write TOOL CALL");
    std::vector<Item> items;
    if (auto done = all_items(in, items); !done) return done;
    motion::DeclaredTool tool;
    std::optional<double> radius_mm;
    tool.line = line_.number;
    for (const Item& item : items) {
        if (item.name.empty() && item.value) {
            tool.number = static_cast<int>(std::clamp(*item.value, 0.0, kLimits.tool_number.range.max));
        } else if (item.name.starts_with('"')) {
            tool.number = number_of_tool(item.name.substr(1));
        } else if (item.name == "R" && item.value) {
            radius_mm = *item.value * unit_mm_;
            tool.diameter_mm = 2 * *item.value * unit_mm_;
            if (tool.diameter_mm != 0) {
                if (auto good = in.in_range(kLimits.cutter_diameter, tool.diameter_mm, item.column); !good)
                    return good;
            }
        } else if (item.name == "L" && item.value) {
            const double length = *item.value * unit_mm_;
            if (auto good = in.in_range(kLimits.tool_length, length, item.column); !good) return good;
            if (length > 0) tool.length_mm = length;
        } else {
            return in.refuse(item.column, item.name + " does not belong into TOOL DEF", "write L and R");
        }
    }
    if (radius_mm) path_.define_radius(tool.number, *radius_mm);
    if (tool.number > 0 && tool.diameter_mm > 0) path_.declare(tool);
    return {};
}

// Finds the numbers that tools have in the text, so that named tools get others.
void Interpreter::number_tools() {
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line line = line_at(i);
        if (line.text.size() < 9 || to_upper(line.text[0]) != 'T') continue;
        LineReader in(line, source_name_, parameters_);
        if (!in.take("TOOL") || (!in.take("CALL") && !in.take("DEF"))) continue;
        const auto number = in.number();
        if (number && *number && **number >= 1 && **number < 1e9) {
            numbered_tools_.insert(static_cast<int>(**number));
        }
    }
}

// Returns the number that stands for a tool's name.
int Interpreter::number_of_tool(const std::string& name) {
    const auto known = named_tools_.find(name);
    if (known != named_tools_.end()) return known->second;
    // That of the text with its name, else one that nothing has.
    const auto stated = path_.notes.number_of(name);
    int number = stated.value_or(1);
    while (!stated && (numbered_tools_.contains(number) || path_.notes.has(number))) ++number;
    numbered_tools_.insert(number);
    named_tools_[name] = number;
    path_.notes.name(number, name, line_.number);
    path_.warn(line_.number, "the tool \"" + name + "\" counts as tool " + std::to_string(number) +
                                 ": give it this number in the job");
    return number;
}

// The comment of a line, a heading `* - TEXT`, or a line in parentheses may describe a tool.
void Interpreter::read_notes(std::string_view line) {
    const std::size_t from = line.find(';');
    if (from != std::string_view::npos) path_.notes.read(line.substr(from + 1), line_.number);
    if (line_.text.starts_with('*') || line_.text.starts_with('('))
        path_.notes.read(line_.text.substr(1), line_.number);
}

// Changes the tool. Q108 holds its radius from then on.
void Interpreter::put_tool(int number) {
    path_.change_tool(number);
    tool_oversize_mm_ = 0;
    if (const auto radius = path_.tool_radius_mm(unit_mm_)) {
        parameters_.set(kRadiusParameter, *radius / unit_mm_);
    } else {
        parameters_.forget(kRadiusParameter);
    }
}

// TOOL CALL 5 Z S2000 F500 DL+0 DR+0
Result<void> Interpreter::call_tool(LineReader& in) {
    std::vector<Item> items;
    if (auto done = close_contour(); !done) return done;
    const int first = in.column();
    const auto number = in.number();  // maybe in a Q parameter
    if (!number) return std::unexpected(number.error());
    if (*number && **number != 0) {
        if (auto good = in.in_range(kLimits.tool_number, **number, first); !good) return good;
    }
    if (*number) put_tool(static_cast<int>(**number));
    if (auto done = all_items(in, items); !done) return done;
    const Item* feed_per = nullptr;  // FU or FZ, which need the speed
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        if (i == 0 && !*number && item.name.starts_with('"')) {
            put_tool(number_of_tool(item.name.substr(1)));
        } else if ((item.name == "X" || item.name == "Y") && !item.value) {
            return in.refuse(item.column, "a tool along " + item.name + " is not read",
                             "write TOOL CALL ... Z");
        } else if (item.name == "S" && item.value) {
            if (*item.value != 0) {
                if (auto good = in.in_range(kLimits.spindle_speed, *item.value, item.column); !good)
                    return good;
            }
            path_.spindle_rpm = *item.value;
            path_.spindle_stands = *item.value == 0;
        } else if (item.name == "F" && item.value) {
            tool_feed_ = *item.value * feed_unit_mm();
            if (tool_feed_ != 0) {
                if (auto good = in.in_range(kLimits.feed, tool_feed_, item.column); !good) return good;
            }
            if (tool_feed_ > 0) path_.feed_mm_per_min = tool_feed_;
        } else if ((item.name == "FU" || item.name == "FZ") && item.value) {
            feed_per = &item;
        } else if (item.name == "DR" || item.name == "DL") {
            // DR2+0.1 is the corner's: a word, a number, and a number.
            const bool of_corner = item.name == "DR" && i + 1 < items.size() && items[i + 1].name.empty();
            const double delta = (of_corner ? items[++i].value : item.value).value_or(0);
            if (item.name == "DR" && !of_corner) tool_oversize_mm_ = delta * unit_mm_;
            if (delta != 0 && path_.first(kDeltas)) {
                path_.warn(line_.number,
                           "the deltas DL and DR of TOOL CALL are left out: coordinates name the "
                           "tip; only radius compensation counts DR");
            }
        } else if (item.name == "VC" && item.value) {
            const auto radius = path_.tool_radius_mm(unit_mm_);
            if (!radius || !(*radius > 0)) {
                path_.warn(line_.number, "VC without the tool's radius gives no speed: the one before stays");
                continue;
            }
            const double rpm = *item.value * 1000 / (math::kTwoPi * *radius);
            if (auto good = in.in_range(kLimits.spindle_speed, rpm, item.column); !good) return good;
            path_.spindle_rpm = rpm;
        } else if (item.name != "Z" && item.name != "U" && item.name != "V" && item.name != "W") {
            return in.refuse(item.column, "'" + item.name + "' does not belong into TOOL CALL",
                             "write Z, S and F");
        }
    }
    if (feed_per != nullptr) {
        const auto feed = feed_of(*feed_per);
        if (!feed) return std::unexpected(feed.error());
        path_.feed_mm_per_min = tool_feed_ = *feed;
    }
    return {};
}

}  // namespace tribo::readers::heidenhain
