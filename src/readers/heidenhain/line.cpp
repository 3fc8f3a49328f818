// SPDX-License-Identifier: MIT
#include "readers/heidenhain/line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr int kDeepestNesting = 60;
// Longest number, digits. No control writes half as many.
constexpr std::size_t kLongestNumber = 64;
constexpr double kLargestNumber = 1e15;

bool is_word(char c) {
    return is_letter(c) || c == '_';
}

double rounded_toward_zero(double x) {
    return x < 0 ? std::ceil(x) : std::floor(x);
}

}  // namespace

Line line_of(std::string_view text, int number) {
    Line line;
    line.number = number;
    std::string_view whole = trimmed(text);
    line.goes_on = whole.ends_with('~');
    if (line.goes_on) whole.remove_suffix(1);
    bool quoted = false;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        if (whole[i] == '"') quoted = !quoted;
        if (whole[i] != ';' || quoted) continue;
        whole = whole.substr(0, i);
        break;
    }
    // A block number is digits and a blank.
    std::size_t digits = 0;
    while (digits < whole.size() && is_digit(whole[digits])) ++digits;
    if (digits > 0 && (digits == whole.size() || is_blank(whole[digits]))) whole.remove_prefix(digits);
    whole = trimmed(whole);
    line.text = whole;
    line.column = whole.empty() ? 1 : static_cast<int>(whole.data() - text.data()) + 1;
    return line;
}

std::unexpected<Error> LineReader::refuse(int column, std::string cause, std::string remedy) const {
    return fail_at(source_name_, line_.number, column, std::move(cause), std::move(remedy));
}

Result<void> LineReader::in_range(const Limit& limit, double value, int column) const {
    if (limit.range.contains(value)) return {};
    return refuse(column, out_of_range(limit, value), range_remedy(limit));
}

void LineReader::skip_blanks() {
    while (is_blank(peek())) ++at_;
}

bool LineReader::at_end() {
    skip_blanks();
    return at_ >= line_.text.size();
}

int LineReader::column() {
    skip_blanks();
    return line_.column + static_cast<int>(at_);
}

bool LineReader::take(std::string_view word) {
    skip_blanks();
    if (line_.text.size() - at_ < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (to_upper(line_.text[at_ + i]) != word[i]) return false;
    }
    const std::size_t after = at_ + word.size();
    if (is_word(word.back()) && after < line_.text.size() && is_word(line_.text[after])) return false;
    at_ = after;
    return true;
}

bool LineReader::take(char character) {
    skip_blanks();
    if (peek() != character) return false;
    ++at_;
    return true;
}

Result<std::optional<int>> LineReader::parameter() {
    skip_blanks();
    if (to_upper(peek()) != 'Q' || at_ + 1 >= line_.text.size()) return std::nullopt;
    const char next = to_upper(line_.text[at_ + 1]);
    const int start = column();
    if ((next == 'L' || next == 'R' || next == 'S') && at_ + 2 < line_.text.size() &&
        is_digit(line_.text[at_ + 2])) {
        return refuse(start, std::string("parameters Q") + next + " are not read yet", "use Q parameters");
    }
    if (!is_digit(next)) return std::nullopt;
    ++at_;
    int index = 0;
    while (is_digit(peek())) {
        if (index < kParameters) index = 10 * index + (peek() - '0');
        ++at_;
    }
    if (!Parameters::has(index))
        return refuse(start, "there is no parameter beyond Q1999", "correct its number");
    return index;
}

