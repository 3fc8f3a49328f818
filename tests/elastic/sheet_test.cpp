// SPDX-License-Identifier: MIT
#include "elastic/sheet.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <rapidcheck/gtest.h>
#include <vector>

#include "elastic/pressure_share.hpp"

namespace tribo::elastic {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ContactEllipse finger_at(double x_mm, double y_mm, double force_n = 1) {
    ContactEllipse c;
    c.x_mm = x_mm;
    c.y_mm = y_mm;
    c.force_n = force_n;
    return c;
}

float height_at(const Sheet& sheet, int x, int y) {
    return sheet.heights(y)[x];
}

bool is_flat(const Sheet& sheet) {
    for (int y = 0; y < sheet.size().height; ++y)
        for (int x = 0; x < sheet.size().width; ++x)
            if (height_at(sheet, x, y) != 0) return false;
    return true;
}

// A node exactly under the contact's centre: its pressure is the force.
TEST(Sheet, steady_state_is_force_over_stiffness) {
    Sheet sheet({101, 77, 1});
    for (const SheetMaterial m : {SheetMaterial{1.4, 0.1}, SheetMaterial{7, 0.3}, SheetMaterial{4, 0.3}}) {
        sheet.reset();
        sheet.set_material(m);
        sheet.press(std::vector{finger_at(50.5, 38.5, 2.5)});
        for (int i = 0; i < 600; ++i) sheet.step(1.0 / 60);
        EXPECT_NEAR(height_at(sheet, 50, 38), -2.5 / m.stiffness_n_per_mm, 1e-3 * 2.5 / m.stiffness_n_per_mm);
    }
}

TEST(Sheet, time_constant_is_viscosity_over_stiffness_at_any_frame_rate) {
    const SheetMaterial m{4, 0.8};  // 0.2 s
    for (const int rate : {30, 60, 144}) {
        Sheet sheet({64, 64, 1});
        sheet.set_material(m);
        sheet.press(std::vector{finger_at(32.5, 32.5)});
        for (int i = 1; i <= rate; ++i) {
            sheet.step(1.0 / rate);
            const double expected = -0.25 * (1 - std::exp(-(1.0 * i / rate) / 0.2));
            EXPECT_NEAR(height_at(sheet, 32, 32), expected, 1e-5) << rate << ' ' << i;
        }
    }
}

TEST(Sheet, implicit_euler_solves_equation_3_as_printed) {
    const double k = 1.4, nu = 0.1, ts = 1.0 / 30;
    Sheet sheet({64, 64, 1});
    sheet.set_material({k, nu});
    sheet.press(std::vector{finger_at(32.5, 32.5)});
    double e = 0;
    for (int i = 0; i < 10; ++i) {
        sheet.step(ts, TimeScheme::implicit_euler);
        e = (-1 + nu / ts * e) / (k + nu / ts);
        EXPECT_NEAR(height_at(sheet, 32, 32), e, 1e-6);
        EXPECT_NEAR(-1, k * e + nu * (e - (e * (k + nu / ts) + 1) / (nu / ts)) / ts, 1e-9);
    }
}

TEST(Sheet, relaxes_to_exact_rest_and_then_costs_nothing) {
    Sheet sheet({130, 90, 0.5});
    sheet.press(std::vector{finger_at(20, 20), finger_at(64.9, 44.9, 3)});
    sheet.step(0.5);
    EXPECT_FALSE(is_flat(sheet));
    sheet.press({});
    int steps = 0;
    while (sheet.step(1.0 / 60) && steps < 1000) ++steps;
    EXPECT_LT(steps, 120);  // ln(1e6) time constants of 0.075 s are 62 frames
    EXPECT_TRUE(is_flat(sheet));
    sheet.update_normals();
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 130; ++x) EXPECT_EQ(sheet.normals_x(y)[x], 0);
    sheet.take_changes();
    sheet.step(1);
    EXPECT_TRUE(sheet.take_changes().empty());
}

TEST(Sheet, a_held_contact_comes_to_a_stop) {
    Sheet sheet({128, 128, 1});
    const std::vector held{finger_at(40, 40)};
    int steps = 0;
    do {
        sheet.press(held);
        sheet.step(1.0 / 60);
    } while (sheet.moving() && ++steps < 1000);
    EXPECT_LT(steps, 200);
    sheet.take_changes();
    sheet.press(held);
    sheet.step(1.0 / 60);
    EXPECT_TRUE(sheet.take_changes().empty());
    sheet.press(std::vector{finger_at(41, 40)});
    sheet.step(1.0 / 60);
    EXPECT_FALSE(sheet.take_changes().empty());
}

