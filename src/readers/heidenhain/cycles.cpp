// SPDX-License-Identifier: MIT
// CYCL DEF and CYCL CALL, datum shifts, tilted planes, tool tip control. The drilling cycles follow the TNC
// 640 manual (Programming of Machining Cycles), cycles 200 to 203.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "readers/heidenhain/interpreter.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr double kRapid = std::numeric_limits<double>::infinity();  // value of a feed for FMAX
constexpr double kFastFeed = 99'999;                                // value of a retraction feed for FMAX
constexpr double kChipBreakMm = 0.2;
constexpr int kMostInfeeds = 100'000;

struct Parameter {
    int q;
    enum { length, feed, other } kind;
};
constexpr std::array kDrillingParameters{
    Parameter{200, Parameter::length}, Parameter{201, Parameter::length}, Parameter{202, Parameter::length},
    Parameter{203, Parameter::length}, Parameter{204, Parameter::length}, Parameter{205, Parameter::length},
    Parameter{206, Parameter::feed},   Parameter{208, Parameter::feed},   Parameter{210, Parameter::other},
    Parameter{211, Parameter::other},  Parameter{212, Parameter::length}, Parameter{213, Parameter::other},
    Parameter{214, Parameter::other},  Parameter{256, Parameter::length}, Parameter{336, Parameter::other},
    Parameter{357, Parameter::length}, Parameter{395, Parameter::other},
};

// Old cycles without effect on the path.
bool is_silent(int cycle) {
    return cycle == 13 || cycle == 32 || cycle == 12;
}

}  // namespace

Result<void> Interpreter::define_cycle(LineReader& in) {
    const int column = in.column();
    const auto value = in.number();
    if (!value) return std::unexpected(value.error());
    if (!*value || **value < 0 || **value > 9999) {
        return in.refuse(column, "CYCL DEF without a cycle's number", "write for example CYCL DEF 200");
    }
    const int number = static_cast<int>(**value);
    if (number >= 200 && number <= 203) return define_drilling(in, number);
    if (number == 7 || number == 10) return set_datum(in);
    if (number == 9) {  // 9.0 names the cycle, 9.1 has the time
        std::vector<Item> items;
        if (**value - number < 0.05) return {};
        if (auto done = in.items(items); !done) return done;
        for (const Item& item : items) {
            if (!item.value) continue;
            if (auto good = in.in_range(kLimits.dwell, *item.value, item.column); !good) return good;
            return path_.dwell(*item.value, place(column));
        }
        return in.refuse(column, "a dwell without its time", "write CYCL DEF 9.1 DWELL 2");
    }
    if (number == 247) {
        DrillingCycle unused;
        if (path_.first(kDatum)) {
            path_.warn(line_.number, "CYCL DEF 247: the preset is taken to be the stock's zero");
        }
        return read_parameters(in, unused);
    }
    if (is_silent(number)) return {};
    return in.refuse(column, "cycle " + std::to_string(number) + " is not read yet",
                     "let the CAM system write its path as L and C blocks");
}

// Reads Q200=2 ... on this line and on the lines joined by '~'.
Result<void> Interpreter::read_parameters(LineReader& in, DrillingCycle& cycle) {
    if (auto done = read_parameters_of_line(in, cycle); !done) return done;
    for (;;) {
        const auto more = goes_on();
        if (!more) return std::unexpected(more.error());
        if (!*more) return {};
        LineReader next(line_, source_name_, parameters_);
        if (auto done = read_parameters_of_line(next, cycle); !done) return done;
    }
}

Result<void> Interpreter::read_parameters_of_line(LineReader& in, DrillingCycle& cycle) {
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    for (const Item& item : items) {
        const int q = item.parameter;
        if (q < 0) continue;
        const auto known = std::find_if(kDrillingParameters.begin(), kDrillingParameters.end(),
                                        [&](const Parameter& p) { return p.q == q; });
        if (item.word == "FMAX") {
            cycle.q[q] = kRapid;
        } else if (item.word == "FAUTO") {
            cycle.q[q] = tool_feed_;
        } else {
            const bool scaled = known != kDrillingParameters.end() && known->kind != Parameter::other;
            cycle.q[q] = *item.value * (scaled ? unit_mm_ : 1);
            parameters_.set(q, *item.value);
        }
    }
    return {};
}

Result<void> Interpreter::define_drilling(LineReader& in, int number) {
    DrillingCycle cycle;
    cycle.number = number;
    cycle.place = place(line_.column);
    if (auto done = read_parameters(in, cycle); !done) return done;
    for (const int q : {200, 201, 206, 203}) {
        if (cycle.q.contains(q)) continue;
        return path_.refuse(cycle.place, "cycle " + std::to_string(number) + " lacks Q" + std::to_string(q),
                            "write all parameters of the cycle");
    }
    if (!(cycle.at(201) < 0)) {
        return path_.refuse(cycle.place, "the depth Q201 is not below zero",
                            "write the depth with a minus sign");
    }
    if (cycle.at(200) < 0 || cycle.at(202) < 0 || !(cycle.at(206) > 0)) {
        return path_.refuse(cycle.place, "Q200, Q202 or Q206 is out of range",
                            "give clearance and infeed without a sign and a feed above 0");
    }
    if (cycle.at(206) != kRapid) {
        if (auto good = path_.in_range(kLimits.feed, cycle.at(206), cycle.place); !good) return good;
    }
    cycle_ = cycle;
    cycle_at_every_position_ = false;
    return {};
}

