// SPDX-License-Identifier: MIT
// Parameters, FN functions, labels, repeats and calls.
#include <algorithm>
#include <cmath>
#include <utility>

#include "readers/control/block_text.hpp"
#include "readers/heidenhain/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

// Largest depth of subprograms; the control allows 19.
constexpr std::size_t kDeepestCalls = 100;
constexpr double kEqual = 1e-9;  // FN 9: numbers closer than this are equal
constexpr long kMostRepeats = 65534;

// The name of a program without its folder and ending.
std::string bare_name(std::string_view name) {
    name = trimmed(name);
    if (name.starts_with('"')) name.remove_prefix(1);
    if (name.ends_with('"')) name.remove_suffix(1);
    if (const std::size_t slash = name.find_last_of("\\/:"); slash != std::string_view::npos)
        name.remove_prefix(slash + 1);
    if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name = name.substr(0, dot);
    return std::string(name);
}

}  // namespace

Result<void> Interpreter::assign(LineReader& in) {
    if (line_.text.size() > 1 && to_upper(line_.text[1]) == 'S' && in.column() == line_.column) {
        return assign_text(in);
    }
    const auto index = in.parameter();
    if (!index) return std::unexpected(index.error());
    if (!*index) return in.refuse(in.column(), "a parameter is missing", "write Q1 = and a formula");
    if (!in.take('=')) return in.refuse(in.column(), "a parameter without '='", "write Q1 = and a formula");
    const auto value = in.formula();
    if (!value) return std::unexpected(value.error());
    if (!in.at_end()) return in.refuse(in.column(), "the formula does not end here", "correct it");
    parameters_.set(**index, *value);
    change_cycle(**index, *value);
    return {};
}

// QS1 = "MILL" || "_10"; what texts are used for beyond names is not followed.
Result<void> Interpreter::assign_text(LineReader& in) {
    const auto index = in.text_parameter();
    if (!index || !in.take('=')) {
        return in.refuse(in.column(), "a text without QS and '='", "write QS1 = \"NAME\"");
    }
    if (auto text = in.text(); text && *text) {
        parameters_.texts[*index] = **text;
        return {};
    }
    parameters_.texts.erase(*index);
    return pass_over("a function of texts");
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
    if (operation == 18) return read_system(in);
    if (operation == 28) {  // TABREAD Q1 = "COLUMN"
        if (in.take("TABREAD")) {
            const auto index = in.parameter();
            if (!index) return std::unexpected(index.error());
            if (*index) parameters_.forget(**index);
        }
        return pass_over("FN 28");
    }
    if (operation == 17 || (operation >= 21 && operation <= 29) || operation == 37 || operation == 38) {
        return pass_over("FN " + std::to_string(operation));
    }
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
    const auto found = labels_.find(label_key(label, at_));
    if (found == labels_.end()) {
        return path_.refuse(place(column), "there is no LBL " + (label[0] == '"' ? label + "\"" : label),
                            "correct the label's name");
    }
    at_ = found->second - 1;  // run() continues after this line
    return {};
}

// FN 18: SYSREAD Q1 = ID270 NR1 IDX3: what the program has set itself is known, the rest is the machine's.
Result<void> Interpreter::read_system(LineReader& in) {
    if (!in.take("SYSREAD"))
        return in.refuse(in.column(), "FN 18 without SYSREAD", "write FN 18: SYSREAD Q1");
    const auto index = in.parameter();
    if (!index) return std::unexpected(index.error());
    if (!*index || !in.take('=')) return in.refuse(in.column(), "a parameter is missing", "write Q1 = ID270");
    std::vector<Item> items;
    if (auto done = in.items(items); !done) return done;
    const auto number = [&](std::string_view name) {
        for (const Item& item : items) {
            if (item.name == name && item.value) return static_cast<int>(std::clamp(*item.value, 0.0, 1e6));
        }
        return 0;
    };
    const int id = number("ID"), nr = number("NR"), axis = number("IDX");
    const bool has_axis = axis >= 1 && axis <= 3;
    std::optional<double> value;
    if (id == 270 && nr == 1 && has_axis && path_.known(axis - 1) == Known::yes) {
        value = here()[axis - 1] / unit_mm_;
    } else if (id == 220 && nr == 2 && has_axis) {
        value = shift_mm_[axis - 1] / unit_mm_;
    } else if ((id == 20 && nr == 1) || (id == 60 && nr == 1)) {
        value = path_.tool;
    } else if (id == 20 && nr == 4) {
        value = path_.spindle_rpm;
    } else if (id == 50 && nr == 2 && path_.tool_radius_mm(unit_mm_)) {
        value = *path_.tool_radius_mm(unit_mm_) / unit_mm_;
    }
    if (value) {
        parameters_.set(**index, *value);
    } else {
        parameters_.forget(**index);
        path_.warn(line_.number,
                   "FN 18 reads what only the machine knows: " + Parameters::name(**index) + " has no value");
    }
    return {};
}

