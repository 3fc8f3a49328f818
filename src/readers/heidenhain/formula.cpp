// SPDX-License-Identifier: MIT
// Formulas of Q parameters.
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "readers/heidenhain/line.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

constexpr int kDeepestNesting = 60;

double angle_from_0_to_360(double y, double x) {
    const double degrees = math::atan2(y, x) * math::kDegPerRad;
    return degrees < 0 ? degrees + 360 : degrees;
}

double rounded_toward_zero(double x) {
    return x < 0 ? std::ceil(x) : std::floor(x);
}

}  // namespace

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
        enum { times, over, remainder, length, angle } operation;
        if (take('*')) {
            operation = times;
        } else if (take('/') || take("DIV")) {
            operation = over;
        } else if (take('%')) {
            operation = remainder;
        } else if (take("LEN")) {
            operation = length;
        } else if (take("ANG")) {
            operation = angle;
        } else {
            return value;
        }
        const auto next = power(depth);
        if (!next) return next;
        if ((operation == over || operation == remainder) && *next == 0)
            return refuse(start, "division by zero", "correct the parameters");
        value = operation == times       ? *value * *next
                : operation == over      ? *value / *next
                : operation == remainder ? *value - *next * std::trunc(*value / *next)
                : operation == length    ? math::hypot(*value, *next)
                                         : angle_from_0_to_360(*value, *next);
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
    while ((is_letter(peek()) || peek() == '_')) ++at_;
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

}  // namespace tribo::readers::heidenhain
