// SPDX-License-Identifier: MIT
#include "readers/apt/formula.hpp"

#include <array>
#include <cmath>

#include "base/math.hpp"
#include "base/text/decimal.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::apt {
namespace {

constexpr int kDeepest = 60;

struct Function {
    std::string_view name;
    double (*of)(double);
};
constexpr std::array kFunctions{
    Function{"SINF", [](double x) { return math::sin(x * math::kRadPerDeg); }},
    Function{"COSF", [](double x) { return math::cos(x * math::kRadPerDeg); }},
    Function{"TANF", [](double x) { return math::tan(x * math::kRadPerDeg); }},
    Function{"ASINF", [](double x) { return math::asin(x) * math::kDegPerRad; }},
    Function{"ACOSF", [](double x) { return math::acos(x) * math::kDegPerRad; }},
    Function{"ATANF", [](double x) { return math::atan(x) * math::kDegPerRad; }},
    Function{"SQRTF", [](double x) { return std::sqrt(x); }},
    Function{"ABSF", [](double x) { return std::abs(x); }},
    Function{"EXPF", [](double x) { return math::exp(x); }},
    Function{"LOGF", [](double x) { return math::log(x); }},
    Function{"INTF", [](double x) { return x < 0 ? std::ceil(x) : std::floor(x); }},
};

struct Comparison {
    std::string_view word;
    bool (*holds)(double difference);
};
constexpr std::array kComparisons{
    Comparison{".LT.", [](double d) { return d < -kEqualValues; }},
    Comparison{".LE.", [](double d) { return d <= kEqualValues; }},
    Comparison{".EQ.", [](double d) { return std::abs(d) <= kEqualValues; }},
    Comparison{".NE.", [](double d) { return std::abs(d) > kEqualValues; }},
    Comparison{".GE.", [](double d) { return d >= -kEqualValues; }},
    Comparison{".GT.", [](double d) { return d > kEqualValues; }},
};

using Value = std::optional<double>;

class FormulaReader {
  public:
    FormulaReader(std::string text, const std::function<Value(const std::string&)>& value_of_name)
        : text_(std::move(text)), value_of_name_(value_of_name) {}

    Value read() {
        const Value value = either();
        return at_ == text_.size() ? value : Value{};
    }

  private:
    static Value finite(Value value) { return value && std::isfinite(*value) ? value : Value{}; }

    bool take(std::string_view word) {
        if (!std::string_view(text_).substr(at_).starts_with(word)) return false;
        at_ += word.size();
        return true;
    }

    Value either() {
        if (++depth_ > kDeepest) return {};
        Value value = both();
        while (value && take(".OR.")) {
            const Value next = both();
            if (!next) return {};
            value = *value != 0 || *next != 0;
        }
        --depth_;
        return value;
    }

    Value both() {
        Value value = comparison();
        while (value && take(".AND.")) {
            const Value next = comparison();
            if (!next) return {};
            value = *value != 0 && *next != 0;
        }
        return value;
    }

    Value comparison() {
        if (take(".NOT.")) {
            if (++depth_ > kDeepest) return {};
            const Value value = comparison();
            --depth_;
            return value ? Value(*value == 0) : value;
        }
        const Value value = finite(sum());
        if (!value) return {};
        for (const Comparison& one : kComparisons) {
            if (!take(one.word)) continue;
            const Value other = finite(sum());
            return other ? Value(one.holds(*value - *other)) : other;
        }
        return value;
    }

    Value sum() {
        // The sign before a sum is that of its first product: -2**2 is -4.
        const bool negative = take("-");
        if (!negative) take("+");
        Value value = product();
        if (value && negative) value = -*value;
        while (value) {
            const bool plus = take("+");
            if (!plus && !take("-")) break;
            const Value next = product();
            if (!next) return {};
            value = plus ? *value + *next : *value - *next;
        }
        return value;
    }

    Value product() {
        Value value = power();
        while (value) {
            const bool times = at_ + 1 < text_.size() && text_[at_] == '*' && text_[at_ + 1] != '*';
            if (!times && !(at_ < text_.size() && text_[at_] == '/')) break;
            ++at_;
            const Value next = power();
            if (!next) return {};
            value = times ? *value * *next : *value / *next;
        }
        return value;
    }

    Value power() {
        if (++depth_ > kDeepest) return {};
        Value value = operand();
        if (value && take("**")) {
            const bool negative = take("-");
            const Value exponent = power();
            if (!exponent) return {};
            value = math::pow(*value, negative ? -*exponent : *exponent);
        }
        --depth_;
        return value;
    }

    Value operand() {
        if (take("(")) {
            const Value value = either();
            return value && take(")") ? value : Value{};
        }
        if (at_ >= text_.size()) return {};
        if (is_digit(text_[at_]) || text_[at_] == '.') return number();
        std::string name;
        while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_'))
            name += text_[at_++];
        if (name.empty()) return {};
        for (const Function& function : kFunctions) {
            if (name != function.name || !take("(")) continue;
            const Value value = either();
            return value && take(")") ? Value(function.of(*value)) : Value{};
        }
        return value_of_name_(name);
    }

    // The point of 5.LT.X belongs to the comparison.
    Value number() {
        std::string_view rest = std::string_view(text_).substr(at_);
        const std::size_t point = rest.find('.');
        if (point != std::string_view::npos && point + 2 < rest.size() && is_letter(rest[point + 1]) &&
            is_letter(rest[point + 2]))
            rest = rest.substr(0, point);
        double value = 0;
        const std::size_t read = parse_decimal(rest, value);
        at_ += read;
        return read > 0 ? Value(value) : Value{};
    }

    std::string text_;
    const std::function<Value(const std::string&)>& value_of_name_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

std::optional<double> value_of(
    std::string_view formula,
    const std::function<std::optional<double>(const std::string& name)>& value_of_name) {
    std::string text;
    for (const char c : formula) {
        if (!is_blank(c)) text += to_upper(c);
    }
    return FormulaReader(std::move(text), value_of_name).read();
}

}  // namespace tribo::readers::apt
