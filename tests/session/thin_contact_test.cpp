// SPDX-License-Identifier: MIT
// Contacts that are narrow beside the cutter: a rib, and a skim of a wall. A straight tooth is in both with
// its whole height at once, so that the torque has a closed form.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "session/block_setup.hpp"
#include "session/cut/mill_session.hpp"
#include "session/cut/mill_warnings.hpp"

namespace tribo::session {
namespace {

constexpr double kLong = 12;  // of the stock, mm

double number(double lo, double hi) {
    return lo + (hi - lo) * 1e-6 * *rc::gen::inRange(0, 1000001);
}

milling::Cutter any_straight_cutter() {
    return {.diameter_mm = number(3, 25), .flutes = 2, .helix_deg = 0, .length_mm = 30};
}

// Along the stock, from air to air.
motion::Move pass(const milling::Cutter& cutter, double y, double z, double feed_mm_per_min) {
    const double air = cutter.diameter_mm + 1;
    return straight_cut({-air, y, z}, {kLong + air, y, z}, feed_mm_per_min);
}

struct OfLine {
    double chip_mm3 = 0, peak_torque_nmm = 0;
};
OfLine rows_of_line(MillSetup setup, int line) {
    MillSession session(std::move(setup), serial_for);
    OfLine sum;
    session.run({[&](const milling::CutRow& row, const milling::RowForce& force) {
                     if (row.line != line) return;
                     sum.chip_mm3 += row.chip_mm3;
                     sum.peak_torque_nmm = std::max(sum.peak_torque_nmm, force.peaks.peak_torque_nmm);
                 },
                 {}});
    return sum;
}

// Of both teeth one cuts, over the depth: at most where the chip is thickest. `sine`: of the angle to the
// wall there.
double torque_nmm(const MillSetup& setup, double feed_per_tooth_mm, double sine, double depth_mm) {
    const milling::CuttingCoefficients& k = setup.coefficients;
    return (k.ktc * feed_per_tooth_mm * sine + k.kte) * depth_mm * setup.cutters[0].radius_mm();
}

// A plate, or what two slots leave between them, from one cell on.
RC_GTEST_PROP(ThinContact, of_a_rib_is_in_the_rows, ()) {
    const milling::Cutter cutter = any_straight_cutter();
    const double r = cutter.radius_mm(), cell = number(0.08, 0.3), thick = cell * number(1.1, 4);
    const double depth = number(1, 4), aside = number(-0.7, 0.7) * r, feed_per_tooth = number(0.02, 0.1);
    const bool is_plate = *rc::gen::inRange(0, 2) == 0;
    const double wide = is_plate ? 0.5 * thick : 0.5 * thick + 2 * r + 3;
    MillSetup setup =
        block_setup({{0, -wide, is_plate ? -depth : -depth - 2}, {kLong, wide, 0}}, cutter, cell);
    const double feed = 6000 * 2 * feed_per_tooth;
    if (!is_plate) {
        for (const double side : {-1.0, 1.0})
            add_cut(setup, pass(cutter, side * (0.5 * thick + r), -depth, feed));
    }
    add_cut(setup, pass(cutter, aside, -depth, feed));
    setup.moves.back().line = 7;
    const double nearest = std::max(std::abs(aside) - 0.5 * thick, 0.0) / r;
    const double expected = torque_nmm(setup, feed_per_tooth, std::sqrt(1 - nearest * nearest), depth);
    const OfLine seen = rows_of_line(std::move(setup), 7);
    RC_ASSERT(std::abs(seen.chip_mm3 / (kLong * thick * depth) - 1) < 0.02);
    RC_ASSERT(std::abs(seen.peak_torque_nmm / expected - 1) < 0.08);
}

// The last pass of a side, which takes a hundredth of the radius or much less.
RC_GTEST_PROP(ThinContact, of_a_skim_is_in_the_rows, ()) {
    const milling::Cutter cutter = any_straight_cutter();
    const double r = cutter.radius_mm(), cell = number(0.08, 0.3), depth = number(1, 4);
    const double allowance = r * std::exp(number(std::log(3e-4), std::log(0.01)));
    const double feed_per_tooth = number(0.02, 0.1), feed = 6000 * 2 * feed_per_tooth;
    MillSetup setup = block_setup({{0, 0, -depth - 2}, {kLong, 6, 0}}, cutter, cell);
    const double y = 2 - r;
    add_cut(setup, pass(cutter, y - allowance, -depth, feed));
    add_cut(setup, pass(cutter, y, -depth, feed));
    setup.moves.back().line = 7;
    const double cosine = 1 - allowance / r;
    const double expected = torque_nmm(setup, feed_per_tooth, std::sqrt(1 - cosine * cosine), depth);
    const OfLine seen = rows_of_line(std::move(setup), 7);
    // A skin of 2e-5 mm counts as rounding (milling/tool/material_arcs.hpp).
    const double skin = 2e-5 / allowance;
    RC_ASSERT(std::abs(seen.chip_mm3 / (kLong * allowance * depth) - 1) < 0.02 + skin);
    RC_ASSERT(std::abs(seen.peak_torque_nmm / expected - 1) < 0.02 + skin);
}

// Thinner than a cell: what the rows miss is told.
TEST(ThinContact, that_the_rows_miss_is_told) {
    const milling::Cutter cutter{.diameter_mm = 20, .flutes = 2, .helix_deg = 0, .length_mm = 30};
    MillSetup setup = block_setup({{0, -0.03, -4}, {kLong, 0.03, 0}}, cutter, 0.25);
    add_cut(setup, pass(cutter, 1, -4, 600));
    setup.moves.back().line = 7;
    MillSession session(std::move(setup), serial_for);
    session.run({});
    const MillTotals& totals = session.totals();
    EXPECT_EQ(totals.unseen_line, 7);
    const Warnings warnings = warnings_of(totals, "a.toml", "a.nc");
    EXPECT_TRUE(std::ranges::any_of(warnings, [](const Warning& w) {
        return w.line == 7 && w.text.find("narrower than a cell of the grid") != std::string::npos;
    }));
    EXPECT_GE(totals.chip_mm3 + totals.unseen_mm3, 0.8 * totals.fed_mm3);
}

}  // namespace
}  // namespace tribo::session
