// SPDX-License-Identifier: MIT
#include "readers/gcode/text/lexer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::readers::gcode {
namespace {

// Remedy for text that begins with a letter and a number but is no word: TRAORI, X=5.
constexpr const char* kOtherDialect = "post-process the program for LinuxCNC or Fanuc";

// Control characters of punched tapes and of the end of DOS files.
bool is_tape_character(char c) {
    return (c >= 0x11 && c <= 0x14) || c == 0x1A || c == 0x7F;
}

// The code of another control for which Fanuc has none (control/fanuc_words.hpp): FAGORG87, GOKUMA16,
// GNUM45; else empty.
std::string code_of_another(std::string_view name) {
    if (name.starts_with("FAGORG")) return std::string(name.substr(5)) + " of Fagor controls";
    if (name.starts_with("GOKUMA") && name.size() > 6)
        return "G" + std::string(name.substr(6)) + " of Okuma controls";
    if (name.starts_with("GFADAL") && name.size() > 6)
        return std::string(name.substr(6)) + " of Fadal controls";
    if (!name.starts_with("GNUM") || name.size() == 4) return {};
    const std::string_view code = name.substr(4);
    return (is_digit(code[0]) ? "G" : "") + std::string(code) + " of NUM controls";
}

}  // namespace

const Word* macro_call_in(const Block& block) {
    for (const Word& word : block.words) {
        if (word.letter == 'G' && (word.value == 65 || word.value == 66)) return &word;
    }
    return nullptr;
}

Lexer::Lexer(std::string_view bytes, std::string source_name, bool skip_deletable,
             const Parameters& parameters)
    : lines_(bytes),
      block_place_(lines_),
      source_name_(std::move(source_name)),
      skip_deletable_(skip_deletable),
      parameters_(parameters) {
    cursor_.source_name = &source_name_;
}

bool starts_o_word(const Cursor& cursor) {
    Cursor ahead = cursor;
    const char c = ahead.peek_after_blanks();
    if (to_upper(c) == 'O') return true;
    if (c == '<') {  // <NAME>: a program of a Fanuc control
        ahead.at = std::min(ahead.line.find('>', ahead.at), ahead.line.size());
        if (ahead.at == ahead.line.size()) return false;
        ++ahead.at;
        return ahead.at_end() || ahead.peek() == '(';
    }
    if (c != ':') return false;
    ++ahead.at;
    if (!is_digit(ahead.peek_after_blanks())) return false;
    while (is_digit(ahead.peek_after_blanks())) ++ahead.at;
    return ahead.at_end() || ahead.peek() == '(';
}

bool has_word(std::string_view text, char letter) {
    TextLines lines(text);
    while (const auto line = lines.next()) {
        int depth = 0;
        for (const char c : *line) {
            if (c == ';' && depth == 0) break;
            if (c == '(') ++depth;
            if (c == ')' && depth > 0) --depth;
            if (depth == 0 && to_upper(c) == letter) return true;
        }
    }
    return false;
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
    const std::optional<std::size_t> rest = std::exchange(rest_at_, std::nullopt);
    if (!rest) {
        block_place_ = lines_;
        const auto line = lines_.next();
        if (!line) return false;
        cursor_.line = *line;
        cursor_.number = lines_.number();
    }
    cursor_.at = rest.value_or(0);
    block.kind = BlockKind::words;
    block.line = lines_.number();
    block.column = 1;
    block.deletable = block.has_nested_comment = block.has_open_comment = block.has_deleted_rest =
        block.has_print = false;
    block.setting = {};
    block.called.clear();
    block.corner.reset();
    block.polar_radius.reset();
    block.polar_angle.reset();
    block.words.clear();
    block.assignments.clear();
    block.comments.clear();
    if (cursor_.line.size() > kLongestBlock)
        return cursor_.refuse(kLongestBlock, too_long_block(cursor_.line.size()),
                              "write it on several lines");
    if (!rest) {
        const auto is_whole = read_head(block);
        if (!is_whole || *is_whole) return is_whole;
    }
    for (;;) {
        const char c = cursor_.peek_after_blanks();
        if (cursor_.at >= cursor_.line.size() || c == ';') break;
        const bool is_first = block.words.empty() && block.assignments.empty();
        if (is_first && starts_o_word(cursor_)) {
            block.kind = BlockKind::o_word;
            block.column = static_cast<int>(cursor_.at) + 1;
            return true;
        }
        if (c == '/' && is_first) {  // behind the line's number
            block.deletable = true;
            if (skip_deletable_) return true;
            ++cursor_.at;
            if (is_digit(cursor_.peek())) ++cursor_.at;
            continue;
        }
        if (c == '/' && skip_deletable_) {
            block.has_deleted_rest = true;
            block.comments.push_back(cursor_.line);  // T1//15.98 names a tool and its diameter (EZ-CAM)
            return true;
        }
        const bool is_end = c == '%' && trimmed(cursor_.line.substr(cursor_.at + 1)).empty();
        if (is_end) return true;  // M30%
        if (is_tape_character(c)) {
            ++cursor_.at;
            continue;
        }
        if (c == ':' && is_first) {  // alignment block (ISO 6983-1): a line number, perhaps without digits
            ++cursor_.at;
            while (is_digit(cursor_.peek_after_blanks())) ++cursor_.at;
            continue;
        }
        if (!block.assignments.empty() && block.words.empty() && parameters_.is_fanuc() &&
            begins_macro_statement(cursor_)) {  // #1=#1+1 IF [#1 GT 5] GOTO 9: one statement after the other
            rest_at_ = cursor_.at;
            return true;
        }
        if (is_first && is_letter(c) && parameters_.is_fanuc()) {
            const std::size_t start = cursor_.at;
            const auto ends = read_macro(block);
            if (!ends) return std::unexpected(ends.error());
            if (*ends) return true;
            if (cursor_.at != start) continue;  // THEN: its statement follows
        }
        if (c == '<' && !is_first && parameters_.is_fanuc() && block.called.empty()) {
            if (auto read = read_angled_name(cursor_, block.called); !read)
                return std::unexpected(read.error());
            continue;
        }
        if (c == ',' && !is_first) {
            ++cursor_.at;
            if (auto read = read_corner(block); !read) return std::unexpected(read.error());
            continue;
        }
        const bool is_spindle = c == '$' && !is_first && cursor_.at + 1 < cursor_.line.size() &&
                                is_digit(cursor_.line[cursor_.at + 1]);
        if (is_spindle) {  // $0: the number of a spindle (LinuxCNC)
            ++cursor_.at;
            while (is_digit(cursor_.peek())) ++cursor_.at;
            continue;
        }
        const Result<void> read = c == '('   ? read_comment(block)
                                  : c == '#' ? read_assignment(block)
                                             : read_word(block);
        if (!read) return std::unexpected(read.error());
    }
    if (cursor_.at < cursor_.line.size()) block.comments.push_back(cursor_.line.substr(cursor_.at + 1));
    return true;
}

