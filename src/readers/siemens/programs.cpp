// SPDX-License-Identifier: MIT
// Variables, and the programs that a program calls.
#include <algorithm>
#include <cmath>

#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr double kLargestArray = 100'000;

// The type of a name of a type.
std::optional<Type> type_of(const std::string& word) {
    if (word == "REAL") return Type::real;
    if (word == "INT" || word == "BOOL" || word == "CHAR") return Type::whole;
    if (word == "STRING" || word == "AXIS" || word == "FRAME") return Type::text;
    return std::nullopt;
}

Variable fresh(Type type, std::size_t count = 1) {
    Variable variable;
    variable.type = type;
    variable.values.assign(count, type == Type::text ? Value{std::string()} : Value{0.0});
    return variable;
}

}  // namespace

// DEF REAL A=1, B[2,3], DEF STRING[20] NAME="X"
Result<void> Interpreter::define(Cursor& in) {
    std::optional<Type> type;
    bool are_frames = false;
    while (!type) {
        in.skip_blanks();
        const std::string word = name_at(in);
        are_frames = word == "FRAME";
        if (word.empty()) return in.refuse(in.at, "DEF without a type", "write REAL, INT, BOOL or STRING");
        type = type_of(word);
        in.at += word.size();
    }
    if (in.peek_after_blanks() == '[') {  // the length of a text
        ++in.at;
        if (const auto length = Formula(in, variables_, *this).indices(); !length) {
            return std::unexpected(length.error());
        }
    }
    while (!in.at_end()) {
        const std::size_t at = in.at;
        const std::string name = name_at(in);
        if (name == "PHU" || name == "LLI" || name == "ULI" || name == "APR" || name == "APW") {
            in.at = in.line.size();  // attributes of a variable of the machine
            break;
        }
        if (name.empty()) return in.refuse(at, "DEF without a name", "write the variable's name");
        in.at += name.size();
        if (are_frames) frame_variables_[name] = {};
        Variable variable = fresh(*type);
        if (in.peek_after_blanks() == '[') {
            if (are_frames) return in.refuse(at, "an array of frames is not read", "define each by its name");
            ++in.at;
            if (auto done = read_sizes(variable, at, in); !done) return done;
        }
        if (!variables_.define(name, std::move(variable))) {
            return in.refuse(at, "the variables hold more than a million values", "define smaller arrays");
        }
        if (in.peek_after_blanks() == '=') {
            if (auto done = assign(name, at, in); !done) return done;
        }
        if (in.peek_after_blanks() == ',') ++in.at;
    }
    return {};
}

// [3] or [2,3] behind the name of an array. The cursor is behind the first bracket.
Result<void> Interpreter::read_sizes(Variable& variable, std::size_t at, Cursor& in) {
    const auto sizes = Formula(in, variables_, *this).indices();
    if (!sizes) return std::unexpected(sizes.error());
    double count = 1;
    for (std::size_t k = 0; k < sizes->size() && k < 2; ++k) {
        const double* size = std::get_if<double>(&(*sizes)[k]);
        count *= size != nullptr && *size >= 1 ? std::floor(*size) : 0;
        if (count >= 1 && count <= kLargestArray) variable.sizes[k] = static_cast<std::size_t>(*size);
    }
    if (!(count >= 1 && count <= kLargestArray) || sizes->size() > 2) {
        return in.refuse(at, "an array of this size is not read", "write at most two sizes");
    }
    variable.values = fresh(variable.type, static_cast<std::size_t>(count)).values;
    return {};
}

// DEFINE NAME AS G1 F500
Result<void> Interpreter::define_macro(Cursor& in) {
    in.skip_blanks();
    const std::string name = name_at(in);
    const std::size_t at = in.at;
    in.at += name.size();
    in.skip_blanks();
    if (name.empty() || name_at(in) != "AS") {
        return in.refuse(at, "DEFINE without a name and AS", "write for example DEFINE LINE AS G1");
    }
    macros_[name] = std::string(in.line.substr(in.at + 2));
    return {};
}