TEST(Sheet, a_rub_leaves_a_trail) {
    Sheet sheet({200, 60, 1});
    sheet.set_material({4, 2});  // 0.5 s
    for (int i = 0; i <= 60; ++i) {
        sheet.press(std::vector{finger_at(30 + 2.0 * i, 30)});
        sheet.step(1.0 / 60);
    }
    // Behind the finger the sheet is still down, falling off with the time since; ahead it is not.
    EXPECT_LT(height_at(sheet, 110, 30), 2 * height_at(sheet, 50, 30));
    EXPECT_LT(height_at(sheet, 50, 30), -0.01F);
    EXPECT_LT(height_at(sheet, 110, 30), 5 * height_at(sheet, 190, 30));
}

TEST(Sheet, pressures_of_several_fingers_add_up) {
    const std::vector five{finger_at(20, 20), finger_at(35, 22), finger_at(50, 25, 2), finger_at(65, 22),
                           finger_at(80, 30)};
    Sheet all({100, 60, 1}), one({100, 60, 1});
    all.press(five);
    std::vector<double> sum(100 * 60);
    for (const ContactEllipse& c : five) {
        one.press(std::vector{c});
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 100; ++x) sum[static_cast<std::size_t>(100 * y + x)] += one.pressures(y)[x];
    }
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 100; ++x)
            EXPECT_NEAR(all.pressures(y)[x], sum[static_cast<std::size_t>(100 * y + x)], 1e-6);
}

// By the formula of the contact, ellipse and angle and all, on every node.
TEST(Sheet, pressure_is_the_published_shape_over_an_ellipse) {
    ContactEllipse c = finger_at(37.3, 21.9, 1.7);
    c.half_width_mm = 4;
    c.half_height_mm = 7;
    c.angle_rad = 0.5;
    Sheet sheet({93, 61, 0.8});
    for (const ContactShape shape : {ContactShape::area, ContactShape::point}) {
        sheet.press(std::vector{c}, {shape, false});
        for (int y = 0; y < 61; ++y) {
            for (int x = 0; x < 93; ++x) {
                const double dx = (x + 0.5) * 0.8 - c.x_mm, dy = (y + 0.5) * 0.8 - c.y_mm;
                const double u = (dx * std::cos(0.5) + dy * std::sin(0.5)) / 4;
                const double v = (dy * std::cos(0.5) - dx * std::sin(0.5)) / 7;
                EXPECT_NEAR(sheet.pressures(y)[x], -1.7 * test::pressure_share(shape, std::hypot(u, v)),
                            2e-6);
            }
        }
    }
}

TEST(Sheet, normals_are_those_of_the_heights) {
    Sheet sheet({75, 53, 0.7});
    sheet.set_material({0.5, 0.1});
    const auto expect_normals = [&sheet] {
        sheet.update_normals();
        for (int y = 0; y < 53; ++y) {
            for (int x = 0; x < 75; ++x) {
                const auto e = [&](int i, int j) {
                    return static_cast<double>(height_at(sheet, std::clamp(i, 0, 74), std::clamp(j, 0, 52)));
                };
                const double gx = (e(x + 1, y) - e(x - 1, y)) / 1.4, gy = (e(x, y + 1) - e(x, y - 1)) / 1.4;
                const double length = std::sqrt(1 + gx * gx + gy * gy);
                ASSERT_NEAR(sheet.normals_x(y)[x], -gx / length, 1e-5) << x << ' ' << y;
                ASSERT_NEAR(sheet.normals_y(y)[x], -gy / length, 1e-5) << x << ' ' << y;
            }
        }
    };
    for (int i = 0; i < 20; ++i) {
        ContactEllipse c = finger_at(3.0 * i, 1.9 * i);
        c.half_width_mm = c.half_height_mm = 1 + 0.2 * i;
        sheet.press(std::vector{c});
        sheet.step(0.03);
        expect_normals();
    }
    sheet.press({});
    while (sheet.step(0.03)) expect_normals();
    expect_normals();
}

TEST(Sheet, a_map_gives_every_node_its_own_material) {
    Sheet mapped({60, 40, 1}), soft({60, 40, 1}), hard({60, 40, 1});
    const SheetMaterial soft_one{1, 0.4}, hard_one{10, 0.5};
    std::vector<std::uint8_t> levels(60 * 40);
    for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = i % 60 < 30 ? 200 : 7;
    std::array<SheetMaterial, 256> palette;
    palette.fill({5, 5});
    palette[200] = soft_one;
    palette[7] = hard_one;
    mapped.set_materials(levels, palette);
    soft.set_material(soft_one);
    hard.set_material(hard_one);
    const std::vector pressed{finger_at(30, 20, 2)};
    for (int i = 0; i < 50; ++i) {
        for (Sheet* sheet : {&mapped, &soft, &hard}) {
            sheet->press(pressed);
            sheet->step(i % 2 ? 0.01 : 0.03);
        }
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 60; ++x)
                ASSERT_NEAR(height_at(mapped, x, y), height_at(x < 30 ? soft : hard, x, y), 2e-6);
    }
}

