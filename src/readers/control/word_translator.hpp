// SPDX-License-Identifier: MIT
// Lines of Okuma and Fagor programs in the words of a Fanuc control: what both share. The statements and
// codes of each control are in okuma_words.cpp and fagor_words.cpp.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "readers/control/block_text.hpp"
#include "readers/control/other_control.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {

// Variables of Fanuc that stand for VC0 .. or P0 .., for other names, and lines that stand for labels.
inline constexpr int kFirstVariable = 500, kFirstLabel = 90'000, kFirstProgram = 7000;
inline constexpr int kMostVariables = 300, kLastLocal = 33;

class WordTranslator {
  public:
    WordTranslator(OtherControl control, std::string_view bytes)
        : is_okuma_(control == OtherControl::okuma),
          says_centres_(!is_okuma_ && has_absolute_centres(bytes)) {
        TextLines lines(bytes);
        for (auto line = lines.next(); is_okuma_ && line; line = lines.next()) {
            const std::string name = program_name(upper(trimmed(*line)));
            if (!name.empty())
                programs_.try_emplace(name, kFirstProgram + static_cast<int>(programs_.size()));
        }
        TextLines again(bytes);
        for (auto line = again.next(); is_okuma_ && line; line = again.next())
            name_arguments(without_blanks_of_formulas(upper(*line)));
    }

    std::string line(std::string_view text) {
        std::string all = upper(text);
        if (is_okuma_) all = without_blanks_of_formulas(all);
        if (is_okuma_ && trimmed(all).starts_with('$')) return {};
        if (trimmed(all).starts_with('%')) return all;
        in_ = all;
        at_ = 0;
        out_.clear();
        skip_blanks();
        while (at_ < in_.size() && in_[at_] == '/') out_ += in_[at_++];
        const bool is_word =
            is_okuma_ && (from(in_, at_).starts_with("NCYL") || from(in_, at_).starts_with("NOEX"));
        if (!is_word && at_ + 1 < in_.size() && in_[at_] == 'N' && is_name(in_[at_ + 1])) {
            ++at_;
            out_ += "N" + label() + " ";
        }
        if (const auto known = programs_.find(program_name(in_.substr(at_))); known != programs_.end()) {
            out_ += "O" + std::to_string(known->second);
            at_ += known->first.size();
        }
        const std::size_t head = out_.size();
        has_centre_ = has_absolute_centre_ = false;
        const std::string behind = is_okuma_ ? std::string() : polar_words();
        while (at_ < in_.size()) word();
        if (says_centres_ && has_centre_) out_.insert(head, has_absolute_centre_ ? "G90.1 " : "G91.1 ");
        return out_ + behind;
    }

  private:
    void skip_blanks() {
        while (at_ < in_.size() && is_blank(in_[at_])) ++at_;
    }
    std::string name_at(std::size_t at) const {
        std::size_t end = at;
        while (end < in_.size() && is_name(in_[end])) ++end;
        return in_.substr(at, end - at);
    }
    // The number of a line: digits, or one for a name.
    std::string label() {
        std::string name = name_at(at_);
        at_ += name.size();
        if (all_digits(name)) return name;
        const auto known = labels_.try_emplace(name, kFirstLabel + static_cast<int>(labels_.size())).first;
        return std::to_string(known->second);
    }
    // The variable of Fanuc for a name; empty: it is none.
    std::string variable(const std::string& name) {
        const std::string_view prefix = is_okuma_ ? "VC" : "P";
        if (name.starts_with(prefix) && all_digits(from(name, prefix.size())) && name.size() < 7) {
            const int number = std::stoi(name.substr(prefix.size()));
            if (number < kMostVariables) return "#" + std::to_string(kFirstVariable + number);
            return {};
        }
        const auto known = names_.find(name);
        return known == names_.end() ? std::string() : "#" + std::to_string(known->second);
    }
    // The variable at a place, VC5 or P5, which ends with its digits; moves behind it. Empty: none is there.
    std::string take_variable() {
        const std::string_view prefix = is_okuma_ ? "VC" : "P";
        if (!from(in_, at_).starts_with(prefix)) return {};
        const std::string name = std::string(prefix) + std::string(digits_at(in_, at_ + prefix.size()));
        const std::string known = variable(name);
        if (!known.empty()) at_ += name.size();
        return known;
    }
    // Each program has its own variables by name, as #1 to #33 are.
    std::string define(const std::string& name) {
        for (int number = 1; number <= kLastLocal; ++number) {
            if (std::ranges::any_of(names_, [&](const auto& known) { return known.second == number; }))
                continue;
            names_.emplace(name, number);
            break;
        }
        return variable(name);
    }
    // A formula up to `ends` outside of its brackets, with the variables of Fanuc.
    std::string formula(std::string_view ends) {
        std::string value;
        int depth = 0;
        while (at_ < in_.size()) {
            const char c = in_[at_];
            if (depth == 0 && ends.find(c) != std::string_view::npos) break;
            if (c == '[' || (c == '(' && !is_okuma_)) ++depth;
            if (c == ']' || (c == ')' && !is_okuma_)) --depth;
            if (depth < 0) break;
            if (is_letter(c)) {
                if (const std::string known = take_variable(); !known.empty()) {
                    value += known;
                    continue;
                }
                const std::string name = name_at(at_), known = variable(name);
                value += known.empty() ? name : known;
                at_ += name.size();
                continue;
            }
            value += is_okuma_ ? c : c == '(' ? '[' : c == ')' ? ']' : c;
            ++at_;
        }
        return value;
    }

