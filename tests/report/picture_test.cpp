// SPDX-License-Identifier: MIT
#include "report/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include "files/scratch.hpp"
#include "report/picture/studio.hpp"

namespace tribo::report {
namespace {

Point3f point(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// A disc of radius 1 in the plane z = `height`, of many thin triangles that share edges.
TriangleMesh disc(double height, int triangles) {
    TriangleMesh mesh;
    mesh.positions.push_back(point(0, 0, height));
    for (int i = 0; i < triangles; ++i) {
        const double a = 2 * std::numbers::pi * i / triangles;
        mesh.positions.push_back(point(std::cos(a), std::sin(a), height));
    }
    for (int i = 0; i < triangles; ++i) {
        mesh.triangles.push_back(
            {0, static_cast<std::uint32_t>(1 + i), static_cast<std::uint32_t>(1 + (i + 1) % triangles)});
    }
    return mesh;
}

std::uint8_t channel(const files::Image& image, int x, int y, int c) {
    return image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x)) +
                      static_cast<std::size_t>(c)];
}

double opaque_pixels(const files::Image& image) {
    double sum = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i] / 255.0;
    return sum;
}

TEST(Picture, of_a_disc_seen_from_above_fills_the_frame_with_its_area) {
    PictureOptions options{.width = 300, .height = 200, .towards_viewer = {0, 0, 1}};
    options.margin = 0.05;
    const files::Image image = draw_part(disc(0, 200), {}, options);
    const double radius = 0.5 * 200 * (1 - 2 * 0.05);
    const double polygon = 0.5 * 200 * std::sin(2 * std::numbers::pi / 200) * radius * radius;
    EXPECT_NEAR(opaque_pixels(image) / polygon, 1, 2e-3);
    EXPECT_EQ(channel(image, 150, 100, 3), 255);
    EXPECT_EQ(channel(image, 2, 100, 3), 0);
}

TEST(Picture, has_no_gaps_where_triangles_meet) {
    const files::Image image =
        draw_part(disc(0, 977), {}, {.width = 400, .height = 400, .towards_viewer = {0.3, -0.5, 1}});
    int changes = 0;  // along each row the disc begins once and ends once
    for (int y = 0; y < 400; ++y) {
        for (int x = 1; x < 400; ++x)
            changes += (channel(image, x, y, 3) == 255) != (channel(image, x - 1, y, 3) == 255);
    }
    int rows = 0;
    for (int y = 0; y < 400; ++y) {
        bool any = false;
        for (int x = 0; x < 400; ++x) any |= channel(image, x, y, 3) == 255;
        rows += any;
    }
    EXPECT_GT(rows, 200);
    EXPECT_EQ(changes, 2 * rows);
}

TEST(Picture, shows_the_nearer_surface) {
    // Two squares seen from above: the upper one stands upright light, the lower is tilted and so darker.
    TriangleMesh mesh;
    mesh.positions = {point(-1, -1, 0),  point(1, -1, 0),  point(1, 1, 0),  point(-1, 1, 0),
                      point(-1, -1, -3), point(1, -1, -1), point(1, 1, -1), point(-1, 1, -3)};
    mesh.triangles = {{4, 5, 6}, {4, 6, 7}};
    const PictureOptions options{.width = 100, .height = 100, .towards_viewer = {0, 0, 1}};
    const files::Image lower = draw_part(mesh, {}, options);
    for (const auto& order : {std::array<std::uint32_t, 2>{0, 4}, std::array<std::uint32_t, 2>{4, 0}}) {
        mesh.triangles.clear();
        for (const std::uint32_t i : order) {
            mesh.triangles.push_back({i, i + 1, i + 2});
            mesh.triangles.push_back({i, i + 2, i + 3});
        }
        const files::Image both = draw_part(mesh, {}, options);
        EXPECT_NE(channel(both, 50, 50, 0), channel(lower, 50, 50, 0));
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        EXPECT_EQ(channel(both, 50, 50, 0), channel(draw_part(mesh, {}, options), 50, 50, 0));
    }
}

TEST(Picture, lights_both_sides_of_a_surface_alike) {
    const PictureOptions options{.width = 64, .height = 64};
    TriangleMesh mesh = disc(0, 50);
    const files::Image front = draw_part(mesh, {}, options);
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    EXPECT_EQ(draw_part(mesh, {}, options).rgba, front.rgba);
}

