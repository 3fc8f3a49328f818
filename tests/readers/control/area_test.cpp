// SPDX-License-Identifier: MIT
// Rings at a distance from the edge of an area: lengths in closed form.
#include "readers/control/area.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "readers/control/area_milling.hpp"

namespace tribo::readers::control {
namespace {

using gcode::Element;
using gcode::Point;
using math::kPi;

Ring polygon(const std::vector<Point>& points) {
    Ring ring;
    for (std::size_t i = 0; i < points.size(); ++i)
        ring.push_back({points[i], points[(i + 1) % points.size()], {}, 0});
    return ring;
}

Ring rectangle(double length, double width) {
    return polygon({{0, 0}, {length, 0}, {length, width}, {0, width}});
}

Ring circle(Point centre, double radius) {
    const Point start{centre.u + radius, centre.v}, end{centre.u - radius, centre.v};
    return {{start, end, centre, kPi}, {end, start, centre, kPi}};
}

double length_of(const Ring& ring) {
    double sum = 0;
    for (const Element& element : ring) sum += element.length();
    return sum;
}

double length_of(const std::vector<Ring>& rings) {
    double sum = 0;
    for (const Ring& ring : rings) sum += length_of(ring);
    return sum;
}

TEST(Area, of_a_rectangle_has_rectangles) {
    const Area area({rectangle(60, 40)}, {});
    for (const double inset : {5.0, 10.0, 15.0}) {
        const auto rings = area.rings_at(inset);
        ASSERT_EQ(rings.size(), 1u) << inset;
        EXPECT_NEAR(length_of(rings), 2 * (60 + 40 - 4 * inset), 1e-6);
    }
    // In the middle a line there and back.
    EXPECT_NEAR(length_of(area.rings_at(20)), 2 * 20, 1e-4);
    EXPECT_TRUE(area.rings_at(20.01).empty());
    EXPECT_TRUE(area.has({1, 1}));
    EXPECT_FALSE(area.has({-1, 1}));
    EXPECT_NEAR(area.to_edge({30, 4}), 4, 1e-12);
}

TEST(Area, does_not_depend_on_the_direction_of_its_contour) {
    Ring back = polygon({{0, 40}, {60, 40}, {60, 0}, {0, 0}});
    EXPECT_NEAR(length_of(Area({back}, {}).rings_at(5)), 160, 1e-6);
}

TEST(Area, goes_round_corners_that_stand_into_it) {
    const Area area({polygon({{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}})}, {});
    EXPECT_NEAR(length_of(area.rings_at(5)), 30 + 10 + 15 + 5 * kPi / 2 + 15 + 10 + 30, 1e-6);
}

TEST(Area, parts_where_it_is_narrow) {
    // Two squares of 20, joined by a channel of 4: at 3 mm it is closed.
    const Area area({polygon({{-30, -10},
                              {-10, -10},
                              {-10, -2},
                              {10, -2},
                              {10, -10},
                              {30, -10},
                              {30, 10},
                              {10, 10},
                              {10, 2},
                              {-10, 2},
                              {-10, 10},
                              {-30, 10}})},
                    {});
    const auto rings = area.rings_at(3);
    ASSERT_EQ(rings.size(), 2u);
    for (const Ring& ring : rings) EXPECT_NEAR(length_of(ring), 4 * 14 - 4 + 6 * std::asin(2.0 / 3), 1e-5);
    EXPECT_EQ(area.rings_at(1).size(), 1u);
}

TEST(Area, keeps_away_from_islands) {
    const Area area({circle({0, 0}, 15)}, {circle({0, 0}, 5)});
    const auto rings = area.rings_at(3);
    ASSERT_EQ(rings.size(), 2u);
    EXPECT_NEAR(length_of(rings), 2 * kPi * (12 + 8), 1e-6);
    // The area beyond 3 mm lies on the left of each.
    for (const Ring& ring : rings) {
        const bool is_outer = std::abs(length_of(ring) - 2 * kPi * 12) < 1e-3;
        EXPECT_EQ(ring[0].turn_rad > 0, is_outer);
    }
    EXPECT_FALSE(area.keeps({-12, 0}, {12, 0}, 3));
    EXPECT_TRUE(area.keeps({-12, 0}, {-8, 0}, 3));
}

TEST(Area, of_pockets_that_overlap_is_their_union) {
    Ring second;
    for (Element element : rectangle(60, 40)) {
        element.start.u += 30;
        element.end.u += 30;
        second.push_back(element);
    }
    const Area area({rectangle(60, 40), second}, {});
    EXPECT_NEAR(length_of(area.rings_at(5)), 2 * (80 + 30), 1e-4);
}

TEST(Area, nests_contours_by_turns) {
    const Area area({circle({0, 0}, 30), circle({0, 0}, 20), circle({0, 0}, 10)});
    EXPECT_TRUE(area.has({25, 0}));
    EXPECT_FALSE(area.has({15, 0}));
    EXPECT_TRUE(area.has({5, 0}));
}

TEST(Area, is_milled_from_the_inside_outwards) {
    AreaMilling milling;
    milling.depths = {5, 0, 1, -4};
    milling.radius = 5;
    milling.step = 5;
    milling.infeed = 2;
    milling.feed = 300;
    milling.plunge = 100;
    const Area area({rectangle(60, 40)}, {});
    const std::vector<Ring> rings = *rings_of(area, milling);
    EXPECT_EQ(ring_count(rings, milling), 8);  // a line and three rectangles, at two depths
    double before = 0;
    for (const Ring& ring : rings) {
        EXPECT_GT(length_of(ring), before);
        before = length_of(ring);
    }
    double at_bottom = 0;
    Vec3 now{-10, -10, 20};
    const PocketMove go = [&](Vec3 to, std::optional<double> feed, const std::optional<motion::Arc>&) {
        if (feed && now.z == -4 && to.z == -4) at_bottom += distance(now, to);
        if (feed) {
            EXPECT_GE(area.to_edge({to.x, to.y}), 5 - 1e-5);
        }
        now = to;
        return Result<void>{};
    };
    ASSERT_TRUE(mill_area(area, rings, milling, now, go).has_value());
    // The rings, and the ways from each to the next one's nearest corner.
    EXPECT_NEAR(at_bottom, 40 + 80 + 120 + 160 + 3 * std::hypot(5, 5), 1e-4);
    EXPECT_EQ(now.z, 5);
    milling.step = 1e-4;
    EXPECT_FALSE(rings_of(area, milling).has_value());
}

}  // namespace
}  // namespace tribo::readers::control
