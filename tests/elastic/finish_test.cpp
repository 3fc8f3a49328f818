// SPDX-License-Identifier: MIT
// Pictures of sheets with a finish: what shows of a dent, and what must not.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "elastic/colour_difference.hpp"
#include "elastic/picture.hpp"
#include "places.hpp"

namespace tribo::elastic {
namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr int kSide = 192;
constexpr double kWidthMm = 80;

Pixels plain(int grey, int side = kSide) {
    Pixels image(4 * static_cast<std::size_t>(side * side), static_cast<std::uint8_t>(grey));
    for (std::size_t i = 3; i < image.size(); i += 4) image[i] = 255;
    return image;
}

// Off-white with fibres a few pixels long: a made-up photograph of paper.
Pixels paper() {
    std::mt19937 random(7);
    std::vector<double> noise(kSide * kSide);
    for (double& n : noise) n = static_cast<double>(random() % 2001) / 1000 - 1;
    Pixels image = plain(255);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            double sum = 0;
            for (int k = 0; k < 9; ++k) {
                const int i = std::min(x + k % 3, kSide - 1), j = std::min(y + k / 3, kSide - 1);
                sum += noise[static_cast<std::size_t>(j * kSide + i)];
            }
            const auto at = static_cast<std::size_t>(4 * (y * kSide + x));
            for (std::size_t c = 0; c < 3; ++c) {
                image[at + c] = static_cast<std::uint8_t>(
                    std::clamp(242 - 3.0 * static_cast<double>(c) + 4 * sum, 0.0, 255.0));
            }
        }
    }
    return image;
}

Sheet pressed(double stiffness, double force, double x_mm = kWidthMm / 2, double y_mm = kWidthMm / 2) {
    Sheet sheet({kSide, kSide, kWidthMm / kSide});
    sheet.set_material({stiffness, 0});
    ContactEllipse c;
    c.x_mm = x_mm;
    c.y_mm = y_mm;
    c.force_n = force;
    sheet.press({&c, 1});
    sheet.step(1);
    return sheet;
}

// As draw_rows, out of relief of its own.
Pixels drawn(const Sheet& sheet, const Pixels& image, Finish finish = {}, const PictureView& view = {},
             float rms_slope = 0.2F) {
    const int side = sheet.size().width;
    const SmallRelief relief = small_relief(image, side, side, rms_slope);
    finish.relief = &relief;
    Pixels out(image.size());
    draw_rows(sheet, image, out, 0, side, &finish, view);
    return out;
}

// From straight above: nothing shifts, so that whatever changes is light.
PictureView from_above() {
    PictureView view;
    view.eye_below = 0;
    view.eye_height = 1e9F;
    return view;
}

int grey_at(const Pixels& image, int x, int y) {
    return image[static_cast<std::size_t>(4 * (y * kSide + x))];
}