    void word() {
        const char c = in_[at_];
        if (c == ';') {
            out_ += in_.substr(at_);
            at_ = in_.size();
        } else if (c == '(') {
            bracket();
        } else if (!is_letter(c)) {
            out_ += c;
            ++at_;
        } else if (is_okuma_ && (okuma_statement() || return_level())) {
            return;
        } else if (c == 'G' && at_ + 1 < in_.size() && is_digit(in_[at_ + 1])) {
            code();
        } else {
            address();
        }
    }

    // A comment, or a statement of Fagor.
    void bracket() {
        const std::size_t end = std::min(in_.find(')', at_), in_.size());
        if (!is_okuma_ && fagor_statement()) return;
        out_ += in_.substr(at_, end + 1 - at_);
        at_ = std::min(end + 1, in_.size());
    }

    // X=VC1+5, XP1, X10, VC1=VC2*2
    void address() {
        const std::string name = name_at(at_);
        const std::size_t after = at_ + name.size();
        const bool has_equals = after < in_.size() && in_[after] == '=';
        std::string known = variable(name);
        if (known.empty() && has_equals && name.size() > 1 && is_letter(name[1])) known = define(name);
        if (has_equals && !known.empty()) {
            at_ = after + 1;
            out_ += known + "=" + formula(" ");
            return;
        }
        const char letter = in_[at_++];
        has_centre_ = has_centre_ || letter == 'I' || letter == 'J' || letter == 'K';
        if (at_ < in_.size() && in_[at_] == '=') {
            ++at_;
            out_ += std::string(1, letter) + "[" + formula(" ") + "]";
            return;
        }
        out_ += letter;
        const bool is_negative = at_ < in_.size() && in_[at_] == '-';
        if (is_negative) ++at_;
        if (const std::string value = take_variable(); !value.empty()) {
            out_ += is_negative ? "[0-" + value + "]" : value;
            return;
        }
        if (is_negative) out_ += '-';
        while (at_ < in_.size() && (is_digit(in_[at_]) || in_[at_] == '.' || is_blank(in_[at_])))
            out_ += in_[at_++];
    }

    bool takes(std::string_view text) {
        if (!from(in_, at_).starts_with(text)) return false;
        at_ += text.size();
        return true;
    }

    static bool is_of_machine(std::string_view program) { return program.size() == 4 && program >= "8000"; }

    void code() {
        ++at_;
        std::string number(digits_at(in_, at_));
        at_ += number.size();
        const bool has_part = at_ < in_.size() && in_[at_] == '.';
        while (number.size() > 1 && number[0] == '0') number.erase(0, 1);
        if (has_part) {
            out_ += "G" + number;
        } else if (is_okuma_) {
            okuma_code(number);
        } else {
            fagor_code(number);
        }
    }

    // Where the rest of the block has a word of that letter; none in a comment of Okuma.
    std::size_t find_word(char letter) const {
        const std::size_t end = is_okuma_ ? in_.find_first_of("(;", at_) : in_.size();
        const std::size_t found = in_.find(letter, at_);
        return found < end ? found : std::string::npos;
    }

    // The word of that letter in the rest of the block, taken out of it; empty: it has none.
    std::string take_word(char letter) {
        const std::size_t found = find_word(letter);
        if (found == std::string::npos) return {};
        std::size_t end = found + 1;
        while (end < in_.size() && (is_name(in_[end]) || in_[end] == '.' || in_[end] == '-')) {
            if (is_letter(in_[end]) && end > found + 1) break;
            ++end;
        }
        const std::string word = in_.substr(found + 1, end - found - 1);
        in_.erase(found, end - found);
        return word;
    }

    // The same as a formula; empty: the block has no such word.
    std::string take_value(char letter) {
        const std::size_t found = find_word(letter);
        if (from(in_, found).substr(0, 2).ends_with('=')) {
            const std::size_t start = std::exchange(at_, found + 2);
            const std::string value = formula(" ");
            in_.erase(found, std::exchange(at_, start) - found);
            return "[" + value + "]";
        }
        std::string word = take_word(letter);
        if (word.empty()) return {};
        const bool is_negative = word[0] == '-';
        if (is_negative) word.erase(0, 1);
        const std::string known = variable(word);
        return "[" + std::string(is_negative ? "0-" : "") + (known.empty() ? word : known) + "]";
    }

    // G73 with an angle while one is in force: the control adds them.
    bool turns_again() const { return is_turned_ && in_.find('Q', at_) != std::string::npos; }

    // okuma_words.cpp
    void name_arguments(const std::string& text);
    std::string take_argument();
    bool okuma_statement();
    std::string program_of(const std::string& name) const;
    bool fixture_offset();
    void work_system();
    void system_of_block();
    void pecks(const std::string& code);
    bool return_level();
    void okuma_code(const std::string& number);

    // fagor_words.cpp
    static bool has_absolute_centres(std::string_view bytes);
    bool fagor_statement();
    bool fagor_repeat(std::size_t at);
    std::string take_way(char letter, const char* place);
    bool has_code(std::string_view code) const;
    std::string polar_words();
    void tangent_arc();
    void three_points();
    void fagor_code(const std::string& number);

    bool is_okuma_, says_centres_;
    bool has_centre_ = false, has_absolute_centre_ = false;  // of the block
    bool cycle_on_ = false, is_turned_ = false;
    bool clears_ = false;                           // the last deep hole had J
    bool is_arc_ = false, is_other_plane_ = false;  // of the last G0 to G3, and of G17 to G19
    std::string in_, out_;
    std::size_t at_ = 0;
    std::map<std::string, int> names_, labels_, programs_;
    std::map<std::string, std::string> turning_zeros_;  // work systems of CALL OO88, and the base of each
};

}  // namespace tribo::readers
