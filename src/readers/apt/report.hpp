// SPDX-License-Identifier: MIT
// Errors and warnings of the APT reader, and the numbers of a statement.
#pragma once

#include <array>
#include <string>

#include "base/limits.hpp"
#include "base/result.hpp"
#include "readers/apt/lexer.hpp"

namespace tribo::readers::apt {

// Assumptions with one warning per program, however often they are made.
enum class Note {
    unit,
    feed,
    spindle_off,
    spindle_stands,
    spindle_backwards,
    cutter_shape,
    inserted_text,
    second_frame,
    local_frame,
    translation,
    origin,
    home,
    rapid_speed,
    full_circle,
    pecks,
    compensation,
    surface_normal,
    arc_slope,
    inch_feeds,
    tool_name,
    turning,
    count
};

class Report {
  public:
    explicit Report(std::string source_name) : source_name_(std::move(source_name)) {}

    std::unexpected<Error> refuse(const Item& at, std::string cause, std::string remedy) const;
    // Reads the item as a number; in the range if one is given.
    Result<double> number(const Item& item) const;
    Result<double> number(const Item& item, const Range& range) const;
    // `scale`: of the number's unit in that of the limit. Returns the number as it is written.
    Result<double> number(const Item& item, const Limit& limit, double scale = 1) const;
    // Returns true at the first call for a note.
    bool first(Note note);
    void warn(int line, std::string text);

    Warnings warnings;

  private:
    std::string source_name_;
    std::array<bool, static_cast<std::size_t>(Note::count)> noted_{};
};

// The range of lengths in a unit.
inline Range lengths(double unit_mm) {
    return {0, kLimits.coordinate.range.max / unit_mm};
}

// Returns an item in quotes, for messages.
std::string quoted(std::string_view text);

}  // namespace tribo::readers::apt
