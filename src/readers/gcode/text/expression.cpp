// SPDX-License-Identifier: MIT
#include "readers/gcode/text/expression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/math.hpp"

namespace tribo::readers::gcode {
namespace {

bool is_vacant(double value) {
    return std::isnan(value);
}
double number_or_0(double value) {
    return is_vacant(value) ? 0 : value;
}

// Largest depth of brackets, functions, signs and '#'.
constexpr int kDeepestNesting = 60;
// Largest difference from a whole number where one is required; also the tolerance of EQ (LinuxCNC).
constexpr double kWholeTolerance = 1e-4, kEqualTolerance = 1e-4;

enum class Function { abs, acos, asin, atan, cos, exists, exp, fix, fup, ln, pow, round, sin, sqrt, tan };
enum class Operator {
    none,
    power,
    times,
    over,
    modulo,
    plus,
    minus,
    eq,
    ne,
    gt,
    ge,
    lt,
    le,
    and_,
    or_,
    xor_
};

template <class What>
struct Named {
    std::string_view name;
    What what;
};
constexpr Named<Function> kFunctions[] = {
    {"ABS", Function::abs},   {"ACOS", Function::acos}, {"ASIN", Function::asin},
    {"ATAN", Function::atan}, {"COS", Function::cos},   {"EXISTS", Function::exists},
    {"EXP", Function::exp},   {"FIX", Function::fix},   {"FUP", Function::fup},
    {"LN", Function::ln},     {"POW", Function::pow},   {"ROUND", Function::round},
    {"SIN", Function::sin},   {"SQRT", Function::sqrt}, {"TAN", Function::tan},
};
constexpr std::size_t kAbbreviation = 2;
// If two names start alike, the longer one comes first.
constexpr Named<Operator> kOperators[] = {
    {"**", Operator::power}, {"*", Operator::times}, {"/", Operator::over},   {"MOD", Operator::modulo},
    {"+", Operator::plus},   {"-", Operator::minus}, {"EQ", Operator::eq},    {"NE", Operator::ne},
    {"GT", Operator::gt},    {"GE", Operator::ge},   {"LT", Operator::lt},    {"LE", Operator::le},
    {"AND", Operator::and_}, {"OR", Operator::or_},  {"XOR", Operator::xor_},
};

// `logic_is_arithmetic`: AND binds as a product does, OR and XOR as a sum (Fanuc, B-63944, custom macro).
int precedence(Operator op, bool logic_is_arithmetic) {
    if (op == Operator::none) return 0;
    if (op == Operator::power) return 5;
    if (op <= Operator::modulo || (logic_is_arithmetic && op == Operator::and_)) return 4;
    if (op <= Operator::minus || (logic_is_arithmetic && op > Operator::and_)) return 3;
    return op <= Operator::le ? 2 : 1;
}

bool stands_here(const Cursor& cursor, std::string_view name) {
    if (cursor.line.size() - cursor.at < name.size()) return false;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (to_upper(cursor.line[cursor.at + i]) != name[i]) return false;
    }
    return true;
}

class ExpressionReader {
  public:
    ExpressionReader(Cursor& cursor, const Parameters& parameters, double round_to)
        : cursor_(cursor), parameters_(parameters), round_to_(round_to) {}

    Result<double> value() {
        if (++depth_ > kDeepestNesting) {
            return cursor_.refuse(cursor_.at, "an expression is nested more than 60 deep",
                                  "compute it in steps, with parameters for the parts");
        }
        Result<double> read = value_here();
        --depth_;
        return read;
    }

    // Operators without brackets around them.
    Result<double> formula() {
        const bool before =
            std::exchange(logic_is_arithmetic_, parameters_.is_fanuc() && comparisons_ahead() < 2);
        auto read = operation(1);
        logic_is_arithmetic_ = before;
        return read;
    }

    Result<void> parameter_name(ParameterName& read) {
        const std::size_t start = cursor_.at++;  // '#'
        read.number = 0;
        read.name.clear();
        if (cursor_.peek_after_blanks() == '<') return read_angled_name(cursor_, read.name);
        const auto number = value();
        if (!number) return std::unexpected(number.error());
        const double whole = std::floor(*number + 0.5);
        const bool is_whole = std::abs(*number - whole) <= kWholeTolerance;
        if (!is_whole || !(whole >= parameters_.first()) || whole > parameters_.last()) {
            return cursor_.refuse(start,
                                  "the number of a parameter is not a whole one from 1 to " +
                                      std::to_string(parameters_.last()),
                                  "correct it");
        }
        read.number = static_cast<int>(whole);
        return {};
    }

