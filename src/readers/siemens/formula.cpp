// SPDX-License-Identifier: MIT
#include "readers/siemens/formula.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "readers/text/decimal_text.hpp"

namespace tribo::readers::siemens {
namespace {

constexpr int kDeepest = 64;
constexpr std::size_t kLongestText = 400;
constexpr double kLargest = 1e15;  // of whole numbers
constexpr double kSame = 1e-12;    // relative: numbers that count as equal

struct Operator {
    std::string_view word;
    int level;
};
constexpr int kLevels = 8;
constexpr std::array kOperators{
    Operator{"OR", 0},    Operator{"XOR", 1},   Operator{"AND", 2}, Operator{"B_OR", 3},
    Operator{"B_XOR", 4}, Operator{"B_AND", 5}, Operator{"+", 6},   Operator{"-", 6},
    Operator{"*", 7},     Operator{"/", 7},     Operator{"DIV", 7}, Operator{"MOD", 7},
};

bool is_equal(double a, double b) {
    return a == b || std::abs(a - b) <= kSame * std::max(std::abs(a), std::abs(b));
}

long long whole(double value) {
    return static_cast<long long>(std::clamp(std::trunc(value), -kLargest, kLargest));
}

bool is_unknown(const Value& value) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr && std::isnan(*number);
}

double rounded(double value) {
    return std::floor(value + 0.5);
}

double apply(std::string_view op, double a, double b) {
    if (op == "OR") return a != 0 || b != 0;
    if (op == "XOR") return (a != 0) != (b != 0);
    if (op == "AND") return a != 0 && b != 0;
    if (op == "B_OR") return static_cast<double>(whole(a) | whole(b));
    if (op == "B_XOR") return static_cast<double>(whole(a) ^ whole(b));
    if (op == "B_AND") return static_cast<double>(whole(a) & whole(b));
    if (op == "+") return a + b;
    if (op == "-") return a - b;
    if (op == "*") return a * b;
    if (op == "/") return a / b;
    return op == "DIV" ? std::trunc(a / b) : std::fmod(a, b);
}

}  // namespace

bool is_name_character(char c) {
    return is_letter(c) || is_digit(c) || c == '_';
}

std::string name_at(const gcode::Cursor& in) {
    std::string name;
    for (std::size_t i = in.at; i < in.line.size() && is_name_character(in.line[i]); ++i) {
        if (name.empty() && is_digit(in.line[i])) break;
        name += to_upper(in.line[i]);
    }
    return name;
}

Result<std::string> quoted(gcode::Cursor& in) {
    const std::size_t begin = in.at, end = in.line.find('"', begin + 1);
    if (end == std::string_view::npos) return in.refuse(begin, "the text does not close", "add a '\"'");
    in.at = end + 1;
    return std::string(in.line.substr(begin + 1, std::min(end - begin - 1, kLongestText)));
}

std::string text_of(const Value& value) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr ? short_decimal(*number, 6) : std::get<std::string>(value);
}

Result<double> Formula::number_of(const Result<Value>& value, std::size_t at) const {
    if (!value) return std::unexpected(value.error());
    const double* number = std::get_if<double>(&*value);
    if (number == nullptr) return refuse(at, "a text stands where a number belongs", "write a number");
    if (!std::isfinite(*number)) {
        return refuse(at, "only the machine knows " + (unknown_.empty() ? "this value" : "$" + unknown_),
                      "write its value here");
    }
    return *number;
}

Result<double> Formula::number() {
    in_.skip_blanks();
    const std::size_t at = in_.at;
    return number_of(value(), at);
}

Result<std::string> Formula::text() {
    auto found = value();
    if (!found) return std::unexpected(found.error());
    return text_of(*found);
}

// The length of the operator of a level at the cursor; none if another one is there.
std::optional<std::size_t> Formula::operator_at(int level) {
    const char c = in_.peek_after_blanks();
    const std::string name = is_letter(c) ? name_at(in_) : std::string(1, c);
    for (const Operator& known : kOperators) {
        if (known.level == level && known.word == name) return name.size();
    }
    return std::nullopt;
}