// CYCL DEF 7.1 X+10 (datum shift, one axis per line) and CYCL DEF 10.1 ROT+30.
Result<void> Interpreter::set_datum(LineReader& in) {
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    for (const Item& item : items) {
        const std::size_t axis = item.name.empty() ? 3 : std::string_view("XYZ").find(item.name.back());
        if (item.name == "ROT" && item.value) {
            rotation_deg_ = *item.value;
        } else if (item.name == "IROT" && item.value) {
            rotation_deg_ += *item.value;
        } else if (axis < 3 && item.value && item.name.size() == 1) {
            shift_mm_[static_cast<int>(axis)] = *item.value * unit_mm_;
        } else if (axis < 3 && item.value && item.name.size() == 2 && item.name[0] == 'I') {
            shift_mm_[static_cast<int>(axis)] += *item.value * unit_mm_;
        } else if (item.value) {
            return in.refuse(item.column, "only X, Y, Z and ROT are read here",
                             "write the shift with X, Y and Z");
        }
    }
    set_frame();
    return {};
}

// TRANS DATUM AXIS X+10 Y+5 and TRANS DATUM RESET.
Result<void> Interpreter::shift_datum(LineReader& in) {
    if (!in.take("DATUM"))
        return in.refuse(in.column(), "only TRANS DATUM is read", "write it with CYCL DEF 7");
    if (in.take("RESET")) {
        shift_mm_ = {};
        set_frame();
        return {};
    }
    if (!in.take("AXIS"))
        return in.refuse(in.column(), "only TRANS DATUM AXIS is read", "write the axes' shifts");
    return set_datum(in);
}

// Sets the frame in force. The tool does not move.
void Interpreter::set_frame() {
    path_.frame = plane_.shifted(shift_mm_).turned({0, 0, 1}, rotation_deg_ * math::kRadPerDeg);
    pole_.reset();
}

Result<void> Interpreter::go_to_height(double z, double feed_mm_per_min) {
    Vec3 to = path_.tip();
    to.z = z;
    const bool rapid = !(feed_mm_per_min < kFastFeed);
    const auto before = path_.feed_mm_per_min;
    if (!rapid) path_.feed_mm_per_min = feed_mm_per_min;
    auto done = go(rapid, to, {}, path_.rotary_rad());
    path_.feed_mm_per_min = before;
    return done;
}

Result<void> Interpreter::call_cycle(Place where) {
    if (cycle_.number == 0) {
        return path_.refuse(where, "a cycle is called, but none is defined", "write CYCL DEF before it");
    }
    if (auto done = require_start(); !done) return done;
    return cycle_.number == 200 || cycle_.number == 203 ? drill() : bore();
}

// 200 and 203: drills infeed by infeed; between infeeds returns to the set-up clearance, or by a short
// distance to break the chip.
Result<void> Interpreter::drill() {
    const double surface = cycle_.at(203), clearance = surface + cycle_.at(200);
    const double depth = -cycle_.at(201), second = std::max(clearance, surface + cycle_.at(204));
    const bool universal = cycle_.number == 203;
    const double plunge = cycle_.at(206);
    double retract = universal ? cycle_.at(208) : kRapid;
    if (universal && retract == 0) retract = plunge;
    double infeed = cycle_.at(202) > 0 ? cycle_.at(202) : depth;
    const double least = std::max(cycle_.at(205), 1e-3), chip = cycle_.at(256, kChipBreakMm);
    const int breaks = universal ? static_cast<int>(std::clamp(cycle_.at(213), 0.0, 1e6)) : 0;
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    double reached = 0;
    for (int i = 0, broken = 0; reached < depth; ++i) {
        if (i > kMostInfeeds)
            return path_.refuse(cycle_.place, "the cycle has too many infeeds", "correct Q202");
        reached = std::min(depth, reached + infeed);
        if (auto done = go_to_height(surface - reached, plunge); !done) return done;
        if (reached >= depth) break;
        if (broken < breaks) {
            ++broken;
            if (auto done = go_to_height(surface - reached + chip, retract); !done) return done;
        } else {
            broken = 0;
            if (auto done = go_to_height(clearance, retract); !done) return done;
            if (auto done = path_.dwell(std::max(cycle_.at(210), 0.0), cycle_.place); !done) {
                return done;
            }
            const double back = std::min(clearance, surface - reached + cycle_.at(200));
            if (auto done = go_to_height(back, kRapid); !done) return done;
        }
        if (universal) infeed = std::max(infeed - std::max(cycle_.at(212), 0.0), least);
    }
    if (auto done = path_.dwell(std::max(cycle_.at(211), 0.0), cycle_.place); !done) return done;
    if (auto done = go_to_height(clearance, retract); !done) return done;
    return second > clearance ? go_to_height(second, kRapid) : Result<void>{};
}

