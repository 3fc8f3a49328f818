// SPDX-License-Identifier: MIT
// Changes the feeds of a program in its own text: only feed words are written, in the units and the format of
// number that the program uses. A program that is read again must be compared: what a control makes of its
// words is not known here.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace tribo::readers {

enum class FeedLanguage { gcode, siemens, heidenhain, apt };

// The feed of a line that moves at a feed: a factor on the one that holds there; 1: it stays. > 0.
struct LineFeed {
    int line = 0;  // from 1
    double factor = 1;
};

// A new feed is rounded down. Of a feed that is lower than the wanted one by at most kFeedReuse nothing is
// written: it holds on. A factor within kFeedKept of 1 counts as 1, so that a second change finds nothing.
inline constexpr double kFeedReuse = 0.01;
inline constexpr double kFeedKeptBelow = 0.985, kFeedKeptAbove = 1.003;

// Whether a feed with this factor stays as it is.
bool keeps_feed(double factor);

// `feeds`: all lines with feed moves, in ascending order, each once. APT has no feed words in its motions:
// there a FEDRAT statement is set before one. Refuses, with the line: feeds that are computed, and lines
// without any feed before them.
Result<std::string> with_feeds(std::string_view text, FeedLanguage language, std::span<const LineFeed> feeds,
                               const std::string& source_name);

}  // namespace tribo::readers