Result<std::optional<double>> LineReader::number() {
    skip_blanks();
    const std::size_t start = at_;
    double sign = 1;
    if (peek() == '+' || peek() == '-') {
        sign = peek() == '-' ? -1 : 1;
        ++at_;
        skip_blanks();
    }
    const auto q = parameter();
    if (!q) return std::unexpected(q.error());
    if (*q) {
        skip_blanks();
        if (peek() != '=') return sign * parameters_.get(**q);
        at_ = start;  // Q200=2 of a cycle is a separate word
        return std::nullopt;
    }
    // The decimal sign may be a comma.
    std::array<char, kLongestNumber> digits{};
    std::size_t count = 0;
    while (is_digit(peek()) || peek() == '.' || peek() == ',') {
        if (count == digits.size()) return refuse(column(), "the number has too many digits", "shorten it");
        digits[count++] = peek() == ',' ? '.' : peek();
        ++at_;
    }
    double value = 0;
    const std::string_view text(digits.data(), count);
    if (count == 0) {
        at_ = start;
        return std::nullopt;
    }
    if (parse_decimal(text, value, DecimalExponent::none) != count || value > kLargestNumber) {
        at_ = start;
        return refuse(column(), "'" + std::string(text) + "' is no number", "correct it");
    }
    return sign * value;
}

Result<double> LineReader::formula() {
    return sum(0);
}

Result<double> LineReader::sum(int depth) {
    auto value = product(depth);
    if (!value) return value;
    for (;;) {
        const bool plus = take('+');
        if (!plus && !take('-')) return value;
        const auto next = product(depth);
        if (!next) return next;
        value = plus ? *value + *next : *value - *next;
    }
}

Result<double> LineReader::product(int depth) {
    auto value = power(depth);
    if (!value) return value;
    for (;;) {
        const int start = column();
        enum { times, over, length, angle } operation;
        if (take('*')) {
            operation = times;
        } else if (take('/') || take("DIV")) {
            operation = over;
        } else if (take("LEN")) {
            operation = length;
        } else if (take("ANG")) {
            operation = angle;
        } else {
            return value;
        }
        const auto next = power(depth);
        if (!next) return next;
        if (operation == over && *next == 0)
            return refuse(start, "division by zero", "correct the parameters");
        value = operation == times    ? *value * *next
                : operation == over   ? *value / *next
                : operation == length ? math::hypot(*value, *next)
                                      : math::atan2(*value, *next) * math::kDegPerRad;
    }
}

Result<double> LineReader::power(int depth) {
    auto value = factor(depth);
    if (!value) return value;
    while (take('^')) {
        const auto next = factor(depth);
        if (!next) return next;
        value = math::pow(*value, *next);
    }
    if (!std::isfinite(*value)) return refuse(column(), "the result is no number", "correct the parameters");
    return value;
}

Result<double> LineReader::factor(int depth) {
    if (depth > kDeepestNesting) return refuse(column(), "the formula is nested too deeply", "split it");
    if (take('(')) {
        const auto value = sum(depth + 1);
        if (!value) return value;
        if (!take(')')) return refuse(column(), "a ')' is missing", "close the parenthesis");
        return value;
    }
    skip_blanks();
    const std::size_t start = at_;
    if (peek() == '+' || peek() == '-') {
        const bool minus = peek() == '-';
        ++at_;
        const auto value = factor(depth + 1);
        if (!value) return value;
        return minus ? -*value : *value;
    }
    const auto plain = number();
    if (!plain) return std::unexpected(plain.error());
    if (*plain) return **plain;
    while (is_word(peek())) ++at_;
    std::string name(line_.text.substr(start, at_ - start));
    std::transform(name.begin(), name.end(), name.begin(), to_upper);
    if (name.empty()) {
        return refuse(column(), at_end() ? "a number is missing" : shown_character(peek()) + " is no number",
                      "write a number, a Q parameter or a function");
    }
    if (name == "PI") return math::kPi;
    at_ = start;
    const int place = column();
    at_ += name.size();
    const auto argument = factor(depth + 1);
    if (!argument) return argument;
    const double x = *argument, rad = x * math::kRadPerDeg;
    double value = 0;
    if (name == "SIN")
        value = math::sin(rad);
    else if (name == "COS")
        value = math::cos(rad);
    else if (name == "TAN")
        value = math::tan(rad);
    else if (name == "ASIN")
        value = math::asin(x) * math::kDegPerRad;
    else if (name == "ACOS")
        value = math::acos(x) * math::kDegPerRad;
    else if (name == "ATAN")
        value = math::atan(x) * math::kDegPerRad;
    else if (name == "SQRT")
        value = std::sqrt(x);
    else if (name == "SQ")
        value = x * x;
    else if (name == "LN")
        value = math::log(x);
    else if (name == "LOG")
        value = math::log10(x);
    else if (name == "EXP")
        value = math::exp(x);
    else if (name == "NEG")
        value = -x;
    else if (name == "ABS")
        value = std::abs(x);
    else if (name == "INT")
        value = rounded_toward_zero(x);
    else if (name == "FRAC")
        value = x - rounded_toward_zero(x);
    else if (name == "SGN")
        value = x > 0 ? 1 : x < 0 ? -1 : 0;
    else
        return refuse(place, "the function " + name + " is not known", "use SIN, COS, SQRT, ABS ...");
    if (!std::isfinite(value)) return refuse(place, name + " has no value here", "correct its argument");
    return value;
}

