// SPDX-License-Identifier: MIT
// CYCL DEF and CYCL CALL: the definitions. TNC 640 manual, Programming of Machining Cycles.
#include <algorithm>
#include <array>
#include <cmath>

#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr std::array kLengths{1,   3,   4,   5,   6,   7,   8,   10,  14,  200, 201, 202, 203,
                              204, 205, 212, 216, 217, 218, 219, 220, 221, 222, 223, 225, 226,
                              227, 228, 229, 230, 231, 232, 233, 234, 235, 236, 237, 238, 239,
                              244, 249, 250, 251, 252, 256, 257, 258, 259, 334, 335, 338, 342,
                              344, 356, 357, 358, 359, 368, 369, 375, 379, 386, 424, 425, 571};
constexpr std::array kFeeds{11, 12, 19, 206, 207, 208, 209, 253, 254, 385};

// The parameters without which a cycle has no path.
struct Needs {
    int cycle;
    std::array<int, 7> q;  // 0: none
};
constexpr std::array kCycles{
    Needs{200, {200, 201, 206, 203}},
    Needs{201, {200, 201, 206, 203}},
    Needs{202, {200, 201, 206, 203}},
    Needs{203, {200, 201, 206, 203}},
    Needs{204, {200, 249, 250, 251, 252, 254, 203}},
    Needs{205, {200, 201, 206, 202, 203}},
    Needs{206, {200, 201, 206, 203}},
    Needs{207, {200, 201, 239, 203}},
    Needs{208, {200, 201, 206, 203, 334, 335}},
    Needs{209, {200, 201, 239, 203}},
    Needs{220, {216, 217, 244, 245, 247, 241}},
    Needs{221, {225, 226, 237, 238, 242, 243}},
    Needs{240, {200, 206, 203}},
    Needs{241, {200, 201, 206, 203}},
    Needs{251, {200, 201, 206, 203, 218, 219}},
    Needs{252, {200, 201, 206, 203, 223}},
    Needs{253, {200, 201, 206, 203, 218, 219}},
    Needs{256, {200, 201, 206, 203, 218, 219}},
    Needs{257, {200, 201, 206, 203, 223}},
    Needs{254, {200, 201, 206, 203, 219, 375, 248}},
    Needs{258, {200, 201, 206, 203, 571, 572}},
    Needs{210, {200, 201, 207, 203, 218, 219}},
    Needs{211, {200, 201, 207, 203, 219, 244, 248}},
    Needs{212, {200, 201, 206, 203, 218, 219}},
    Needs{213, {200, 201, 206, 203, 218, 219}},
    Needs{214, {200, 201, 206, 203, 223}},
    Needs{215, {200, 201, 206, 203, 223}},
    Needs{230, {225, 226, 227, 218, 219, 240, 207}},
    Needs{231, {225, 228, 231, 234, 240, 207}},
    Needs{232, {225, 226, 227, 386, 218, 219, 207}},
    Needs{233, {227, 386, 218, 219, 207}},
    Needs{262, {335, 239, 201, 200, 203, 207}},
    Needs{263, {335, 239, 201, 356, 200, 203, 207}},
    Needs{264, {335, 239, 201, 356, 206, 203, 207}},
    Needs{265, {335, 239, 201, 200, 203, 207}},
    Needs{267, {335, 239, 201, 200, 203, 207}},
};

// Cycles without a path of their own: orientation, tolerance, load.
bool is_silent_cycle(int cycle) {
    return cycle == 13 || cycle == 32 || cycle == 239;
}

// Cycles of the machine's maker (TNC 640, Programming of Machining Cycles: "machine-specific cycles").
bool is_of_machine(int cycle) {
    return cycle >= 300 && cycle < 400;
}

constexpr int kEngraving = 225;  // a text in the letters of the control

// The block from its first Q200=... on: the name of a cycle may have any characters.
Line from_first_parameter(Line line, std::size_t at) {
    const std::string_view text = line.text;
    while (at < text.size() && !(to_upper(text[at]) == 'Q' && (at == 0 || is_blank(text[at - 1])) &&
                                 at + 1 < text.size() && is_digit(text[at + 1]))) {
        ++at;
    }
    line.text.remove_prefix(std::min(at, text.size()));
    line.column += static_cast<int>(at);
    return line;
}

