// SPDX-License-Identifier: MIT
#include "readers/control/num_words.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "readers/control/block_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

// Variables of Fanuc that stand for L0 to L399 and for names in brackets; L900 and on keep their numbers.
constexpr int kFirstL = 500, kVariableCount = 400, kFirstOwn = 900, kLastOwn = 999;
constexpr int kFirstName = 100, kMostNames = 100;

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

// The words of a block.
class NumBlock {
  public:
    explicit NumBlock(std::vector<NumWord> words) : words_(std::move(words)) {
        for (const NumWord& word : words_) {
            if (word.address == "G" && is_cycle(word.value)) cycle_ = word.value;
        }
    }

    std::string in_fanuc_words() {
        for (const NumWord& word : words_) {
            if (word.address == "G" && !is_read(word.value)) return refused(word.value);
        }
        if (has_code("77")) return call();
        if (const auto all = of_its_own()) return *all;
        std::string out;
        if (has_code("4")) {
            if (const auto seconds = take("F")) out += "X[" + *seconds + "]";  // computed: in seconds
        }
        if (!has_code("41") && !has_code("42")) {
            if (const auto offset = take("D")) out += *offset == "0" ? "G49 " : "G43 ";
        }
        for (const NumWord& word : words_) {
            const std::string text = fanuc_word(word);
            if (text.starts_with("GNUM")) return text;
            out += text;
        }
        if (cycle_.empty()) return out;
        // The tool returns to the plane of ER; without one, to where it is.
        return "G99 " + out + (has("ER") ? "" : "R#5043");
    }

  private:
    // In the table, or with a reading of its own.
    static bool is_read(std::string_view code) {
        constexpr std::array<std::string_view, 4> own{"4", "16", "77", "151"};
        return std::ranges::find(own, code) != own.end() ||
               std::ranges::find(kCodes, code, &Renamed::num) != kCodes.end();
    }
    bool has(std::string_view address) const {
        return std::ranges::find(words_, address, &NumWord::address) != words_.end();
    }
    bool has_code(std::string_view code) const {
        return std::ranges::any_of(words_,
                                   [&](const NumWord& w) { return w.address == "G" && w.value == code; });
    }
    // The value of the word, taken out of the block; none: the block has no such word.
    std::optional<std::string> take(std::string_view address) {
        const auto found = std::ranges::find(words_, address, &NumWord::address);
        if (found == words_.end()) return std::nullopt;
        std::string value = found->is_negative ? "[0-" + found->value + "]" : found->value;
        words_.erase(found);
        return value;
    }

    // G77 H50 S2: a program; G77 N10 N20 S3: lines.
    std::string call() {
        std::vector<std::string> lines;
        const auto program = take("H"), times = take("S");
        while (const auto line = take("N")) lines.push_back(*line);
        const std::string repeats = times ? "L" + *times : "";
        const bool is_alone = words_.size() == 1;
        if (is_alone && program && lines.empty()) return "M98P" + *program + repeats;
        if (is_alone && !program && (lines.size() == 1 || lines.size() == 2))
            return "M97P" + lines.front() + "Q" + lines.back() + repeats;
        return refused("77");
    }

    // Blocks that are read as a whole; none: word by word.
    std::optional<std::string> of_its_own() {
        if (has_code("151")) return words_.size() == 2 && take("S") == "0" ? "G49" : refused("151");
        // The spindle along +Z is the state at the start.
        if (has_code("16")) return words_.size() == 2 && take("R") == "0" ? "" : refused("16");
        // A limit of the speed, or of the feed on arcs.
        if (has_code("92") && (has("S") || has("R"))) return "";
        const bool is_turned = has("I") || has("J") || has("K") || has("ED");
        if (has_code("59") && is_turned) return refused("59");
        return std::nullopt;
    }

    std::string fanuc_word(const NumWord& word) const {
        const bool is_variable = word.value.starts_with('#');
        const std::string signed_value =
            word.is_negative ? (is_variable ? "-[" + word.value + "]" : "-" + word.value) : word.value;
        if (word.address == "G") {
            const auto known = std::ranges::find(kCodes, word.value, &Renamed::num);
            return known == kCodes.end() ? "G4 " : std::string(known->fanuc) + " ";
        }
        // Positive: a round corner; negative: a chamfer.
        if (word.address == "EB")
            return is_variable ? refused("EB") : (word.is_negative ? ",C" : ",R") + word.value + " ";
        if (word.address == "ER") return "R" + signed_value + " ";
        if (word.address == "EF")
            return cycle_ == "82" || cycle_ == "89" ? "P[" + word.value + "*1000] " : "";
        if (!cycle_.empty()) {
            const bool pecks = cycle_ == "83" || cycle_ == "87";
            if (word.address == "P") return pecks ? "Q" + word.value + " " : "";
            // Q: the last peck of some that grow shorter.
            if (word.address == "Q" || is_aside(word.address)) return "";
        }
        if (word.address == "EC") return "";
        if (word.address.size() > 1) return refused(word.address);
        if (word.address == "E") return refused("E" + word.value);
        return word.address + signed_value + " ";
    }

