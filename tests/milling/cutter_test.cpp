// SPDX-License-Identifier: MIT
#include "milling/tool/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace tribo::milling {
namespace {

TEST(Cutter, edge_lags_by_a_turn_per_lead) {
    const Cutter c{.diameter_mm = 12, .helix_deg = 30};
    const double lead = std::numbers::pi * 12 / std::tan(std::numbers::pi / 6);
    EXPECT_NEAR(c.lag_rad(lead), 2 * std::numbers::pi, 1e-12);
    EXPECT_EQ((Cutter{.helix_deg = 0}.lag_rad(10)), 0);
}

struct Bad {
    const char* key;  // that the message must name
    std::function<void(Cutter&)> spoil;
};

TEST(Cutter, what_cannot_be_a_tool_is_refused_by_the_name_of_the_key) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    const Bad bad[] = {
        {"diameter_mm", [&](Cutter& c) { c.diameter_mm = 0; }},
        {"diameter_mm", [&](Cutter& c) { c.diameter_mm = nan; }},
        {"diameter_mm", [&](Cutter& c) { c.diameter_mm = infinity; }},
        {"corner_mm", [&](Cutter& c) { c.kind = CutterKind::bull; }},
        {"corner_mm", [&](Cutter& c) { c.kind = CutterKind::bull, c.corner_mm = 5; }},
        {"corner_mm", [&](Cutter& c) { c.kind = CutterKind::bull, c.corner_mm = nan; }},
        {"flutes", [&](Cutter& c) { c.flutes = 0; }},
        {"flutes", [&](Cutter& c) { c.flutes = 65; }},
        {"helix_deg", [&](Cutter& c) { c.helix_deg = -86; }},
        {"helix_deg", [&](Cutter& c) { c.helix_deg = 90; }},
        {"helix_deg", [&](Cutter& c) { c.helix_deg = nan; }},
        {"core_mm", [&](Cutter& c) { c.core_mm = -1; }},
        {"core_mm", [&](Cutter& c) { c.core_mm = nan; }},
        {"core_mm", [&](Cutter& c) { c.kind = CutterKind::ball, c.core_mm = 1; }},
        {"length_mm", [&](Cutter& c) { c.length_mm = 0; }},
        {"length_mm", [&](Cutter& c) { c.kind = CutterKind::ball, c.length_mm = 4; }},
        {"runout_mm", [&](Cutter& c) { c.runout_mm = -0.01; }},
        {"runout_mm", [&](Cutter& c) { c.runout_mm = 5; }},
        {"runout_deg", [&](Cutter& c) { c.runout_deg = infinity; }},
        {"pitch_deg", [&](Cutter& c) { c.pitch_deg = {120, 240, 0}; }},
        {"pitch_deg", [&](Cutter& c) { c.pitch_deg = {170, 180}; }},
        {"pitch_deg", [&](Cutter& c) { c.pitch_deg = {400, -40}; }},
        {"holder", [&](Cutter& c) { c.holder = {{40, 0}}; }},
        {"stickout_mm", [&](Cutter& c) { c.stickout_mm = 39; }},
        {"stickout_mm", [&](Cutter& c) { c.stickout_mm = -60; }},
        {"shank_mm", [&](Cutter& c) { c.shank_mm = 12; }},
        {"neck_mm", [&](Cutter& c) { c.stickout_mm = 60, c.neck_mm = 10.1; }},
        {"reach_mm", [&](Cutter& c) { c.stickout_mm = 60, c.reach_mm = 50; }},
        {"reach_mm", [&](Cutter& c) { c.stickout_mm = 60, c.neck_mm = 9, c.reach_mm = 61; }},
    };
    for (const Bad& b : bad) {
        Cutter c;
        ASSERT_TRUE(check(c));
        b.spoil(c);
        const Result<void> result = check(c);
        ASSERT_FALSE(result) << b.key;
        EXPECT_NE(result.error().cause.find(b.key), std::string::npos) << result.error().text();
        EXPECT_FALSE(result.error().remedy.empty()) << b.key;
    }
}

TEST(Cutter, pitch_as_a_drawing_rounds_it_is_taken) {
    Cutter c{.flutes = 3, .pitch_deg = {119.99, 120.0, 119.99}};
    EXPECT_TRUE(check(c));
}

TEST(Cutter, has_neck_and_shank_between_its_edges_and_its_holder) {
    Cutter c{.diameter_mm = 10, .length_mm = 20, .holder = {{30, 25}}};
    const auto is = [](const std::vector<HolderStep>& found, const std::vector<HolderStep>& known) {
        return std::equal(found.begin(), found.end(), known.begin(), known.end(),
                          [](const HolderStep& a, const HolderStep& b) {
                              return a.diameter_mm == b.diameter_mm && a.length_mm == b.length_mm;
                          });
    };
    EXPECT_TRUE(is(c.steps(), {{30, 25}}));
    c.stickout_mm = 60;
    EXPECT_TRUE(is(c.steps(), {{10, 40}, {30, 25}}));
    c.shank_mm = 12;
    EXPECT_TRUE(is(c.shank_steps(), {{12, 40}}));
    c.neck_mm = 9;
    EXPECT_TRUE(is(c.steps(), {{9, 40}, {30, 25}}));
    c.reach_mm = 50;
    EXPECT_TRUE(is(c.steps(), {{9, 30}, {12, 10}, {30, 25}}));
    EXPECT_TRUE(check(c));
    c.stickout_mm = 20;
    c.neck_mm = c.reach_mm = 0;
    EXPECT_TRUE(is(c.steps(), {{30, 25}}));
}

}  // namespace
}  // namespace tribo::milling
