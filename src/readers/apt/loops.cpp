// SPDX-License-Identifier: MIT
#include "readers/apt/loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "readers/apt/formula.hpp"
#include "readers/apt/procedures.hpp"

namespace tribo::readers::apt {
namespace {

constexpr const char* kWriteIf = "write IF (A-5) L1,L2,L3 or IF (A .LT. 5) JUMPTO/L1";

// The place behind the bracket that closes the first one; npos: there is none.
std::size_t end_of_brackets(std::string_view text) {
    int open = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '(') ++open;
        if (text[at] == ')' && --open == 0) return at + 1;
        if (open == 0 && !is_blank(text[at])) break;
    }
    return std::string_view::npos;
}

}  // namespace

std::string upper(std::string_view text) {
    std::string out(trimmed(text));
    std::transform(out.begin(), out.end(), out.begin(), to_upper);
    return out;
}

std::string whole(const Statement& statement) {
    std::string text(statement.word.text);
    for (std::size_t i = 0; i < statement.items.size(); ++i) {
        text += i == 0 ? '/' : ',';
        text += statement.items[i].text;
    }
    return text;
}

bool is_jump(std::string_view word) {
    if (matches(word, "JUMPTO")) return true;
    return word.size() > 2 && matches(word.substr(0, 2), "IF") && trimmed(word.substr(2)).starts_with('(');
}

std::string take_label(Statement& statement) {
    std::string_view& text = statement.word.text;
    std::size_t end = 0;
    while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
    if (end == 0 || end == text.size() || text[end] != ')') return {};
    std::string label = upper(text.substr(0, end));
    const std::string_view rest = trimmed(text.substr(end + 1));
    statement.word.column += static_cast<int>(rest.empty() ? 0 : rest.data() - text.data());
    text = rest;
    return label;
}

std::optional<double> Procedures::value(std::string_view formula) const {
    return value_of(formula, [&](const std::string& name) -> std::optional<double> {
        const auto known = names_.find(name);
        if (known == names_.end() || known->second.size() != 1) return {};
        return number_of(known->second[0]);
    });
}

Result<void> Procedures::run_block(const std::vector<Statement>& statements, double unit_mm, const Run& run) {
    std::map<std::string, std::size_t> labels;
    for (std::size_t i = 0; i < statements.size(); ++i) {
        Statement statement = statements[i];
        if (statement.is_text || statement.is_header) continue;
        const std::string label = take_label(statement);
        if (label.empty() || labels.emplace(label, i).second) continue;
        return report_.refuse(statements[i].word, "the label " + label + " stands twice",
                              "give each label once");
    }
    const bool outside = std::exchange(in_block_, true);
    Result<void> done;
    // The search for labels costs as much as a run of each statement.
    count_ += statements.size();
    for (std::size_t i = 0; i < statements.size() && done;) {
        const Statement& statement = statements[i++];
        if (++count_ > most_statements_) {
            done = refuse_more_statements(statement.word);
            break;
        }
        const auto jump = run_in_block(statement, unit_mm, run);
        if (!jump) {
            done = std::unexpected(jump.error());
        } else if (!jump->empty()) {
            const auto found = labels.find(*jump);
            if (found == labels.end()) {
                done = report_.refuse(
                    statement.word, "a jump to " + *jump + ", which is no label here",
                    "write the label before a statement of the same loop or macro: " + *jump + ")");
            } else {
                i = found->second;
            }
        }
    }
    in_block_ = outside;
    return done;
}

Result<std::string> Procedures::run_in_block(const Statement& written, double unit_mm, const Run& run) {
    Statement statement = written;
    const bool is_plain = statement.is_text || statement.is_header;
    if (!is_plain && defining_.empty()) {
        take_label(statement);
        const std::string_view word = statement.word.text;
        if (word.empty() || matches(word, "LOOPST") || matches(word, "LOOPND")) return std::string();
        if (matches(word, "JUMPTO")) {
            if (statement.items.size() == 1 && !statement.items[0].text.empty())
                return upper(statement.items[0].text);
            return report_.refuse(statement.word, "JUMPTO without its label", "write JUMPTO/ and a label");
        }
        if (is_jump(word)) return run_if(statement, unit_mm, run);
    }
    if (auto done = take(statement, unit_mm, run); !done) return std::unexpected(done.error());
    return std::string();
}

Result<std::string> Procedures::run_if(const Statement& statement, double unit_mm, const Run& run) {
    const std::string_view text = kept(whole(statement));
    const std::string_view behind_word = trimmed(text.substr(2));
    const std::size_t end = end_of_brackets(behind_word);
    const auto condition = end == std::string_view::npos ? std::nullopt : value(behind_word.substr(0, end));
    if (!condition) {
        return report_.refuse(statement.word, "IF without a formula in brackets whose names have values",
                              kWriteIf);
    }
    const std::string_view then = trimmed(behind_word.substr(end));
    if (then.empty() || matches(then, "THEN"))
        return report_.refuse(statement.word, "IF without labels and without a statement", kWriteIf);
    if (std::count(then.begin(), then.end(), ',') == 2 && then.find('/') == std::string_view::npos) {
        const std::size_t first = then.find(','), second = then.rfind(',');
        if (*condition < -kEqualValues) return upper(then.substr(0, first));
        if (*condition > kEqualValues) return upper(then.substr(second + 1));
        return upper(then.substr(first + 1, second - first - 1));
    }
    if (*condition == 0) return std::string();
    Lexer lexer(then, {});
    Statement inner;
    if (const auto found = lexer.next(inner);
        !found || !*found || (is_jump(inner.word.text) && !matches(inner.word.text, "JUMPTO")))
        return report_.refuse(statement.word, "IF without labels and without a statement", kWriteIf);
    inner.word = {inner.word.text, statement.word.line, statement.word.column};
    for (Item& item : inner.items) item = {item.text, statement.word.line, statement.word.column};
    return run_in_block(inner, unit_mm, run);
}

}  // namespace tribo::readers::apt
