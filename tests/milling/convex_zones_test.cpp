// SPDX-License-Identifier: MIT
// A cutter with any profile is solid inside and ends at its drawing, also far from it.
#include "milling/tool/convex_zones.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iomanip>
#include <numbers>
#include <optional>
#include <rapidcheck/gtest.h>
#include <vector>

#include "milling/any_profile.hpp"

namespace tribo::milling {
namespace {

double rounded(double value, int decimals) {
    const double unit = std::pow(10, -decimals);
    return unit * std::round(value / unit);
}

// Lines and arcs of any kind and order, rounded as people write them: tangents are barely missed to both
// sides, necks are as narrow as 0.1 mm.
std::optional<Cutter> any_lines_and_arcs() {
    Cutter c{.kind = CutterKind::profile, .length_mm = 0};
    const int decimals = *rc::gen::inRange(1, 7), pieces = *rc::gen::inRange(2, 8);
    double r = *rc::gen::inRange(0, 3) == 0 ? 0 : drawn(0.2, 2), z = 0;
    double way_rad = drawn(0, math::kPi);  // from the radius to the axis
    const auto go = [&](double length, double direction_rad) {
        r = std::max(r + length * std::cos(direction_rad), 0.1);
        z += length * std::max(std::sin(direction_rad), 0.0);
        c.profile.push_back({rounded(r, decimals), rounded(z, decimals), 0});
    };
    c.profile.push_back({rounded(r, decimals), 0, 0});
    for (int n = 0; n < pieces; ++n) {
        const int what = *rc::gen::inRange(0, 6);
        const double length = drawn(0.2, 3);
        if (what == 0) way_rad = drawn(0, math::kPi);
        if (what == 1) way_rad = 0.5 * math::kPi;
        if (what == 2) way_rad = *rc::gen::inRange(0, 2) * math::kPi;
        if (what < 4) {
            go(length, way_rad);
            continue;
        }
        // An arc that goes on from the tangent, convex or hollow; some programs draw it as short lines.
        const double end_rad = std::clamp(way_rad + (what == 4 ? 1 : -1) * drawn(0.1, 1.5), 0.0, math::kPi);
        if (*rc::gen::inRange(0, 4) == 0) {
            const int lines = *rc::gen::inRange(2, 100);
            for (int k = 0; k < lines; ++k)
                go(length / lines, way_rad + (k + 0.5) / lines * (end_rad - way_rad));
            way_rad = end_rad;
            continue;
        }
        c.profile.back().bulge = rounded(std::tan(0.25 * (end_rad - way_rad)), decimals + 1);
        go(length, 0.5 * (way_rad + end_rad));
        way_rad = end_rad;
    }
    go(drawn(0.5, 5), 0.5 * math::kPi);
    if (!make_profile(c)) return std::nullopt;
    return c;
}

void is_its_drawing(const Cutter& c) {
    // The surface of a profile may be off by this much where tangents are rounded, mm.
    constexpr double kOff = 5e-5;
    const ConvexZones zones(c);
    for (const ProfileVertex& v : c.profile)
        RC_LOG() << std::setprecision(12) << "vertex " << v.r_mm << " " << v.z_mm << " bulge " << v.bulge
                 << "\n";
    for (int n = 0; n < 60; ++n) {
        const double r = *rc::gen::inRange(0, 5) == 0 ? 0 : drawn(0, 1.3) * zones.radius_mm();
        double z = drawn(-0.2, 1.2) * zones.length_mm();
        const int where = *rc::gen::inRange(0, 4);
        if (where == 0) z = drawn(-100, 200);
        // At the height of a vertex two zones may end.
        if (where > 1) z = c.profile[*rc::gen::inRange<std::size_t>(0, c.profile.size())].z_mm;
        if (where > 2) z += drawn(-1e-3, 1e-3);
        const double truth = drawn_point(c, r, z).distance_mm, d = zones.distance_mm({r, z});
        RC_LOG() << "(" << r << ", " << z << ") " << truth << " " << d << "\n";
        if (truth > kOff) RC_ASSERT(d > 0);
        if (truth < -kOff) RC_ASSERT(d < 0);
        RC_ASSERT(d <= std::max(truth, 0.0) + kOff);
    }
}

RC_GTEST_PROP(ConvexZones, of_any_lines_and_arcs_are_the_drawing, ()) {
    const auto c = any_lines_and_arcs();
    RC_PRE(c.has_value());
    is_its_drawing(*c);
}
RC_GTEST_PROP(ConvexZones, of_every_kind_are_the_drawing, ()) {
    is_its_drawing(any_profile());
}

// Inside, the distance is no small part of the way out where zones meet: it would leave material there.
TEST(ConvexZones, leave_nothing_where_they_meet) {
    const struct {
        std::vector<ProfileVertex> profile;
        double r_mm, z_mm, way_mm;
    } cases[] = {
        // A round-over: the hollow quarter ends level, at the wall or at a step.
        {{{2, 0, 1 - std::numbers::sqrt2}, {4, 2, 0}, {4, 6, 0}}, 1, 2, 2},
        {{{2, 0, 1 - std::numbers::sqrt2}, {4, 2, 0}, {5, 2, 0}, {5, 6, 0}}, 1, 2, 2},
        // A cone, then a hollow arc that stands more upright.
        {{{1, 0, 0}, {1.5, 2, -0.4}, {2.5, 3, 0}, {2.5, 6, 0}}, 0.5, 2, 0.97},
        // A disc whose side and back are nearly tangent.
        {{{3, 0, 0}, {3, 1, 0.1005}, {2.8, 2, 0}, {1, 2, 0}, {1, 6, 0}}, 1, 1, 1},
        // A slit between two levels: an arc ends in one.
        {{{2, 0, std::numbers::sqrt2 - 1}, {1, 1, 0}, {1.5, 1, 0}, {1.5, 5, 0}}, 0.5, 1, 0.5},
    };
    for (const auto& [profile, r, z, way] : cases) {
        Cutter c{.kind = CutterKind::profile, .length_mm = 0};
        c.profile = profile;
        const ConvexZones zones(finished(c));
        EXPECT_LT(zones.distance_mm({r, z}), -0.3 * way) << r << " " << z;
        EXPECT_GT(zones.distance_mm({0, 100}), 50) << r << " " << z;
    }
}

// A hollow corner of radius 0.1 mm that is drawn as 150 short lines stays hollow.
TEST(ConvexZones, keep_a_hollow_that_is_drawn_as_short_lines) {
    Cutter c{.kind = CutterKind::profile, .length_mm = 0};
    c.profile.push_back({1, 0, 0});
    for (int n = 0; n <= 150; ++n) {
        const double angle = n * 0.5 / 150 * math::kPi;
        c.profile.push_back({1.1 - 0.1 * std::cos(angle), 1 + 0.1 * std::sin(angle), 0});
    }
    c.profile.push_back({3, 1.1, 0});
    c.profile.push_back({3, 5, 0});
    const ConvexZones zones(finished(c));
    for (const double angle : {0.1, 0.4, 0.8, 1.2, 1.5})
        for (const double off : {0.001, 0.01, 0.09}) {
            const double reach = 0.1 - off;
            EXPECT_NEAR(zones.distance_mm({1.1 - reach * std::cos(angle), 1 + reach * std::sin(angle)}), off,
                        5e-5)
                << angle << " " << off;
        }
}

}  // namespace
}  // namespace tribo::milling
