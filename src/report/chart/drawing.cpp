// SPDX-License-Identifier: MIT
#include "report/chart/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "report/chart/stroke_font.hpp"

namespace tribo::report {
namespace {

constexpr double kPen = 0.13;         // width of a stroke of a letter, in capitals
constexpr double kSvgCapital = 0.72;  // height of a capital, in sizes of a common font

std::uint8_t byte_of(float share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0F, 1.0F)));
}

// At most two places, without zeros at the end.
std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    std::string s = text;
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s;
}

std::string hex(const Colour& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte_of(colour[0]), byte_of(colour[1]),
                  byte_of(colour[2]));
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&') {
            out += "&amp;";
        } else if (c == '<') {
            out += "&lt;";
        } else {
            out += c;
        }
    }
    return out;
}

struct Svg {
    std::string text;

    void operator()(const DrawnArea& a) {
        text += "<rect x=\"" + number(a.x) + "\" y=\"" + number(a.y) + "\" width=\"" + number(a.width) +
                "\" height=\"" + number(a.height) + "\" fill=\"" + hex(a.fill) + "\"/>\n";
    }
    void operator()(const DrawnLine& l) {
        text += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" stroke=\"" +
                hex(l.colour) + "\" stroke-width=\"" + number(l.width) + "\" points=\"";
        for (const auto& p : l.points) text += number(p[0]) + "," + number(p[1]) + " ";
        text += "\"/>\n";
    }
    void operator()(const DrawnDisc& d) {
        text += "<circle cx=\"" + number(d.x) + "\" cy=\"" + number(d.y) + "\" r=\"" + number(d.radius) +
                "\" fill=\"" + hex(d.fill) + "\"/>\n";
    }
    void operator()(const DrawnText& t) {
        static constexpr const char* kAnchors[] = {"start", "middle", "end"};
        text += "<text x=\"" + number(t.x) + "\" y=\"" + number(t.y) + "\" font-size=\"" +
                number(t.height / kSvgCapital) + "\" text-anchor=\"" +
                kAnchors[static_cast<std::size_t>(t.anchor)] + "\" fill=\"" + hex(t.colour) + "\"";
        if (t.upwards) text += " transform=\"rotate(-90 " + number(t.x) + " " + number(t.y) + ")\"";
        text += ">" + escaped(t.text) + "</text>\n";
    }
};

// Paints a pixel by the share of it that is covered.
struct Paint {
    files::Image& image;

    void blend(int x, int y, double share, const Colour& colour) {
        if (x < 0 || y < 0 || x >= image.width || y >= image.height || share <= 0) return;
        std::uint8_t* pixel = &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
        for (std::size_t c = 0; c < 3; ++c) {
            const double old = pixel[c] / 255.0;
            pixel[c] = byte_of(static_cast<float>(old + std::min(share, 1.0) * (colour[c] - old)));
        }
    }
    // What lies within `radius` of a piece of a line.
    void capsule(std::array<double, 2> a, std::array<double, 2> b, double radius, const Colour& colour) {
        const double dx = b[0] - a[0], dy = b[1] - a[1], squared = dx * dx + dy * dy;
        const auto low = [&](double p, double q) {
            return static_cast<int>(std::floor(std::min(p, q) - radius - 1));
        };
        const auto high = [&](double p, double q) {
            return static_cast<int>(std::ceil(std::max(p, q) + radius + 1));
        };
        for (int y = std::max(0, low(a[1], b[1])); y <= std::min(image.height - 1, high(a[1], b[1])); ++y) {
            for (int x = std::max(0, low(a[0], b[0])); x <= std::min(image.width - 1, high(a[0], b[0]));
                 ++x) {
                const double px = x + 0.5 - a[0], py = y + 0.5 - a[1];
                const double along = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0.0;
                const double apart = std::hypot(px - along * dx, py - along * dy);
                blend(x, y, radius + 0.5 - apart, colour);
            }
        }
    }

    void operator()(const DrawnArea& a) {
        const auto covered = [](int pixel, double from, double to) {
            return std::clamp(std::min(pixel + 1.0, to) - std::max<double>(pixel, from), 0.0, 1.0);
        };
        for (int y = std::max(0, static_cast<int>(a.y)); y < std::min<double>(image.height, a.y + a.height);
             ++y) {
            for (int x = std::max(0, static_cast<int>(a.x)); x < std::min<double>(image.width, a.x + a.width);
                 ++x)
                blend(x, y, covered(x, a.x, a.x + a.width) * covered(y, a.y, a.y + a.height), a.fill);
        }
    }
    void operator()(const DrawnLine& l) {
        for (std::size_t n = 0; n + 1 < l.points.size(); ++n)
            capsule(l.points[n], l.points[n + 1], 0.5 * l.width, l.colour);
    }
    void operator()(const DrawnDisc& d) { capsule({d.x, d.y}, {d.x, d.y}, d.radius, d.fill); }
    void operator()(const DrawnText& t) {
        const double share = t.anchor == TextAnchor::start ? 0 : t.anchor == TextAnchor::middle ? 0.5 : 1;
        double at = -share * text_width(t.text, t.height);
        for (const char c : t.text) {
            const Glyph glyph = glyph_of(c);
            for (const Stroke& stroke : glyph.strokes) {
                const auto placed = [&](std::size_t n) -> std::array<double, 2> {
                    const auto& p = stroke[std::min(n, stroke.size() - 1)];
                    const double along = at + t.height * p[0], up = t.height * p[1];
                    if (t.upwards) return {t.x - up, t.y - along};
                    return {t.x + along, t.y - up};
                };
                for (std::size_t n = 0; n + 1 < std::max<std::size_t>(2, stroke.size()); ++n)
                    capsule(placed(n), placed(n + 1), 0.5 * kPen * t.height, t.colour);
            }
            at += t.height * glyph.advance;
        }
    }
};

}  // namespace

std::string svg_of(const Drawing& drawing) {
    const std::string size = number(drawing.width) + "\" height=\"" + number(drawing.height);
    Svg svg;
    svg.text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " +
               number(drawing.width) + " " + number(drawing.height) +
               "\" font-family=\"Helvetica, Arial, sans-serif\">\n<rect width=\"" + size +
               "\" fill=\"#ffffff\"/>\n";
    for (const auto& shape : drawing.shapes) std::visit(svg, shape);
    return svg.text + "</svg>\n";
}

files::Image image_of(const Drawing& drawing) {
    files::Image image{drawing.width, drawing.height, {}};
    image.rgba.assign(4 * static_cast<std::size_t>(drawing.width * drawing.height), 255);
    Paint paint{image};
    for (const auto& shape : drawing.shapes) std::visit(paint, shape);
    return image;
}

double text_width(const std::string& text, double height) {
    double sum = 0;
    for (const char c : text) sum += glyph_of(c).advance;
    return height * sum;
}

}  // namespace tribo::report