Result<std::string> LineReader::label() {
    skip_blanks();
    const int start = column();
    if (peek() == '"') {
        const std::size_t end = line_.text.find('"', at_ + 1);
        if (end == std::string_view::npos) return refuse(start, "the name has no second quote", "close it");
        std::string name(line_.text.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return "\"" + name;
    }
    const auto value = number();
    if (!value) return std::unexpected(value.error());
    constexpr double most = 65535;
    if (!*value || **value < 0 || **value > most || **value != std::floor(**value)) {
        return refuse(start, "a label's number is missing", "write LBL 1 to LBL 65535, or a name in quotes");
    }
    return std::to_string(static_cast<int>(**value));
}

Result<std::optional<Item>> LineReader::item() {
    if (at_end()) return std::nullopt;
    Item item;
    item.column = column();
    const std::size_t start = at_;
    if (peek() == '"') {
        const auto name = label();
        if (!name) return std::unexpected(name.error());
        item.name = *name;
        return item;
    }
    while (is_word(peek())) ++at_;
    // FQ5 and X+Q5: the parameter is the value, not a part of the word.
    if (at_ - start > 1 && to_upper(line_.text[at_ - 1]) == 'Q' && is_digit(peek())) --at_;
    for (std::size_t i = start; i < at_; ++i) item.name += to_upper(line_.text[i]);
    if (item.name == "Q" && is_digit(peek())) {
        at_ = start;
        const auto index = parameter();
        if (!index) return std::unexpected(index.error());
        item.value = **index;
        if (!take('=')) {
            at_ = start;
            return refuse(item.column, "a parameter without a word before it", "write for example X+Q1");
        }
        item.name = "Q" + std::to_string(**index);
        item.parameter = **index;
        for (const std::string_view word : {"FAUTO", "FMAX"}) {
            if (take(word)) item.word = word;
        }
        if (!item.word.empty()) {
            item.value.reset();
            return item;
        }
        const auto value = number();
        if (!value) return std::unexpected(value.error());
        if (!*value) return refuse(column(), "a parameter without a value", "write a number after '='");
        item.value = **value;
        return item;
    }
    const auto value = number();
    if (!value) return std::unexpected(value.error());
    item.value = *value;
    if (!item.value && (peek() == '+' || peek() == '-')) item.sign = peek() == '+' ? 1 : -1, ++at_;
    if (item.name.empty() && !item.value) {
        return refuse(item.column, shown_character(line_.text[start]) + " does not belong into a block",
                      "delete it");
    }
    return item;
}

Result<void> LineReader::items(std::vector<Item>& items) {
    for (;;) {
        auto next = item();
        if (!next) return std::unexpected(next.error());
        if (!*next) return {};
        items.push_back(**std::move(next));
    }
}

}  // namespace tribo::readers::heidenhain
