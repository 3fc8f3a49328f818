// SPDX-License-Identifier: MIT
#include "readers/heidenhain/interpreter.hpp"

#include <cmath>
#include <utility>

#include "readers/heidenhain/reader.hpp"
#include "readers/text/length_unit.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace heidenhain {
namespace {

// Largest depth of subprograms; the control allows 19.
constexpr std::size_t kDeepestCalls = 100;
constexpr double kEqual = 1e-9;  // FN 9: numbers closer than this are equal
constexpr long kMostRepeats = 65534;

}  // namespace

Interpreter::Interpreter(std::string_view bytes, const GcodeOptions& options, MoveSink* sink)
    : source_name_(options.source_name),
      path_(options, sink),
      limit_(path_.options, bytes.size(), path_.moves) {
    path_.program.dialect = "Heidenhain";
    TextLines text(bytes);
    while (const auto line = text.next()) lines_.push_back(*line);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const Line line = line_of(lines_[i], static_cast<int>(i) + 1);
        if (line.text.size() < 4 || to_upper(line.text[0]) != 'L') continue;
        LineReader in(line, source_name_, parameters_);
        if (!in.take("LBL")) continue;
        if (const auto label = in.label(); label && *label != "0") labels_.try_emplace(*label, i + 1);
    }
}

Result<motion::Program> Interpreter::run() {
    for (; at_ < lines_.size() && !ended_; ++at_) {
        if (auto taken = take_line(); !taken) return std::unexpected(taken.error());
        if (line_.text.empty()) continue;
        LineReader in(line_, source_name_, parameters_);
        if (auto done = execute(in); !done) return std::unexpected(done.error());
    }
    return finish();
}

// Makes the line at at_ the running line, and counts it.
Result<void> Interpreter::take_line() {
    const std::string_view text = lines_[at_];
    const int number = static_cast<int>(at_) + 1;
    if (text.size() > kLongestBlock) {
        return path_.refuse({number, static_cast<int>(kLongestBlock) + 1}, too_long_block(text.size()),
                            "write it on several lines");
    }
    line_ = line_of(text, number);
    auto cause = limit_.count(text.size());
    if (!cause) return {};
    return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
}

// Moves to the line joined by '~'. Returns false if there is none.
Result<bool> Interpreter::goes_on() {
    if (!line_.goes_on || at_ + 1 >= lines_.size()) return false;
    ++at_;
    if (auto taken = take_line(); !taken) return std::unexpected(taken.error());
    return true;
}

Result<void> Interpreter::execute(LineReader& in) {
    const char first = line_.text[0];
    if (first == '*' || first == '%' || first == '?') return {};
    if (to_upper(first) == 'Q') return assign(in);
    if (in.take("BEGIN")) return begin(in);
    if (in.take("END")) {
        ended_ = true;
        return {};
    }
    if (!std::exchange(begun_, true) && path_.first(kNoUnit)) {
        path_.warn(line_.number,
                   "no BEGIN PGM with MM or INCH before the first block: millimetres are taken");
    }
    if (in.take("BLK")) return blank_form(in);
    if (in.take("TOOL")) return in.take("CALL") ? call_tool(in) : define_tool(in);
    if (in.take("LBL")) {
        const auto label = in.label();
        if (!label) return std::unexpected(label.error());
        return *label == "0" ? end_label() : Result<void>{};
    }
    if (in.take("CALL")) return call_label(in);
    if (in.take("CYCL")) {
        if (in.take("DEF")) return define_cycle(in);
        if (!in.take("CALL")) return in.refuse(in.column(), "CYCL without DEF or CALL", "write CYCL CALL");
        const int column = in.column();
        if (in.take("POS")) {
            if (auto done = line(in, false); !done) return done;
        } else if (!in.at_end() && !in.take("M")) {
            return in.refuse(column, "only CYCL CALL and CYCL CALL POS are read",
                             "write the positions as L blocks");
        }
        return call_cycle(place(column));
    }
    if (in.take("FN")) return function(in);
    if (in.take("FUNCTION")) return tip_control(in);
    if (in.take("PLANE")) return plane(in);
    if (in.take("TRANS")) return shift_datum(in);
    if (in.take("STOP")) return {};
    if (in.take("LN")) return line_with_vectors(in);
    if (in.take("LP")) return line(in, true);
    if (in.take("L")) return line(in, false);
    if (in.take("CC")) return pole(in);
    if (in.take("CP")) return polar_circle(in);
    if (in.take("CR")) return circle_of_radius(in);
    if (in.take("CT")) return tangent_circle(in);
    if (in.take("C")) return circle(in);
    for (const std::string_view word :
         {"RND", "CHF", "APPR", "DEP", "CTP", "FL", "FC", "FLT", "FCT", "FPOL"}) {
        if (!in.take(word)) continue;
        return in.refuse(line_.column, std::string(word) + " is not read yet",
                         "let the CAM system write the path with L, C and CC");
    }
    // A block with miscellaneous functions only.
    if (to_upper(first) == 'M') {
        const auto words = read_words(in, "M");
        if (!words) return std::unexpected(words.error());
        return miscellaneous(*words);
    }
    const std::size_t blank = line_.text.find_first_of(" \t");
    std::string word(line_.text.substr(0, std::min<std::size_t>(blank, 12)));
    for (char& c : word) {
        if (c < ' ' || c > '~') c = '?';
    }
    return in.refuse(line_.column, "the block '" + word + "' is not known",
                     "check that this is a conversational program");
}