TEST(Picture, hides_the_path_behind_the_part_and_shows_it_in_front) {
    const PictureOptions options{.width = 200, .height = 200, .towards_viewer = {0, 0, 1}};
    const files::Image bare = draw_part(disc(0, 100), {}, options);
    const auto with_line_at = [&](double z) {
        const PictureLine line{{{-0.5, 0, z}, {0.5, 0, z}}, {{1, 0, 0}}, 4};
        return draw_part(disc(0, 100), {line}, options);
    };
    EXPECT_EQ(with_line_at(-0.5).rgba, bare.rgba);
    for (const double z : {0.0, 0.5}) {
        const files::Image shown = with_line_at(z);
        EXPECT_EQ(channel(shown, 100, 100, 0), 255) << z;
        EXPECT_EQ(channel(shown, 100, 100, 1), 0) << z;
    }
}

TEST(Picture, of_a_line_is_as_long_and_wide_as_the_line) {
    TriangleMesh corners = disc(0, 4);  // a square of diagonal 2 gives the scale
    corners.triangles.clear();
    const PictureOptions options{.width = 400, .height = 400, .towards_viewer = {0, 0, 1}, .margin = 0.1};
    const double px_per_mm = 0.5 * 400 * 0.8;
    for (const Vec3 end : {Vec3{0.6, 0, 0}, Vec3{0, 0.6, 0}, Vec3{0.48, 0.36, 0}}) {
        const files::Image image = draw_part(corners, {{{-end, end}, {{0, 0, 1}}, 5}}, options);
        const double area = opaque_pixels(image), length = 1.2 * px_per_mm;
        EXPECT_NEAR(area, length * 5 + std::numbers::pi * 2.5 * 2.5, 0.01 * area);
    }
}

// A square of `size` about a point, at a height.
void add_square(TriangleMesh& mesh, Vec3 middle, double size) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        mesh.positions.push_back(point(middle.x + u * size, middle.y + v * size, middle.z));
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

// What paint shows of the sun is even over a plane, but for the shadow.
TEST(Picture, shows_the_shadow_of_what_is_above_where_the_sun_throws_it) {
    TriangleMesh mesh;
    add_square(mesh, {0, 0, 0}, 20);
    PictureOptions options{.width = 200, .height = 200, .towards_viewer = {0, 0, 1}};
    const std::vector<std::array<std::uint8_t, 3>> white(4, {200, 200, 200});
    options.triangle_colours = white;
    const files::Image bare = draw_part(mesh, {}, options);
    const double high = 4;
    add_square(mesh, {0, 0, high}, 3);
    const files::Image both = draw_part(mesh, {}, options);
    const Vec3 sun = Studio::to_sun(), shadow = (-high / sun.z) * sun;  // its middle, from above the square
    // 200 pixels show 20 mm and the margins, seen from 40 mm and more: the square above hides its own place.
    const auto at = [](double x, double y) {
        return std::pair{static_cast<int>(100 + 9.2 * x), static_cast<int>(100 - 9.2 * y)};
    };
    const auto [sx, sy] = at(shadow.x, shadow.y);
    const auto [lx, ly] = at(-shadow.x, -shadow.y);
    EXPECT_LT(channel(both, sx, sy, 1), channel(bare, sx, sy, 1) - 15);
    EXPECT_NEAR(channel(both, lx, ly, 1), channel(bare, lx, ly, 1), 1);
}

TEST(Picture, stands_on_ground_that_has_its_shadow_on_the_side_away_from_the_sun) {
    TriangleMesh mesh;
    add_square(mesh, {0, 0, 0}, 20);
    add_square(mesh, {0, 0, 6}, 20);
    const PictureOptions options{.width = 240, .height = 240, .towards_viewer = {0, 0, 1}, .on_ground = true};
    const files::Image image = draw_part(mesh, {}, options);
    const Vec3 sun = Studio::to_sun();
    double along = 0, weight = 0, darkest = 0;
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 240; ++x) {
            const int a = channel(image, x, y, 3);
            if (a == 0 || channel(image, x, y, 0) != 0) continue;  // neither ground nor the part
            darkest = std::max(darkest, a / 255.0);
            along += a * ((x - 120) * sun.x - (y - 120) * sun.y);
            weight += a;
        }
    }
    ASSERT_GT(weight, 0);
    EXPECT_LT(along / weight, 0);
    EXPECT_NEAR(darkest, 0.255, 0.01);  // 0.3 of black where 0.85 of the sun is gone
    for (int n = 0; n < 240; ++n) {     // the frame has room for it
        EXPECT_EQ(channel(image, n, 0, 3), 0);
        EXPECT_EQ(channel(image, n, 239, 3), 0);
        EXPECT_EQ(channel(image, 0, n, 3), 0);
        EXPECT_EQ(channel(image, 239, n, 3), 0);
    }
}