// 201 and 202: drill to the depth in one move, and return at their own feed.
Result<void> Interpreter::bore() {
    const double surface = cycle_.at(203), clearance = surface + cycle_.at(200);
    const double second = std::max(clearance, surface + cycle_.at(204)), plunge = cycle_.at(206);
    const double retract = cycle_.at(208) > 0 ? cycle_.at(208) : plunge;
    if (cycle_.number == 202 && cycle_.at(214) != 0 && path_.first(kDisengage)) {
        path_.warn(cycle_.place.line,
                   "cycle 202 steps off the wall before it retracts (Q214): that step is left out");
    }
    if (auto done = go_to_height(clearance, kRapid); !done) return done;
    if (auto done = go_to_height(surface + cycle_.at(201), plunge); !done) return done;
    if (auto done = path_.dwell(std::max(cycle_.at(211), 0.0), cycle_.place); !done) return done;
    if (auto done = go_to_height(clearance, retract); !done) return done;
    return second > clearance ? go_to_height(second, kRapid) : Result<void>{};
}

// PLANE SPATIAL, EULER and VECTOR: the plane of the following blocks, with the tool normal to it.
Result<void> Interpreter::plane(LineReader& in) {
    const int column = in.column();
    enum { spatial, euler, vector, reset } kind;
    if (in.take("SPATIAL")) {
        kind = spatial;
    } else if (in.take("EULER")) {
        kind = euler;
    } else if (in.take("VECTOR")) {
        kind = vector;
    } else if (in.take("RESET")) {
        kind = reset;
    } else {
        return in.refuse(column, "this way to give a plane is not read",
                         "write PLANE SPATIAL, EULER or VECTOR");
    }
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    const auto has = [&](std::string_view name) {
        return std::any_of(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
    };
    const auto value = [&](std::string_view name) {
        for (const Item& item : items) {
            if (item.name == name) return item.value.value_or(0);
        }
        return 0.0;
    };
    const auto rad = [&](std::string_view name) { return value(name) * math::kRadPerDeg; };
    motion::WorkFrame turned;
    if (kind == spatial) {  // about the fixed axes: x, then y, then z
        turned =
            turned.turned({0, 0, 1}, rad("SPC")).turned({0, 1, 0}, rad("SPB")).turned({1, 0, 0}, rad("SPA"));
    } else if (kind == euler) {
        turned = turned.turned({0, 0, 1}, rad("EULPR"))
                     .turned({1, 0, 0}, rad("EULNU"))
                     .turned({0, 0, 1}, rad("EULROT"));
    } else if (kind == vector) {
        const Vec3 base{value("BX"), value("BY"), value("BZ")}, normal{value("NX"), value("NY"), value("NZ")};
        turned.z = normalized(normal);
        const Vec3 x = base - dot(base, turned.z) * turned.z;
        if (!(length(normal) > 1e-6) || !(length(x) > 1e-6)) {
            return in.refuse(column, "the vectors of the plane do not span it", "correct BX BY BZ, NX NY NZ");
        }
        turned.x = normalized(x);
        turned.y = cross(turned.z, turned.x);
    }
    if (!plane_.is_tilted()) untilted_shift_mm_ = shift_mm_;
    turned.origin_mm = kind == reset ? Vec3{} : path_.frame.origin_mm;
    plane_ = turned;
    shift_mm_ = kind == reset ? untilted_shift_mm_ : Vec3{};
    const motion::WorkFrame frame =
        plane_.shifted(shift_mm_).turned({0, 0, 1}, rotation_deg_ * math::kRadPerDeg);
    pole_.reset();
    if (path_.tilt(frame, has("MOVE"), line_.number)) return {};
    return in.refuse(column, "the machine " + path_.machine->machine().name + " cannot turn its tool there",
                     "name the machine that the program is written for");
}

// FUNCTION TCPM ... and FUNCTION RESET TCPM.
Result<void> Interpreter::tip_control(LineReader& in) {
    const int column = in.column();
    const bool off = in.take("RESET");
    if (in.take("TCPM")) {
        if (!off && !path_.machine) path_.note_machine_needed(line_.number, "tool tip control (TCPM)");
        path_.switch_tip_control(!off, line_.number);
        return {};
    }
    if (!off && in.take("MODE") && in.take("MILL")) return {};
    if (!off && in.take("FEED")) return {};
    return in.refuse(column, "this FUNCTION is not read", "write FUNCTION TCPM or FUNCTION RESET TCPM");
}

}  // namespace tribo::readers::heidenhain