  private:
    Result<double> value_here() {
        const char c = cursor_.peek_after_blanks();
        const std::size_t start = cursor_.at;
        if (c == '[') return bracket();
        if (c == '#') return parameter();
        if (c == '-' || c == '+') {
            ++cursor_.at;
            auto read = value();
            if (read) *read = c == '-' ? -number_or_0(*read) : number_or_0(*read);
            return read;
        }
        if (is_letter(c)) return function();
        const auto digits = read_digits(cursor_, start);
        if (!digits) return std::unexpected(digits.error());
        if (*digits) return **digits;
        return cursor_.refuse(start, "a number is missing here",
                              "write digits, a #parameter, a function or an [expression]");
    }

    Result<double> parameter() {
        const std::size_t start = cursor_.at;
        ParameterName name;
        if (auto read = parameter_name(name); !read) return std::unexpected(read.error());
        auto got = name.name.empty() ? parameters_.get(name.number) : parameters_.get(name.name);
        if (got) return got;
        return cursor_.refuse(start, std::move(got.error().cause), std::move(got.error().remedy));
    }

    Result<double> bracket() {
        const std::size_t open = cursor_.at++;
        pass_comments();
        auto read = formula();
        if (!read) return read;
        if (cursor_.peek_after_blanks() != ']') {
            return cursor_.at >= cursor_.line.size()
                       ? cursor_.refuse(open, "a '[' is not closed on this line", "add the missing ']'")
                       : cursor_.refuse(
                             cursor_.at,
                             shown_character(cursor_.peek()) +
                                 " is neither an operator nor the end of the expression",
                             "write an operator (+ - * / ** MOD EQ NE GT GE LT LE AND OR XOR) or ']'");
        }
        ++cursor_.at;
        return read;
    }

    // A Fanuc control skips what stands between ( and ) anywhere, also within brackets.
    void pass_comments() {
        while (depth_ > 0 && parameters_.is_fanuc() && cursor_.peek_after_blanks() == '(') {
            const std::size_t close = cursor_.line.find(')', cursor_.at);
            if (close == std::string_view::npos) return;
            cursor_.at = close + 1;
        }
    }

    // Evaluates operators of at least this precedence.
    Result<double> operation(int least) {
        auto left = value();
        if (!left) return left;
        for (;;) {
            pass_comments();
            cursor_.skip_blanks();
            const std::size_t start = cursor_.at;
            const Operator op = peek_operator();
            const int binds = precedence(op, logic_is_arithmetic_);
            if (binds < least) return left;
            for (const auto& named : kOperators) {
                if (named.what == op) cursor_.at += named.name.size();
            }
            auto right = operation(binds + 1);
            if (!right) return right;
            left = applied(op, *left, *right, start);
            if (!left) return left;
        }
    }

    // Comparisons up to the end of the bracket at the cursor, without those in brackets of their own. Fanuc
    // controls take one; two side by side are joined by AND, OR or XOR.
    int comparisons_ahead() const {
        int count = 0, depth = 0;
        for (Cursor ahead = cursor_; ahead.at < ahead.line.size() && depth >= 0; ++ahead.at) {
            const char c = ahead.peek();
            depth += c == '[' ? 1 : c == ']' ? -1 : 0;
            if (c == '(') ahead.at = std::min(ahead.line.find(')', ahead.at), ahead.line.size() - 1);
            count += depth == 0 && precedence(operator_at(ahead), true) == 2 ? 1 : 0;
        }
        return count;
    }

    Operator peek_operator() const { return operator_at(cursor_); }

    static Operator operator_at(const Cursor& cursor) {
        for (const auto& named : kOperators) {
            if (stands_here(cursor, named.name)) return named.what;
        }
        return Operator::none;
    }