// BEGIN PGM NAME MM
Result<void> Interpreter::begin(LineReader&) {
    begun_ = true;
    const std::string_view text = line_.text;
    if (text.ends_with("INCH") || text.ends_with("inch")) {
        unit_mm_ = mm_per(LengthUnit::inch);
    } else if (!text.ends_with("MM") && !text.ends_with("mm") && path_.first(kNoUnit)) {
        path_.warn(line_.number, "BEGIN PGM names no unit: millimetres are taken");
    }
    return {};
}

// BLK FORM 0.1 Z X Y Z and BLK FORM 0.2 X Y Z: two corners.
Result<void> Interpreter::blank_form(LineReader& in) {
    if (!in.take("FORM")) return in.refuse(in.column(), "BLK without FORM", "write BLK FORM 0.1");
    if (in.take("CYLINDER") || in.take("ROTATION") || in.take("FILE")) {
        if (path_.first(kCylinder)) {
            path_.warn(line_.number, "this BLK FORM is no box: the stock is taken from the job");
        }
        for (;;) {
            const auto more = goes_on();
            if (!more) return std::unexpected(more.error());
            if (!*more) return {};
        }
    }
    const int column = in.column();
    const auto which = in.number();
    if (!which) return std::unexpected(which.error());
    const bool first = *which && std::abs(**which - 0.1) < kEqual;
    if (!first && !(*which && std::abs(**which - 0.2) < kEqual)) {
        return in.refuse(column, "BLK FORM without 0.1 or 0.2",
                         "write the lower corner as 0.1, the upper as 0.2");
    }
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
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
    if (!(box.volume() > 0)) return in.refuse(column, "the blank has no volume", "correct its corners");
    path_.program.stock = motion::DeclaredStock{box, line_.number};
    return {};
}

// TOOL DEF 1 L+0 R+5
Result<void> Interpreter::define_tool(LineReader& in) {
    if (!in.take("DEF")) return in.refuse(in.column(), "TOOL without CALL or DEF", "write TOOL CALL");
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    motion::DeclaredTool tool;
    tool.line = line_.number;
    for (const Item& item : items) {
        if (item.name.empty() && item.value) {
            tool.number = static_cast<int>(std::clamp(*item.value, 0.0, kLimits.tool_number.range.max));
        } else if (item.name == "R" && item.value) {
            tool.diameter_mm = 2 * *item.value * unit_mm_;
            if (tool.diameter_mm != 0) {
                if (auto good = in.in_range(kLimits.cutter_diameter, tool.diameter_mm, item.column); !good)
                    return good;
            }
        } else if (item.name == "L" && item.value) {
            const double length = *item.value * unit_mm_;
            if (auto good = in.in_range(kLimits.tool_length, length, item.column); !good) return good;
            if (length > 0) tool.length_mm = length;
        } else if (!item.name.starts_with('"')) {
            return in.refuse(item.column, item.name + " does not belong into TOOL DEF", "write L and R");
        }
    }
    if (tool.number > 0 && tool.diameter_mm > 0) path_.declare(tool);
    return {};
}

// TOOL CALL 5 Z S2000 F500 DL+0 DR+0
Result<void> Interpreter::call_tool(LineReader& in) {
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        if (i == 0 && item.name.starts_with('"')) {
            return in.refuse(item.column, "a tool with a name instead of a number",
                             "call the tool by its number");
        }
        if (i == 0 && item.name.empty() && item.value) {
            if (*item.value != 0) {
                if (auto good = in.in_range(kLimits.tool_number, *item.value, item.column); !good)
                    return good;
            }
            path_.tool = static_cast<int>(*item.value);
            path_.measure_tool();
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
            tool_feed_ = *item.value * unit_mm_;
            if (tool_feed_ != 0) {
                if (auto good = in.in_range(kLimits.feed, tool_feed_, item.column); !good) return good;
            }
            if (tool_feed_ > 0) path_.feed_mm_per_min = tool_feed_;
        } else if (item.name == "DR" || item.name == "DL") {
            if (item.value.value_or(0) != 0 && path_.first(kDeltas)) {
                path_.warn(line_.number,
                           "the deltas DL and DR of TOOL CALL are left out: coordinates name the tip");
            }
        } else if (item.name != "Z") {
            return in.refuse(item.column, "'" + item.name + "' does not belong into TOOL CALL",
                             "write Z, S and F");
        }
    }
    return {};
}

