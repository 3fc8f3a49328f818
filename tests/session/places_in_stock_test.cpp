// SPDX-License-Identifier: MIT
// Paths that begin inside the stock: what the tool stands in is gone without a force, and the force of the
// rest balances what it removes.
#include "session/cut/places_in_stock.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <rapidcheck/gtest.h>

#include "session/cut/mill_session.hpp"
#include "session/cut/mill_warnings.hpp"

namespace tribo::session {
namespace {

motion::Move feed(Vec3 from, Vec3 to, int tool = 0) {
    motion::Move move;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    move.feed_mm_per_min = 600;
    move.tool = tool;
    return move;
}

// A block of 60 x 40 x 20 mm with its top at z = 0.
job::LoadedJob loaded(std::vector<motion::Move> moves, std::vector<double> diameters) {
    job::LoadedJob loaded;
    loaded.job.file = "a.toml";
    loaded.job.cutters.resize(diameters.size());
    for (std::size_t n = 0; n < diameters.size(); ++n) {
        milling::Cutter& cutter = loaded.job.cutters[n];
        cutter.number = diameters.size() > 1 ? static_cast<int>(n + 1) : 0;
        cutter.diameter_mm = diameters[n];
        cutter.length_mm = 30;
    }
    loaded.job.material.name = "al7075-t6";
    loaded.job.process.spindle_rpm = 6000;
    loaded.blank = job::box_solid({{-20, -20, -20}, {40, 20, 0}});
    loaded.program.source = "a.nc";
    for (std::size_t n = 0; n < moves.size(); ++n) moves[n].line = static_cast<int>(n + 1);
    loaded.program.moves = std::move(moves);
    return loaded;
}

struct Milled {
    MillTotals totals;
    Warnings warnings;
    std::size_t moves = 0;
};

Milled milled(const job::LoadedJob& job, double cell_mm) {
    Milled out;
    MillOptions options;
    options.cell_mm = cell_mm;
    auto setup = prepare_mill(job, options, out.warnings);
    EXPECT_TRUE(setup) << setup.error().text();
    out.moves = setup->moves.size();
    MillSession session(*std::move(setup), serial_for);
    session.run({});
    out.totals = session.totals();
    out.warnings = warnings_of(out.totals, "a.toml", "a.nc");
    return out;
}

TEST(PlacesInStock, what_the_tool_stands_in_first_is_gone_without_a_force) {
    const Milled m = milled(loaded({feed({0, 0, -4}, {15, 0, -8})}, {10}), 0.25);
    EXPECT_NEAR(m.totals.stood_in_mm3, std::numbers::pi * 25 * 4, 0.01 * 314);
    EXPECT_EQ(m.totals.stood_in_line, 1);
    EXPECT_NEAR(m.totals.stood_in_mm3 + m.totals.fed_mm3, m.totals.removed_mm3, 1e-6);
    EXPECT_NEAR(*m.totals.energy_balance, 1, 0.01);
    EXPECT_TRUE(m.totals.collisions.empty());
    ASSERT_FALSE(m.warnings.empty());
    EXPECT_NE(m.warnings[0].message().find("a.nc:1: warning: the path begins inside the stock: the 31"),
              std::string::npos)
        << m.warnings[0].message();
}

TEST(PlacesInStock, a_wider_tool_that_goes_on_in_a_slot_stands_in_its_rim) {
    const Milled m =
        milled(loaded({feed({-30, 0, -2}, {0, 0, -2}, 1), feed({0, 0, -2}, {10, 0, -2}, 2)}, {6, 12}), 0.25);
    // The disc of 12 mm, less what the slot of 6 mm that ends in its centre has taken of it.
    const double half = std::asin(0.5), strip = 2 * (36 * half / 2 + 3 * 6 * std::cos(half) / 2);
    const double gone = strip + std::numbers::pi * 9 / 2;
    EXPECT_NEAR(m.totals.stood_in_mm3, 2 * (std::numbers::pi * 36 - gone), 4);
    EXPECT_EQ(m.totals.stood_in_line, 2);
    EXPECT_EQ(m.moves, 3U);
}

TEST(PlacesInStock, a_path_that_begins_in_air_is_as_it_was) {
    const Milled m =
        milled(loaded({feed({-30, 0, -2}, {0, 0, -2}), feed({0, 0, -2}, {10, 0, -4})}, {6}), 0.25);
    EXPECT_EQ(m.moves, 2U);
    EXPECT_EQ(m.totals.stood_in_mm3, 0);
}

RC_GTEST_PROP(PlacesInStock, the_work_of_any_first_move_is_that_of_its_chips, ()) {
    const auto in = [](int low, int high) { return *rc::gen::inRange(10 * low, 10 * high) / 10.0; };
    const Vec3 from{in(-15, 15), in(-15, 15), in(-10, -1)};
    const Vec3 to{from.x + in(8, 16), from.y + in(-5, 5), in(-10, -1)};
    const Milled m = milled(loaded({feed(from, to)}, {in(4, 12)}), 0.2);
    RC_ASSERT(m.totals.stood_in_mm3 > 0);
    RC_ASSERT(m.totals.energy_balance && std::abs(*m.totals.energy_balance - 1) < 0.01);
}

}  // namespace
}  // namespace tribo::session