    Result<double> applied(Operator op, double a, double b, std::size_t start) const {
        const auto truth = [](bool is) { return is ? 1.0 : 0.0; };
        // A vacant variable equals only another one; elsewhere it counts as 0.
        if (is_vacant(a) != is_vacant(b) && (op == Operator::eq || op == Operator::ne)) {
            return truth(op == Operator::ne);
        }
        a = number_or_0(a);
        b = number_or_0(b);
        switch (op) {
            case Operator::power:
                return finite(math::pow(a, b), start, "a power without a real value",
                              "raise only positive numbers to broken powers");
            case Operator::times:
                return finite(a * b, start, "a product too large for a number", "correct the expression");
            case Operator::over:
                return finite(a / b, start, "a division by zero", "test the divisor before");
            case Operator::modulo: {
                // Fanuc: of whole numbers, with the sign of the first.
                if (parameters_.is_fanuc()) {
                    a = std::round(a);
                    b = std::round(b);
                }
                if (b == 0) return finite(a / b, start, "a division by zero", "test the divisor before");
                const double rest = std::fmod(a, b);
                return rest < 0 && !parameters_.is_fanuc() ? rest + std::abs(b) : rest;
            }
            case Operator::plus:
            case Operator::minus:
                return finite(op == Operator::plus ? a + b : a - b, start, "a sum too large for a number",
                              "correct the expression");
            case Operator::eq:
                return truth(std::abs(a - b) < kEqualTolerance);
            case Operator::ne:
                return truth(!(std::abs(a - b) < kEqualTolerance));
            case Operator::gt:
                return truth(a > b);
            case Operator::ge:
                return truth(a >= b);
            case Operator::lt:
                return truth(a < b);
            case Operator::le:
                return truth(a <= b);
            default:
                return parameters_.is_fanuc() ? of_bits(op, a, b) : truth(of_truths(op, a != 0, b != 0));
        }
    }

    static bool of_truths(Operator op, bool a, bool b) {
        return op == Operator::and_ ? a && b : op == Operator::or_ ? a || b : a != b;
    }

    // Fanuc and Haas: of the bits of the whole parts.
    static double of_bits(Operator op, double a, double b) {
        const auto bits = [](double v) { return static_cast<std::int32_t>(std::clamp(v, -2e9, 2e9)); };
        const std::int32_t first = bits(a), second = bits(b);
        return op == Operator::and_ ? first & second : op == Operator::or_ ? first | second : first ^ second;
    }

    // Fanuc controls know a function by the first two letters before its bracket, too.
    bool is_abbreviated(std::string_view name) const {
        Cursor ahead = cursor_;
        if (!parameters_.is_fanuc() || !stands_here(ahead, name.substr(0, kAbbreviation))) return false;
        ahead.at += kAbbreviation;
        return ahead.peek_after_blanks() == '[';
    }

    Result<double> function() {
        const std::size_t start = cursor_.at;
        const Named<Function>* found = nullptr;
        std::size_t length = 0;
        for (const auto& named : kFunctions) {
            if (stands_here(cursor_, named.name)) {
                found = &named;
                length = named.name.size();
            } else if (found == nullptr && is_abbreviated(named.name)) {
                found = &named;
                length = kAbbreviation;
            }
        }
        cursor_.at += length;
        if (found == nullptr || cursor_.peek_after_blanks() != '[') {
            return cursor_.refuse(start, "this is neither a number nor a function with its [argument]",
                                  "use ABS ACOS ASIN ATAN COS EXISTS EXP FIX FUP LN ROUND SIN SQRT TAN");
        }
        if (found->what == Function::exists) return existence();
        if (parameters_.is_fanuc() && (found->what == Function::atan || found->what == Function::pow)) {
            return of_two(found->what, start);
        }
        auto x = bracket();
        if (!x) return x;
        *x = number_or_0(*x);
        if (found->what == Function::atan) return arc_tangent(*x);
        if (found->what == Function::pow) {
            return cursor_.refuse(start, "POW is a function of Fanuc controls", "write [a ** b]");
        }
        if (parameters_.is_fanuc() && found->what == Function::fix) return std::trunc(*x);
        if (parameters_.is_fanuc() && found->what == Function::fup) {
            return *x < 0 ? std::floor(*x) : std::ceil(*x);
        }
        return finite(called(found->what, *x), start,
                      "a function has no value there: " + std::string(found->name),
                      "keep SQRT and LN above 0, ASIN and ACOS within 1");
    }

    Result<double> finite(double value, std::size_t start, std::string cause, std::string remedy) const {
        if (std::isfinite(value)) return value;
        return cursor_.refuse(start, std::move(cause), std::move(remedy));
    }

    // EXISTS[#<name>]
    Result<double> existence() {
        const std::size_t open = cursor_.at++;
        ParameterName name;
        if (cursor_.peek_after_blanks() != '#') {
            return cursor_.refuse(open, "EXISTS asks for a parameter", "write EXISTS[#<name>]");
        }
        if (auto read = parameter_name(name); !read) return std::unexpected(read.error());
        if (name.name.empty()) {
            return cursor_.refuse(open, "EXISTS asks for a parameter with a name", "write EXISTS[#<name>]");
        }
        if (cursor_.peek_after_blanks() != ']') {
            return cursor_.refuse(open, "a '[' is not closed on this line", "add the missing ']'");
        }
        ++cursor_.at;
        return parameters_.exists(name.name) ? 1.0 : 0.0;
    }

