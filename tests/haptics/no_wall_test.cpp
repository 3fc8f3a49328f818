// SPDX-License-Identifier: MIT
// Where cuts meet, overlap a little, or end at a face of the blank there is no wall: a probe passes without a
// force. A wall of some micrometres holds it.
#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/contact/field_contact.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::haptics {
namespace {

constexpr double kSpring = 0.5, kPassDeep = 15, kPassDiameter = 6;

ContactOptions no_wall_options(double radius_mm) {
    ContactOptions options;
    options.stiffness_n_per_mm = kSpring;
    options.probe_radius_mm = radius_mm;
    return options;
}

// Largest force on the way, at 1 kHz and 400 mm/s.
double largest_force_between(FieldContact& contact, Vec3 from, Vec3 to) {
    constexpr double kStep = 0.4;
    const int ticks = static_cast<int>(std::ceil(distance(from, to) / kStep));
    double most = 0;
    for (int n = 0; n <= ticks; ++n)
        most = std::max(most, length(contact.update(lerp(from, to, static_cast<double>(n) / ticks)).force_n));
    return most;
}

std::unique_ptr<const field::Shape> flat_pass(Vec3 from, Vec3 to) {
    milling::Cutter cutter;
    cutter.diameter_mm = kPassDiameter;
    cutter.length_mm = 40;
    motion::Move move;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    return milling::make_sweep(cutter, move);
}

TEST(NoWall, is_left_at_a_face_of_the_blank_where_a_cut_ends) {
    for (const double beyond : {-1e-9, 0.0, 1e-9, 1e-7, 1e-3, 0.1, 0.4, 1.0}) {
        for (const double radius : {0.0, 0.2, 0.5, 2.0}) {
            field::CarvedField field(std::make_unique<field::BoxShape>(Box3{{0, 0, 0}, {40, 40, 40}}), 0.5);
            field.carve(std::make_unique<field::BoxShape>(Box3{{-1, -1, 10}, {40 + beyond, 41, 41}}));
            FieldContact contact(field, no_wall_options(radius));
            EXPECT_EQ(largest_force_between(contact, {44, 20, 25.03}, {36, 20, 25.03}), 0)
                << beyond << " " << radius;
            EXPECT_EQ(largest_force_between(contact, {36, 20, 25.03}, {40, 25, 25}), 0)
                << beyond << " " << radius;
            EXPECT_EQ(largest_force_between(contact, {40, 25, 25}, {40, 5, 25}), 0)
                << beyond << " " << radius;
        }
    }
}

// Two passes of a flat cutter side by side, in any direction.
struct TwoPasses {
    std::unique_ptr<field::CarvedField> field;
    Vec3 middle, across;  // a place of the floor between them, and the way from one to the other

    TwoPasses(double apart_mm, double turn_rad, Vec3 off, double cell_mm) {
        field = std::make_unique<field::CarvedField>(
            std::make_unique<field::BoxShape>(Box3{{-15, -15, -20}, {15, 15, 0}}), cell_mm);
        across = {std::cos(turn_rad), std::sin(turn_rad), 0};
        middle = Vec3{0, 0, -kPassDeep} + off;
        const Vec3 along{-across.y, across.x, 0};
        for (const double side : {-0.5, 0.5}) {
            const Vec3 at = middle + side * apart_mm * across;
            field->carve(flat_pass(at - 30 * along, at + 30 * along));
        }
    }
};

TEST(NoWall, is_left_between_two_passes_that_meet_or_overlap) {
    const CounterNoise noise(71);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int n = 0; n < 150; ++n) {
        constexpr double kOverlaps[] = {0, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 0.1, 0.25, 0.5, 1};
        const double overlap = kOverlaps[n % 10] * between(0.5, 1), radius = n % 3 == 0 ? 0 : between(0.1, 2);
        const TwoPasses two(kPassDiameter - overlap, between(0, 6.3),
                            {between(-1, 1), between(-1, 1), between(-1, 1)}, between(0.2, 0.7));
        FieldContact contact(*two.field, no_wall_options(radius));
        const double high = radius + between(0.3, kPassDeep);
        const Vec3 from = two.middle - 0.8 * two.across + Vec3{0, 0, high},
                   to = two.middle + 0.8 * two.across + Vec3{0, 0, high};
        EXPECT_EQ(largest_force_between(contact, from, to), 0) << n << " " << overlap << " " << radius;
        EXPECT_EQ(largest_force_between(contact, to, from), 0) << n << " " << overlap << " " << radius;
        // The floor below is there.
        const Vec3 pressed = two.middle + Vec3{0, 0, radius - 0.3};
        (void)largest_force_between(contact, from, pressed);
        ProbeContact c;
        for (int k = 0; k < 20; ++k) c = contact.update(pressed);
        EXPECT_NEAR(c.force_n.z, 0.3 * kSpring, 0.01 * kSpring) << n << " " << overlap << " " << radius;
    }
}

