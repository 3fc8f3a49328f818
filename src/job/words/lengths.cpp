// SPDX-License-Identifier: MIT
#include "job/words/lengths.hpp"

#include <cmath>

#include "base/text/decimal.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::job {
namespace {

using readers::is_digit;
using readers::is_letter;

struct NamedUnit {
    std::string_view word;
    Unit unit;
};
constexpr NamedUnit kUnits[] = {
    {"mm", Unit::millimetre}, {"in", Unit::inch},    {"inch", Unit::inch},
    {"inches", Unit::inch},   {"deg", Unit::degree}, {"degrees", Unit::degree},
};

bool separates(char c) {
    return readers::is_blank(c) || c == ',' || c == ';' || c == ':' || c == '=';
}

bool begins_number(std::string_view text) {
    const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    if (text.size() > sign && is_digit(text[sign])) return true;
    return text.size() > sign + 1 && text[sign] == '.' && is_digit(text[sign + 1]);
}

Result<Item> take_number(std::string_view& text) {
    Item item;
    std::size_t length = parse_decimal(text, item.value, DecimalExponent::none);
    if (length < text.size() && text[length] == '/') {
        double below = 0;
        const std::size_t more = parse_decimal(text.substr(length + 1), below, DecimalExponent::none);
        if (more == 0 || below == 0) {
            return fail("'" + std::string(text.substr(0, length + 1 + more)) + "' is no fraction",
                        "write 1/4, or 0.25");
        }
        item.value /= below;
        length += 1 + more;
    }
    item.text = text.substr(0, length);
    if (!std::isfinite(item.value))
        return fail("'" + std::string(item.text) + "' is too large", "correct it");
    text.remove_prefix(length);
    if (text.starts_with('"')) {
        item.unit = Unit::inch;
        text.remove_prefix(1);
    }
    return item;
}

Item take_word(std::string_view& text) {
    Item item;
    std::size_t length = 0;
    for (; length < text.size(); ++length) {
        const char c = text[length];
        if (is_letter(c)) {
            item.word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        } else if (c != '_' && !(c == '-' && length + 1 < text.size() && is_letter(text[length + 1]))) {
            break;
        }
    }
    item.text = text.substr(0, length);
    text.remove_prefix(length);
    return item;
}

// Gives the unit to the number before it.
bool take_unit(const Item& item, std::vector<Item>& items) {
    if (items.empty() || !items.back().is_number() || items.back().unit != Unit::none) return false;
    for (const NamedUnit& named : kUnits) {
        if (item.word != named.word) continue;
        items.back().unit = named.unit;
        return true;
    }
    return false;
}

}  // namespace

Result<std::vector<Item>> items_of(std::string_view text) {
    std::vector<Item> items;
    while (!text.empty()) {
        if (separates(text[0]) || (text[0] == '-' && (text.size() == 1 || separates(text[1])))) {
            text.remove_prefix(1);
        } else if (begins_number(text)) {
            const auto number = take_number(text);
            if (!number) return std::unexpected(number.error());
            items.push_back(*number);
        } else if (is_letter(text[0])) {
            const Item word = take_word(text);
            if (!take_unit(word, items)) items.push_back(word);
        } else {
            return fail("the character " + readers::shown_character(text[0]) + " has no meaning here",
                        "write words and numbers");
        }
    }
    return items;
}

}  // namespace tribo::job