Result<void> Interpreter::assign(LineReader& in) {
    const auto index = in.parameter();
    if (!index) return std::unexpected(index.error());
    if (!*index) return in.refuse(in.column(), "a parameter is missing", "write Q1 = and a formula");
    if (!in.take('=')) return in.refuse(in.column(), "a parameter without '='", "write Q1 = and a formula");
    const auto value = in.formula();
    if (!value) return std::unexpected(value.error());
    if (!in.at_end()) return in.refuse(in.column(), "the formula does not end here", "correct it");
    parameters_.set(**index, *value);
    return {};
}

// FN 0 to FN 13. Other functions have no effect on the tool or are refused.
Result<void> Interpreter::function(LineReader& in) {
    const int column = in.column();
    const auto number = in.number();
    if (!number) return std::unexpected(number.error());
    if (!*number || !in.take(':'))
        return in.refuse(column, "FN without a number and ':'", "write FN 0: Q1 = 5");
    const int operation = static_cast<int>(std::clamp(**number, -1.0, 99.0));
    if ((operation >= 0 && operation <= 8) || operation == 13) return assign(in);
    if (operation >= 9 && operation <= 12) return jump_if(in, operation);
    if (operation == 15 || operation == 16 || operation == 19 || operation == 20) return {};
    if (operation == 14) {
        ended_ = true;
        path_.warn(line_.number, "FN 14 stops the program with an error message");
        return {};
    }
    return in.refuse(column, "FN " + std::to_string(operation) + " is not read",
                     "let the CAM system write the path without it");
}

// FN 9: IF +Q1 EQU +Q2 GOTO LBL 5
Result<void> Interpreter::jump_if(LineReader& in, int operation) {
    if (!in.take("IF")) return in.refuse(in.column(), "IF is missing", "write FN 9: IF Q1 EQU 2 GOTO LBL 5");
    const auto left = in.formula();
    if (!left) return std::unexpected(left.error());
    constexpr std::string_view words[] = {"EQU", "NE", "GT", "LT"};
    if (!in.take(words[operation - 9])) {
        return in.refuse(in.column(), std::string(words[operation - 9]) + " is missing",
                         "correct the comparison");
    }
    const auto right = in.formula();
    if (!right) return std::unexpected(right.error());
    if (!in.take("GOTO") || !in.take("LBL"))
        return in.refuse(in.column(), "GOTO LBL is missing", "write the label");
    const int column = in.column();
    const auto label = in.label();
    if (!label) return std::unexpected(label.error());
    const bool equal = std::abs(*left - *right) < kEqual;
    const bool holds = operation == 9    ? equal
                       : operation == 10 ? !equal
                       : operation == 11 ? *left > *right
                                         : *left < *right;
    return holds ? go_to(*label, column) : Result<void>{};
}

Result<void> Interpreter::go_to(const std::string& label, int column) {
    const auto found = labels_.find(label);
    if (found == labels_.end()) {
        return path_.refuse(place(column), "there is no LBL " + (label[0] == '"' ? label + "\"" : label),
                            "correct the label's name");
    }
    at_ = found->second - 1;  // run() continues after this line
    return {};
}

// CALL LBL 1 runs to LBL 0 and returns. CALL LBL 1 REP 2 repeats the lines from the label to here twice.
Result<void> Interpreter::call_label(LineReader& in) {
    const int column = in.column();
    if (!in.take("LBL")) {
        return in.refuse(column, "only CALL LBL is read: other programs are not at hand",
                         "copy the program that is called into this one, behind a label");
    }
    const auto label = in.label();
    if (!label) return std::unexpected(label.error());
    if (in.take("REP")) {
        const auto count = in.number();
        if (!count) return std::unexpected(count.error());
        if (!*count || **count < 0 || **count > static_cast<double>(kMostRepeats)) {
            return in.refuse(column, "REP without a number of repeats", "write REP and a whole number");
        }
        const auto left = repeats_.try_emplace(at_, static_cast<long>(**count)).first;
        if (left->second == 0) {
            repeats_.erase(left);
            return {};
        }
        --left->second;
        return go_to(*label, column);
    }
    if (calls_.size() >= kDeepestCalls) {
        return in.refuse(column, "subprograms are nested too deeply", "correct the calls");
    }
    const std::size_t back = at_;
    if (auto done = go_to(*label, column); !done) return done;
    calls_.push_back(back);
    return {};
}

Result<void> Interpreter::end_label() {
    if (calls_.empty()) return {};
    at_ = calls_.back();
    calls_.pop_back();
    return {};
}

Result<motion::Program> Interpreter::finish() {
    motion::Program& program = path_.program;
    if (!begun_) {
        return path_.refuse({}, "no conversational program in this file", "check that it is the right one");
    }
    if (path_.machine) {
        for (Warning& found : path_.machine->findings(program.source)) {
            program.warnings.push_back(std::move(found));
        }
    }
    if (path_.moves == 0) path_.warn(0, "the program moves no tool");
    return std::move(program);
}

}  // namespace heidenhain

Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options) {
    return heidenhain::Interpreter(bytes, options, nullptr).run();
}

Result<motion::Program> read_heidenhain(std::string_view bytes, const GcodeOptions& options, MoveSink& sink) {
    return heidenhain::Interpreter(bytes, options, &sink).run();
}

}  // namespace tribo::readers