// CALL PGM: a program of the text runs from its BEGIN PGM to its END PGM.
Result<void> Interpreter::call_program(std::string name) {
    const std::string bare = upper(bare_name(name));
    const auto unit = std::find_if(programs_.begin(), programs_.end(),
                                   [&](const Unit& known) { return known.name == bare; });
    if (unit == programs_.end()) return leave_out_program(std::move(name));
    if (calls_.size() >= kDeepestCalls) {
        return path_.refuse(place(line_.column), "programs are nested too deeply", "correct the calls");
    }
    calls_.push_back({at_, true, unit_mm_});
    // run() goes on after this line, with BEGIN PGM.
    at_ = unit->begin - 1;
    return {};
}

// END PGM, M2, M30: back to the program that called this one.
void Interpreter::end_program() {
    while (!calls_.empty() && !calls_.back().of_program) calls_.pop_back();
    if (calls_.empty()) {
        ended_ = true;
        return;
    }
    at_ = calls_.back().line;
    unit_mm_ = calls_.back().unit_mm;
    calls_.pop_back();
}

// Each program has labels of its own.
std::string Interpreter::label_key(const std::string& label, std::size_t line) const {
    const auto next = std::upper_bound(programs_.begin(), programs_.end(), line,
                                       [](std::size_t at, const Unit& unit) { return at < unit.begin; });
    const auto unit = std::max<std::ptrdiff_t>(next - programs_.begin() - 1, 0);
    return std::to_string(unit) + " " + label;
}

// A program that is not at hand: its moves are left out.
Result<void> Interpreter::leave_out_program(std::string name) {
    if (path_.options.missing_programs != nullptr) path_.options.missing_programs->push_back(bare_name(name));
    for (char& c : name) {
        if (c < ' ' || c > '~') c = '?';
    }
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    path_.lose(line_.number);
    if (passed_over_.insert(name).second) {
        path_.warn(line_.number,
                   "the program " + name +
                       " is not at hand: its moves are left out, and the tool's place is unknown "
                       "after it; lay its file beside this one");
    }
    return {};
}

std::unexpected<Error> Interpreter::refuse_behind_label(const LineReader& in, int column) const {
    return in.refuse(column, "this does not belong behind CALL LBL", "write REP and a number, or nothing");
}

// CALL LBL 1 runs to LBL 0 and returns, also as CALL LBL 1 REP (old controls). CALL LBL 1 REP 2 repeats the
// lines from the label to here twice; so do REP 2/2, where the control counts, and REPQ5.
Result<void> Interpreter::call(LineReader& in) {
    const int column = in.column();
    if (in.take("PGM") || in.take("SELECTED")) {
        const std::string name(line_.text.substr(static_cast<std::size_t>(in.column() - line_.column)));
        return call_program(name);
    }
    if (!in.take("LBL")) {
        return in.refuse(column, "only CALL LBL and CALL PGM are read", "write CALL LBL with a label");
    }
    const auto label = in.label();
    if (!label) return std::unexpected(label.error());
    const int behind = in.column();
    const bool repeats = in.take("REP") || in.take_before_parameter("REP");
    if (repeats && !in.at_end()) {
        const auto count = in.number();
        if (!count) return std::unexpected(count.error());
        if (*count && in.take('/')) {
            if (const auto left = in.number(); !left) return std::unexpected(left.error());
        }
        if (!*count || **count < 0 || **count > static_cast<double>(kMostRepeats)) {
            return in.refuse(column, "REP without a number of repeats", "write REP and a whole number");
        }
        if (!in.at_end()) return refuse_behind_label(in, in.column());
        const auto left = repeats_.try_emplace(at_, static_cast<long>(**count)).first;
        if (left->second == 0) {
            repeats_.erase(left);
            return {};
        }
        --left->second;
        return go_to(*label, column);
    }
    if (!in.at_end()) return refuse_behind_label(in, behind);
    if (calls_.size() >= kDeepestCalls) {
        return in.refuse(column, "subprograms are nested too deeply", "correct the calls");
    }
    const std::size_t back = at_;
    if (auto done = go_to(*label, column); !done) return done;
    calls_.push_back({back, false, unit_mm_});
    return {};
}

Result<void> Interpreter::end_label() {
    if (calls_.empty() || calls_.back().of_program) return {};
    at_ = calls_.back().line;
    calls_.pop_back();
    return {};
}

}  // namespace tribo::readers::heidenhain
