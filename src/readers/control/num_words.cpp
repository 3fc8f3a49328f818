// SPDX-License-Identifier: MIT
#include "readers/control/num_words.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// Variables of Fanuc that stand for L0 to L399 and for names in brackets; L900 and on keep their numbers.
constexpr int kFirstVariable = 500, kMostVariables = 400, kFirstOwn = 900, kLastOwn = 999;
constexpr int kFirstName = 100, kMostNames = 100;

std::string_view from(std::string_view text, std::size_t at) {
    return text.substr(std::min(at, text.size()));
}

std::string_view digits_at(std::string_view text, std::size_t at) {
    const std::string_view rest = from(text, at);
    return rest.substr(0, std::min(rest.find_first_not_of("0123456789"), rest.size()));
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

// A word that is refused by its name.
std::string refused(std::string_view what) {
    return "GNUM" + std::string(what) + " ";
}

// Words of cycles that say nothing about the path: the stop of the spindle, the pitch that the feed holds
// too.
bool is_aside(std::string_view address) {
    return address == "EC" || address == "EK" || address == "K" || address == "EP";
}

struct Renamed {
    std::string_view num, fanuc;
};
// The same code, another one, or none.
constexpr std::array kCodes{
    Renamed{"0", "G0"},   Renamed{"1", "G1"},   Renamed{"2", "G2"},   Renamed{"3", "G3"},
    Renamed{"9", "G9"},   Renamed{"17", "G17"}, Renamed{"18", "G18"}, Renamed{"19", "G19"},
    Renamed{"40", "G40"}, Renamed{"41", "G41"}, Renamed{"42", "G42"}, Renamed{"52", "G53"},
    Renamed{"54", "G54"}, Renamed{"55", "G55"}, Renamed{"56", "G56"}, Renamed{"57", "G57"},
    Renamed{"59", "G52"}, Renamed{"70", "G20"}, Renamed{"71", "G21"}, Renamed{"73", ""},
    Renamed{"80", "G80"}, Renamed{"90", "G90"}, Renamed{"91", "G91"}, Renamed{"92", "G92"},
    Renamed{"93", "G93"}, Renamed{"94", "G94"}, Renamed{"95", "G95"}, Renamed{"97", "G97"},
    Renamed{"81", "G81"}, Renamed{"82", "G82"}, Renamed{"83", "G83"}, Renamed{"84", "G84"},
    Renamed{"85", "G85"}, Renamed{"86", "G86"}, Renamed{"87", "G73"}, Renamed{"89", "G89"},
};

bool is_cycle(std::string_view code) {
    return code.size() == 2 && code[0] == '8' && code[1] != '0';
}

}  // namespace

bool is_block_of_num(std::string_view block) {
    if (block.starts_with('N')) block = from(block, 1 + digits_at(block, 1).size());
    for (const std::string_view begin : {"G79N", "G79L", "G79[", "G77H", "G77N"}) {
        if (block.starts_with(begin)) return true;
    }
    const std::size_t cycle = block.find("G8"), retract = block.find("ER");
    return cycle != std::string_view::npos && retract != std::string_view::npos &&
           retract + 2 < block.size() && (is_digit(block[retract + 2]) || block[retract + 2] == '-');
}

// The variable of Fanuc for L5 or [NAME]; empty: none begins here.
std::string NumWords::variable_at(std::size_t& at) const {
    if (at < in_.size() && in_[at] == 'L') {
        const std::string_view digits = digits_at(in_, at + 1);
        if (digits.empty() || digits.size() > 3) return {};
        const int number = std::stoi(std::string(digits));
        const bool is_own = number >= kFirstOwn && number <= kLastOwn;
        if (!is_own && number >= kMostVariables) return {};
        at += 1 + digits.size();
        return "#" + std::to_string(is_own ? number : kFirstVariable + number);
    }
    if (at < in_.size() && in_[at] == '[') {
        const std::size_t end = in_.find(']', at);
        const std::string name = in_.substr(at, end - at);
        if (end == std::string::npos || (names_.size() >= kMostNames && !names_.contains(name))) return {};
        const auto known = names_.try_emplace(name, kFirstName + static_cast<int>(names_.size())).first;
        at = end + 1;
        return "#" + std::to_string(known->second);
    }
    return {};
}

