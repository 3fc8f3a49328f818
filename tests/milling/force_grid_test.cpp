// SPDX-License-Identifier: MIT
#include "milling/force/force_grid.hpp"

#include <gtest/gtest.h>
#include <numbers>

#include "milling/force/force.hpp"
#include "milling/tool/materials.hpp"

namespace tribo::milling {
namespace {

using std::numbers::pi;

Cutter flat() {
    Cutter c;
    c.diameter_mm = 12;
    c.flutes = 2;
    c.length_mm = 40;
    return c;
}

Vec3 closed_form(double rotation, double entry, double exit, double helix_deg, double feed) {
    Cutter c = flat();
    c.helix_deg = helix_deg;
    ForceModel model(c, find_material("al7075-t6")->coefficients);
    Engagement e;
    e.bands.push_back({0, 2, entry, exit});
    model.engage(e, {feed, 0});
    return model.at(rotation).force_n;
}

TEST(ForceGrid, holds_the_closed_form_at_its_samples) {
    ForceGridOptions o;
    o.rotations = 13;
    o.entries = o.exits = 7;
    const ForceGrid grid(flat(), find_material("al7075-t6")->coefficients, o);
    EXPECT_EQ(grid.bytes(), 13U * 7 * 7 * 5 * 4 * 12);
    for (const double rotation : {0.0, pi / 12, pi / 2}) {
        const Vec3 shown = grid.force_n(rotation, pi / 6, 5 * pi / 6, 30, 0.08);
        EXPECT_LT(distance(shown, closed_form(rotation, pi / 6, 5 * pi / 6, 30, 0.08)), 1e-3) << rotation;
        // The force repeats from tooth to tooth.
        EXPECT_LT(distance(shown, grid.force_n(rotation + pi, pi / 6, 5 * pi / 6, 30, 0.08)), 1e-3);
    }
}

// Force is linear in the feed: between samples of the feed alone nothing is lost.
TEST(ForceGrid, is_exact_between_feeds_and_clamped_outside) {
    ForceGridOptions o;
    o.rotations = 13;
    o.entries = o.exits = 7;
    const ForceGrid grid(flat(), find_material("al7075-t6")->coefficients, o);
    EXPECT_LT(distance(grid.force_n(0, 0, pi, 30, 0.1234), closed_form(0, 0, pi, 30, 0.1234)), 1e-2);
    EXPECT_EQ(grid.force_n(0, 0, pi, 30, 5), grid.force_n(0, 0, pi, 30, 0.2));
    EXPECT_EQ(grid.force_n(0, pi / 2, pi / 6, 30, 0.1), Vec3{});
}

}  // namespace
}  // namespace tribo::milling