    std::vector<NumWord> words_;
    std::string cycle_;  // 81 for G81; empty: none
};

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
std::string NumWords::variable_at(std::string_view text, std::size_t& at) {
    if (at < text.size() && text[at] == 'L') {
        const std::string_view digits = digits_at(text, at + 1);
        if (digits.empty() || digits.size() > 3) return {};
        const int number = std::stoi(std::string(digits));
        const bool is_own = number >= kFirstOwn && number <= kLastOwn;
        if (!is_own && number >= kVariableCount) return {};
        at += 1 + digits.size();
        return "#" + std::to_string(is_own ? number : kFirstL + number);
    }
    if (at < text.size() && text[at] == '[') {
        const std::size_t end = text.find(']', at);
        const std::string name(text.substr(at, end - at));
        if (end == std::string_view::npos || (names_.size() >= kMostNames && !names_.contains(name)))
            return {};
        const auto known = names_.try_emplace(name, kFirstName + static_cast<int>(names_.size())).first;
        at = end + 1;
        return "#" + std::to_string(known->second);
    }
    return {};
}

// A variable or a number without its sign; empty: none begins here.
std::string NumWords::operand_at(std::string_view text, std::size_t& at) {
    if (std::string variable = variable_at(text, at); !variable.empty()) return variable;
    const std::size_t start = at;
    while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
    return std::string(text.substr(start, at - start));
}

// The control works from left to right, without an order of operators: a formula that * or / behind + or -
// would make another one is refused.
std::string NumWords::formula(std::string_view text) {
    std::string value;
    bool has_sum = false;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (is_blank(c)) {
            ++at;
            continue;
        }
        if (c == '+' || c == '-' || c == '*' || c == '/') {
            if (has_sum && (c == '*' || c == '/')) return refused("ORDER");
            has_sum = has_sum || (!value.empty() && (c == '+' || c == '-'));
            value += c;
            ++at;
            continue;
        }
        const std::string operand = operand_at(text, at);
        if (operand.empty()) return refused("FUNCTION");
        value += operand;
    }
    return value.starts_with('-') || value.starts_with('+') ? "0" + value : value;
}

// L1 = L2+5, [NAME] = 3; empty: the line assigns nothing.
std::string NumWords::assignment() {
    std::string out;
    std::size_t at = 0;
    while (at < in_.size()) {
        while (at < in_.size() && is_blank(in_[at])) ++at;
        const std::string variable = variable_at(in_, at);
        while (at < in_.size() && is_blank(in_[at])) ++at;
        if (variable.empty() || at >= in_.size() || in_[at] != '=') return {};
        const std::size_t start = ++at;
        // The next assignment begins with a variable that has a sign of equality behind it.
        std::size_t end = in_.size();
        for (std::size_t next = start; next < in_.size(); ++next) {
            std::size_t behind = next;
            if (in_[next] != 'L' && in_[next] != '[') continue;
            if (variable_at(in_, behind).empty()) continue;
            while (behind < in_.size() && is_blank(in_[behind])) ++behind;
            if (behind < in_.size() && in_[behind] == '=') {
                end = next;
                break;
            }
        }
        const std::string value = formula(std::string_view(in_).substr(start, end - start));
        if (!value.starts_with("GNUM")) out.append(variable).append("=");
        out += value;
        if (!value.starts_with("GNUM")) out += ' ';
        at = end;
    }
    return out;
}

// G79 N100, G79 L1 < 5 N100; `at`: behind G79.
std::string NumWords::jump(std::size_t at) {
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
        return std::string("IF[")
            .append(left)
            .append(" ")
            .append(word)
            .append(" ")
            .append(right)
            .append("]GOTO")
            .append(digits);
    }
    return refused("79");
}

// A word without a number has the value 0.
bool NumWords::read_word(std::size_t& at, std::vector<NumWord>& words) {
    if (!is_letter(in_[at])) return false;
    NumWord word;
    word.address = in_[at++];
    if (word.address == "E" && at < in_.size() && is_letter(in_[at])) word.address += in_[at++];
    while (at < in_.size() && is_blank(in_[at])) ++at;
    if (at < in_.size() && (in_[at] == '-' || in_[at] == '+')) word.is_negative = in_[at++] == '-';
    word.value = operand_at(in_, at);
    if (word.value.empty()) word.value = "0";
    words.push_back(word);
    return true;
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
    const auto line = [&](std::string_view text) {
        std::string all = head;
        return all.append(text).append(comments);
    };
    if (in_ == "VAR" || in_ == "ENDV" || all_digits(in_)) return line("");
    if (const std::string assigned = assignment(); !assigned.empty()) return line(assigned);
    std::vector<NumWord> words;
    for (at = 0; at < in_.size();) {
        if (is_blank(in_[at])) {
            ++at;
        } else if (from(in_, at).starts_with("G79")) {
            return line(words.empty() ? jump(at + 3) : refused("79"));
        } else if (!read_word(at, words)) {
            return line(in_);  // refused as it is written
        } else if (at < in_.size() && in_[at] == '=') {
            return line(refused(words.back().address + words.back().value));
        }
    }
    for (NumWord& word : words) {
        const bool is_code = word.address == "G" || word.address == "M";
        while (is_code && word.value.size() > 1 && word.value[0] == '0') word.value.erase(0, 1);
    }
    return head + NumBlock(std::move(words)).in_fanuc_words() + comments;
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

std::string num_in_fanuc_words(std::string_view bytes) {
    NumWords num;
    std::vector<std::string> translated;
    TextLines lines(bytes);
    while (const auto line = lines.next()) {
        std::string text = num.line(*line);
        if (num.begins_program()) num.end_program(translated);
        translated.push_back(std::move(text));
    }
    num.end_program(translated);
    std::string all;
    for (const std::string& line : translated) all += line + '\n';
    return all;
}

}  // namespace tribo::readers