// The axis leans along the feed, and turns there: both passes end at the plane between them.
TEST(NoWall, is_left_between_two_passes_of_a_leaning_or_turning_cutter) {
    const CounterNoise noise(73);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int n = 0; n < 300; ++n) {
        constexpr double kOverlaps[] = {0, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 0.1, 0.25, 0.5, 1};
        constexpr milling::CutterKind kKinds[] = {milling::CutterKind::flat, milling::CutterKind::bull,
                                                  milling::CutterKind::ball};
        milling::Cutter cutter;
        cutter.kind = kKinds[n % 3];
        cutter.diameter_mm = kPassDiameter;
        cutter.length_mm = 40;
        if (cutter.kind == milling::CutterKind::bull) cutter.corner_mm = between(0.5, 2);
        field::CarvedField field(std::make_unique<field::BoxShape>(Box3{{-20, -20, -25}, {20, 20, 0}}),
                                 between(0.2, 0.7));
        const double turn = between(0, 6.3), lean = between(0, 0.5),
                     half_turned = (n / 10 % 2) * between(-0.15, 0.15);
        const Vec3 across{std::cos(turn), std::sin(turn), 0}, along{-across.y, across.x, 0},
            middle{between(-1, 1), between(-1, 1), -kPassDeep};
        const auto leaning = [&](double by) { return Vec3{0, 0, std::cos(by)} + std::sin(by) * along; };
        for (const double side : {-0.5, 0.5}) {
            const Vec3 at = middle + side * (kPassDiameter - kOverlaps[n % 10] * between(0.5, 1)) * across;
            motion::Move move;
            move.start = {at - 4 * along, leaning(lean - half_turned)};
            move.end = {at + 4 * along, leaning(lean + half_turned)};
            field.carve(milling::make_sweep(cutter, move));
        }
        const double cusp = cutter.kind == milling::CutterKind::ball ? 0.5 * kPassDiameter : cutter.corner_mm,
                     radius = n % 4 == 0 ? 0 : between(0.1, 1.5);
        const Vec3 up = (radius + cusp + between(0.1, 4)) * leaning(lean);
        FieldContact contact(field, no_wall_options(radius));
        EXPECT_EQ(largest_force_between(contact, middle - 0.9 * across + up, middle + 0.9 * across + up), 0)
            << n << " " << radius;
    }
}

TEST(NoWall, is_another_thing_than_a_thin_wall) {
    const CounterNoise noise(72);
    std::uint64_t drawn = 0;
    const auto between = [&](double low, double high) { return low + (high - low) * noise.uniform(drawn++); };
    for (int n = 0; n < 100; ++n) {
        constexpr double kWalls[] = {0.003, 0.01, 0.05, 0.2};
        const double wall = kWalls[n % 4], radius = n % 3 == 0 ? 0 : between(0.1, 1.5);
        const TwoPasses two(kPassDiameter + wall, between(0, 6.3),
                            {between(-1, 1), between(-1, 1), between(-1, 1)}, between(0.2, 0.7));
        FieldContact contact(*two.field, no_wall_options(radius));
        const Vec3 up{0, 0, radius + between(0.3, 5)}, from = two.middle - 2.5 * two.across + up,
                                                       to = two.middle + two.across + up;
        (void)largest_force_between(contact, from, to);
        ProbeContact c;
        for (int k = 0; k < 20; ++k) c = contact.update(to);
        EXPECT_NEAR(dot(c.force_n, two.across), -kSpring * (1 + 0.5 * wall + radius), 0.02)
            << n << " " << wall;
    }
}

}  // namespace
}  // namespace tribo::haptics
