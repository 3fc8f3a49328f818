// SPDX-License-Identifier: MIT
#include "formats/gcode_lexer.hpp"

#include <array>
#include <utility>

namespace tribo::formats::gcode {
namespace {

// Longest number in a word, characters without its sign and blanks; no control writes half as many.
constexpr std::size_t kLongestNumber = 64;

constexpr const char* kPlainWords = "let the CAM system or the control write it out as plain G0 to G3 moves";

bool is_number_character(char c) {
    return is_digit(c) || c == '.';
}

}  // namespace

Lexer::Lexer(std::string_view bytes, std::string source_name, bool skip_deletable)
    : lines_(bytes), source_name_(std::move(source_name)), skip_deletable_(skip_deletable) {}

std::unexpected<Error> Lexer::refuse(std::size_t at, std::string cause, std::string remedy) const {
    return fail_at(source_name_, lines_.number(), static_cast<int>(at) + 1, std::move(cause),
                   std::move(remedy));
}

void Lexer::skip_blanks() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
}

Result<bool> Lexer::next(Block& block) {
    const auto line = lines_.next();
    if (!line) return false;
    line_ = *line;
    at_ = 0;
    block.kind = BlockKind::words;
    block.line = lines_.number();
    block.column = 1;
    block.deletable = false;
    block.words.clear();
    block.comments.clear();

    skip_blanks();
    if (at_ < line_.size() && line_[at_] == '%') {
        block.kind = BlockKind::percent;
        block.column = static_cast<int>(at_) + 1;
        return true;
    }
    if (at_ < line_.size() && line_[at_] == '/') {
        block.deletable = true;
        if (skip_deletable_) return true;
        ++at_;
        if (at_ < line_.size() && is_digit(line_[at_])) ++at_;  // which of several delete switches
    }
    for (;;) {
        skip_blanks();
        if (at_ >= line_.size() || line_[at_] == ';') break;
        const char c = line_[at_];
        const Result<void> read = c == '('             ? read_comment(block)
                                  : to_upper(c) == 'O' ? read_o_word(block)
                                                       : read_word(block);
        if (!read) return std::unexpected(read.error());
    }
    if (at_ < line_.size()) block.comments.push_back(line_.substr(at_ + 1));
    return true;
}

Result<void> Lexer::read_comment(Block& block) {
    const std::size_t open = at_;
    const std::size_t close = line_.find_first_of("()", open + 1);
    if (close == std::string_view::npos) {
        return refuse(open, "a comment is opened here and not closed on this line", "add the missing ')'");
    }
    if (line_[close] == '(') {
        return refuse(close, "a comment is opened inside another comment",
                      "use square brackets inside a comment");
    }
    block.comments.push_back(line_.substr(open + 1, close - open - 1));
    at_ = close + 1;
    return {};
}

Result<void> Lexer::read_o_word(Block& block) {
    const std::size_t start = at_++;
    skip_blanks();
    const std::size_t digits = at_;
    while (at_ < line_.size() && is_digit(line_[at_])) ++at_;
    const bool numbered = at_ > digits;
    while (numbered) {
        skip_blanks();
        if (at_ >= line_.size() || line_[at_] != '(') break;
        if (const auto read = read_comment(block); !read) return read;
    }
    const bool alone = numbered && (at_ >= line_.size() || line_[at_] == ';');
    if (!alone || !block.words.empty()) {
        return refuse(start, "O-words (subroutines, loops and branches) are not read yet", kPlainWords);
    }
    block.kind = BlockKind::program_number;
    block.column = static_cast<int>(start) + 1;
    return {};
}

Result<void> Lexer::read_word(Block& block) {
    const std::size_t start = at_;
    const char c = line_[start];
    if (c == '#' || c == '[') {
        return refuse(start, "variables and expressions are not read yet", kPlainWords);
    }
    if (c == '/') {
        return refuse(start, "'/' deletes whole blocks and stands inside one",
                      "move it to the start of the line");
    }
    if (!is_letter(c)) {
        return refuse(
            start, shown_character(c) + " cannot start a word",
            is_number_character(c) ? "put a letter before the number" : "delete it or put it into a comment");
    }
    ++at_;
    const char letter = to_upper(c);
    const auto value = read_number(letter);
    if (!value) return std::unexpected(value.error());
    if (letter != 'N') {
        block.words.push_back({letter, *value, static_cast<int>(start) + 1});
    } else if (!block.words.empty()) {
        return refuse(start, "a line number (N) stands inside the block", "move it to the start of the line");
    }
    return {};
}

// Blanks between sign and digits, and between digits, do not count: RS274/NGC 3.3.2.
Result<double> Lexer::read_number(char letter) {
    const std::size_t word = at_ - 1;
    skip_blanks();
    const bool has_sign = at_ < line_.size() && (line_[at_] == '-' || line_[at_] == '+');
    const bool negative = has_sign && line_[at_] == '-';
    if (has_sign) {
        ++at_;
        skip_blanks();
    }
    std::array<char, kLongestNumber> digits;
    std::size_t length = 0;
    while (at_ < line_.size() && is_number_character(line_[at_])) {
        if (length == digits.size()) {
            return refuse(word, std::string("the number after ") + letter + " has more than 64 digits",
                          "round it");
        }
        digits[length++] = line_[at_++];
        skip_blanks();
    }
    const auto value = number_of({digits.data(), length});
    if (value) return negative ? -*value : *value;

    const char next = at_ < line_.size() ? line_[at_] : ' ';
    if (length > 0) {
        return refuse(word, std::string("the number after ") + letter + " is malformed",
                      "write it with digits and at most one decimal point");
    }
    if (next == '#' || next == '[') {
        return refuse(at_, "variables and expressions are not read yet", kPlainWords);
    }
    if (next == '=') {
        return refuse(word, std::string("'") + letter + "=' is a word of another dialect",
                      "post-process the program for LinuxCNC or Fanuc");
    }
    if (is_letter(next) && !has_sign) {
        std::size_t end = word;
        while (end < line_.size() && (is_letter(line_[end]) || is_digit(line_[end])) && end - word < 20) {
            ++end;
        }
        return refuse(word,
                      "'" + std::string(line_.substr(word, end - word)) + "' is not a letter with a number",
                      "post-process the program for LinuxCNC or Fanuc, or put text into a comment");
    }
    return refuse(word, std::string("no number after ") + letter, "add the number or delete the letter");
}

}  // namespace tribo::formats::gcode