// A variable or a number without its sign; empty: none begins here.
std::string NumWords::operand_at(std::size_t& at) const {
    if (std::string variable = variable_at(at); !variable.empty()) return variable;
    const std::size_t start = at;
    while (at < in_.size() && (is_digit(in_[at]) || in_[at] == '.')) ++at;
    return in_.substr(start, at - start);
}

// The control works from left to right, without an order of operators: a formula that * or / behind + or -
// would make another one is refused.
std::string NumWords::formula(std::string_view text) const {
    NumWords inner;
    inner.names_ = names_;
    for (const char c : text) {
        if (!is_blank(c)) inner.in_ += c;
    }
    std::string value;
    bool has_sum = false;
    for (std::size_t at = 0; at < inner.in_.size();) {
        const char c = inner.in_[at];
        if (c == '+' || c == '-' || c == '*' || c == '/') {
            if (has_sum && (c == '*' || c == '/')) return refused("ORDER");
            has_sum = has_sum || (!value.empty() && (c == '+' || c == '-'));
            value += c;
            ++at;
            continue;
        }
        const std::string operand = inner.operand_at(at);
        if (operand.empty()) return refused("FUNCTION");
        value += operand;
    }
    names_ = inner.names_;
    return value.starts_with('-') || value.starts_with('+') ? "0" + value : value;
}

// L1 = L2+5, [NAME] = 3; empty: the line assigns nothing.
std::string NumWords::assignment() {
    std::string out;
    std::size_t at = 0;
    while (at < in_.size()) {
        while (at < in_.size() && is_blank(in_[at])) ++at;
        const std::string variable = variable_at(at);
        while (at < in_.size() && is_blank(in_[at])) ++at;
        if (variable.empty() || at >= in_.size() || in_[at] != '=') return {};
        const std::size_t start = ++at;
        // The next assignment begins with a variable that has a sign of equality behind it.
        std::size_t end = in_.size();
        for (std::size_t next = start; next < in_.size(); ++next) {
            std::size_t behind = next;
            if (in_[next] != 'L' && in_[next] != '[') continue;
            if (variable_at(behind).empty()) continue;
            while (behind < in_.size() && is_blank(in_[behind])) ++behind;
            if (behind < in_.size() && in_[behind] == '=') {
                end = next;
                break;
            }
        }
        const std::string value = formula(std::string_view(in_).substr(start, end - start));
        out += value.starts_with("GNUM") ? value : variable + "=" + value + " ";
        at = end;
    }
    return out;
}

// G79 N100, G79 L1 < 5 N100; `at`: behind G79.
std::string NumWords::jump(std::size_t at) const {
    const std::size_t to = in_.rfind('N');
    if (to == std::string::npos || to < at) return refused("79");
    const std::string_view digits = digits_at(in_, to + 1);
    const std::string_view condition = trimmed(std::string_view(in_).substr(at, to - at));
    if (digits.empty()) return refused("79");
    if (condition.empty()) return "GOTO" + std::string(digits);
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> signs{
        {{"<=", "LE"}, {">=", "GE"}, {"<>", "NE"}, {"<", "LT"}, {">", "GT"}, {"=", "EQ"}}};
    for (const auto& [sign, word] : signs) {
        const std::size_t found = condition.find(sign);
        if (found == std::string_view::npos) continue;
        const std::string left = formula(condition.substr(0, found)),
                          right = formula(condition.substr(found + sign.size()));
        if (left.starts_with("GNUM") || left.empty() || right.starts_with("GNUM") || right.empty())
            return refused("79");
        return "IF[" + left + " " + std::string(word) + " " + right + "]GOTO" + std::string(digits);
    }
    return refused("79");
}