// True for a line of a cycle that some posts, and the listings of manuals, write without '~' on the line
// before: Q206=150 alone, without a block number.
bool is_parameter_line(std::string_view text) {
    text = trimmed(text);
    std::size_t digits = 1;
    while (digits < text.size() && is_digit(text[digits])) ++digits;
    while (digits < text.size() && is_blank(text[digits])) ++digits;
    return text.size() > 4 && to_upper(text[0]) == 'Q' && (text[1] == '2' || text[1] == '3') &&
           is_digit(text[2]) && is_digit(text[3]) && digits < text.size() && text[digits] == '=';
}

template <std::size_t n>
bool contains(const std::array<int, n>& list, int q) {
    return std::find(list.begin(), list.end(), q) != list.end();
}

}  // namespace

Result<void> Interpreter::define_cycle(LineReader& in) {
    const int column = in.column();
    const auto value = in.number();
    if (!value) return std::unexpected(value.error());
    if (!*value || **value < 0 || **value > 9999) {
        return in.refuse(column, "CYCL DEF without a cycle's number", "write for example CYCL DEF 200");
    }
    // 7.1 is the first line of values of cycle 7; 7.0 names it.
    const int number = static_cast<int>(**value + 1e-6);
    const int part = static_cast<int>(std::lround((**value - number) * 10));
    if (number == 12 && part == 1) {
        cycle_ = {};
        cycle_.number = number;
        cycle_.place = place(column);
        called_program_ =
            std::string(line_.text.substr(static_cast<std::size_t>(in.column() - line_.column)));
        return {};
    }
    if (number >= 200 && number < 300 && number != 247) {
        const bool known = std::any_of(kCycles.begin(), kCycles.end(),
                                       [&](const Needs& needs) { return needs.cycle == number; });
        if (known) return define_q_cycle(in, number);
    }
    switch (number) {
        case 1:
        case 2:
        case 3:
        case 4:
        case 5:
        case 17:
            return define_old_cycle(in, number, part);
        case 7:
        case 10:
            return set_datum(in, part);
        case 8:
            return part == 0 ? Result<void>{} : mirror(in);
        case 11:
        case 26:
            return part == 0 ? Result<void>{} : set_scale(in, number);
        case 19:
            return part == 0 ? Result<void>{} : working_plane(in);
        case 9: {  // 9.0 names the cycle, 9.1 has the time
            if (part == 0) return {};
            const auto seconds = in.last_number();
            if (!seconds) return std::unexpected(seconds.error());
            if (!*seconds) {
                return in.refuse(column, "a dwell without its time", "write CYCL DEF 9.1 DWELL 2");
            }
            if (auto good = in.in_range(kLimits.dwell, **seconds, column); !good) return good;
            if (auto done = close_contour(); !done) return done;
            return path_.dwell(**seconds, place(column));
        }
        case 12:
            return {};
        case 14:
            return part == 0 ? Result<void>{} : choose_contours(in);
        case 20:
        case 22:
        case 23:
        case 24:
        case 25:
            return define_contour_cycle(in, number);
        case 247: {
            Cycle unused;
            if (auto done = take_preset("CYCL DEF 247"); !done) return done;
            return read_parameters(in, unused);
        }
        default:
            if (is_silent_cycle(number)) return skip_continuation();
            if (is_of_machine(number)) return leave_out_cycle(number);
            if (number == kEngraving) {
                cycle_ = {};
                cycle_.number = number;
                cycle_at_every_position_ = false;
                return skip_continuation();
            }
            return in.refuse(column, "cycle " + std::to_string(number) + " is not read yet",
                             "let the CAM system write its path as L and C blocks");
    }
}

Result<void> Interpreter::take_preset(const std::string& block) {
    if (path_.first(kDatum)) {
        path_.warn(line_.number, block + ": the preset is taken to be the stock's zero");
    }
    return {};
}

