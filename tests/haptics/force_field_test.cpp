// SPDX-License-Identifier: MIT
#include "haptics/contact/force_field.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "haptics/texture/haptic_texture.hpp"

namespace tribo::haptics {
namespace {

class Steady final : public CuttingForce {
  public:
    explicit Steady(Vec3 force) : force_(force) {}
    Vec3 force_n(double) noexcept override { return force_; }

  private:
    Vec3 force_;
};

ForceFieldInput moment(double apart) {
    ForceFieldInput m;
    m.cutter = {{0, 0, 0}, {0, 0, 1}, 5, 40};
    m.finger = {{5 + 8 + apart, 0, 0}, {0, 0, 1}, 8, 30};
    return m;
}

RC_GTEST_PROP(CylinderDistance, is_that_of_the_nearest_of_many_points, ()) {
    const auto number = [](int most) { return 0.01 * *rc::gen::inRange(-100 * most, 100 * most); };
    const auto cylinder = [&] {
        const Vec3 axis{number(1), number(1), number(1)};
        return Cylinder{{number(5), number(5), number(5)}, normalized(axis), 0.3, 0.01 + std::abs(number(6))};
    };
    const Cylinder a = cylinder(), b = cylinder();
    double least = 1e9;
    for (int i = 0; i <= 200; ++i) {
        const Vec3 p = a.end_mm + (a.length_mm * i / 200) * a.axis;
        const double t = std::clamp(dot(p - b.end_mm, b.axis), 0.0, b.length_mm);
        least = std::min(least, distance(p, b.end_mm + t * b.axis));
    }
    const double d = cylinder_distance_mm(a, b) + 0.6;
    RC_ASSERT(d <= least + 1e-9);
    RC_ASSERT(d >= least - a.length_mm / 200);
}

TEST(ForceField, is_felt_near_the_cutter_and_fades_smoothly_to_nothing) {
    Steady cut({3, 0, 0});
    ForceField field(cut, {});
    EXPECT_DOUBLE_EQ(field.render(moment(0)).total_n().x, 3);
    EXPECT_DOUBLE_EQ(field.render(moment(2)).total_n().x, 3);
    EXPECT_DOUBLE_EQ(field.render(moment(6)).total_n().x, 1.5);
    EXPECT_DOUBLE_EQ(field.render(moment(10)).total_n().x, 0);
    double last = 3;
    for (double apart = 2; apart < 11; apart += 0.01) {
        const double now = field.render(moment(apart)).total_n().x;
        EXPECT_LE(now, last);
        EXPECT_GT(now, last - 3 * 1.5 * 0.01 / 8 - 1e-9);  // steepest slope of the fade
        last = now;
    }
}

TEST(ForceField, turns_cutting_on_and_off_without_a_step) {
    Steady cut({0, 4, 0});
    ForceField field(cut, {});
    double last = 4, largest = 0;
    for (int n = 0; n < 600; ++n) {
        field.switch_cutting(n < 150 || (n > 200 && n < 260));
        const double now = field.render(moment(0)).total_n().y;
        largest = std::max(largest, std::abs(now - last));
        last = now;
    }
    EXPECT_EQ(last, 0);
    EXPECT_LE(largest, 4 * 1.5 / 100 + 1e-9);  // a smooth rise over 100 ticks
}

contact::TextureRecord groove_record() {
    contact::TextureRecord r;
    r.half_along_mm = 0.25;
    r.half_across_mm = 0.5;
    r.grooves = {1, 0.025, 0.5, 0.008};
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
            r.height_mm[j][i] = (j == 1 ? -0.0125 : 0.0125) + (i == 1 ? -0.004 : 0.004);
        }
    }
    return r;
}

TEST(HapticTexture, pushes_off_the_crests_and_towards_the_bottom) {
    const contact::TextureRecord r = groove_record();
    const TextureTouch left{{0, 0.4, 0}, {}, 0.2}, right{{0, -0.4, 0}, {}, 0.2}, bottom{{0, 0, 0}, {}, 0.2};
    const Vec3 l = texture_force(r, left, 1, 1000), o = texture_force(r, right, 1, 1000);
    EXPECT_LT(l.y, 0);
    EXPECT_GT(o.y, 0);
    EXPECT_GT(l.z, texture_force(r, bottom, 1, 1000).z);
    // A slope of 0.025 in 0.5 mm tilts a press of 0.2 mm.
    EXPECT_NEAR(-l.y, 0.2 * 0.05, 0.003);
}

// 1 mm grooves at 100 mm/s are 100 Hz; at 500 mm/s a loop of 1 kHz would play them as something else.
TEST(HapticTexture, keeps_only_what_the_loop_carries) {
    EXPECT_EQ(groove_gain(100, 1, 1000), 1);
    EXPECT_EQ(groove_gain(500, 1, 1000), 0);
    EXPECT_GT(groove_gain(300, 1, 1000), 0);
    EXPECT_LT(groove_gain(300, 1, 1000), 1);
    EXPECT_EQ(groove_gain(500, 1, 10000), 1);
    const contact::TextureRecord r = groove_record();
    // Along the feed the marks come too fast, across it the scallops are slow.
    const Vec3 f = texture_force(r, {{0.2, 0.4, 0}, {300, 1, 0}, 0.2}, 1, 1000);
    EXPECT_NEAR(f.x, 0, 1e-12);
    EXPECT_LT(f.y, -0.005);
}

TEST(HapticTexture, is_that_of_the_nearest_record) {
    std::vector<contact::TextureRecord> records(400);
    for (std::size_t n = 0; n < records.size(); ++n)
        records[n].place_mm = {0.3 * static_cast<double>(n % 20), 0.4 * static_cast<double>(n / 20), 0};
    const TextureMap map(records, 1);
    for (double x = -0.5; x < 7; x += 0.37) {
        for (double y = -0.5; y < 9; y += 0.41) {
            const contact::TextureRecord* found = map.nearest({x, y, 0.1});
            double least = 1e9;
            for (const auto& r : records) least = std::min(least, distance(r.place_mm, {x, y, 0.1}));
            ASSERT_EQ(found != nullptr, least <= 1) << x << " " << y;
            if (found == nullptr) continue;
            EXPECT_EQ(distance(found->place_mm, {x, y, 0.1}), least);
        }
    }
    EXPECT_EQ(map.nearest({1e9, 0, 0}), nullptr);
}

}  // namespace
}  // namespace tribo::haptics
