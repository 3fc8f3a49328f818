// SPDX-License-Identifier: MIT
#include "readers/tools/text_tokens.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr double kInch = 25.4;

struct Unit {
    std::string_view word;
    double mm;  // 0: degrees
};
constexpr std::array kUnits{
    Unit{"MM", 1},        Unit{"MILLIMETER", 1}, Unit{"MILLIMETERS", 1}, Unit{"MILLIMETRES", 1},
    Unit{"CM", 10},       Unit{"INCH", kInch},   Unit{"INCHES", kInch},  Unit{"ZOLL", kInch},
    Unit{"POUCE", kInch}, Unit{"IN", kInch},     Unit{"DEG", 0},         Unit{"DEGREE", 0},
    Unit{"DEGREES", 0},   Unit{"GRAD", 0},       Unit{"GR", 0},          Unit{"DEGRES", 0},
    Unit{"GRADOS", 0},
};

class Tokenizer {
  public:
    explicit Tokenizer(std::string_view text) : text_(text) {}

    std::vector<TextToken> read() {
        while (at_ < text_.size()) {
            if (is_blank(text_[at_]) || text_[at_] == '\r') {
                ++at_;
                continue;
            }
            TextToken token;
            token.is_glued = at_ > 0 && !is_blank(text_[at_ - 1]);
            const std::size_t start = at_;
            if (starts_number()) {
                read_number(token);
            } else if (is_letter(text_[at_])) {
                token.kind = TextToken::Kind::word;
                while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
            } else {
                ++at_;
            }
            token.text = text_.substr(start, at_ - start);
            tokens_.push_back(token);
        }
        return std::move(tokens_);
    }

  private:
    char peek(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : ' '; }
    bool starts_number() const {
        return is_digit(peek(0)) ||
               (peek(0) == '.' && is_digit(peek(1)) && !(at_ > 0 && is_digit(text_[at_ - 1])));
    }

    // Digits with one point, or one comma between digits.
    double decimal(bool& is_integer) {
        const std::size_t start = at_;
        std::string digits;
        is_integer = true;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            const bool is_point = c == '.' || (c == ',' && at_ > start && is_digit(peek(1)));
            if (is_point && !is_integer) break;
            if (!is_digit(c) && !is_point) break;
            is_integer = is_integer && !is_point;
            digits += is_point ? '.' : c;
            ++at_;
        }
        return number_of(digits).value_or(0);
    }

    // The denominator behind a '/', a power of two as on rulers; 0 for anything else. Moves behind it.
    double denominator() {
        if (peek(0) != '/' || !is_digit(peek(1))) return 0;
        std::size_t end = at_ + 1;
        while (end < text_.size() && is_digit(text_[end])) ++end;
        const std::string_view digits = text_.substr(at_ + 1, end - at_ - 1);
        for (const std::string_view good : {"2", "4", "8", "16", "32", "64"}) {
            if (digits != good) continue;
            at_ = end;
            return *number_of(good);
        }
        return 0;
    }

    void read_number(TextToken& token) {
        token.kind = TextToken::Kind::number;
        token.value = decimal(token.is_integer);
        if (token.is_integer) read_fraction(token);
        read_unit(token);
    }

    // 1/4, 1-1/2, 1 1/2.
    void read_fraction(TextToken& token) {
        if (const double below = denominator(); below > 0) {
            set_inches(token, token.value / below);
            return;
        }
        const std::size_t back = at_;
        // The 1 of "T1 1/2 END MILL" is the tool's number.
        const bool is_name =
            token.is_glued && !tokens_.empty() && tokens_.back().kind != TextToken::Kind::number;
        if (is_name || (peek(0) != '-' && peek(0) != ' ') || !is_digit(peek(1))) return;
        ++at_;
        bool is_integer = true;
        const double above = decimal(is_integer), below = is_integer ? denominator() : 0;
        if (below > above) {
            set_inches(token, token.value + above / below);
        } else {
            at_ = back;
        }
    }

    static void set_inches(TextToken& token, double value) {
        token.value = value;
        token.unit_mm = kInch;
        token.is_integer = false;
    }

    void read_unit(TextToken& token) {
        std::size_t start = at_;
        while (start < text_.size() && is_blank(text_[start])) ++start;
        // 4-INCH FACE MILL
        const bool is_joined =
            start == at_ && start + 1 < text_.size() && text_[start] == '-' && is_letter(text_[start + 1]);
        if (is_joined) ++start;
        // The quote that ends a name, "PLANFR63", is no sign of inches.
        const bool is_quoted =
            std::ranges::count_if(tokens_, [](const TextToken& t) { return t.is_sign('"'); }) % 2 == 1;
        // 63 "PLANFR63": the quote begins a name.
        const bool begins_name = start > at_ && start + 1 < text_.size() && is_letter(text_[start + 1]);
        if (start < text_.size() && text_[start] == '"' && !is_quoted && !begins_name) {
            token.unit_mm = kInch;
            at_ = start + 1;
            return;
        }
        std::size_t end = start;
        while (end < text_.size() && is_letter(text_[end])) ++end;
        const std::string_view word = text_.substr(start, end - start);
        for (const Unit& unit : kUnits) {
            if (word != unit.word) continue;
            // "in" may be a word of the sentence: 6 in a row.
            const bool is_word = start != at_ && end < text_.size() && is_blank(text_[end]);
            if (word == "IN" && token.is_integer && is_word) return;
            if (is_joined && unit.mm != kInch) return;
            if (unit.mm > 0) token.unit_mm = unit.mm;
            token.is_angle = unit.mm == 0;
            at_ = end;
            return;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<TextToken> tokens_;
};

}  // namespace

std::vector<TextToken> tokens_of(std::string_view folded_text) {
    return Tokenizer(folded_text).read();
}

}  // namespace tribo::readers
