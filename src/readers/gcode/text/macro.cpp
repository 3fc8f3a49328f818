// SPDX-License-Identifier: MIT
#include "readers/gcode/text/macro.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "readers/gcode/text/expression.hpp"
#include "readers/gcode/text/labels.hpp"
#include "readers/gcode/text/lexer.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr std::size_t kMostPlaces = 1'000'000;  // about 50 MB
constexpr int kLastLoop = 127;                  // DO127; Fanuc controls end at DO3, some of their kin go on

// Moves past the word if it stands here. Blanks do not count (ISO 6983-1).
bool take(Cursor& cursor, std::string_view word) {
    Cursor ahead = cursor;
    for (const char c : word) {
        if (to_upper(ahead.peek_after_blanks()) != c) return false;
        ++ahead.at;
    }
    cursor = ahead;
    return true;
}

// The same for a word or its two letters, which Fanuc controls know, too. A number stands behind the letters.
bool take(Cursor& cursor, std::string_view word, std::string_view letters) {
    if (take(cursor, word)) return true;
    Cursor ahead = cursor;
    if (!take(ahead, letters)) return false;
    const char next = ahead.peek_after_blanks();
    if (!is_digit(next) && next != '#' && next != '[') return false;
    cursor = ahead;
    return true;
}

Result<int> read_number(Cursor& cursor, const Parameters& parameters, std::size_t start) {
    const auto value = read_value(cursor, parameters);
    if (!value) return std::unexpected(value.error());
    if (!(*value >= 0 && *value <= kLargestLabel) || *value != std::floor(*value)) {
        return cursor.refuse(start, "the number after GOTO, DO or END is not a whole one", "correct it");
    }
    return static_cast<int>(*value);
}

Result<bool> read_condition(Cursor& cursor, const Parameters& parameters, std::size_t start) {
    if (cursor.peek_after_blanks() != '[') {
        return cursor.refuse(start, "IF or WHILE without its [condition]", "write it in square brackets");
    }
    const auto value = read_value(cursor, parameters);
    if (!value) return std::unexpected(value.error());
    return *value != 0 && !std::isnan(*value);
}

Result<MacroStatement> numbered(MacroKind kind, bool holds, Cursor& cursor, const Parameters& parameters,
                                std::size_t start) {
    const auto number = read_number(cursor, parameters, start);
    if (!number) return std::unexpected(number.error());
    if (kind != MacroKind::jump && (*number < 1 || *number > kLastLoop)) {
        return cursor.refuse(start, "the number of a loop is not one from 1 to 127", "write DO1 and END1");
    }
    return MacroStatement{kind, holds, *number};
}

// Reads the digits at the cursor; none if there are none, or too many.
std::optional<int> take_digits(Cursor& cursor) {
    if (!is_digit(cursor.peek_after_blanks())) return std::nullopt;
    double number = 0;
    while (is_digit(cursor.peek_after_blanks())) {
        number = 10 * number + (cursor.peek() - '0');
        if (number > kLargestLabel) return std::nullopt;
        ++cursor.at;
    }
    return static_cast<int>(number);
}

}  // namespace

bool begins_macro_statement(Cursor cursor) {
    return take(cursor, "IF") || take(cursor, "WHILE", "WH") || take(cursor, "GOTO", "GO");
}

Result<MacroStatement> read_macro_statement(Cursor& cursor, const Parameters& parameters) {
    cursor.skip_blanks();
    const std::size_t start = cursor.at;
    for (const std::string_view word : {"DPRNT", "BPRNT", "POPEN", "PCLOS"}) {
        if (!take(cursor, word)) continue;
        cursor.at = cursor.line.size();
        return MacroStatement{MacroKind::print, true, 0};
    }
    if (take(cursor, "GOTO", "GO")) return numbered(MacroKind::jump, true, cursor, parameters, start);
    if (take(cursor, "END", "EN")) return numbered(MacroKind::end, true, cursor, parameters, start);
    if (take(cursor, "DO")) return numbered(MacroKind::loop, true, cursor, parameters, start);
    const bool is_while = take(cursor, "WHILE", "WH");
    if (!is_while && !take(cursor, "IF")) return MacroStatement{};
    const auto holds = read_condition(cursor, parameters, start);
    if (!holds) return std::unexpected(holds.error());
    if (is_while) {
        if (take(cursor, "DO")) return numbered(MacroKind::loop, *holds, cursor, parameters, start);
        return cursor.refuse(cursor.at, "WHILE without DO", "write WHILE [...] DO1, and END1 after the loop");
    }
    if (take(cursor, "GOTO", "GO")) return numbered(MacroKind::jump, *holds, cursor, parameters, start);
    if (!take(cursor, "THEN") && cursor.peek_after_blanks() != '#') {
        return cursor.refuse(cursor.at, "IF without GOTO or THEN",
                             "write IF [...] GOTO 100, or IF [...] THEN");
    }
    return MacroStatement{MacroKind::then, *holds, 0};
}

Result<MacroPlaces> MacroPlaces::of(std::string_view bytes, const std::string& source_name,
                                    bool skip_deletable) {
    MacroPlaces places;
    TextLines lines(bytes);
    Cursor cursor;
    cursor.source_name = &source_name;
    std::size_t count = 0;
    for (;;) {
        const TextLines at = lines;
        const auto line = lines.next();
        if (!line) return places;
        cursor.line = *line;
        cursor.at = 0;
        cursor.number = lines.number();
        if (cursor.peek_after_blanks() == '/' && skip_deletable) continue;
        if (starts_o_word(cursor)) places.programs_.push_back(lines.number());
        if (take(cursor, "N")) {
            const auto number = take_digits(cursor);
            if (!number) continue;
            places.numbers_[*number].push_back({lines.number(), at});
            ++count;
        }
        if (take(cursor, "END", "EN")) {
            const auto number = take_digits(cursor);
            if (!number) continue;
            places.ends_[*number].push_back({lines.number(), lines});
            ++count;
        }
        if (count > kMostPlaces) {
            return cursor.refuse(0, "the program has more than a million numbered lines and jumps",
                                 "delete the line numbers that nothing jumps to");
        }
    }
}

int MacroPlaces::program_start(int line) const {
    const auto after = std::upper_bound(programs_.begin(), programs_.end(), line);
    return after == programs_.begin() ? 0 : *std::prev(after);
}

int MacroPlaces::program_end(int line) const {
    const auto after = std::upper_bound(programs_.begin(), programs_.end(), line);
    return after == programs_.end() ? std::numeric_limits<int>::max() : *after;
}

namespace {

template <class Places>
auto* first_from(const Places& places, int line) {
    const auto found = std::lower_bound(places.begin(), places.end(), line,
                                        [](const auto& place, int wanted) { return place.line < wanted; });
    return found == places.end() ? nullptr : &*found;
}

}  // namespace

const TextLines* MacroPlaces::find_number(int number, int line) const {
    const auto found = numbers_.find(number);
    if (found == numbers_.end()) return nullptr;
    const int end = program_end(line);
    const auto* place = first_from(found->second, line);
    if (place == nullptr || place->line >= end) place = first_from(found->second, program_start(line));
    return place == nullptr || place->line >= end ? nullptr : &place->where;
}

const TextLines* MacroPlaces::find_end(int number, int line) const {
    const auto found = ends_.find(number);
    if (found == ends_.end()) return nullptr;
    const auto* place = first_from(found->second, line + 1);
    return place == nullptr || place->line >= program_end(line) ? nullptr : &place->where;
}

}  // namespace tribo::readers::gcode