// Returns true if the line is a setting, a '%' or skipped.
Result<bool> Lexer::read_head(Block& block) {
    if (cursor_.peek() == '$') return read_setting(block);
    if (cursor_.peek() == '[' && cursor_.line.size() > 1 && is_letter(cursor_.line[1])) {
        block.setting = trimmed(cursor_.line);  // [BILLET X100 Y80 Z30
        return true;
    }
    if (cursor_.peek_after_blanks() == '%') {
        block.kind = BlockKind::percent;
        block.column = static_cast<int>(cursor_.at) + 1;
        block.label = trimmed(cursor_.line.substr(cursor_.at + 1));
        return true;
    }
    if (cursor_.peek() == '/') {
        block.deletable = true;
        if (skip_deletable_) return true;
        ++cursor_.at;
        if (is_digit(cursor_.peek())) ++cursor_.at;  // number of the delete switch
    }
    return false;
}

// $H, $X, $100=80: commands and settings of Grbl; the name of the file on other controls.
Result<bool> Lexer::read_setting(Block& block) {
    block.setting = trimmed(cursor_.line);
    if (to_upper(block.setting.size() > 1 ? block.setting[1] : ' ') != 'J') return true;
    return cursor_.refuse(0, "$J (jogging) moves the machine and is not read", "write the move as G0 or G1");
}

// Returns true if a statement has ended the block.
Result<bool> Lexer::read_macro(Block& block) {
    const auto statement = read_macro_statement(cursor_, parameters_);
    if (!statement) return std::unexpected(statement.error());
    switch (statement->kind) {
        case MacroKind::none:
            return false;
        case MacroKind::then:
            return !statement->holds;
        case MacroKind::print:
            block.has_print = true;
            return true;
        default:
            block.kind = BlockKind::macro;
            block.macro = *statement;
            // WHILE [] DO1 #1=#1+1: the first statement of the loop stands in its line (Haas).
            if (statement->kind == MacroKind::loop && !cursor_.at_end() && cursor_.peek() != '(') {
                if (statement->holds) rest_at_ = cursor_.at;
                return true;
            }
            if (auto end = read_end(block); !end) return std::unexpected(end.error());
            return true;
    }
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
    std::size_t close = open, depth = 1;
    while (depth > 0) {
        close = line.find_first_of("()", close + 1);
        if (close == std::string_view::npos) break;
        if (line[close] == '(') block.has_nested_comment = true;
        depth += line[close] == '(' ? 1 : static_cast<std::size_t>(-1);
    }
    if (depth > 0) {
        // Not closed: the line must hold nothing behind the last ')', which might close it on other controls.
        const std::size_t last = line.find_last_of(')');
        const bool is_closed = last != std::string_view::npos && last > open;
        if (is_closed && !trimmed(line.substr(last + 1)).empty()) {
            return cursor_.refuse(line.find('(', open + 1), "a comment is opened inside another comment",
                                  "use square brackets inside a comment");
        }
        block.has_open_comment = true;
        close = is_closed ? last : line.size();
    }
    block.comments.push_back(line.substr(open + 1, close - open - 1));
    cursor_.at = std::min(close + 1, line.size());
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
    const auto value = read_formula(cursor_, parameters_);
    if (!value) return std::unexpected(value.error());
    assignment.value = *value;
    block.assignments.push_back(std::move(assignment));
    return {};
}

