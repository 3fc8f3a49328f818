// SPDX-License-Identifier: MIT
#include "readers/rewrite/speed_words.hpp"

#include <algorithm>
#include <cmath>

#include "base/text/decimal.hpp"
#include "readers/rewrite/word_search.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

constexpr WordName kSpeedName{'S', "SPINDL"};

std::string with_decimals_of(std::string_view old, double value) {
    const std::size_t point = old.find_first_of(".,");
    const std::size_t decimals = point == std::string_view::npos ? 0 : old.size() - point - 1;
    double scale = 1;
    for (std::size_t n = 0; n < std::min<std::size_t>(decimals, 6); ++n) scale *= 10;
    std::string text = format_decimal(std::max(1.0, std::round(value * scale)) / scale);
    if (point == std::string_view::npos) return text;
    if (const std::size_t dot = text.find('.'); dot != text.npos) {
        text[dot] = old[point];
    } else {
        text += old[point];
    }
    return text;
}

}  // namespace

Result<std::string> with_speeds(std::string_view text, FeedLanguage language,
                                std::span<const LineSpeed> speeds, const std::string& source_name) {
    std::string out;
    std::size_t copied = 0;
    TextLines lines(text);
    auto next = speeds.begin();
    while (const auto line = lines.next()) {
        next = std::find_if(next, speeds.end(), [&](const auto& s) { return s.line >= lines.number(); });
        if (next == speeds.end()) break;
        const auto word = word_in_line(*line, language, kSpeedName);
        if (!word || next->factor == 1) continue;
        // SPINDL/ON and SPINDL/OFF have no number.
        if (word->computed && language == FeedLanguage::apt) continue;
        if (word->computed)
            return fail_at(source_name, lines.number(), 0, "the spindle speed of this line is computed",
                           "write it as a number");
        const auto at = static_cast<std::size_t>(line->data() - text.data());
        out += text.substr(copied, at + word->at - copied);
        out += with_decimals_of(line->substr(word->at, word->end - word->at), next->factor * word->value);
        copied = at + word->end;
    }
    out += text.substr(copied);
    return out;
}

}  // namespace tribo::readers
