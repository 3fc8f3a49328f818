// SPDX-License-Identifier: MIT
#include "report/chart/drawing.hpp"

#include <gtest/gtest.h>
#include <set>

#include "report/chart/stroke_font.hpp"
#include "report/stability_picture.hpp"

namespace tribo::report {
namespace {

constexpr Colour kBlack{0, 0, 0};

int red(const files::Image& image, int x, int y) {
    return image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
}

// Sum of what is black, in pixels.
double ink(const files::Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) sum += 1 - red(image, x, y) / 255.0;
    return sum;
}

TEST(Drawing, paints_areas_lines_and_discs_where_they_are) {
    const files::Image area = image_of({40, 30, {DrawnArea{5, 10, 20, 8.5, kBlack}}});
    EXPECT_EQ(red(area, 5, 10), 0);
    EXPECT_EQ(red(area, 24, 17), 0);
    EXPECT_EQ(red(area, 4, 10), 255);
    EXPECT_EQ(red(area, 25, 10), 255);
    EXPECT_NEAR(ink(area), 170, 0.5);
    const files::Image line = image_of({40, 30, {DrawnLine{{{5, 15}, {35, 15}}, 4, kBlack}}});
    EXPECT_NEAR(ink(line), 30 * 4 + 3.14159 * 4, 2);
    EXPECT_EQ(red(line, 20, 15), 0);
    EXPECT_EQ(red(line, 20, 18), 255);
    EXPECT_NEAR(ink(image_of({40, 30, {DrawnDisc{20, 15, 10, kBlack}}})), 314, 3);
    // Beyond the border too.
    EXPECT_NEAR(ink(image_of({40, 30, {DrawnDisc{0, 0, 10, kBlack}}})), 314 / 4, 2);
}

TEST(Drawing, writes_a_text_at_its_anchor) {
    const double width = text_width("HHHH", 10);
    for (const auto& [anchor, from] : {std::pair{TextAnchor::start, 50.0},
                                       {TextAnchor::middle, 50 - 0.5 * width},
                                       {TextAnchor::end, 50 - width}}) {
        const files::Image image = image_of({100, 40, {DrawnText{50, 30, 10, "HHHH", anchor}}});
        int first = 100, lowest = 0, highest = 40;
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 100; ++x) {
                if (red(image, x, y) > 100) continue;
                first = std::min(first, x);
                lowest = std::max(lowest, y);
                highest = std::min(highest, y);
            }
        }
        EXPECT_NEAR(first, from, 1);
        EXPECT_NEAR(lowest, 30, 1);
        EXPECT_NEAR(highest, 20, 1);
    }
}

TEST(StrokeFont, has_a_different_form_for_every_letter_and_digit) {
    std::set<std::vector<Stroke>> forms;
    std::string all = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHJKLMNPQRSTUVWXYZ.,:;()-+/%=<>'";
    for (const char c : all) forms.insert(glyph_of(c).strokes);
    EXPECT_EQ(forms.size(), all.size());
    EXPECT_EQ(glyph_of('\x01').strokes, glyph_of('#').strokes);  // the box
    EXPECT_FALSE(forms.contains(glyph_of('#').strokes));
}

TEST(Drawing, is_a_well_formed_svg_with_its_texts) {
    const std::string svg =
        svg_of({100, 50, {DrawnText{5, 5, 10, "a < b & c"}, DrawnArea{1, 2, 3, 4, kBlack}}});
    EXPECT_NE(svg.find(">a &lt; b &amp; c</text>"), std::string::npos);
    EXPECT_NE(svg.find("<rect x=\"1\" y=\"2\" width=\"3\" height=\"4\" fill=\"#000000\"/>"),
              std::string::npos);
    EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\""));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

// Stable below 1 mm, then growing; at 3000 rpm stable all the way.
dynamics::StabilityChart step_chart() {
    const auto at = [](double rpm, double depth_mm) {
        const double multiplier = rpm > 2800 && rpm < 3200 ? 0.5
                                  : depth_mm < 1           ? 0.9
                                  : depth_mm < 2           ? 1.2
                                                           : 3;
        return dynamics::Stability{multiplier, 0, 0, 0, dynamics::ChatterKind::stable};
    };
    return dynamics::stability_chart({1000, 5000, 50, 4, 0.1}, at, serial_for);
}

TEST(StabilityPicture, is_darker_where_vibrations_grow_faster) {
    const files::Image image = image_of(draw_stability(step_chart(), {"A cut", 2000, 1.5, false}));
    // Columns of pixels near 4700 rpm, away from lines and labels: grey as a printer makes it.
    const auto grey = [&](double share) {
        const int x = 905, y = static_cast<int>(650 - share * 560);
        const std::uint8_t* p = &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
        return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    };
    EXPECT_EQ(grey(0.16), 255);
    EXPECT_LT(grey(0.36), 230);
    EXPECT_LT(grey(0.9), grey(0.36) - 40);
}

TEST(StabilityPicture, names_the_job_the_pocket_and_the_units) {
    const std::string svg = svg_of(draw_stability(step_chart(), {"A cut", 2000, 1.5, false}));
    for (const char* text : {">A cut<", ">spindle speed, rpm<", ">axial depth, mm<",
                             ">the job: 2000 rpm, 1.5 mm, chatters<", ">3000 rpm: 4 mm or more<"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    // A job beside the chart is not drawn into it.
    EXPECT_EQ(svg_of(draw_stability(step_chart(), {"A cut", 9000, 1.5, false})).find("the job:"),
              std::string::npos);
}

}  // namespace
}  // namespace tribo::report