// The cursor is behind the comma.
Result<void> Lexer::read_corner(Block& block) {
    const std::size_t start = cursor_.at;
    const char letter = to_upper(cursor_.peek_after_blanks());
    if ((letter != 'R' && letter != 'C') || block.corner) {
        return cursor_.refuse(start, "a comma without R or C behind it", "write ,R5 or ,C5, or delete it");
    }
    const std::size_t word = cursor_.at++;
    const auto value = read_number(letter, word);
    if (!value) return std::unexpected(value.error());
    if (*value) block.corner = Word{letter, **value, static_cast<int>(word) + 1};
    return {};
}

// The cursor is on @ or ^.
Result<void> Lexer::read_polar(Block& block) {
    const std::size_t start = cursor_.at++;
    const char sign = cursor_.line[start];
    if (parameters_.is_fanuc()) {
        return cursor_.refuse(start, shown_character(sign) + " is a polar word of LinuxCNC",
                              "choose the dialect linuxcnc, or write the point with X and Y");
    }
    auto& place = sign == '@' ? block.polar_radius : block.polar_angle;
    if (place) {
        return cursor_.refuse(start, shown_character(sign) + " stands twice in the block",
                              "delete one of the two or start a new line between them");
    }
    const auto value = read_number(sign, start);
    if (!value) return std::unexpected(value.error());
    if (*value) place = Word{sign, **value, static_cast<int>(start) + 1};
    return {};
}

Result<void> Lexer::read_word(Block& block) {
    const std::size_t start = cursor_.at;
    const char c = cursor_.peek();
    if (c == '@' || c == '^') return read_polar(block);
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
    // X1.2E-5 may be a number of other systems, X1.2 E-5 is not; E is also an argument: G65 P1 K1.E100.
    if (letter == 'E' && start > 0 && macro_call_in(block) == nullptr &&
        (is_digit(cursor_.line[start - 1]) || cursor_.line[start - 1] == '.')) {
        return cursor_.refuse(start, "E follows a number without a blank, like an exponent",
                              "write the number without exponent, or a blank before E");
    }
    const auto value = read_number(letter, start);
    if (!value) return std::unexpected(value.error());
    if (letter == 'O') {
        return cursor_.refuse(start, "an O-word stands inside the block", "move it to a line of its own");
    }
    if (!*value) return {};
    if (letter != 'N') {
        const std::string_view written = cursor_.line.substr(start, cursor_.at - start);
        const bool is_computed = written.find_first_of("[#") != std::string_view::npos;
        const bool has_point = written.contains('.') && !is_computed;
        block.words.push_back({letter, **value, static_cast<int>(start) + 1, has_point, is_computed});
        const bool shows_text = letter == 'M' && (**value == 117 || **value == 118);  // Marlin
        if (shows_text) cursor_.at = cursor_.line.size();
    } else if (!block.words.empty()) {
        return cursor_.refuse(start, "a line number (N) stands inside the block",
                              "move it to the start of the line");
    }
    return {};
}

Result<std::optional<double>> Lexer::read_number(char letter, std::size_t word) {
    char c = cursor_.peek_after_blanks();
    const bool has_sign = c == '-' || c == '+', negative = c == '-';
    if (has_sign) {
        ++cursor_.at;
        c = cursor_.peek_after_blanks();
    }
    // Z. is zero on Fanuc controls.
    const bool is_point = c == '.' && parameters_.is_fanuc() &&
                          (cursor_.at + 1 == cursor_.line.size() || !is_digit(cursor_.line[cursor_.at + 1]));
    if (is_point) {
        ++cursor_.at;
        return 0.0;
    }
    if (is_digit(c) || c == '.') {
        const auto digits = read_digits(cursor_, word);
        if (!digits) return std::unexpected(digits.error());
        return negative ? -**digits : **digits;
    }
    if (!starts_computed_value(cursor_)) return refuse_number(letter, word, has_sign);
    const auto value = read_value(cursor_, parameters_, parameters_.round_to(letter));
    if (!value) return std::unexpected(value.error());
    if (std::isnan(*value)) return std::nullopt;
    return negative ? -*value : *value;
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
        const std::string_view name = line.substr(word, end - word);
        if (const std::string code = code_of_another(name); !code.empty()) {
            return cursor_.refuse(word, code + " is not read yet",
                                  "let the CAM system write it as plain G0 to G3 moves");
        }
        return cursor_.refuse(word, "'" + std::string(name) + "' is not a letter with a number",
                              std::string(kOtherDialect) + ", or put text into a comment");
    }
    return cursor_.refuse(word, std::string("no number after ") + letter,
                          "add the number or delete the letter");
}

}  // namespace tribo::readers::gcode