// Along grooves of 0.02 mm, 0.5 mm wide, one part is lighter than the other.
TEST(Picture, shows_grooves_of_two_hundredths_of_a_millimetre) {
    TriangleMesh mesh;
    const int count = 400;
    for (int n = 0; n <= count; ++n) {
        const double y = 10.0 * n / count, z = 0.01 * std::cos(2 * std::numbers::pi * y / 0.5);
        mesh.positions.push_back(point(0, y, z));
        mesh.positions.push_back(point(10, y, z));
    }
    for (std::uint32_t n = 0; n < count; ++n) {
        mesh.triangles.push_back({2 * n, 2 * n + 1, 2 * n + 3});
        mesh.triangles.push_back({2 * n, 2 * n + 3, 2 * n + 2});
    }
    const files::Image image = draw_part(mesh, {}, {.width = 600, .height = 450});
    std::vector<int> column;
    for (int y = 0; y < 450; ++y)
        if (channel(image, 300, y, 3) == 255) column.push_back(channel(image, 300, y, 1));
    ASSERT_GT(column.size(), 100u);
    std::sort(column.begin(), column.end());
    EXPECT_GT(column[column.size() * 9 / 10] - column[column.size() / 10], 20);
}

RC_GTEST_PROP(Studio, has_no_seams, ()) {
    const static Studio studio;
    const auto coordinate = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const Vec3 to_viewer = normalized(Vec3{coordinate(), coordinate(), coordinate()}, {0, 0, 1});
    const Vec3 aside = normalized(cross(to_viewer, Vec3{0.3, 0.7, 0.2}), {1, 0, 0});
    const Vec3 a = normalized(to_viewer + *rc::gen::inRange(0, 1500) / 1000.0 * aside),
               b = normalized(a + 2e-4 * aside);
    for (const Finish finish : {Finish::machined, Finish::sawn, Finish::paint}) {
        const Rgb seen = studio.on(finish, {0.6F, 0.6F, 0.6F}, a, to_viewer, 0),
                  beside = studio.on(finish, {0.6F, 0.6F, 0.6F}, b, to_viewer, 0);
        RC_ASSERT(std::abs(seen.g - beside.g) < 0.02);
        RC_ASSERT(seen.g >= 0 && seen.g < 6);  // no brighter than the brightest panel
    }
}

TEST(Studio, tones_dark_light_but_little_and_keeps_all_below_white) {
    for (float v = 0; v < 20; v = 1.3F * v + 0.01F) {
        const Rgb grey = toned({v, v, v});
        EXPECT_GE(grey.g, 0);
        EXPECT_LT(grey.g, 1);
        EXPECT_EQ(grey.r, grey.b);
    }
    EXPECT_NEAR(toned({0.5F, 0.5F, 0.5F}).g, 0.46F, 1e-6F);  // less the 0.04 that a dielectric would add
}