// A word without a number has the value 0.
bool NumWords::read_word(std::size_t& at, std::vector<Word>& words) const {
    if (!is_letter(in_[at])) return false;
    Word word;
    word.address = in_[at++];
    if (word.address == "E" && at < in_.size() && is_letter(in_[at])) word.address += in_[at++];
    while (at < in_.size() && is_blank(in_[at])) ++at;
    if (at < in_.size() && (in_[at] == '-' || in_[at] == '+')) word.is_negative = in_[at++] == '-';
    word.value = operand_at(at);
    if (word.value.empty()) word.value = "0";
    words.push_back(word);
    return true;
}

std::string NumWords::in_words(std::vector<Word> words) const {
    const auto find = [&](std::string_view address) {
        return std::ranges::find(words, address, &Word::address);
    };
    const auto take = [&](std::string_view address) -> std::optional<std::string> {
        const auto found = find(address);
        if (found == words.end()) return std::nullopt;
        const std::string value = found->is_negative ? "[0-" + found->value + "]" : found->value;
        words.erase(found);
        return value;
    };
    const auto has_code = [&](std::string_view code) {
        return std::ranges::any_of(words, [&](const Word& w) { return w.address == "G" && w.value == code; });
    };
    // Codes with a reading of their own are not in the table.
    for (const Word& word : words) {
        constexpr std::array<std::string_view, 4> own{"4", "16", "77", "151"};
        const bool is_known = word.address != "G" || std::ranges::find(own, word.value) != own.end() ||
                              std::ranges::find(kCodes, word.value, &Renamed::num) != kCodes.end();
        if (!is_known) return refused(word.value);
    }
    std::string out, cycle;
    if (has_code("77")) {
        std::vector<std::string> lines;
        const auto program = take("H"), times = take("S");
        while (const auto line = take("N")) lines.push_back(*line);
        const std::string repeats = times ? "L" + *times : "";
        if (words.size() == 1 && program && lines.empty()) return "M98P" + *program + repeats;
        if (words.size() == 1 && !program && (lines.size() == 1 || lines.size() == 2))
            return "M97P" + lines.front() + "Q" + lines.back() + repeats;
        return refused("77");
    }
    if (has_code("4")) {
        if (const auto seconds = take("F")) out += "X" + *seconds;
    }
    if (has_code("151") && find("S") != words.end() && words.size() == 2 && take("S") == "0") return "G49";
    if (has_code("16")) {
        // The spindle along +Z is the state at the start.
        if (words.size() != 2 || find("R") == words.end() || find("R")->is_negative) return refused("16");
        return {};
    }
    if (has_code("92") && (find("S") != words.end() || find("R") != words.end())) return {};
    for (const Word& word : words) {
        if (word.address == "G" && is_cycle(word.value)) cycle = word.value;
    }
    const bool is_compensated = has_code("41") || has_code("42");
    if (!is_compensated) {
        if (const auto offset = take("D")) out += *offset == "0" ? "G49 " : "G43 ";
    }
    if (has_code("59")) {
        for (const char* turned : {"I", "J", "K", "ED"}) {
            if (find(turned) != words.end()) return refused("59");
        }
    }
    for (const Word& word : words) {
        const std::string signed_value =
            (word.is_negative ? "-" : "") +
            (word.value.starts_with('#') && word.is_negative ? "[" + word.value + "]" : word.value);
        if (word.address == "G") {
            const auto known = std::ranges::find(kCodes, word.value, &Renamed::num);
            if (known == kCodes.end() && word.value != "4") return refused(word.value);
            out += known == kCodes.end() ? "G4 " : std::string(known->fanuc) + " ";
        } else if (word.address == "EB") {
            // Positive: a round corner; negative: a chamfer.
            if (word.value.starts_with('#')) return refused("EB");
            out += (word.is_negative ? ",C" : ",R") + word.value + " ";
        } else if (word.address == "ER") {
            out += "R" + signed_value + " ";
        } else if (word.address == "EF") {
            const bool dwells = cycle == "82" || cycle == "89";
            if (dwells) out += "P[" + word.value + "*1000] ";
        } else if (!cycle.empty() && word.address == "P") {
            if (cycle == "83" || cycle == "87") out += "Q" + word.value + " ";
        } else if (!cycle.empty() && word.address == "Q") {
            continue;  // the last peck of some that grow shorter
        } else if (!cycle.empty() && is_aside(word.address)) {
            continue;
        } else if (word.address.size() > 1) {
            if (word.address != "EC") return refused(word.address);
        } else if (word.address == "E") {
            return refused("E" + word.value);
        } else {
            out += word.address + signed_value + " ";
        }
    }
    if (cycle.empty()) return out;
    // The tool returns to the plane of ER; without one, to where it is.
    return "G99 " + out + (find("ER") == words.end() ? "R#5043" : "");
}