    // Fanuc: ATAN[y]/[x], ATAN[y,x], ATAN[y] and POW[a,b].
    Result<double> of_two(Function function, std::size_t start) {
        const std::size_t open = cursor_.at++;
        auto first = formula();
        if (!first) return first;
        std::optional<double> second;
        if (cursor_.peek_after_blanks() == ',') {
            ++cursor_.at;
            const auto read = formula();
            if (!read) return read;
            second = number_or_0(*read);
        }
        if (cursor_.peek_after_blanks() != ']') {
            return cursor_.refuse(open, "a '[' is not closed on this line", "add the missing ']'");
        }
        ++cursor_.at;
        *first = number_or_0(*first);
        if (function == Function::pow) {
            return finite(math::pow(*first, second.value_or(1)), start, "a power without a real value",
                          "raise only positive numbers to broken powers");
        }
        Cursor ahead = cursor_;
        if (!second && ahead.peek_after_blanks() == '/') {
            ++ahead.at;
            if (ahead.peek_after_blanks() == '[') return arc_tangent(*first);
        }
        return second ? angle_deg(*first, *second) : math::atan2(*first, 1.0) * math::kDegPerRad;
    }

    // Fanuc: from 0 to 360 (parameter 6004), LinuxCNC: from -180 to 180.
    double angle_deg(double y, double x) const {
        const double degrees = math::atan2(y, x) * math::kDegPerRad;
        return degrees < 0 && parameters_.is_fanuc() ? degrees + 360 : degrees;
    }

    // ATAN[y]/[x], in degrees.
    Result<double> arc_tangent(double y) {
        const bool divided = cursor_.peek_after_blanks() == '/';
        if (divided) ++cursor_.at;
        if (!divided || cursor_.peek_after_blanks() != '[') {
            return cursor_.refuse(cursor_.at, "ATAN has one argument, it needs two", "write ATAN[y]/[x]");
        }
        const auto x = bracket();
        if (!x) return x;
        return angle_deg(y, number_or_0(*x));
    }

    double called(Function function, double x) const {
        switch (function) {
            case Function::abs:
                return std::abs(x);
            case Function::acos:
                return math::acos(x) * math::kDegPerRad;
            case Function::asin:
                return math::asin(x) * math::kDegPerRad;
            case Function::cos:
                return math::cos(x * math::kRadPerDeg);
            case Function::exp:
                return math::exp(x);
            // Fanuc: towards zero and away from it.
            case Function::fix:
                return x < 0 && parameters_.is_fanuc() ? std::ceil(x) : std::floor(x);
            case Function::fup:
                return x < 0 && parameters_.is_fanuc() ? std::floor(x) : std::ceil(x);
            case Function::ln:
                return math::log(x);
            case Function::round:
                return round_to_ * std::round(x / round_to_);
            case Function::sin:
                return math::sin(x * math::kRadPerDeg);
            case Function::sqrt:
                return x < 0 ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(x);
            default:
                return math::tan(x * math::kRadPerDeg);
        }
    }

    Cursor& cursor_;
    const Parameters& parameters_;
    double round_to_;
    int depth_ = 0;
    bool logic_is_arithmetic_ = false;  // in the bracket that is read
};

}  // namespace

Result<double> read_value(Cursor& cursor, const Parameters& parameters, double round_to) {
    return ExpressionReader(cursor, parameters, round_to).value();
}

Result<double> read_formula(Cursor& cursor, const Parameters& parameters) {
    return ExpressionReader(cursor, parameters, 1).formula();
}

bool starts_computed_value(const Cursor& cursor) {
    Cursor ahead = cursor;
    const char c = ahead.peek_after_blanks();
    if (c == '#' || c == '[') return true;
    for (const auto& named : kFunctions) {
        if (!stands_here(ahead, named.name)) continue;
        ahead.at += named.name.size();
        return ahead.peek_after_blanks() == '[';
    }
    return false;
}

Result<void> read_parameter_name(Cursor& cursor, const Parameters& parameters, ParameterName& read) {
    return ExpressionReader(cursor, parameters, 1).parameter_name(read);
}

}  // namespace tribo::readers::gcode
