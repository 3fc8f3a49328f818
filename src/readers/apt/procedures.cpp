// SPDX-License-Identifier: MIT
#include "readers/apt/procedures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "readers/apt/formula.hpp"
#include "readers/apt/loops.hpp"

namespace tribo::readers::apt {
namespace {

constexpr int kDeepest = 16;  // calls within each other
constexpr double kMostCopies = 10'000;

bool is_name(const std::string& text) {
    return !text.empty() && is_letter(text[0]) && std::all_of(text.begin(), text.end(), [](char c) {
        return is_letter(c) || is_digit(c) || c == '_';
    });
}

// The text before and after the first '='.
std::pair<std::string, std::string> sides_of(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return {upper(text), ""};
    return {upper(text.substr(0, equals)), upper(text.substr(equals + 1))};
}

}  // namespace

std::string_view Procedures::kept(std::string text) {
    texts_.push_back(std::move(text));
    return texts_.back();
}

Result<void> Procedures::take(const Statement& statement, double unit_mm, const Run& run) {
    const bool is_plain = statement.is_text || statement.is_header;
    if (!defining_.empty()) {
        if (!is_plain && matches(statement.word.text, "TERMAC")) {
            defining_.clear();
        } else {
            macros_[defining_].statements.push_back(statement);
        }
        return {};
    }
    if (loops_ > 0) {
        Statement bare = statement;
        const bool has_label = !is_plain && !take_label(bare).empty();
        if (!is_plain && matches(bare.word.text, "LOOPST")) ++loops_;
        if (is_plain || !matches(bare.word.text, "LOOPND") || --loops_ > 0) {
            loop_.push_back(statement);
            return {};
        }
        if (has_label) loop_.push_back(statement);  // a jump to it ends the loop
        const std::vector<Statement> statements = std::exchange(loop_, {});
        return run_block(statements, unit_mm, run);
    }
    if (is_plain) return run_one(statement, run);
    if (!in_block_ && matches(statement.word.text, "LOOPST")) {
        loop_at_ = statement.word;
        loops_ = 1;
        return {};
    }
    if (is_jump(statement.word.text)) {
        return report_.refuse(statement.word, "a jump outside of a loop and a macro",
                              "write LOOPST before it and its labels, and LOOPND behind them");
    }
    const auto defined = define(statement);
    if (!defined) return std::unexpected(defined.error());
    if (*defined) return {};
    if (matches(statement.word.text, "CALL")) return call(statement, unit_mm, run);
    if (matches(statement.word.text, "COPY")) return copy(replaced(statement), unit_mm, run);
    if (matches(statement.word.text, "INDEX")) {
        const auto number = statement.items.empty() ? std::nullopt : number_of(statement.items[0].text);
        if (!number || std::abs(*number) > 1e6)
            return report_.refuse(statement.word, "INDEX without its number", "write for example INDEX/1");
        if (statement.items.size() == 1) indices_[static_cast<int>(*number)] = recorded_.size();
        return {};
    }
    return run_one(names_.empty() ? statement : replaced(statement), run);
}

Result<void> Procedures::finish() const {
    if (loops_ > 0)
        return report_.refuse(loop_at_, "LOOPST without its LOOPND", "write LOOPND behind the loop");
    if (defining_.empty()) return {};
    return report_.refuse(macros_.at(defining_).at, "the macro " + defining_ + " has no TERMAC",
                          "write TERMAC behind its last statement");
}

std::unexpected<Error> Procedures::refuse_more_statements(const Item& at) const {
    return report_.refuse(
        at, "macros, loops and copies run more than " + std::to_string(most_statements_) + " statements",
        "write fewer copies, or correct the calls and the conditions of the loops");
}

Result<void> Procedures::run_one(const Statement& statement, const Run& run) {
    if (!indices_.empty()) {
        written_.push_back(statement);
        if (auto done = record({&written_.back(), {}}); !done) return done;
    }
    return run(statement, {});
}

Result<void> Procedures::record(const Recorded& recorded) {
    if (recorded_.size() >= most_statements_) return refuse_more_statements(recorded.statement->word);
    recorded_.push_back(recorded);
    return {};
}

// A name on the left of '='. Returns false for other statements, and for geometry that has no points.
Result<bool> Procedures::define(const Statement& statement) {
    const auto [name, what] = sides_of(statement.word.text);
    if (what.empty() || !is_name(name)) return false;
    if (what == "MACRO") {
        if (auto done = begin_macro(name, statement); !done) return std::unexpected(done.error());
        return true;
    }
    if (what == "POINT" && (statement.items.size() == 2 || statement.items.size() == 3)) {
        std::vector<std::string> values;
        for (const Item& item : replaced(statement).items) {
            if (!number_of(item.text)) return false;
            values.emplace_back(item.text);
        }
        values.resize(3, "0");
        names_[name] = values;
        return true;
    }
    const auto known = names_.find(what);
    if (statement.items.empty() && known != names_.end()) {
        names_[name] = std::vector<std::string>(known->second);
        return true;
    }
    // A slash of the formula stands where that of a statement does.
    const std::string text = whole(statement);
    const auto number = value(text.substr(text.find('=') + 1));
    if (!number) return false;
    names_[name] = {format_decimal(*number)};
    return true;
}

Result<void> Procedures::begin_macro(const std::string& name, const Statement& statement) {
    if (macros_.size() >= 1000)
        return report_.refuse(statement.word, "more than 1000 macros", "split the program");
    Macro macro;
    macro.at = statement.word;
    for (const Item& item : statement.items) {
        const auto [parameter, value] = sides_of(item.text);
        if (!is_name(parameter))
            return report_.refuse(item, "a parameter of a macro without a name", "write a name of letters");
        macro.names.push_back(parameter);
        if (!value.empty()) macro.values[parameter] = value;
    }
    macros_[name] = std::move(macro);
    defining_ = name;
    return {};
}

// CALL/NAME,A=1,B=2: the statements of the macro, with its parameters replaced.
Result<void> Procedures::call(const Statement& statement, double unit_mm, const Run& run) {
    const auto found = statement.items.empty() ? macros_.end() : macros_.find(upper(statement.items[0].text));
    if (found == macros_.end())
        return report_.refuse(statement.word, "CALL of a macro that is not defined before it",
                              "define it with MACRO");
    if (depth_ >= kDeepest)
        return report_.refuse(statement.word, "macros call each other too deeply", "correct the calls");
    const Macro& macro = found->second;
    const Names outside = names_;
    count_ += names_.size();
    for (const auto& [name, value] : macro.values) names_[name] = {value};
    for (std::size_t i = 1; i < statement.items.size(); ++i) {
        auto [name, value] = sides_of(statement.items[i].text);
        if (std::find(macro.names.begin(), macro.names.end(), name) == macro.names.end() || value.empty())
            return report_.refuse(statement.items[i], "CALL gives a value to no parameter of the macro",
                                  "write NAME=value");
        const auto known = outside.find(value);
        names_[name] = known != outside.end() ? known->second : std::vector<std::string>{value};
    }
    ++depth_;
    // A copy: a macro may define itself anew while it runs.
    const std::vector<Statement> statements = macro.statements;
    const Result<void> done = run_block(statements, unit_mm, run);
    --depth_;
    names_ = outside;
    return done;
}

// What one copy is moved by.
Result<Frame> Procedures::step_of(const Statement& statement, double unit_mm) const {
    const auto& items = statement.items;
    const std::string kind = items.size() > 1 ? upper(items[1].text) : "";
    Frame step;
    if (kind == "SAME" && items.size() == 3) return step;
    if (kind == "TRANSL" && items.size() == 6) {
        for (int k = 0; k < 3; ++k) {
            const auto by =
                report_.number(items[2 + static_cast<std::size_t>(k)], kLimits.coordinate, unit_mm);
            if (!by) return std::unexpected(by.error());
            step.origin_mm[k] = *by * unit_mm;
        }
        return step;
    }
    if (kind == "XYROT" && items.size() == 4) {
        const auto angle = report_.number(items[2], kLimits.rotary_angle);
        if (!angle) return std::unexpected(angle.error());
        const double c = math::cos(*angle * math::kRadPerDeg), s = math::sin(*angle * math::kRadPerDeg);
        step.x = {c, s, 0};
        step.y = {-s, c, 0};
        return step;
    }
    return report_.refuse(statement.word, "COPY is read with SAME, TRANSL and XYROT",
                          "write COPY/1,TRANSL,x,y,z,times, or let the CAM system write the points");
}

// COPY/n,...,times: what was written since INDEX/n again, each time moved on.
Result<void> Procedures::copy(const Statement& statement, double unit_mm, const Run& run) {
    const auto& items = statement.items;
    const auto number = items.empty() ? std::nullopt : number_of(items[0].text);
    const auto marked =
        number && std::abs(*number) < 1e6 ? indices_.find(static_cast<int>(*number)) : indices_.end();
    if (marked == indices_.end())
        return report_.refuse(statement.word, "COPY without its INDEX before it",
                              "write INDEX with the same number");
    const auto step = step_of(statement, unit_mm);
    if (!step) return std::unexpected(step.error());
    const auto times = number_of(items.back().text);
    if (!times || !(*times >= 0 && *times <= kMostCopies) || *times != std::floor(*times))
        return report_.refuse(items.back(), "COPY without a number of copies",
                              "write a whole number up to 10000");
    const std::size_t begin = marked->second, end = recorded_.size();
    if (static_cast<double>(end - begin) * *times + static_cast<double>(count_) >
        static_cast<double>(most_statements_))
        return refuse_more_statements(statement.word);
    Frame frame;
    for (double i = 0; i < *times; ++i) {
        frame = *step * frame;
        for (std::size_t k = begin; k < end; ++k) {
            ++count_;
            const Recorded again{recorded_[k].statement, frame * recorded_[k].frame};
            if (auto done = record(again); !done) return done;
            if (auto done = run(*again.statement, again.frame); !done) return done;
        }
    }
    return run({}, {});
}

// The statement with its names replaced by what they stand for.
Statement Procedures::replaced(const Statement& statement) {
    Statement changed = statement;
    changed.items.clear();
    for (const Item& item : statement.items) {
        const bool is_negative = item.text.starts_with('-');
        const auto found = names_.find(upper(is_negative ? item.text.substr(1) : item.text));
        if (found == names_.end()) {
            changed.items.push_back(item);
            // A number stays as it is written.
            if (number_of(item.text)) continue;
            if (const auto number = value(item.text))
                changed.items.back().text = kept(format_decimal(*number));
            continue;
        }
        for (const std::string& value : found->second) {
            const bool was_negative = value.starts_with('-');
            std::string text = !is_negative ? value : was_negative ? value.substr(1) : "-" + value;
            changed.items.push_back({kept(std::move(text)), item.line, item.column});
        }
    }
    return changed;
}

}  // namespace tribo::readers::apt
