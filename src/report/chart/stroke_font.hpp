// SPDX-License-Identifier: MIT
// Letters as strokes of a pen.
#pragma once

#include <array>
#include <vector>

namespace tribo::report {

using Stroke = std::vector<std::array<double, 2>>;  // one point: a dot

struct Glyph {
    double advance = 0;  // to the next glyph
    std::vector<Stroke> strokes;
};

// Of a character, with capitals of height 1, the base line at 0 and y upwards. An unknown one is a box.
Glyph glyph_of(char character);

}  // namespace tribo::report