std::string NumWords::line(std::string_view text) {
    begins_program_ = false;
    std::string comments;
    in_.clear();
    bool is_comment = false;
    for (const char c : text) {
        if (c == '$' && !is_comment) break;  // a message
        if (c == '(') is_comment = true;
        if (is_comment) {
            comments += c;
        } else {
            in_ += to_upper(c);
        }
        if (c == ')') is_comment = false;
    }
    in_ = trimmed(in_);
    if (in_.starts_with('%')) {
        const std::string_view number = digits_at(in_, 1);
        if (number.empty()) return in_ + comments;
        begins_program_ = true;
        ++programs_;
        return "O" + std::string(number) + comments;
    }
    std::string head;
    std::size_t at = 0;
    if (in_.starts_with('/')) {
        head = "/";
        ++at;
        while (at < in_.size() && is_blank(in_[at])) ++at;
    }
    if (at < in_.size() && in_[at] == 'N' && !digits_at(in_, at + 1).empty()) {
        const std::string_view number = digits_at(in_, at + 1);
        head += "N" + std::string(number) + " ";
        at += 1 + number.size();
    }
    in_ = trimmed(std::string_view(in_).substr(at));
    if (in_ == "VAR" || in_ == "ENDV" || all_digits(in_)) return head + comments;
    if (const std::string assigned = assignment(); !assigned.empty()) return head + assigned + comments;
    std::vector<Word> words;
    for (at = 0; at < in_.size();) {
        if (is_blank(in_[at])) {
            ++at;
        } else if (from(in_, at).starts_with("G79")) {
            return head + (words.empty() ? jump(at + 3) : refused("79")) + comments;
        } else if (!read_word(at, words)) {
            return head + in_ + comments;  // refused as it is written
        } else if (at < in_.size() && in_[at] == '=') {
            return head + refused(words.back().address + words.back().value) + comments;
        }
    }
    for (Word& word : words) {
        const bool is_code = word.address == "G" || word.address == "M";
        while (is_code && word.value.size() > 1 && word.value[0] == '0') word.value.erase(0, 1);
    }
    return head + in_words(std::move(words)) + comments;
}

void NumWords::end_program(std::vector<std::string>& lines) const {
    const int ended = programs_ - (begins_program_ ? 1 : 0);
    if (ended == 0) return;
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
        const std::string_view text = trimmed(*line);
        if (text.empty() || text == "%") continue;
        const bool ends = text.find("M2 ") != std::string_view::npos || text.ends_with("M2") ||
                          text.find("M30") != std::string_view::npos;
        if (!ends && !text.starts_with('O')) *line += ended == 1 ? " M2" : " M99";
        return;
    }
}

}  // namespace tribo::readers