Result<Value> Formula::comparison(int depth) {
    if (depth > kDeepest) return refuse(in_.at, "the formula is nested too deeply", "write it in parts");
    auto left = joined(depth);
    while (left) {
        const char c = in_.peek_after_blanks();
        const std::size_t at = in_.at;
        const char next = at + 1 < in_.line.size() ? in_.line[at + 1] : '\0';
        if (c != '<' && c != '>' && !(c == '=' && next == '=')) break;
        const bool two = next == '=' || (c == '<' && next == '>');
        in_.at += two ? 2 : 1;
        const auto right = joined(depth);
        if (!right) return right;
        int order = 0;
        if (std::holds_alternative<std::string>(*left) && std::holds_alternative<std::string>(*right)) {
            order = std::get<std::string>(*left).compare(std::get<std::string>(*right));
        } else {
            const auto a = number_of(left, at), b = number_of(right, at);
            if (!a || !b) return std::unexpected(a ? b.error() : a.error());
            order = is_equal(*a, *b) ? 0 : *a < *b ? -1 : 1;
        }
        const bool holds = c == '='   ? order == 0
                           : c == '<' ? (next == '>'   ? order != 0
                                         : next == '=' ? order <= 0
                                                       : order < 0)
                                      : (next == '=' ? order >= 0 : order > 0);
        left = Value{holds ? 1.0 : 0.0};
    }
    return left;
}

// "T"<<R1
Result<Value> Formula::joined(int depth) {
    auto left = binary(0, depth);
    while (left && in_.peek_after_blanks() == '<' && in_.line.substr(in_.at).starts_with("<<")) {
        const std::size_t at = in_.at;
        in_.at += 2;
        const auto right = binary(0, depth);
        if (!right) return right;
        std::string text = text_of(*left) + text_of(*right);
        if (text.size() > kLongestText) return refuse(at, "the text is too long", "write a shorter one");
        left = Value{std::move(text)};
    }
    return left;
}

Result<Value> Formula::binary(int level, int depth) {
    if (level == kLevels) return unary(depth);
    auto left = binary(level + 1, depth);
    while (left) {
        const auto length = operator_at(level);
        if (!length) break;
        const std::size_t at = in_.at;
        std::string op;
        for (std::size_t i = 0; i < *length; ++i) op += to_upper(in_.line[at + i]);
        in_.at += *length;
        const auto right = binary(level + 1, depth);
        if (!right) return right;
        if (is_unknown(*left) || is_unknown(*right)) {
            left = Value{std::nan("")};
            continue;
        }
        const auto a = number_of(left, at), b = number_of(right, at);
        if (!a || !b) return std::unexpected(a ? b.error() : a.error());
        if ((op == "/" || op == "DIV" || op == "MOD") && *b == 0) {
            return refuse(at, "a division by zero", "correct the formula");
        }
        const double result = apply(op, *a, *b);
        if (!std::isfinite(result)) return refuse(at, "the value is too large", "correct the formula");
        left = Value{result};
    }
    return left;
}

Result<Value> Formula::unary(int depth) {
    if (depth > kDeepest) return refuse(in_.at, "the formula is nested too deeply", "write it in parts");
    const char c = in_.peek_after_blanks();
    const std::size_t at = in_.at;
    const std::string name = is_letter(c) ? name_at(in_) : std::string(1, c);
    if (name != "-" && name != "+" && name != "NOT" && name != "B_NOT") return primary(depth);
    in_.at += name.size();
    const auto inner = unary(depth + 1);
    if (inner && is_unknown(*inner)) return inner;
    const auto operand = number_of(inner, at);
    if (!operand) return std::unexpected(operand.error());
    if (name == "NOT") return Value{*operand == 0 ? 1.0 : 0.0};
    if (name == "B_NOT") return Value{static_cast<double>(~whole(*operand))};
    return Value{name == "-" ? -*operand : *operand};
}