TEST(ColourDifference, is_that_of_the_published_pairs) {
    const struct {
        Lab a, b;
        double difference;
    } pairs[] = {
        {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
        {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
        {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
        {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    for (const auto& p : pairs) {
        EXPECT_NEAR(ciede2000(p.a, p.b), p.difference, 1e-4);
        EXPECT_NEAR(ciede2000(p.b, p.a), p.difference, 1e-4);
    }
    const std::uint8_t red[] = {255, 0, 0}, black[] = {0, 0, 0};
    EXPECT_NEAR(lab_of(red)[0], 53.24, 0.01);
    EXPECT_NEAR(lab_of(red)[1], 80.09, 0.01);
    EXPECT_NEAR(lab_of(red)[2], 67.20, 0.01);
    EXPECT_NEAR(cie76(lab_of(red), lab_of(black)), std::hypot(53.24, 80.09, 67.20), 0.02);
}

TEST(SmallRelief, has_the_slope_asked_for_and_leans_away_from_what_is_bright) {
    const Pixels image = paper();
    const SmallRelief relief = small_relief(image, kSide, kSide, 0.2F);
    double sum = 0;
    for (const std::int8_t s : relief.slopes) sum += std::pow(s * static_cast<double>(kSteepest) / 127, 2);
    EXPECT_NEAR(std::sqrt(sum / (kSide * kSide)), 0.2, 0.02);
    // A bright line from top to bottom: its left side leans to the left.
    Pixels line = plain(60);
    for (int y = 0; y < kSide; ++y)
        for (std::size_t c = 0; c < 3; ++c) line[static_cast<std::size_t>(4 * (y * kSide + 90)) + c] = 200;
    const SmallRelief ridge = small_relief(line, kSide, kSide, 0.2F);
    const auto slope = [&](int x, int axis) {
        return ridge.slopes[static_cast<std::size_t>(2 * (50 * kSide + x) + axis)];
    };
    EXPECT_LT(slope(89, 0), -20);
    EXPECT_GT(slope(91, 0), 20);
    EXPECT_EQ(slope(89, 0), -slope(91, 0));
    for (int x = 0; x < kSide; ++x) EXPECT_EQ(slope(x, 1), 0);
}

TEST(SmallRelief, is_none_of_a_plain_image_and_next_to_none_of_noise_of_its_bits) {
    for (const std::int8_t s : small_relief(plain(200), kSide, kSide, 1).slopes) ASSERT_EQ(s, 0);
    for (const std::int8_t s : small_relief(paper(), kSide, kSide, 0).slopes) ASSERT_EQ(s, 0);
    std::mt19937 random(3);
    Pixels noise = plain(200);
    for (std::uint8_t& v : noise) v = static_cast<std::uint8_t>(v - random() % 2);
    double sum = 0;
    for (const std::int8_t s : small_relief(noise, kSide, kSide, 0.2F).slopes) {
        sum += std::pow(s * static_cast<double>(kSteepest) / 127, 2);
    }
    EXPECT_LT(std::sqrt(sum / (kSide * kSide)), 0.07);
}

// Sides of one pixel, of one row or column, and where the blur is wider than the image.
TEST(SmallRelief, takes_images_of_any_size) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {3, 200}}) {
        Pixels image(4 * static_cast<std::size_t>(width * height));
        for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<std::uint8_t>(i * i * 7);
        EXPECT_EQ(small_relief(image, width, height, 0.2F).slopes.size(), image.size() / 2);
    }
}

TEST(Finish, at_rest_is_the_image_byte_by_byte_whatever_the_material) {
    std::mt19937 random(1);
    Pixels image = plain(0);
    for (std::uint8_t& v : image) v = static_cast<std::uint8_t>(random());
    const Sheet sheet({kSide, kSide, 0.3});
    for (const float gloss : {0.0F, 0.04F, 1.0F}) {
        for (const float roughness : {0.05F, 0.5F, 1.0F}) {
            EXPECT_EQ(drawn(sheet, image, {nullptr, gloss, roughness}, {}, 1), image);
        }
    }
}

// 0.5 N on K = 7 and 1.4 N/mm, the paper and the sponge of the touch paper.
TEST(Finish, half_a_newton_is_seen_on_two_percent_of_paper_and_ten_of_sponge) {
    const Pixels image = paper();
    // From below, and by light alone.
    for (const PictureView& view : {PictureView{}, from_above()}) {
        const auto seen = [&](double stiffness) {
            Finish finish;
            finish.full_mm = static_cast<float>(2 / stiffness);
            return share_seen(image, drawn(pressed(stiffness, 0.5), image, finish, view));
        };
        EXPECT_GE(seen(7), 0.02);
        EXPECT_GE(seen(1.4), 0.10);
    }
}

TEST(Finish, shows_the_rim_of_a_dent_in_a_plain_grey_image) {
    const Pixels image = plain(128), out = drawn(pressed(7, 0.5), image, {}, from_above());
    EXPECT_GE(share_seen(image, out), 0.02);
    // Dark and bright where the wall is steepest, half a radius about the rim, on the line towards the light.
    const auto [dark, bright] = std::minmax_element(
        out.begin(), out.end(), [](int a, int b) { return (a == 255 ? 128 : a) < (b == 255 ? 128 : b); });
    const auto from_centre = [&](auto at) {
        const auto pixel = (at - out.begin()) / 4;
        const double x = static_cast<double>(pixel % kSide) + 0.5 - kSide / 2.0,
                     y = static_cast<double>(pixel / kSide) + 0.5 - kSide / 2.0;
        return std::array{std::hypot(x, y) * kWidthMm / kSide, std::atan2(y, x)};
    };
    EXPECT_NEAR(from_centre(dark)[0], 6, 3);
    EXPECT_NEAR(from_centre(bright)[0], 6, 3);
    const PictureView view;
    const double to_light = std::atan2(view.light_y, view.light_x);
    EXPECT_NEAR(from_centre(dark)[1], to_light, 0.5);
    EXPECT_NEAR(std::abs(from_centre(bright)[1] - to_light), std::numbers::pi, 0.5);
    EXPECT_LT(*dark, 128 - 6);
    EXPECT_GT(*bright, 128 + 6);
}

TEST(Finish, is_the_same_wherever_the_dent_is_and_symmetric_about_the_light) {
    const Pixels image = plain(128);
    PictureView view = from_above();
    view.light_x = view.light_y = -0.53033F;
    const double node = kWidthMm / kSide;
    const Pixels here = drawn(pressed(1.4, 1, 96 * node, 96 * node), image, {}, view);
    const Pixels there = drawn(pressed(1.4, 1, 106 * node, 92 * node), image, {}, view);
    for (int y = 60; y < 130; ++y) {
        for (int x = 60; x < 130; ++x) {
            ASSERT_NEAR(grey_at(here, x, y), grey_at(here, y, x), 1) << x << ' ' << y;
            ASSERT_NEAR(grey_at(here, x, y), grey_at(there, x + 10, y - 4), 1) << x << ' ' << y;
        }
    }
}

// An image of a relief as this light shows it: pressed flat, it is the plain colour that the relief has.
TEST(Finish, evens_out_under_the_finger_what_light_shows_of_the_relief) {
    const SmallRelief relief = small_relief(paper(), kSide, kSide, 0.2F);
    const PictureView view = from_above();
    Pixels image = plain(255);
    for (std::size_t i = 0; i < relief.slopes.size(); i += 2) {
        const double step = static_cast<double>(kSteepest) / 127, x = step * relief.slopes[i],
                     y = step * relief.slopes[i + 1];
        const double l[] = {view.light_x, view.light_y, view.light_z}, sky = view.ambient;
        const double sun = (x * l[0] + y * l[1] + l[2]) / std::sqrt(x * x + y * y + 1) / l[2];
        const double light = 0.3 * (sky + (1 - sky) * sun);
        for (std::size_t c = 0; c < 3; ++c) {
            image[2 * i + c] = static_cast<std::uint8_t>(std::lround(255 * std::pow(light, 1 / 2.2)));
        }
    }
    const int colour = static_cast<int>(std::lround(255 * std::pow(0.3, 1 / 2.2)));
    const Sheet sheet = pressed(1.4, 3);
    const auto lit = [&](const SmallRelief* own, const Pixels& picture, float flatten_mm) {
        Finish finish{own, 0};
        finish.flatten_mm = flatten_mm;
        Pixels out(picture.size());
        draw_rows(sheet, picture, out, 0, kSide, &finish, view);
        return out;
    };
    // How far a picture is from that of the plain colour, in the middle of the dent.
    const auto deviation = [](const Pixels& picture, const Pixels& smooth) {
        double squares = 0;
        for (int y = 92; y < 100; ++y) {
            for (int x = 92; x < 100; ++x)
                squares += std::pow(grey_at(picture, x, y) - grey_at(smooth, x, y), 2);
        }
        return std::sqrt(squares / 64);
    };
    const double at_rest = deviation(image, plain(colour));
    const Pixels smooth = lit(nullptr, plain(colour), 1);
    const auto left = [&](float flatten_mm) { return deviation(lit(&relief, image, flatten_mm), smooth); };
    ASSERT_GT(at_rest, 4);
    EXPECT_NEAR(left(1e9F), at_rest, 0.15 * at_rest);
    EXPECT_LT(left(3), 0.4 * at_rest);
    EXPECT_LT(left(0.01F), 1);
}

TEST(Finish, does_not_clip_black_nor_white) {
    for (const double force : {0.5, 3.0}) {
        const Sheet sheet = pressed(1.4, force);
        // Black is lit by what it mirrors, and never glares.
        const Pixels black = drawn(sheet, plain(0), {}, from_above());
        int brightest = 0;
        for (std::size_t i = 0; i < black.size(); i += 4) brightest = std::max<int>(brightest, black[i]);
        EXPECT_GT(brightest, 8);
        EXPECT_LT(brightest, 80);
        // White cannot get brighter; its shaded walls show, and none is black.
        const Pixels white = drawn(sheet, plain(255), {}, from_above());
        const int darkest = *std::min_element(white.begin(), white.end());
        EXPECT_LT(darkest, 240);
        EXPECT_GT(darkest, 60);
        // Nearly white does not turn white, and keeps its grain where it is lit.
        const Pixels image = paper();
        const Pixels out = drawn(sheet, image, {}, from_above());
        const auto whites = [](const Pixels& p) {
            return std::count(p.begin(), p.end(), 255) - kSide * kSide;
        };
        EXPECT_LE(whites(out), whites(image));
        double sum = 0, squares = 0;
        for (int y = 104; y < 114; ++y) {
            for (int x = 102; x < 112; ++x) {
                sum += grey_at(out, x, y);
                squares += grey_at(out, x, y) * grey_at(out, x, y);
            }
        }
        EXPECT_GT(squares / 100 - sum / 100 * sum / 100, 0.2);
    }
}

TEST(Finish, of_the_glossiest_and_of_the_roughest_material_keeps_numbers_in_range) {
    const Pixels image = paper();
    for (const float roughness : {0.05F, 0.2F, 1.0F}) {
        const Pixels out = drawn(pressed(1.4, 3), image, {nullptr, 1, roughness}, {}, 1);
        EXPECT_GT(share_seen(image, out), 0.1);
        for (std::size_t i = 3; i < out.size(); i += 4) ASSERT_EQ(out[i], 255);
    }
}

// Hairs that lean to the light hide it from what is seen, those that lean away show their lit sides.
TEST(Finish, shows_which_way_hairs_were_brushed) {
    const Pixels image = plain(128);
    const Sheet sheet({kSide, kSide, kWidthMm / kSide});
    const PictureView view;
    const auto middle = [&](double towards) {
        Pile pile(sheet.size());
        ContactEllipse c;
        c.x_mm = c.y_mm = kWidthMm / 2;
        c.force_n = 1;
        pile.brush(c, towards * 40 * view.light_x, towards * 40 * view.light_y);
        Finish finish;
        finish.hairs = &pile;
        finish.pile = 0.6F;
        return grey_at(drawn(sheet, image, finish, view), kSide / 2, kSide / 2);
    };
    EXPECT_LT(middle(1), 128 - 20);
    EXPECT_GT(middle(-1), 128 + 20);
    EXPECT_EQ(middle(0), 128);
}

// What the page's shader is held to as well (web/touch/test/picture.test.ts): the same picture, in
// pressed.ppm. A change of the look changes it: TRIBO_WRITE_PRESSED=1 writes it anew; look at it.
TEST(Finish, draws_the_picture_that_the_page_is_held_to) {
    constexpr int kPictureSide = 64;
    Pixels image = plain(255, kPictureSide);
    for (int y = 0; y < kPictureSide; ++y) {
        for (int x = 0; x < kPictureSide; ++x) {
            std::uint8_t* pixel = &image[static_cast<std::size_t>(4 * (y * kPictureSide + x))];
            const int stripe = 6 * std::abs((x + y) % 20 - 10);
            pixel[0] = static_cast<std::uint8_t>(90 + stripe + x);
            pixel[1] = static_cast<std::uint8_t>(60 + stripe + y);
            pixel[2] = static_cast<std::uint8_t>(40 + stripe);
        }
    }
    Sheet sheet({kPictureSide, kPictureSide, 0.5});
    sheet.set_material({2, 0});
    ContactEllipse c;
    c.x_mm = 14;
    c.y_mm = 17;
    c.half_width_mm = c.half_height_mm = 4;
    c.force_n = 1;
    sheet.press({&c, 1});
    sheet.step(1);
    Pile pile(sheet.size());
    c.x_mm = 24;
    pile.brush(c, 6, -4);
    pile.rise(1);
    const Pixels out =
        drawn(sheet, image, {.gloss = 0.1F, .roughness = 0.3F, .full_mm = 1, .hairs = &pile, .pile = 0.5F});
    std::string text = "P6\n64 64\n255\n";
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (i % 4 != 3) text += static_cast<char>(out[i]);
    }
    const std::string path = TRIBO_SOURCE_DIR "/tests/elastic/pressed.ppm";
    if (std::getenv("TRIBO_WRITE_PRESSED") != nullptr) std::ofstream(path, std::ios::binary) << text;
    std::ifstream in(path, std::ios::binary);
    const std::string held(std::istreambuf_iterator<char>(in), {});
    EXPECT_TRUE(held == text);
}

}  // namespace
}  // namespace tribo::elastic
