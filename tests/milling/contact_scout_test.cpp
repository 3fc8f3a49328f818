// SPDX-License-Identifier: MIT
// What the scout finds, against a look at every point of a fine net over the envelope.
#include "milling/engagement/contact_scout.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "field/carved/carved_field.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {
namespace {

double in(double from, double to) {
    return from + (to - from) * *rc::gen::inRange(0, 10001) / 10000;
}

Vec3 point(const CutPose& pose, const ProfilePoint& at, double rotation) {
    const Vec3 out = std::sin(rotation) * pose.frame.x + std::cos(rotation) * pose.frame.y;
    return pose.on_axis(at.height_mm) + at.radius_mm * out;
}

// Against a look at every point of the lateral surface up to a height.
void check(const field::CarvedField& stock, const Cutter& cutter, const CutPose& pose, double height_mm) {
    const CutterProfile profile(cutter);
    const double s0 = profile.corner_end(), s1 = profile.at_height(std::min(height_mm, cutter.length_mm));
    if (!(s1 > s0)) return;
    std::vector<MeridianStretch> found;
    ContactScout scout(cutter);
    scout.look(stock, pose, s0, s1, found);

    for (const MeridianStretch& stretch : found) {
        RC_ASSERT(stretch.s0_mm >= s0 - 1e-9 && stretch.s1_mm <= s1 + 1e-9 && stretch.s1_mm > stretch.s0_mm);
    }
    // Rows are a thirty-second of the part or a cell high, columns a sixty-fourth of a turn wide.
    const double row = std::max((s1 - s0) / 32, 0.5), column = math::kTwoPi / 64;
    constexpr int kNet = 400;
    for (int i = 0; i < kNet; ++i) {
        const double s = s0 + (s1 - s0) * (i + 0.5) / kNet;
        const bool engaged = std::any_of(found.begin(), found.end(), [&](const MeridianStretch& f) {
            return f.engaged && s > f.s0_mm && s < f.s1_mm;
        });
        bool any = false, wide = false;
        double since = -1e9;
        for (int j = 0; j < 2 * 360; ++j) {
            const double rotation = math::kTwoPi * j / 360;
            const ProfilePoint at = profile.at(s);
            const TurnLaw law = normal_travel(pose.travel, at);
            const bool outward =
                law.sine * std::sin(rotation) + law.cosine * std::cos(rotation) + law.constant > 1e-4;
            // In material from a row below, or the part's end, to a row above: a whole cell lies in it.
            const auto material = [&](double by) {
                const double there = std::clamp(s + by, s0, s1);
                return stock.is_material(point(pose, profile.at(there), rotation), 1e-3);
            };
            any = any || (outward && stock.is_material(point(pose, at, rotation), 0));
            if (!outward || !material(0) || !material(-row) || !material(row)) since = rotation;
            wide = wide || rotation - since > 1.5 * column;
        }
        if (wide) RC_ASSERT(engaged);
        if (engaged && !any) {
            // Only the ends of a row may lie in air: its middle, half a row away at most, has material in the
            // middle of a column, however thin.
            constexpr int kSteps = 500;
            bool near = false;
            for (int k = -kSteps; k <= kSteps && !near; ++k) {
                const double there = std::clamp(s + 0.51 * row * k / kSteps, s0, s1);
                for (int column = 0; column < 64 && !near; ++column) {
                    near = stock.is_material(
                        point(pose, profile.at(there), math::kTwoPi * (column + 0.5) / 64), 0);
                }
            }
            RC_ASSERT(near);
        }
    }
}

field::CarvedField block() {
    return {std::make_unique<field::BoxShape>(Box3{{0, 0, -10}, {30, 30, 0}}), 0.5};
}

Cutter any_cutter() {
    Cutter cutter;
    cutter.kind = *rc::gen::element(CutterKind::flat, CutterKind::ball, CutterKind::bull);
    cutter.diameter_mm = in(2, 12);
    cutter.corner_mm = 0.2 * cutter.diameter_mm;
    cutter.length_mm = 15;
    return cutter;
}

CutPose any_pose(Vec3 axis, double turn_rad) {
    return {{in(3, 27), in(3, 27), in(-6, 0)},
            tool_frame(axis, {in(-1, 1), in(-1, 1), in(-0.3, 0.3)}, {1, 0, 0}),
            {.across_mm = 1, .down_mm = in(-0.3, 0.3), .turn_x_rad = turn_rad}};
}

RC_GTEST_PROP(ContactScout, finds_what_a_look_at_every_point_finds, ()) {
    field::CarvedField stock = block();
    for (int boxes = *rc::gen::inRange(0, 4); boxes > 0; --boxes) {
        const Vec3 a{in(0, 30), in(0, 30), in(-9, 0)};
        stock.carve(std::make_unique<field::BoxShape>(Box3{a, a + Vec3{in(1, 20), in(1, 20), 12}}));
    }
    const Vec3 axis = normalized({in(-0.5, 0.5), in(-0.5, 0.5), 1});
    check(stock, any_cutter(), any_pose(axis, in(-0.02, 0.02)), 15);
}

// Earlier passes of the same tool, along the same way and beside it, higher and lower: their walls touch the
// tool.
RC_GTEST_PROP(ContactScout, finds_what_a_look_at_every_point_finds_behind_earlier_passes, ()) {
    field::CarvedField stock = block();
    const Cutter cutter = any_cutter();
    const Vec3 axis =
        *rc::gen::inRange(0, 2) == 0 ? Vec3{0, 0, 1} : normalized({in(-0.5, 0.5), in(-0.5, 0.5), 1});
    const CutPose pose = any_pose(axis, 0);
    for (int passes = *rc::gen::inRange(1, 6); passes > 0; --passes) {
        const bool is_same_way = *rc::gen::inRange(0, 3) > 0;
        const Vec3 aside = is_same_way ? Vec3{} : in(-6, 6) * pose.frame.y;
        const Vec3 middle = pose.tip_mm + aside + in(-1, 3) * axis;
        motion::Move move;
        move.start = {middle - in(0, 12) * pose.frame.x, axis};
        move.end = {middle + in(0, 12) * pose.frame.x, axis};
        if (*rc::gen::inRange(0, 3) == 0)
            move.quadratic = motion::Quadratic{middle + in(-2, 2) * pose.frame.y + in(-1, 1) * axis, axis};
        stock.carve(make_sweep(cutter, move));
    }
    check(stock, cutter, pose, *rc::gen::inRange(0, 2) == 0 ? 15 : -pose.tip_mm.z / axis.z);
}

TEST(ContactScout, sees_a_contact_of_a_hundredth_of_a_millimetre_at_the_tip) {
    const field::CarvedField stock(std::make_unique<field::BoxShape>(Box3{{0, 0, -10}, {30, 30, 0}}), 0.25);
    for (const CutterKind kind : {CutterKind::flat, CutterKind::ball, CutterKind::bull}) {
        Cutter cutter;
        cutter.kind = kind;
        cutter.diameter_mm = 10;
        cutter.corner_mm = 2;
        cutter.length_mm = 20;
        const CutterProfile profile(cutter);
        const CutPose pose{{15, 15, -0.01}, tool_frame({0, 0, 1}, {1, 0, 0}, {1, 0, 0}), {.across_mm = 1}};
        std::vector<MeridianStretch> found;
        ContactScout scout(cutter);
        const bool flat = kind == CutterKind::flat;
        scout.look(stock, pose, profile.bottom_end(), flat ? profile.end() : profile.corner_end(), found);
        ASSERT_FALSE(found.empty());
        EXPECT_TRUE(found.front().engaged);
        EXPECT_LT(profile.at(found.front().s1_mm).height_mm, 0.05);
    }
}

}  // namespace
}  // namespace tribo::milling