Result<Value> Formula::primary(int depth) {
    const char c = in_.peek_after_blanks();
    const std::size_t at = in_.at;
    if (c == '(') {
        ++in_.at;
        auto inner = comparison(depth + 1);
        if (!inner) return inner;
        if (in_.peek_after_blanks() != ')') return refuse(at, "the parenthesis does not close", "close it");
        ++in_.at;
        return inner;
    }
    if (c == '"') {
        auto text = quoted(in_);
        if (!text) return std::unexpected(text.error());
        return Value{*std::move(text)};
    }
    if (c == '\'') return quoted_number();
    if (is_letter(c) || c == '_' || c == '$') return named(depth);
    std::size_t end = at;
    while (end < in_.line.size() && (is_digit(in_.line[end]) || in_.line[end] == '.')) ++end;
    auto number = readers::number_of(in_.line.substr(at, end - at));
    if (!number) return refuse(at, "a value is missing here", "write a number or a variable");
    in_.at = end;
    // 1.5EX-3
    const bool has_power =
        end + 2 < in_.line.size() && to_upper(in_.line[end]) == 'E' && to_upper(in_.line[end + 1]) == 'X';
    if (!has_power) return Value{*number};
    std::size_t last = end + 2;
    if (in_.line[last] == '-' || in_.line[last] == '+') ++last;
    while (last < in_.line.size() && is_digit(in_.line[last])) ++last;
    const auto power = readers::number_of(in_.line.substr(end + 2, last - end - 2));
    if (!power) return refuse(end, "EX without a number", "write for example 1.5EX3");
    in_.at = last;
    const double value = *number * math::pow(10, std::clamp(*power, -400.0, 400.0));
    if (!std::isfinite(value)) return refuse(at, "the value is too large", "correct the number");
    return Value{value};
}

// 'HFF' and 'B1010'
Result<Value> Formula::quoted_number() {
    const std::size_t at = in_.at, end = in_.line.find('\'', at + 1);
    double value = 0;
    bool good = end != std::string_view::npos && end > at + 2;
    const char kind = good ? to_upper(in_.line[at + 1]) : '\0';
    const int base = kind == 'H' ? 16 : kind == 'B' ? 2 : 0;
    for (std::size_t i = at + 2; good && i < end; ++i) {
        const char c = to_upper(in_.line[i]);
        const int digit = is_digit(c) ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : 99;
        good = digit < base && value < kLargest;
        value = value * base + digit;
    }
    if (!good) return refuse(at, "no number in these quotes", "write for example 'HFF' or 'B101'");
    in_.at = end + 1;
    return Value{value};
}

Result<std::vector<Value>> Formula::indices(int depth) {
    std::vector<Value> found;
    const bool before = std::exchange(takes_names_, true);
    for (;;) {
        auto next = comparison(depth);
        if (!next) return std::unexpected(next.error());
        found.push_back(*std::move(next));
        const char c = in_.peek_after_blanks();
        if (c != ',' && c != ']') return refuse(in_.at, "the bracket does not close", "add a ']'");
        ++in_.at;
        if (c == ']') break;
    }
    takes_names_ = before;
    return found;
}

Result<std::size_t> Formula::element(const Variable& variable, const std::vector<Value>& index,
                                     std::size_t at) const {
    std::size_t place = 0;
    bool good = index.size() <= 2;
    for (std::size_t k = 0; good && k < index.size(); ++k) {
        const double* number = std::get_if<double>(&index[k]);
        good = number != nullptr && *number >= 0 && *number < static_cast<double>(variable.sizes[k]);
        if (good) place = place * variable.sizes[k] + static_cast<std::size_t>(*number);
    }
    if (good && index.size() == 1) place *= variable.sizes[1];
    if (!good) return refuse(at, "the index lies outside of the array", "correct it; indices begin at 0");
    return place;
}

Result<Value> Formula::named(int depth) {
    const std::size_t at = in_.at;
    const bool is_system = in_.peek() == '$';
    if (is_system) {
        while (in_.peek() == '$') ++in_.at;
    }
    const std::string name = name_at(in_);
    in_.at += name.size();
    const std::size_t behind = in_.at;
    const char next = in_.peek_after_blanks();
    std::vector<Value> index;
    if (next == '[') {
        ++in_.at;
        auto found = indices(depth + 1);
        if (!found) return std::unexpected(found.error());
        index = *std::move(found);
    }
    if (is_system) {
        auto value = system_.system_value(name, index);
        if (value) return *std::move(value);
        unknown_ = name.substr(0, 20);
        return Value{std::nan("")};
    }
    if (next == '(') return function(name, at, depth);
    in_.at = next == '[' ? in_.at : behind;
    if (name == "TRUE" || name == "FALSE") return Value{name == "TRUE" ? 1.0 : 0.0};
    const bool is_r =
        name[0] == 'R' &&
        (name.size() == 1 ? index.size() == 1 : std::all_of(name.begin() + 1, name.end(), is_digit));
    if (const Variable* variable = variables_.find(name)) {
        const auto place = element(*variable, index, at);
        if (!place) return std::unexpected(place.error());
        return variable->values[*place];
    }
    if (is_r) {
        const double* given = index.empty() ? nullptr : std::get_if<double>(&index[0]);
        const double number = given != nullptr ? *given : readers::number_of(name.substr(1)).value_or(-1);
        if (!(number >= 0 && number < Variables::kMostR)) {
            return refuse(at, "there is no such R parameter", "use R0 to R9999");
        }
        return Value{variables_.r(static_cast<int>(number))};
    }
    if (takes_names_ && index.empty()) return Value{name};
    return refuse(at, "'" + name.substr(0, 31) + "' is not known", "define it with DEF, or write its value");
}