// Reads Q200=2 ... on this line and on the lines joined by '~'.
Result<void> Interpreter::read_parameters(LineReader& in, Cycle& cycle) {
    std::vector<Item> items;
    const Line rest = from_first_parameter(line_, static_cast<std::size_t>(in.column() - line_.column));
    const bool goes_on = line_.goes_on;
    LineReader parameters(rest, source_name_, parameters_);
    if (auto done = all_items(parameters, items); !done) return done;
    const bool is_list = goes_on || items.empty();
    while (is_list && at_ + 1 < lines_.size() && is_parameter_line(lines_[at_ + 1])) {
        ++at_;
        if (auto taken = take_line(); !taken) return taken;
        LineReader next(line_, source_name_, parameters_);
        if (auto done = all_items(next, items); !done) return done;
    }
    for (const Item& item : items) {
        const int q = item.parameter;
        if (q < 0) continue;
        if (item.word == "FMAX" || item.word == "MAX") {
            cycle.q[q] = kRapid;
        } else if (item.word == "FAUTO" || item.word == "AUTO") {
            cycle.q[q] = tool_feed_;
        } else if (item.word == "PREDEF") {
            const auto known = general_.find(q);
            if (known == general_.end()) {
                return path_.refuse({item.line, item.column},
                                    "Q" + std::to_string(q) + " is PREDEF, but no GLOBAL DEF gives it",
                                    "write its value");
            }
            cycle.q[q] = known->second;
        } else {
            cycle.q[q] = *item.value * unit_of_parameter(q);
            parameters_.set(q, *item.value);
        }
    }
    return {};
}

double Interpreter::unit_of_parameter(int q) const {
    return contains(kLengths, q) ? unit_mm_ : contains(kFeeds, q) ? feed_unit_mm() : 1;
}

// A cycle reads its parameters where it is called: Q201=-18 behind CYCL DEF changes the depth.
void Interpreter::change_cycle(int parameter, double value) {
    const auto known = cycle_.q.find(parameter);
    if (cycle_.number < 200 || known == cycle_.q.end()) return;
    known->second = value * unit_of_parameter(parameter);
}

Result<void> Interpreter::define_q_cycle(LineReader& in, int number) {
    Cycle cycle;
    cycle.number = number;
    cycle.place = place(line_.column);
    if (auto done = read_parameters(in, cycle); !done) return done;
    const auto needs = std::find_if(kCycles.begin(), kCycles.end(),
                                    [&](const Needs& known) { return known.cycle == number; });
    for (const int q : needs->q) {
        if (q == 0 || cycle.q.contains(q)) continue;
        return path_.refuse(cycle.place, "cycle " + std::to_string(number) + " lacks Q" + std::to_string(q),
                            "write all parameters of the cycle");
    }
    if (number == 220 || number == 221) return run_point_pattern(cycle);
    if (auto good = check_cycle(cycle); !good) return good;
    cycle_ = cycle;
    cycle_at_every_position_ = false;
    return {};
}

Result<void> Interpreter::check_cycle(const Cycle& cycle) const {
    if (is_thread(cycle.number) || is_face(cycle.number)) return {};  // checked where they run
    if (cycle.number == 204) return check_back_boring(cycle);
    const bool by_diameter = cycle.number == 240 && cycle.at(343) != 0;
    if (by_diameter ? cycle.at(344) == 0 : !(cycle.at(201) < 0)) {
        return path_.refuse(cycle.place,
                            by_diameter ? "the diameter Q344 is zero" : "the depth Q201 is not below zero",
                            by_diameter ? "write the diameter" : "write the depth with a minus sign");
    }
    const bool has_feed =
        cycle.number != 207 && cycle.number != 209 && cycle.number != 210 && cycle.number != 211;
    if (cycle.at(200) < 0 || cycle.at(202) < 0 || (has_feed && !(cycle.at(206) > 0))) {
        return path_.refuse(cycle.place, "Q200, Q202 or Q206 is out of range",
                            "give clearance and infeed without a sign and a feed above 0");
    }
    if (has_feed && cycle.at(206) != kRapid) {
        if (auto good = path_.in_range(kLimits.feed, cycle.at(206), cycle.place); !good) return good;
    }
    if (cycle.number == 208 && (!(cycle.at(334) > 0) || !(cycle.at(335) > 0))) {
        return path_.refuse(cycle.place, "Q334 or Q335 is out of range",
                            "give the infeed per turn and the diameter without a sign");
    }
    return {};
}

