// SPDX-License-Identifier: MIT
#include "readers/gcode/text/lexer.hpp"

#include <utility>

namespace tribo::readers::gcode {
namespace {

// Remedy for text that begins with a letter and a number but is no word: TRAORI, X=5.
constexpr const char* kOtherDialect = "post-process the program for LinuxCNC or Fanuc";

}  // namespace

Lexer::Lexer(std::string_view bytes, std::string source_name, bool skip_deletable,
             const Parameters& parameters)
    : lines_(bytes),
      source_name_(std::move(source_name)),
      skip_deletable_(skip_deletable),
      parameters_(parameters) {
    cursor_.source_name = &source_name_;
}

bool skip_block_head(Cursor& cursor) {
    bool deletable = false;
    if (cursor.peek_after_blanks() == '/') {
        deletable = true;
        ++cursor.at;
        if (is_digit(cursor.peek())) ++cursor.at;  // number of the delete switch
    }
    if (to_upper(cursor.peek_after_blanks()) == 'N') {
        ++cursor.at;
        while (is_digit(cursor.peek_after_blanks()) || cursor.peek() == '.') ++cursor.at;
    }
    return deletable;
}

Result<bool> Lexer::next(Block& block) {
    const auto line = lines_.next();
    if (!line) return false;
    cursor_.line = *line;
    cursor_.at = 0;
    cursor_.number = lines_.number();
    block.kind = BlockKind::words;
    block.line = lines_.number();
    block.column = 1;
    block.deletable = false;
    block.words.clear();
    block.assignments.clear();
    block.comments.clear();
    if (line->size() > kLongestBlock)
        return cursor_.refuse(kLongestBlock, too_long_block(line->size()), "write it on several lines");

    if (cursor_.peek_after_blanks() == '%') {
        block.kind = BlockKind::percent;
        block.column = static_cast<int>(cursor_.at) + 1;
        return true;
    }
    if (cursor_.peek() == '/') {
        block.deletable = true;
        if (skip_deletable_) return true;
        ++cursor_.at;
        if (is_digit(cursor_.peek())) ++cursor_.at;  // number of the delete switch
    }
    for (;;) {
        const char c = cursor_.peek_after_blanks();
        if (cursor_.at >= cursor_.line.size() || c == ';') break;
        if ((c == 'O' || c == 'o') && block.words.empty() && block.assignments.empty()) {
            block.kind = BlockKind::o_word;
            block.column = static_cast<int>(cursor_.at) + 1;
            return true;
        }
        const Result<void> read = c == '('   ? read_comment(block)
                                  : c == '#' ? read_assignment(block)
                                             : read_word(block);
        if (!read) return std::unexpected(read.error());
    }
    if (cursor_.at < cursor_.line.size()) block.comments.push_back(cursor_.line.substr(cursor_.at + 1));
    return true;
}

Result<void> Lexer::read_end(Block& block) {
    while (!cursor_.at_end()) {
        if (cursor_.peek() != '(') {
            return cursor_.refuse(cursor_.at, "nothing but a comment may follow here",
                                  "move the rest to the next line");
        }
        if (auto read = read_comment(block); !read) return read;
    }
    return {};
}

Result<void> Lexer::read_comment(Block& block) {
    const std::string_view line = cursor_.line;
    const std::size_t open = cursor_.at;
    const std::size_t close = line.find_first_of("()", open + 1);
    if (close == std::string_view::npos) {
        return cursor_.refuse(open, "a comment is opened here and not closed on this line",
                              "add the missing ')'");
    }
    if (line[close] == '(') {
        return cursor_.refuse(close, "a comment is opened inside another comment",
                              "use square brackets inside a comment");
    }
    block.comments.push_back(line.substr(open + 1, close - open - 1));
    cursor_.at = close + 1;
    return {};
}

Result<void> Lexer::read_assignment(Block& block) {
    Assignment assignment;
    const std::size_t start = cursor_.at;
    assignment.column = static_cast<int>(start) + 1;
    if (auto read = read_parameter_name(cursor_, parameters_, assignment.to); !read) return read;
    if (cursor_.peek_after_blanks() != '=') {
        return cursor_.refuse(start, "a parameter stands here without '=' and a value",
                              "assign a value to it, or put a letter before it");
    }
    ++cursor_.at;
    const auto value = read_value(cursor_, parameters_);
    if (!value) return std::unexpected(value.error());
    assignment.value = *value;
    block.assignments.push_back(std::move(assignment));
    return {};
}

Result<void> Lexer::read_word(Block& block) {
    const std::size_t start = cursor_.at;
    const char c = cursor_.peek();
    if (c == '/') {
        return cursor_.refuse(start, "'/' deletes whole blocks and stands inside one",
                              "move it to the start of the line");
    }
    if (c == '[') {
        return cursor_.refuse(start, "an expression stands here without a letter or parameter to give it to",
                              "write X[...] or #1=[...]");
    }
    if (!is_letter(c)) {
        return cursor_.refuse(start, shown_character(c) + " cannot start a word",
                              is_digit(c) || c == '.' ? "put a letter before the number"
                                                      : "delete it or put it into a comment");
    }
    ++cursor_.at;
    const char letter = to_upper(c);
    const auto value = read_number(letter, start);
    if (!value) return std::unexpected(value.error());
    if (letter == 'O') {
        return cursor_.refuse(start, "an O-word stands inside the block", "move it to a line of its own");
    }
    if (letter != 'N') {
        block.words.push_back({letter, *value, static_cast<int>(start) + 1});
    } else if (!block.words.empty()) {
        return cursor_.refuse(start, "a line number (N) stands inside the block",
                              "move it to the start of the line");
    }
    return {};
}

Result<double> Lexer::read_number(char letter, std::size_t word) {
    char c = cursor_.peek_after_blanks();
    const bool has_sign = c == '-' || c == '+', negative = c == '-';
    if (has_sign) {
        ++cursor_.at;
        c = cursor_.peek_after_blanks();
    }
    if (is_digit(c) || c == '.') {
        const auto digits = read_digits(cursor_, word);
        if (!digits) return std::unexpected(digits.error());
        return negative ? -**digits : **digits;
    }
    if (!starts_computed_value(cursor_)) return refuse_number(letter, word, has_sign);
    auto value = read_value(cursor_, parameters_);
    if (value && negative) *value = -*value;
    return value;
}

// Refuses the text at the place of a number.
std::unexpected<Error> Lexer::refuse_number(char letter, std::size_t word, bool has_sign) {
    const std::string_view line = cursor_.line;
    const char next = cursor_.peek();
    if (next == '=') {
        return cursor_.refuse(word, std::string("'") + letter + "=' is a word of another dialect",
                              kOtherDialect);
    }
    if (is_letter(next) && !has_sign) {
        std::size_t end = word;
        while (end < line.size() && (is_letter(line[end]) || is_digit(line[end])) && end - word < 20) {
            ++end;
        }
        return cursor_.refuse(
            word, "'" + std::string(line.substr(word, end - word)) + "' is not a letter with a number",
            std::string(kOtherDialect) + ", or put text into a comment");
    }
    return cursor_.refuse(word, std::string("no number after ") + letter,
                          "add the number or delete the letter");
}

}  // namespace tribo::readers::gcode