Result<Value> Formula::function(const std::string& name, std::size_t at, int depth) {
    std::vector<Value> given;
    ++in_.at;
    if (in_.peek_after_blanks() == ')') {
        ++in_.at;
    } else {
        for (;;) {
            auto next = comparison(depth + 1);
            if (!next) return next;
            given.push_back(*std::move(next));
            const char c = in_.peek_after_blanks();
            if (c != ',' && c != ')') return refuse(at, "the parenthesis does not close", "close it");
            ++in_.at;
            if (c == ')') break;
        }
    }
    if (std::any_of(given.begin(), given.end(), is_unknown)) return Value{std::nan("")};
    const auto number = [&](std::size_t i) {
        const double* found = i < given.size() ? std::get_if<double>(&given[i]) : nullptr;
        return found != nullptr ? *found : std::nan("");
    };
    const double a = number(0), b = number(1);
    const std::string text = !given.empty() ? text_of(given[0]) : "";
    const auto refuse_values = [&] {
        return refuse(at, name + " has no value here", "correct what stands in its parentheses");
    };
    const auto finite = [&](double value) -> Result<Value> {
        if (!std::isfinite(value)) return refuse_values();
        return Value{value};
    };
    if (name == "SIN") return finite(math::sin(a * math::kRadPerDeg));
    if (name == "COS") return finite(math::cos(a * math::kRadPerDeg));
    if (name == "TAN") return finite(math::tan(a * math::kRadPerDeg));
    if (name == "ASIN") return finite(math::asin(a) * math::kDegPerRad);
    if (name == "ACOS") return finite(math::acos(a) * math::kDegPerRad);
    if (name == "ATAN") return finite(math::atan(a) * math::kDegPerRad);
    if (name == "ATAN2") return finite(math::atan2(a, b) * math::kDegPerRad);
    if (name == "SQRT") return finite(std::sqrt(a));
    if (name == "POT") return finite(a * a);
    if (name == "ABS") return finite(std::abs(a));
    if (name == "TRUNC") return finite(std::trunc(a));
    if (name == "ROUND") return finite(rounded(a));
    if (name == "ROUNDUP") return finite(std::ceil(a));
    if (name == "LN") return finite(math::log(a));
    if (name == "EXP") return finite(math::exp(a));
    if (name == "MINVAL") return finite(std::min(a, b));
    if (name == "MAXVAL") return finite(std::max(a, b));
    if (name == "BOUND") return finite(std::max(a, std::min(b, number(2))));
    if (name == "NUMBER") {
        const auto value = readers::number_of(trimmed(text));
        return value ? Result<Value>(Value{*value}) : Result<Value>(refuse_values());
    }
    if (name == "ISNUMBER") return Value{readers::number_of(trimmed(text)) ? 1.0 : 0.0};
    if (name == "STRLEN") return Value{static_cast<double>(text.size())};
    if (name == "TOUPPER" || name == "AXNAME" || name == "AXSTRING") {
        std::string upper = text;
        std::transform(upper.begin(), upper.end(), upper.begin(), to_upper);
        return Value{upper};
    }
    if (name == "SUBSTR" && b >= 0) {
        const std::size_t begin = std::min(static_cast<std::size_t>(std::min(b, 1e3)), text.size());
        const double length = given.size() > 2 ? number(2) : 1e3;
        if (!(length >= 0)) return refuse_values();
        return Value{text.substr(begin, static_cast<std::size_t>(std::min(length, 1e3)))};
    }
    if (name == "ISVAR") {
        std::string upper = text;
        std::transform(upper.begin(), upper.end(), upper.begin(), to_upper);
        return Value{variables_.find(upper) != nullptr ? 1.0 : 0.0};
    }
    return refuse(at, "the function " + name.substr(0, 31) + "() is not known", "write its value here");
}

}  // namespace tribo::readers::siemens