// The cursor is behind the name: [index] = value, or a list of values for an array.
Result<void> Interpreter::assign(const std::string& name, std::size_t at, Cursor& in) {
    std::vector<Value> index;
    if (in.peek_after_blanks() == '[') {
        ++in.at;
        auto found = Formula(in, variables_, *this).indices();
        if (!found) return std::unexpected(found.error());
        index = *std::move(found);
    }
    if (in.peek_after_blanks() != '=')
        return in.refuse(at, name + " without '='", "write its value behind '='");
    ++in.at;
    if (frame_variables_.contains(name)) return assign_frame(name, index, at, in);
    Variable* variable = variables_.find(name);
    if (variable == nullptr) {
        const double* given = index.empty() ? nullptr : std::get_if<double>(&index[0]);
        const double number = given != nullptr ? *given : number_of(name.substr(1)).value_or(-1);
        if (name[0] != 'R' || !(number >= 0 && number < Variables::kMostR)) {
            return in.refuse(at, "'" + name.substr(0, 31) + "' is not known", "define it with DEF");
        }
        const auto value = Formula(in, variables_, *this).value();
        if (!value) return std::unexpected(value.error());
        Variable holder = fresh(Type::real);
        if (auto done = set_element(holder, 0, *value, at, in); !done) return done;
        variables_.set_r(static_cast<int>(number), std::get<double>(holder.values[0]));
        return {};
    }
    const auto place = Formula(in, variables_, *this).element(*variable, index, at);
    if (!place) return std::unexpected(place.error());
    in.skip_blanks();
    const std::string word = name_at(in);
    const bool is_array = variable->values.size() > 1;
    const bool is_list = is_array && (word == "SET" || word == "REP" || in.peek() == '(');
    if (!is_list) {
        const auto value = Formula(in, variables_, *this).value_or_name();
        if (!value) return std::unexpected(value.error());
        return set_element(*variable, *place, *value, at, in);
    }
    in.at += in.peek() == '(' ? 0 : word.size();
    const auto list = call_at(in, word, at);
    if (!list) return std::unexpected(list.error());
    const std::size_t count = word == "REP" ? variable->values.size() - *place : list->given.size();
    for (std::size_t i = 0; i < count && *place + i < variable->values.size(); ++i) {
        const std::size_t from = word == "REP" ? 0 : i;
        if (!list->has(from)) continue;
        if (auto done = set_element(*variable, *place + i, *list->given[from], at, in); !done) return done;
    }
    return {};
}

Result<void> Interpreter::set_element(Variable& variable, std::size_t place, const Value& value,
                                      std::size_t at, Cursor& in) const {
    const double* number = std::get_if<double>(&value);
    if (variable.type == Type::text) {
        variable.values[place] = text_of(value);
        return {};
    }
    if (number == nullptr) return in.refuse(at, "a text for a variable of numbers", "write a number");
    variable.values[place] = variable.type == Type::whole ? std::floor(*number + 0.5) : *number;
    return {};
}

// NAME(1,,"A") with the cursor behind the name; without parentheses no values.
Result<Call> Interpreter::call_at(Cursor& in, const std::string& name, std::size_t at) {
    Call call;
    call.name = name;
    call.line = line_number();
    call.column = static_cast<int>(at) + 1;
    if (in.peek_after_blanks() != '(') return call;
    call.has_list = true;
    ++in.at;
    for (;;) {
        const char c = in.peek_after_blanks();
        if (c == ',' || c == ')') {
            call.given.emplace_back();
            call.names.emplace_back();
        } else {
            const std::string variable = name_at(in);
            auto value = Formula(in, variables_, *this).value_or_name();
            if (!value) return std::unexpected(value.error());
            call.given.emplace_back(*std::move(value));
            call.names.push_back(variable);
        }
        const char next = in.peek_after_blanks();
        if (next != ',' && next != ')') return in.refuse(at, "the parenthesis does not close", "close it");
        ++in.at;
        if (next == ')') return call;
    }
}

// The name in upper case, without folder and ending.
std::string Interpreter::program_name(const std::string& text) {
    std::string name;
    for (const char c : text.substr(text.find_last_of("/\\:") + 1)) name += to_upper(c);
    if (name.starts_with("_N_")) name.erase(0, 3);
    for (const std::string_view ending : {".MPF", ".SPF", "_MPF", "_SPF"}) {
        if (name.ends_with(ending)) name.erase(name.size() - ending.size());
    }
    return name;
}

// CALL "NAME", PCALL NAME(..), EXTCALL "DIRECTORY/NAME.MPF"
Result<void> Interpreter::call_by_text(const std::string& word, Cursor& in) {
    in.skip_blanks();
    const std::size_t at = in.at;
    std::string name = name_at(in);
    Call call;
    if (word == "CALL" && (name == "BLOCK" || name == "LBL")) {
        return in.refuse(at, "CALL " + name + " is not read", "write REPEAT with two labels");
    }
    if (!name.empty() && variables_.find(name) == nullptr) {
        in.at += name.size();
        auto found = call_at(in, name, at);
        if (!found) return std::unexpected(found.error());
        call = *std::move(found);
    } else {
        auto text = Formula(in, variables_, *this).text();
        if (!text) return std::unexpected(text.error());
        auto found = call_at(in, *text, at);
        if (!found) return std::unexpected(found.error());
        call = *std::move(found);
    }
    call.name = program_name(call.name);
    if (call.name.empty()) return in.refuse(at, word + " without the name of a program", "write it");
    return run_call(call);
}

Result<void> Interpreter::run_call(const Call& call) {
    const auto is_cycle = run_cycle(call);
    if (!is_cycle) return std::unexpected(is_cycle.error());
    if (*is_cycle) return {};
    const Unit* unit = text_.unit_named(call.name);
    if (unit == nullptr) return leave_out_program(call);
    for (long i = 0; i < call.times && !ended_; ++i) {
        if (auto done = run_unit(*unit, call); !done) return done;
    }
    return {};
}

