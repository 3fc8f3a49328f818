// SPDX-License-Identifier: MIT
// Profiles of the named kinds against their drawings, and profiles that cannot be turned.
#include "milling/tool/cutter_shape.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "milling/tool/turned_profile.hpp"

namespace tribo::milling {
namespace {

Cutter made(Cutter cutter) {
    const auto done = make_profile(cutter);
    EXPECT_TRUE(done) << done.error().text();
    const auto good = check(cutter);
    EXPECT_TRUE(good) << good.error().text();
    return cutter;
}

std::string refusal(Cutter cutter) {
    const auto done = make_profile(cutter);
    return done ? "made" : done.error().text();
}

void expect_vertices(const Cutter& cutter, const std::vector<ProfileVertex>& expected) {
    ASSERT_EQ(cutter.profile.size(), expected.size());
    for (std::size_t n = 0; n < expected.size(); ++n) {
        EXPECT_NEAR(cutter.profile[n].r_mm, expected[n].r_mm, 1e-12) << n;
        EXPECT_NEAR(cutter.profile[n].z_mm, expected[n].z_mm, 1e-12) << n;
        EXPECT_NEAR(cutter.profile[n].bulge, expected[n].bulge, 1e-12) << n;
    }
}

TEST(CutterShape, of_pointed_tools_is_a_cone_of_the_given_angle) {
    const double root3 = std::sqrt(3.0);
    expect_vertices(made({.kind = CutterKind::v, .diameter_mm = 6, .point_deg = 60}),
                    {{0, 0, 0}, {3, 3 * root3, 0}});
    expect_vertices(made({.kind = CutterKind::engraver, .diameter_mm = 4, .tip_mm = 0.2, .point_deg = 90}),
                    {{0.1, 0, 0}, {2, 1.9, 0}});
    const Cutter drill = made({.kind = CutterKind::drill, .diameter_mm = 8});
    EXPECT_EQ(drill.point_deg, 118);
    expect_vertices(drill, {{0, 0, 0}, {4, 4 / std::tan(59 * math::kRadPerDeg), 0}});
    EXPECT_NEAR(made({.kind = CutterKind::countersink, .diameter_mm = 10}).profile.back().z_mm, 5, 1e-12);
    EXPECT_NEAR(made({.kind = CutterKind::chamfer, .diameter_mm = 10, .tip_mm = 2}).profile.back().z_mm, 4,
                1e-12);
}

// The side of a tapered mill passes through (tip / 2, 0) if it is sharp; a ball of half its tip touches side
// and axis.
TEST(CutterShape, of_a_taper_follows_from_its_tip_or_from_its_diameter) {
    const double slope = std::tan(5 * math::kRadPerDeg);
    const Cutter sharp =
        made({.kind = CutterKind::taper, .diameter_mm = 6, .length_mm = 20, .tip_mm = 3, .taper_deg = 5});
    expect_vertices(sharp, {{1.5, 0, 0}, {3, 1.5 / slope, 0}});
    const Cutter by_length =
        made({.kind = CutterKind::taper, .diameter_mm = 6, .length_mm = 20, .taper_deg = 5});
    EXPECT_NEAR(by_length.tip_mm, 6 - 2 * 20 * slope, 1e-12);
    EXPECT_EQ(by_length.profile.back().z_mm, 20);
    const Cutter ball = made({.kind = CutterKind::taper,
                              .diameter_mm = 6,
                              .corner_mm = 1,
                              .length_mm = 30,
                              .tip_mm = 2,
                              .taper_deg = 5});
    ASSERT_EQ(ball.profile.size(), 3U);
    EXPECT_EQ(ball.profile[0].r_mm, 0);
    EXPECT_NEAR(ball.profile[0].bulge, std::tan(85 * math::kRadPerDeg / 4), 1e-12);
    EXPECT_NEAR(ball.profile[1].r_mm, std::cos(5 * math::kRadPerDeg), 1e-12);
}

TEST(CutterShape, of_undercutting_tools_narrows_to_the_neck_and_ends_there) {
    const Cutter dovetail =
        made({.kind = CutterKind::dovetail, .diameter_mm = 12, .taper_deg = 45, .height_mm = 3});
    expect_vertices(dovetail, {{6, 0, 0}, {3, 3, 0}});
    EXPECT_EQ(dovetail.length_mm, 3);
    EXPECT_NEAR(dovetail.top_diameter_mm(), 6, 1e-12);
    const Cutter lollipop = made({.kind = CutterKind::lollipop, .diameter_mm = 10, .neck_mm = 6});
    expect_vertices(lollipop, {{0, 0, std::tan((math::kHalfPi + std::acos(0.6)) / 4)}, {3, 9, 0}});
    const Cutter thread =
        made({.kind = CutterKind::thread, .diameter_mm = 8, .neck_mm = 6, .tip_mm = 0.1, .point_deg = 90});
    expect_vertices(thread, {{3, 0, 0}, {4, 1, 0}, {4, 1.1, 0}, {3, 2.1, 0}});
    EXPECT_EQ(thread.core_mm, 6);
}

TEST(CutterShape, of_lens_and_barrel_is_tangent_where_arcs_meet) {
    for (const Cutter& cutter :
         {made({.kind = CutterKind::lens, .diameter_mm = 10, .corner_mm = 1, .side_mm = 20}),
          made({.kind = CutterKind::barrel,
                .diameter_mm = 10,
                .corner_mm = 1.5,
                .length_mm = 20,
                .side_mm = 80}),
          made(
              {.kind = CutterKind::taper, .diameter_mm = 10, .corner_mm = 1, .tip_mm = 5, .taper_deg = 7})}) {
        const auto elements = profile_elements(cutter);
        EXPECT_NEAR(largest_radius_mm(elements), 5, 1e-12);
        for (std::size_t n = 1; n < elements.size(); ++n) {
            if (!elements[n].is_arc() && !elements[n - 1].is_arc()) continue;
            if (cutter.kind == CutterKind::barrel && n + 1 == elements.size()) continue;
            EXPECT_NEAR(cross(elements[n - 1].to_normal, elements[n].from_normal), 0, 1e-9) << n;
        }
    }
    const Cutter sharp = made({.kind = CutterKind::barrel, .diameter_mm = 10, .length_mm = 6, .side_mm = 5});
    expect_vertices(sharp, {{4, 0, std::tan(std::asin(0.6) / 2)}, {4, 6, 0}});
}

// The ends of an arc lie on its circle, and its normals point away from or to its centre, for any bulge.
RC_GTEST_PROP(CutterShape, an_arc_has_the_angle_of_its_bulge, ()) {
    const double angle = *rc::gen::inRange(1, 1750) * 1e-3 * (*rc::gen::arbitrary<bool>() ? 1 : -1);
    Cutter cutter{.kind = CutterKind::profile, .length_mm = 0};
    const double r = *rc::gen::inRange(3000, 9000) * 1e-3;
    cutter.profile = {{r, 0, std::tan(angle / 4)}, {r + 0.7, 1.7, 0}};
    const auto done = make_profile(cutter);
    if (!done) RC_DISCARD("hangs back");
    const ProfileElement arc = profile_elements(cutter)[1];
    RC_ASSERT(std::abs(norm(arc.from - arc.centre) - std::abs(arc.radius_mm)) < 1e-9);
    RC_ASSERT(std::abs(norm(arc.to - arc.centre) - std::abs(arc.radius_mm)) < 1e-9);
    RC_ASSERT(
        std::abs(std::atan2(cross(arc.from_normal, arc.to_normal), dot(arc.from_normal, arc.to_normal)) -
                 angle) < 1e-9);
}

TEST(CutterShape, that_cannot_be_is_refused_with_its_key_and_the_cure) {
    const auto profile = [](std::vector<ProfileVertex> vertices, double length = 0) {
        Cutter cutter{.kind = CutterKind::profile, .length_mm = length};
        cutter.profile = std::move(vertices);
        return cutter;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<Cutter, const char*> cases[] = {
        {{.kind = CutterKind::v}, "point_deg of a v is missing; add point_deg"},
        {{.kind = CutterKind::v, .point_deg = 180}, "point_deg is 180; keep"},
        {{.kind = CutterKind::taper}, "taper_deg of a taper is missing"},
        {{.kind = CutterKind::taper, .taper_deg = 20}, "taper_deg is too steep"},
        {{.kind = CutterKind::taper, .tip_mm = 20, .taper_deg = 5}, "tip_mm of 20 mm leaves no cone"},
        {{.kind = CutterKind::taper, .corner_mm = 2, .tip_mm = 2, .taper_deg = 5},
         "corner_mm is larger than half"},
        {{.kind = CutterKind::v, .length_mm = 5, .point_deg = 60}, "length_mm ends below the diameter"},
        {{.kind = CutterKind::dovetail, .taper_deg = 45, .height_mm = 6}, "height_mm does not fit the angle"},
        {{.kind = CutterKind::lens, .side_mm = 4}, "side_mm of a lens must be"},
        {{.kind = CutterKind::barrel, .side_mm = 10}, "does not reach from the bottom"},
        {{.kind = CutterKind::lollipop}, "neck_mm of a lollipop is missing"},
        {{.kind = CutterKind::lollipop, .neck_mm = 10}, "neck_mm is not below the diameter"},
        {{.kind = CutterKind::v, .point_deg = nan}, "point_deg is nan"},
        {profile({}), "profile is missing; add profile"},
        {profile({{1, 0, 0}, {-1, 2, 0}}), "vertex 2 at a negative radius"},
        {profile({{1, 0, 0}, {nan, 2, 0}}), "vertex 2 with a coordinate of a profile of nan"},
        {profile({{1, 0.5, 0}, {2, 2, 0}}), "vertex 1 at z = 0.5; begin at the tip"},
        {profile({{1, 0, 0}, {2, 2, 0}, {3, 1, 0}}), "vertex 3 below the one before it"},
        {profile({{1, 0, 0}, {1, 0, 0}, {3, 1, 0}}), "vertex 2 at the place of the one before it"},
        {profile({{1, 0, 2}, {2, 2, 0}}), "bulge of an arc of 2"},
        {profile({{1, 0, 0.9}, {2, 2, 0}}), "hangs back"},
        {profile({{5, 0, 0}, {3, 0, 0}, {3, 1, 0}}), "turns back on itself"},
        {profile({{1, 0, 0}, {0, 2, 0}}), "vertex 2 on the axis"},
        {profile({{0.5, 0, -0.6}, {0.5, 4, 0}}), "crosses the axis"},
        {profile({{0, 0, 0}, {0, 1, 0}, {2, 2, 0}}), "runs along the axis between (0, 0) and (0, 1)"},
        {profile({{1, 0, 0}, {2, 2, 0}}, 1), "length_mm ends below"},
        {profile(std::vector<ProfileVertex>(10'000)), "has 10000 vertices, more than 200"},
    };
    for (const auto& [cutter, text] : cases)
        EXPECT_NE(refusal(cutter).find(text), std::string::npos) << refusal(cutter);
}

}  // namespace
}  // namespace tribo::milling
