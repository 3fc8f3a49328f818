// SPDX-License-Identifier: MIT
#include "readers/heidenhain/line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/decimal.hpp"
#include "base/text/limit_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers::heidenhain {
namespace {

// Longest number, digits. No control writes half as many.
constexpr std::size_t kLongestNumber = 64;
constexpr double kLargestNumber = 1e15;

bool is_word(char c) {
    return is_letter(c) || c == '_';
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
        line.comment_goes_on = line.goes_on;
        break;
    }
    // A block number is digits and a blank; some training systems write an N before them.
    const std::size_t first = whole.size() > 1 && to_upper(whole[0]) == 'N' ? 1 : 0;
    std::size_t digits = first;
    while (digits < whole.size() && is_digit(whole[digits])) ++digits;
    if (digits > first && (digits == whole.size() || is_blank(whole[digits]))) whole.remove_prefix(digits);
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

bool LineReader::take_before_parameter(std::string_view word) {
    skip_blanks();
    const std::string_view rest = line_.text.substr(at_);
    const std::size_t size = word.size();
    if (rest.size() < size + 2 || to_upper(rest[size]) != 'Q') return false;
    const char kind = to_upper(rest[size + 1]);
    if (!is_digit(kind) && kind != 'L' && kind != 'R') return false;
    for (std::size_t i = 0; i < size; ++i) {
        if (to_upper(rest[i]) != word[i]) return false;
    }
    at_ += size;
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
    const int start = column();
    const char kind = to_upper(line_.text[at_ + 1]);
    const bool has_kind = kind == 'L' || kind == 'R';
    const std::size_t digits = at_ + (has_kind ? 2 : 1);
    if (digits >= line_.text.size() || !is_digit(line_.text[digits])) return std::nullopt;
    at_ = digits;
    int index = 0;
    while (is_digit(peek())) {
        if (index < kParameters) index = 10 * index + (peek() - '0');
        ++at_;
    }
    const int most = has_kind ? kParameters - kRemanent : kLocal;
    if (index >= most) {
        const std::string name = has_kind ? std::string{'Q', kind} : "Q";
        return refuse(start, "there is no parameter beyond " + name + std::to_string(most - 1),
                      "correct its number");
    }
    return index + (kind == 'L' ? kLocal : kind == 'R' ? kRemanent : 0);
}

std::optional<int> LineReader::text_parameter() {
    skip_blanks();
    if (at_ + 2 >= line_.text.size() || to_upper(peek()) != 'Q' || to_upper(line_.text[at_ + 1]) != 'S' ||
        !is_digit(line_.text[at_ + 2])) {
        return std::nullopt;
    }
    at_ += 2;
    int index = 0;
    while (is_digit(peek())) {
        if (index < kParameters) index = 10 * index + (peek() - '0');
        ++at_;
    }
    return index;
}

Result<std::optional<std::string>> LineReader::text() {
    std::string whole;
    for (;;) {
        skip_blanks();
        const int start = column();
        if (const auto index = text_parameter()) {
            const auto known = parameters_.texts.find(*index);
            if (known == parameters_.texts.end()) {
                return refuse(start, "the text QS" + std::to_string(*index) + " is not known",
                              "write the text in quotes");
            }
            whole += known->second;
        } else if (peek() == '"') {
            const std::size_t end = line_.text.find('"', at_ + 1);
            if (end == std::string_view::npos)
                return refuse(start, "the name has no second quote", "close it");
            whole += line_.text.substr(at_ + 1, end - at_ - 1);
            at_ = end + 1;
        } else if (whole.empty()) {
            return std::nullopt;
        } else {
            return refuse(start, "a text is missing", "write a text in quotes or a QS parameter");
        }
        if (whole.size() > kLongestBlock) return refuse(start, "the text is too long", "shorten it");
        if (!take("||")) return whole;
    }
}

Result<std::optional<double>> LineReader::last_number() {
    std::optional<double> last;
    while (!at_end()) {
        const bool is_point = (peek() == '.' || peek() == ',') &&
                              !(at_ + 1 < line_.text.size() && is_digit(line_.text[at_ + 1]));
        if (is_point) {  // V.ZEIT
            ++at_;
            continue;
        }
        const auto value = number();
        if (!value) return value;
        if (*value) {
            last = *value;
        } else {
            ++at_;
        }
    }
    return last;
}

Result<std::optional<double>> LineReader::number() {
    const int first_column = column();
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
        if (peek() != '=' && !parameters_.knows(**q)) {
            return refuse(first_column, Parameters::name(**q) + " holds a value that only the machine knows",
                          **q == kRadiusParameter
                              ? "give the tool's diameter to the job, or write TOOL DEF with its radius R"
                              : "set it in the program, for example " + Parameters::name(**q) +
                                    " = 5; where it is the radius of a tool, give the tool to the job, or "
                                    "describe it in a comment");
        }
        if (peek() != '=') {
            parameters_.note_read(**q);
            return sign * parameters_.get(**q);
        }
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

Result<std::string> LineReader::label() {
    skip_blanks();
    const int start = column();
    const auto name = text();
    if (!name) return std::unexpected(name.error());
    if (*name) return "\"" + **name;
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
    item.line = line_.number;
    item.column = column();
    const std::size_t start = at_;
    const auto quoted = text();
    if (!quoted) return std::unexpected(quoted.error());
    if (*quoted) {
        item.name = "\"" + **quoted;
        return item;
    }
    while (is_word(peek())) ++at_;
    // FQ5 and FQL5: the parameter is the value, not a part of the word.
    if (is_digit(peek())) {
        for (const std::size_t size : {std::size_t{1}, std::size_t{2}}) {
            if (at_ - start > size && to_upper(line_.text[at_ - size]) == 'Q' &&
                (size == 1 || to_upper(line_.text[at_ - 1]) == 'L' || to_upper(line_.text[at_ - 1]) == 'R')) {
                at_ -= size;
                break;
            }
        }
    }
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
        for (const std::string_view word : {"FAUTO", "FMAX", "MAX", "AUTO", "PREDEF"}) {
            if (take(word)) item.word = word;
        }
        if (!item.word.empty()) {
            item.value.reset();
            return item;
        }
        const auto value = number();
        if (!value) return std::unexpected(value.error());
        if (!*value) return refuse(column(), "a parameter without a value", "write a number after '='");
        item.value = *value;
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