// Whether the cycle moves the tool, and when, only its machine knows.
Result<void> Interpreter::leave_out_cycle(int number) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    path_.lose(line_.number);
    cycle_ = {};
    cycle_.number = number;
    if (passed_over_.insert("CYCL DEF " + std::to_string(number)).second) {
        path_.warn(line_.number, "cycle " + std::to_string(number) +
                                     (number == kEngraving ? " engraves letters of the control's own"
                                                           : " is one of the machine's maker") +
                                     ": its moves are left out, and the tool's place is unknown after it");
    }
    return skip_continuation();
}

// CYCL DEF 1.2 DEPTH-10: one value on each line.
Result<void> Interpreter::define_old_cycle(LineReader& in, int number, int part) {
    const int column = in.column();
    if (part == 0) {
        cycle_ = {};
        cycle_.number = number;
        cycle_.place = place(line_.column);
        cycle_at_every_position_ = false;
        return {};
    }
    if (cycle_.number == number && is_pocket(number)) return define_old_pocket(in, part);
    const auto value = in.last_number();
    if (!value) return std::unexpected(value.error());
    if (cycle_.number != number || !*value) {
        return in.refuse(column, "this line of cycle " + std::to_string(number) + " has no place or no value",
                         "write its lines one after the other, from .0");
    }
    const int dwell = number == 1 ? 4 : 3;
    const bool is_dwell = part == dwell && number != 17, is_feed = part == dwell + 1 && number != 17;
    cycle_.q[part] = **value * (is_dwell ? 1 : is_feed ? feed_unit_mm() : unit_mm_);
    return {};
}

// CYCL CALL M3, CYCL CALL POS X+5 Y+5 and CYCL CALL PAT FMAX.
Result<void> Interpreter::call_cycle(LineReader& in) {
    const Place where = place(in.column());
    if (in.take("POS")) {
        if (auto done = line(in, false); !done) return done;
        return run_cycle(where);
    }
    const bool at_pattern = in.take("PAT");
    const auto words = read_words(in, "M");
    if (!words) return std::unexpected(words.error());
    if (auto done = miscellaneous(*words); !done) return done;
    if (!at_pattern) return run_cycle(where);
    if (pattern_.empty()) {
        return path_.refuse(where, "CYCL CALL PAT without a pattern", "write PATTERN DEF before it");
    }
    return run_at(pattern_, where);
}

// A cycle with heights of its own is often called where X and Y are stated and Z is not: behind M140 MB MAX
// or M91. The tool then comes from its second clearance.
void Interpreter::come_from_above() {
    const bool stands_over = path_.known(0) == Known::yes && path_.known(1) == Known::yes;
    if (!stands_over || path_.known(2) == Known::yes) return;
    const bool is_contour = is_contour_cycle(cycle_.number);
    if (!is_contour && (cycle_.number < 200 || is_face(cycle_.number))) return;
    Vec3 above = path_.tip();
    above.z = is_contour ? contour_depths().back : cycle_.at(203) + std::max(cycle_.at(200), cycle_.at(204));
    path_.put(above, {Known::yes, Known::yes, Known::yes}, line_.number);
}

Result<void> Interpreter::run_cycle(Place where) {
    if (cycle_.number == 0) {
        if (follows_refusal()) return {};
        return path_.refuse(where, "a cycle is called, but none is defined", "write CYCL DEF before it");
    }
    if (captured_) return path_.refuse(where, "a cycle is called within a contour", "call it behind LBL 0");
    if (cycle_.number == 12) return call_program(called_program_);
    if (is_of_machine(cycle_.number) || cycle_.number == kEngraving) return leave_out_cycle(cycle_.number);
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    come_from_above();
    if (is_lost()) {
        leave_out();
        return {};
    }
    assume_start();
    if (scale_.z != 1) {
        return path_.refuse(where, "a cycle in a frame with a scale", "end the scale before it");
    }
    if (is_pocket(cycle_.number)) return mill_pocket_cycle();
    if (is_thread(cycle_.number)) return mill_thread();
    if (is_face(cycle_.number)) return mill_face();
    if (is_contour_cycle(cycle_.number)) return mill_contour_cycle();
    switch (cycle_.number) {
        case 1:
        case 2:
        case 17:
            return drill_as_of_old();
        case 200:
        case 203:
            return drill();
        case 205:
            return peck_deep();
        case 206:
        case 207:
        case 209:
            return tap();
        case 208:
            return mill_bore();
        case 204:
            return bore_back();
        default:
            return bore();
    }
}

}  // namespace tribo::readers::heidenhain