// Runs a program of this file, and returns.
Result<void> Interpreter::run_unit(const Unit& unit, const Call& call) {
    if (depth_ >= kDeepestCall) {
        return path_.refuse({call.line, call.column}, "programs call each other too deeply",
                            "correct the calls");
    }
    const std::size_t back = at_;
    const Unit* caller = unit_;
    variables_.enter();
    std::vector<Returned> returned;
    auto done = take_parameters(unit, call, returned);
    if (done) {
        ++depth_;
        unit_ = &unit;
        done = run_lines(unit.begin, unit.end);
        unit_ = caller;
        --depth_;
    }
    for (Returned& parameter : returned) parameter.values = variables_.find(parameter.name)->values;
    variables_.leave();
    for (const Returned& parameter : returned) {
        Variable* variable = variables_.find(parameter.given);
        const double* number = std::get_if<double>(&parameter.values[0]);
        if (variable != nullptr && variable->values.size() == parameter.values.size()) {
            variable->values = parameter.values;
        } else if (variable == nullptr && number != nullptr && parameter.given[0] == 'R') {
            const auto r = number_of(parameter.given.substr(1));
            if (r && *r >= 0 && *r < Variables::kMostR) variables_.set_r(static_cast<int>(*r), *number);
        }
    }
    at_ = back;
    jumped_ = returned_ = false;
    return done;
}

// PROC NAME(REAL A, INT B=2, VAR REAL C, VAR REAL D[3])
Result<void> Interpreter::take_parameters(const Unit& unit, const Call& call,
                                          std::vector<Returned>& returned) {
    if (!unit.proc) return {};
    const std::string_view code = code_of(text_.line(*unit.proc));
    Cursor in{code, head_of(code).at + 4, static_cast<int>(*unit.proc) + 1, &source_name_};
    in.skip_blanks();
    in.at += name_at(in).size();
    if (in.peek_after_blanks() != '(') return {};
    ++in.at;
    for (std::size_t i = 0; in.peek_after_blanks() != ')'; ++i) {
        const std::size_t at = in.at;
        std::string word = name_at(in);
        in.at += word.size();
        const bool is_returned = word == "VAR";
        if (is_returned) {
            in.skip_blanks();
            word = name_at(in);
            in.at += word.size();
        }
        const auto type = type_of(word);
        if (in.peek_after_blanks() == '[') {
            ++in.at;
            if (const auto length = Formula(in, variables_, *this).indices(); !length) {
                return std::unexpected(length.error());
            }
            in.skip_blanks();
        }
        const std::string name = name_at(in);
        if (!type || name.empty()) {
            return in.refuse(at, "a parameter without type and name", "write for example PROC NAME(REAL A)");
        }
        in.at += name.size();
        Variable variable = fresh(*type);
        const Variable* array = nullptr;  // of the caller
        if (in.peek_after_blanks() == '[') {
            ++in.at;
            if (call.has(i)) array = variables_.find_of_caller(call.names[i]);
            const bool is_of_any_size = in.peek_after_blanks() == ']' || in.peek_after_blanks() == ',';
            if (is_of_any_size) {  // A[] and A[,]
                while (in.peek_after_blanks() == ',') ++in.at;
                if (in.peek_after_blanks() == ']') ++in.at;
                if (array != nullptr) variable.sizes = array->sizes;
            } else if (auto done = read_sizes(variable, at, in); !done) {
                return done;
            }
            if (array == nullptr || array->type != *type || array->sizes != variable.sizes) {
                return path_.refuse({call.line, call.column},
                                    call.name + " without an array of the size of its parameter " + name,
                                    "give it an array of this type and size");
            }
            variable.values = array->values;
        }
        if (in.peek_after_blanks() == '=') {
            ++in.at;
            const auto value = Formula(in, variables_, *this).value();
            if (!value) return std::unexpected(value.error());
            if (auto done = set_element(variable, 0, *value, at, in); !done) return done;
        }
        if (call.has(i) && array == nullptr) {
            if (auto done = set_element(variable, 0, *call.given[i], at, in); !done) return done;
        }
        if (!variables_.define(name, std::move(variable))) {
            return in.refuse(at, "the variables hold more than a million values", "define smaller arrays");
        }
        if (is_returned && call.has(i) && !call.names[i].empty())
            returned.push_back({name, call.names[i], {}});
        const char next = in.peek_after_blanks();
        if (next != ',' && next != ')') return in.refuse(at, "the parenthesis does not close", "close it");
        if (next == ',') ++in.at;
    }
    return {};
}

// A program that is not at hand: its moves are left out.
Result<void> Interpreter::leave_out_program(const Call& call) {
    if (auto done = close_contour(); !done) return done;
    contour_.leave();
    path_.lose(line_number());
    if (path_.options.missing_programs != nullptr) path_.options.missing_programs->push_back(call.name);
    std::string name;
    for (const char c : call.name.substr(0, 31)) name += c < ' ' || c > '~' ? '?' : c;
    if (passed_over_.insert(name).second) {
        path_.warn(line_number(),
                   "the program " + name +
                       " is not at hand: its moves are left out, and the tool's place is "
                       "unknown after it; lay its file beside this one, or copy it into this one "
                       "behind PROC " +
                       name);
    }
    return {};
}

}  // namespace tribo::readers::siemens
