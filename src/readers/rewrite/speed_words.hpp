// SPDX-License-Identifier: MIT
// Changes the spindle speeds of a program in its own text: the numbers of its speed words (S, TOOL CALL ...
// S, SPINDL). As for feeds, the program must be read again and compared.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "readers/rewrite/feed_words.hpp"

namespace tribo::readers {

// A factor on the speed of a line that moves. > 0.
struct LineSpeed {
    int line = 0;  // from 1
    double factor = 1;
};

// `speeds`: all lines with feed moves, in ascending order. A speed word holds for the first of them that does
// not stand before it. A new speed is rounded to the decimals of the old one. Refuses, with the line, a speed
// that is computed and should change.
Result<std::string> with_speeds(std::string_view text, FeedLanguage language,
                                std::span<const LineSpeed> speeds, const std::string& source_name);

}  // namespace tribo::readers
