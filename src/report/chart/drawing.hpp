// SPDX-License-Identifier: MIT
// A flat drawing of areas, lines and texts that becomes a PNG or an SVG: charts that are looked at without a
// browser. In pixels; x to the right, y down. The same drawing gives the same bytes.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "files/image/image.hpp"
#include "report/picture/picture.hpp"

namespace tribo::report {

struct DrawnArea {
    double x, y, width, height;
    Colour fill;
};
struct DrawnLine {
    std::vector<std::array<double, 2>> points;
    double width;
    Colour colour;
};
struct DrawnDisc {
    double x, y, radius;
    Colour fill;
};
enum class TextAnchor { start, middle, end };
// The base line begins, has its middle or ends at (x, y). ASCII; other characters become boxes in a PNG.
struct DrawnText {
    double x, y;
    double height;  // of a capital
    std::string text;
    TextAnchor anchor = TextAnchor::start;
    bool upwards = false;  // read from below
    Colour colour{0.1F, 0.1F, 0.1F};
};

struct Drawing {
    int width = 0, height = 0;
    // Later ones cover earlier ones.
    std::vector<std::variant<DrawnArea, DrawnLine, DrawnDisc, DrawnText>> shapes;
};

std::string svg_of(const Drawing& drawing);
// On white.
files::Image image_of(const Drawing& drawing);
// Of a text in a PNG; an SVG leaves the font to its viewer.
double text_width(const std::string& text, double height);

}  // namespace tribo::report
