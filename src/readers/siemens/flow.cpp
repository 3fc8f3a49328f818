// SPDX-License-Identifier: MIT
// Structures, jumps and repeats.
#include <algorithm>
#include <cmath>

#include "readers/siemens/interpreter.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::siemens {
namespace {

bool is_loop(std::string_view word) {
    return word == "WHILE" || word == "FOR" || word == "LOOP" || word == "REPEAT";
}
bool is_loop_end(std::string_view word) {
    return word == "ENDWHILE" || word == "ENDFOR" || word == "ENDLOOP" || word == "UNTIL";
}
bool is_jump(std::string_view word) {
    return word == "GOTO" || word == "GOTOF" || word == "GOTOB" || word == "GOTOC" || word == "GOTOS";
}

}  // namespace

void Interpreter::go_to(std::size_t line) {
    at_ = line;
    jumped_ = true;
}

// Runs the block if it belongs to a structure; the cursor is at its word. Returns false if it does not.
Result<bool> Interpreter::run_structure(const std::string& word, Cursor& in) {
    const std::size_t after = in.at + word.size();
    const auto ran = [](Result<void> done) -> Result<bool> {
        if (!done) return std::unexpected(done.error());
        return true;
    };
    if (word.size() < 2) return false;
    in.at = after;
    if (word == "IF") return ran(run_if(in));
    if (word == "ELSE") {
        const auto end = text_.partner(at_);
        if (!end || *end < at_)
            return in.refuse(after - 4, "ELSE without IF and ENDIF", "add what is missing");
        go_to(*end);
        return true;
    }
    if (word == "ENDIF" || word == "ENDLABEL") return true;
    if (word == "REPEATB") return ran(repeat(in, true));
    if (word == "REPEAT" && !in.at_end()) return ran(repeat(in, false));
    if (is_loop(word)) return ran(begin_loop(word, in));
    if (is_loop_end(word)) return ran(end_loop(word, in));
    if (is_jump(word)) return ran(jump(word, in));
    if (word == "CASE") return ran(choose_case(in));
    return false;
}

Result<bool> Interpreter::condition(Cursor& in) {
    const auto value = Formula(in, variables_, *this).number();
    if (!value) return std::unexpected(value.error());
    return *value != 0;
}

// IF R1>2 GOTOF LABEL, or IF R1>2 with ELSE and ENDIF below.
Result<void> Interpreter::run_if(Cursor& in) {
    const std::size_t at = in.at;
    const auto holds = condition(in);
    if (!holds) return std::unexpected(holds.error());
    in.skip_blanks();
    const std::string word = name_at(in);
    if (is_jump(word)) {
        in.at += word.size();
        return *holds ? jump(word, in) : Result<void>{};
    }
    if (!in.at_end())
        return in.refuse(in.at, "this does not belong behind the condition", "write GOTOF there");
    const auto end = text_.partner(at_);
    if (!end) return in.refuse(at, "IF without ENDIF", "add ENDIF, or GOTOF behind the condition");
    if (!*holds) go_to(*end + 1);
    return {};
}

Result<void> Interpreter::begin_loop(const std::string& word, Cursor& in) {
    const std::size_t at = in.at;
    const auto end = text_.partner(at_);
    if (!end) return in.refuse(at, word + " without its end", "add the end of the loop");
    bool runs = true;
    if (word == "WHILE" || word == "FOR") {
        const auto holds = word == "FOR" ? step_for(in, true) : condition(in);
        if (!holds) return std::unexpected(holds.error());
        runs = *holds;
    }
    if (!runs) go_to(*end + 1);
    return {};
}

Result<void> Interpreter::end_loop(const std::string& word, Cursor& in) {
    const auto begin = text_.partner(at_);
    if (!begin || *begin > at_) return in.refuse(in.at, word + " without its beginning", "add it");
    if (word == "UNTIL") {
        const auto holds = condition(in);
        if (!holds) return std::unexpected(holds.error());
        if (!*holds) go_to(*begin + 1);
        return {};
    }
    if (word != "ENDFOR") {
        go_to(word == "ENDWHILE" ? *begin : *begin + 1);
        return {};
    }
    const std::string_view code = code_of(text_.line(*begin));
    Cursor head{code, head_of(code).at + 3, static_cast<int>(*begin) + 1, &source_name_};
    const auto goes_on = step_for(head, false);
    if (!goes_on) return std::unexpected(goes_on.error());
    if (*goes_on) go_to(*begin + 1);
    return {};
}

// FOR R1=1 TO 10: sets the variable at the beginning, adds 1 later. Returns true while it is within its end.
Result<bool> Interpreter::step_for(Cursor& in, bool begins) {
    in.skip_blanks();
    const std::size_t at = in.at;
    const std::string name = name_at(in);
    const std::size_t equals = in.line.find('=', at);
    const auto refuse_for = [&] {
        return in.refuse(at, "FOR without a variable, its start and TO", "write for example FOR R1=1 TO 10");
    };
    if (name.empty() || equals == std::string_view::npos) return refuse_for();
    const auto now = [&] {
        Cursor value{in.line, at, in.number, in.source_name};
        return Formula(value, variables_, *this).number();
    };
    in.at = at + name.size();
    if (begins) {
        if (auto done = assign(name, at, in); !done) return std::unexpected(done.error());
    } else {
        in.at = equals + 1;
        const auto start = Formula(in, variables_, *this).number();
        if (!start) return std::unexpected(start.error());
        const auto old = now();
        if (!old) return std::unexpected(old.error());
        Variable* variable = variables_.find(name);
        if (variable != nullptr && in.line.substr(at, equals - at).find('[') == std::string_view::npos) {
            variable->values[0] = *old + 1;
        } else if (variable == nullptr && name[0] == 'R' && number_of(name.substr(1))) {
            variables_.set_r(static_cast<int>(*number_of(name.substr(1))), *old + 1);
        } else {
            return refuse_for();
        }
    }
    in.skip_blanks();
    if (name_at(in) != "TO") return refuse_for();
    in.at += 2;
    const auto last = Formula(in, variables_, *this).number();
    if (!last) return std::unexpected(last.error());
    const auto value = now();
    if (!value) return std::unexpected(value.error());
    return *value <= *last;
}

