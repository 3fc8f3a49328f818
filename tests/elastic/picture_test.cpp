// SPDX-License-Identifier: MIT
#include "elastic/picture.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace tribo::elastic {
namespace {

constexpr int kPictureSide = 96;

std::vector<std::uint8_t> plain_picture(std::uint8_t grey) {
    std::vector<std::uint8_t> image(4 * kPictureSide * kPictureSide, grey);
    for (std::size_t i = 3; i < image.size(); i += 4) image[i] = 200;
    return image;
}

Sheet pressed_at(double x_mm, double y_mm) {
    Sheet sheet({kPictureSide, kPictureSide, 1});
    sheet.set_material({1, 0});
    ContactEllipse c;
    c.x_mm = x_mm;
    c.y_mm = y_mm;
    c.force_n = 5;
    sheet.press({&c, 1});
    sheet.step(1);
    return sheet;
}

TEST(Picture, at_rest_is_the_image_byte_by_byte) {
    std::vector<std::uint8_t> image(4 * kPictureSide * kPictureSide), out(image.size());
    std::iota(image.begin(), image.end(), std::uint8_t{0});
    const Sheet sheet({kPictureSide, kPictureSide, 0.3});
    draw_rows(sheet, image, out, 0, kPictureSide);
    EXPECT_EQ(out, image);
}

TEST(Picture, the_far_wall_of_a_dent_is_lit_and_the_near_one_dark) {
    const Sheet sheet = pressed_at(48, 48);
    const auto image = plain_picture(120);
    std::vector<std::uint8_t> out(image.size());
    draw_rows(sheet, image, out, 0, kPictureSide);
    const auto grey = [&](int x, int y) {
        return int{out[static_cast<std::size_t>(4 * (y * kPictureSide + x))]};
    };
    // The light stands at the upper left: the wall that faces it is the one at the lower right.
    EXPECT_GT(grey(54, 57), 125);
    EXPECT_LT(grey(42, 39), 115);
    EXPECT_NEAR(grey(3, 92), 120, 2);
    EXPECT_EQ(out[3], 200);
}

TEST(Picture, what_is_pressed_moves_away_from_the_eye) {
    // A dark row of the image through the dent: the eye looks from below, so that its image comes nearer
    // to the middle of the eye's field, downwards.
    const Sheet sheet = pressed_at(48, 30);
    auto image = plain_picture(250);
    for (int x = 0; x < kPictureSide; ++x)
        for (int c = 0; c < 3; ++c) image[static_cast<std::size_t>(4 * (30 * kPictureSide + x) + c)] = 0;
    std::vector<std::uint8_t> out(image.size());
    PictureView view;
    view.relief = 2;
    view.half_mm = 5;
    draw_rows(sheet, image, out, 0, kPictureSide, nullptr, view);
    const auto darkest = [&](int x) {
        int best = 0;
        for (int y = 0; y < kPictureSide; ++y)
            if (out[static_cast<std::size_t>(4 * (y * kPictureSide + x))] <
                out[static_cast<std::size_t>(4 * (best * kPictureSide + x))])
                best = y;
        return best;
    };
    EXPECT_EQ(darkest(1), 30);
    // 5 mm are drawn as 2 * 5 / (1 + 5 / 5) = 5. The eye is over y = 95.5 at a height of 96: (95.5 - 30) 5 /
    // 101 = 3.2 aside.
    EXPECT_NEAR(darkest(48), 33, 1);
}

// At its centre a contact of 2 N goes 2 / K deep: the least and the most that the materials of the examples
// do, and a twentieth of it, what is left of the least after three time constants.
TEST(Picture, dents_of_stiff_and_soft_materials_show_and_the_deeper_ones_more) {
    const auto contrast = [](double stiffness, double force) {
        Sheet sheet({192, 192, 80.0 / 192});
        sheet.set_material({stiffness, 0});
        ContactEllipse c;
        c.x_mm = c.y_mm = 40;
        c.force_n = force;
        sheet.press({&c, 1});
        sheet.step(1);
        std::vector<std::uint8_t> image(4 * 192 * 192, 150), out(image.size());
        draw_rows(sheet, image, out, 0, 192);
        const auto [least, most] = std::minmax_element(out.begin(), out.end());
        return *most - *least;
    };
    // A step of 2 in 150 is about what can just be seen.
    EXPECT_GE(contrast(7, 0.1), 4);
    EXPECT_GE(contrast(7, 2), 40);
    EXPECT_GT(contrast(4, 2), contrast(7, 2) + 5);
    EXPECT_GT(contrast(1.4, 2), contrast(4, 2) + 5);
}

TEST(Picture, rows_drawn_apart_are_those_drawn_at_once) {
    const Sheet sheet = pressed_at(40, 50);
    const auto image = plain_picture(120);
    std::vector<std::uint8_t> whole(image.size()), parts(image.size());
    draw_rows(sheet, image, whole, 0, kPictureSide);
    for (int y = 0; y < kPictureSide; y += 5)
        draw_rows(sheet, image, parts, y, std::min(5, kPictureSide - y));
    EXPECT_EQ(whole, parts);
}

}  // namespace
}  // namespace tribo::elastic
