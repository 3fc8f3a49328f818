// SPDX-License-Identifier: MIT
// Waves of a machined surface under a finger: the spring of a surface that stands out or back by them.
#include "session/feel/surface_waves.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "surface/straight_wall.hpp"

namespace tribo::session {
namespace {

// Along x, 20 mm long, with a mark each 0.1 mm.
template <class Value>
surface::FormError error_of(Value&& left_mm) {
    surface::ToothTraces all;
    for (int row = 0; row < 40; ++row) {
        surface::ToothTrace t;
        t.from_mm = {0.5 * row, 0, 0};
        t.to_mm = {0.5 * row + 0.5, 0, 0};
        t.inner_mm = {0.5 * row + 0.25, 0, 0};
        t.normal = {0, -1, 0};
        t.arc_mm = 1e-3;  // sharp teeth: the marks stay as they are
        t.width_mm = 1;
        t.start_s = 0.01 * row;
        t.end_s = t.start_s + 0.01;
        t.first = all.marks.size();
        t.count = 5;
        for (int n = 0; n < 5; ++n) {
            const double at = (n + 0.5) / 5;
            all.marks.push_back({static_cast<float>(at), static_cast<float>(left_mm(0.5 * (row + at))), 0});
        }
        if (row > 0) t.before = static_cast<std::uint32_t>(row - 1);
        all.traces.push_back(t);
    }
    return surface::FormError(std::move(all), test::StraightWall());
}

haptics::ProbeContact contact_at(double x, double penetration_mm, double mm_per_s = 0) {
    haptics::ProbeContact contact;
    contact.in_contact = true;
    contact.proxy_mm = {x, 0, 0};
    contact.normal = {0, -1, 0};
    contact.penetration_mm = penetration_mm;
    contact.slip_mm_per_s = {mm_per_s, 0, 0};
    contact.force_n = 0.5 * penetration_mm * contact.normal;
    return contact;
}

TEST(SurfaceWaves, push_as_the_surface_stands) {
    for (const double stands : {0.04, -0.04}) {
        const surface::FormError error = error_of([&](double) { return stands; });
        SurfaceWaves waves(error, 0.5);
        for (double pressed = 0; pressed < 0.2; pressed += 0.01) {
            const haptics::ProbeContact contact = contact_at(7, pressed);
            const double all = -(contact.force_n + waves.force(contact, 1e-3)).y;
            EXPECT_GE(all, -1e-12);
            if (pressed > std::abs(stands)) {
                EXPECT_NEAR(all, 0.5 * (pressed + stands), 1e-6);
            } else if (pressed == 0) {
                EXPECT_NEAR(all, 0, 1e-12);
            }
        }
    }
}

TEST(SurfaceWaves, are_felt_slowly_and_fade_where_the_servo_cannot_carry_them) {
    const surface::FormError error =
        error_of([](double x) { return 0.02 + 0.01 * std::sin(2 * 3.14159265358979 * x / 0.8); });
    const auto range = [&](double mm_per_s) {
        SurfaceWaves waves(error, 0.5);
        double least = 1, most = 0;
        for (int n = 0; n < 400; ++n) {
            const double x = 2 + std::fmod(n * 1e-3 * mm_per_s, 16.0);
            const double force = -waves.force(contact_at(x, 0.3, mm_per_s), 1e-3).y;
            if (n < 200) continue;
            least = std::min(least, force);
            most = std::max(most, force);
        }
        return std::pair{least, most};
    };
    const auto [low, high] = range(20);
    EXPECT_NEAR(low, 0.5 * 0.01, 5e-4);
    EXPECT_NEAR(high, 0.5 * 0.03, 5e-4);
    const auto [fast_low, fast_high] = range(500);
    EXPECT_LT(fast_high - fast_low, 1.5e-3);
    EXPECT_NEAR(fast_low, 0.5 * 0.02, 1.5e-3);
}

TEST(SurfaceWaves, are_nothing_where_none_are_known_and_in_air) {
    const surface::FormError error = error_of([](double) { return 0.02; });
    SurfaceWaves waves(error, 0.5);
    EXPECT_EQ(waves.force(contact_at(-5, 0.1), 1e-3), Vec3{});
    haptics::ProbeContact air = contact_at(5, 0.1);
    air.in_contact = false;
    EXPECT_EQ(waves.force(air, 1e-3), Vec3{});
}

}  // namespace
}  // namespace tribo::session