TEST(Sheet, changes_hold_every_node_that_moved) {
    Sheet sheet({300, 200, 1});
    sheet.press(std::vector{finger_at(100, 100)});
    sheet.step(0.1);
    const NodeRect changed = sheet.take_changes();
    EXPECT_LT(changed.width, 120);
    EXPECT_LT(changed.height, 120);
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 300; ++x) {
            const bool inside = x >= changed.x && x < changed.x + changed.width && y >= changed.y &&
                                y < changed.y + changed.height;
            EXPECT_TRUE(inside || height_at(sheet, x, y) == 0);
        }
    }
}

RC_GTEST_PROP(Sheet, stays_finite_and_below_rest_whatever_comes_in, ()) {
    const auto any_number = [] {
        return *rc::gen::element(0.0, 1.0, -1.0, 12.5, 60.0, 1e-3, 1e3, 1e300, -1e300, 1e-310, kNan,
                                 std::numeric_limits<double>::infinity());
    };
    Sheet sheet({*rc::gen::inRange(1, 80), *rc::gen::inRange(1, 80), *rc::gen::element(1e-3, 0.2, 1.0, 1e3)});
    sheet.set_material({*rc::gen::element(1e-3, 1.0, 1e6), *rc::gen::element(0.0, 0.3, 1e6)});
    double most_n = 0;
    for (int i = 0; i < 8; ++i) {
        std::vector<ContactEllipse> contacts(*rc::gen::inRange<std::size_t>(0, 4));
        double sum_n = 0;
        for (ContactEllipse& c : contacts) {
            c = {any_number(), any_number(), any_number(), any_number(),
                 any_number(), any_number(), any_number()};
            if (touches(c)) sum_n += c.force_n;
        }
        most_n = std::max(most_n, sum_n);
        sheet.press(contacts, {*rc::gen::element(ContactShape::area, ContactShape::point), false});
        sheet.step(any_number(), *rc::gen::element(TimeScheme::exact, TimeScheme::implicit_euler));
        sheet.update_normals();
        const double deepest = most_n / 1e-3 * 1.0001;
        for (int y = 0; y < sheet.size().height; ++y) {
            for (int x = 0; x < sheet.size().width; ++x) {
                const float e = height_at(sheet, x, y);
                RC_ASSERT(e <= 0 && e >= -deepest);
                RC_ASSERT(std::isfinite(sheet.normals_x(y)[x]) && std::isfinite(sheet.normals_y(y)[x]));
            }
        }
    }
}

TEST(SheetKernels, all_builds_give_the_same_bits) {
    const SheetKernels* v3 = sheet_kernels_v3();
    if (v3 == nullptr) GTEST_SKIP() << "this processor has one build only";
    constexpr int kStride = 48;
    std::vector<float> e(kStride * 20), p(e.size());
    for (std::size_t i = 0; i < e.size(); ++i) {
        e[i] = static_cast<float>(-std::abs(std::sin(0.37 * static_cast<double>(i * i % 997))));
        p[i] = i % 7 == 0 ? 0 : static_cast<float>(-std::abs(std::cos(0.11 * static_cast<double>(i))));
    }
    const auto run = [&](const SheetKernels& kernels) {
        std::vector<float> heights = e, pressures = p, nx(e.size()), ny(e.size());
        std::vector<std::uint8_t> levels(e.size());
        for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<std::uint8_t>(i * 31);
        std::vector<float> compliance(256), share(256);
        for (std::size_t i = 0; i < 256; ++i) {
            compliance[i] = 1 / (1 + static_cast<float>(i));
            share[i] = static_cast<float>(i) / 256;
        }
        std::array<TileMotion, 2> motion;
        PressRow row{12, 0.2F, 0.5F, 0.3F, {8, 32}, {16, 24}, false, 2.5F, share_law(ContactShape::area)};
        for (int y = 0; y < 16; ++y) {
            row.over = y % 2 == 1;
            kernels.press(pressures.data() + 8 + y * kStride, 32, row);
        }
        kernels.step(heights.data() + 8, pressures.data() + 8, kStride, 2, 16, {0.7F, 0.13F}, motion.data());
        kernels.step_mapped(heights.data() + 8, pressures.data() + 8, kStride, 2, 16,
                            {levels.data() + 8, compliance.data(), share.data()}, motion.data());
        kernels.normals(heights.data() + 8, nx.data() + 8, ny.data() + 8,
                        {kStride, 32, 16, false, true, 1.1F});
        for (const TileMotion& m : motion) {
            heights.insert(heights.end(), {m.way_mm, m.moved ? 1.0F : 0.0F});
        }
        heights.insert(heights.end(), pressures.begin(), pressures.end());
        heights.insert(heights.end(), nx.begin(), nx.end());
        heights.insert(heights.end(), ny.begin(), ny.end());
        return heights;
    };
    EXPECT_EQ(run(*sheet_kernels_sse2()), run(*v3));
}

}  // namespace
}  // namespace tribo::elastic