// Two halves of one upright square, seen from the front: the left one is sawn.
TEST(Picture, tells_sawn_faces_from_machined_ones) {
    TriangleMesh mesh;
    for (const double x : {-20.0, 0.0, 20.0})
        for (const double z : {-20.0, 20.0}) mesh.positions.push_back(point(x, 0, z));
    mesh.triangles = {{0, 2, 1}, {2, 3, 1}, {2, 4, 3}, {4, 5, 3}};
    PictureOptions options{.width = 200, .height = 200, .towards_viewer = {0, -1, 0}};
    const files::Image bright = draw_part(mesh, {}, options);
    const std::array<std::uint8_t, 4> sawn{1, 1, 0, 0};
    options.sawn = sawn;
    const files::Image both = draw_part(mesh, {}, options);
    const auto lightness = [&](const files::Image& image, int from) {
        double sum = 0;
        for (int y = 20; y < 180; ++y)
            for (int x = from; x < from + 60; ++x) sum += channel(image, x, y, 1);
        return sum / (160 * 60);
    };
    EXPECT_LT(lightness(both, 20), 0.8 * lightness(bright, 20));
    EXPECT_EQ(lightness(both, 120), lightness(bright, 120));
    // Its stripes lie across the part: a column goes through them.
    int least = 255, most = 0;
    for (int y = 20; y < 180; ++y) {
        least = std::min<int>(least, channel(both, 50, y, 1));
        most = std::max<int>(most, channel(both, 50, y, 1));
    }
    EXPECT_GT(most - least, 5);
    // Colours of data lie over both.
    const std::array<std::array<std::uint8_t, 3>, 4> red{
        {{200, 0, 0}, {200, 0, 0}, {200, 0, 0}, {200, 0, 0}}};
    options.triangle_colours = red;
    const files::Image data = draw_part(mesh, {}, options);
    options.sawn = {};
    EXPECT_EQ(draw_part(mesh, {}, options).rgba, data.rgba);
}

TEST(Picture, of_nothing_is_transparent) {
    const files::Image image = draw_part({}, {}, {.width = 10, .height = 20});
    EXPECT_EQ(image.rgba.size(), 800u);
    EXPECT_EQ(opaque_pixels(image), 0);
}

RC_GTEST_PROP(Picture, keeps_every_part_inside_the_frame_and_fills_it, ()) {
    TriangleMesh mesh;
    const auto coordinate = [] { return *rc::gen::inRange(-1000, 1000) / 10.0; };
    for (std::uint32_t i = 0; i < 10; ++i) {  // small tetrahedra here and there, at least 100 mm apart in all
        const double x = coordinate() + (i == 0 ? 300 : 0), y = coordinate(), z = coordinate();
        for (const Point3f& p :
             {point(x, y, z), point(x + 8, y, z), point(x, y + 8, z), point(x, y, z + 8)}) {
            mesh.positions.push_back(p);
        }
        for (const Triangle& t :
             {Triangle{0, 1, 2}, Triangle{0, 1, 3}, Triangle{0, 2, 3}, Triangle{1, 2, 3}}) {
            mesh.triangles.push_back({4 * i + t[0], 4 * i + t[1], 4 * i + t[2]});
        }
    }
    const PictureOptions options{
        .width = 80, .height = 60, .towards_viewer = {coordinate(), coordinate(), 1}, .margin = 0.1};
    const files::Image image = draw_part(mesh, {}, options);
    int x0 = 80, x1 = -1, y0 = 60, y1 = -1;
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) {
            if (channel(image, x, y, 3) == 0) continue;
            x0 = std::min(x0, x);
            x1 = std::max(x1, x);
            y0 = std::min(y0, y);
            y1 = std::max(y1, y);
        }
    }
    RC_ASSERT(x0 >= 5 && x1 < 75 && y0 >= 5 && y1 < 55);
    RC_ASSERT(x1 - x0 >= 64 || y1 - y0 >= 44);  // 68 by 48 pixels are inside the margins
}

TEST(Png, gives_back_every_pixel_and_the_same_bytes_each_time) {
    const files::Image image = draw_part(disc(0, 9), {}, {.width = 33, .height = 21});
    const std::string bytes = files::png_bytes(image);
    EXPECT_EQ(bytes, files::png_bytes(draw_part(disc(0, 9), {}, {.width = 33, .height = 21})));
    int width = 0, height = 0, channels = 0;
    stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                            static_cast<int>(bytes.size()), &width, &height, &channels, 4);
    ASSERT_NE(pixels, nullptr);
    EXPECT_EQ(width, 33);
    EXPECT_EQ(height, 21);
    EXPECT_TRUE(std::equal(image.rgba.begin(), image.rgba.end(), pixels));
    stbi_image_free(pixels);
    const test::Scratch scratch;
    ASSERT_TRUE(files::write_png(scratch / "a.png", image));
    EXPECT_EQ(scratch.get("a.png"), bytes);
}

}  // namespace
}  // namespace tribo::report