// A label's name, a block number, or a text that says one of them.
Result<std::string> Interpreter::label(Cursor& in) {
    const char c = in.peek_after_blanks();
    if (c == ':') {
        std::string number = ":";
        while (is_digit(in.line.substr(in.at + 1).empty() ? '\0' : in.line[in.at + 1])) {
            number += in.line[++in.at];
        }
        ++in.at;
        return number;
    }
    const std::string name = name_at(in);
    const bool is_text = c == '"' || c == '(' || c == '<' || variables_.find(name) != nullptr;
    std::string found = name;
    if (is_text) {
        auto text = Formula(in, variables_, *this).text();
        if (!text) return text;
        found = *std::move(text);
        std::transform(found.begin(), found.end(), found.begin(), to_upper);
    } else {
        in.at += name.size();
    }
    if (found.empty()) return in.refuse(in.at, "a label is missing here", "write its name");
    return found;
}

Result<void> Interpreter::jump(const std::string& word, Cursor& in) {
    const std::size_t at = in.at;
    if (word == "GOTOS") {
        go_to(unit_->begin);
        return {};
    }
    const auto to = label(in);
    if (!to) return std::unexpected(to.error());
    const Text::Way way = word == "GOTOF"   ? Text::Way::forward
                          : word == "GOTOB" ? Text::Way::backward
                                            : Text::Way::both;
    const auto line = text_.place_of(*to, at_, way, *unit_);
    if (!line && word == "GOTOC") return {};
    if (!line) {
        return in.refuse(at, "there is no label " + to->substr(0, 31) + " in this direction",
                         "correct its name, or write GOTO");
    }
    go_to(*line);
    return {};
}

// CASE R1 OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C
Result<void> Interpreter::choose_case(Cursor& in) {
    const std::size_t begin = in.at;
    const auto value = Formula(in, variables_, *this).value();
    if (!value) return std::unexpected(value.error());
    in.skip_blanks();
    if (name_at(in) != "OF")
        return in.refuse(begin, "CASE without OF", "write for example CASE R1 OF 1 GOTOF A");
    in.at += 2;
    while (!in.at_end()) {
        bool fits = name_at(in) == "DEFAULT";
        if (fits) {
            in.at += 7;
        } else {
            const auto constant = Formula(in, variables_, *this).value();
            if (!constant) return std::unexpected(constant.error());
            fits = text_of(*constant) == text_of(*value);
        }
        in.skip_blanks();
        const std::string word = name_at(in);
        if (!is_jump(word)) return in.refuse(in.at, "CASE without a jump here", "write GOTOF and a label");
        in.at += word.size();
        if (fits) return jump(word, in);
        if (const auto passed = label(in); !passed) return std::unexpected(passed.error());
    }
    return {};
}

// REPEAT A P=2 runs the lines from A to here again, or to ENDLABEL; REPEAT A B those from A to B; REPEATB A
// the line of A.
Result<void> Interpreter::repeat(Cursor& in, bool one_block) {
    const std::size_t at = in.at, back = at_;
    const auto first = label(in);
    if (!first) return std::unexpected(first.error());
    const auto begin = text_.place_of(*first, at_, Text::Way::both, *unit_);
    std::optional<std::size_t> end;
    double times = 1;
    std::string last;
    while (!in.at_end()) {
        const std::string name = name_at(in);
        const bool is_count = name == "P" || (name.size() > 1 && name[0] == 'P' && number_of(name.substr(1)));
        if (!is_count) {
            const auto second = label(in);
            if (!second) return std::unexpected(second.error());
            last = *second;
            continue;
        }
        ++in.at;
        if (in.peek_after_blanks() == '=') ++in.at;
        const auto count = Formula(in, variables_, *this).number();
        if (!count) return std::unexpected(count.error());
        times = *count;
    }
    if (begin && one_block) {
        end = *begin + 1;
    } else if (begin && !last.empty()) {
        const auto found =
            *begin < unit_->end ? text_.place_of(last, *begin, Text::Way::forward, *unit_) : std::nullopt;
        if (found) end = *found + 1;
    } else if (begin) {
        const auto mark = text_.place_of("ENDLABEL", *begin, Text::Way::forward, *unit_);
        if (*begin < back) end = mark && *mark < back ? *mark : back;
        if (*begin > back && mark) end = *mark;
    }
    if (!begin || !end) {
        return in.refuse(at, "the lines to repeat are not in this program",
                         "write a label before them, and one or ENDLABEL: at their end");
    }
    if (depth_ >= kDeepestCall) return in.refuse(at, "repeats are nested too deeply", "correct the labels");
    for (long left = static_cast<long>(std::clamp(times, 0.0, 1e9)); left > 0; --left) {
        ++depth_;
        const auto done = run_lines(*begin, *end);
        --depth_;
        if (!done) return done;
        if (ended_ || returned_) break;
        if (at_ != *end) {  // a jump has left them
            jumped_ = true;
            return {};
        }
        if (auto cause = limit_.count(0)) {
            is_over_ = true;
            return path_.refuse(place(1), *std::move(cause), RunLimit::kRemedy);
        }
    }
    at_ = back;
    jumped_ = false;
    return {};
}

}  // namespace tribo::readers::siemens
