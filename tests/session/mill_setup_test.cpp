// SPDX-License-Identifier: MIT
// What a setup refuses before it takes memory, and the grid that it chooses.
#include "session/cut/mill_setup.hpp"

#include <gtest/gtest.h>

#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

job::LoadedJob loaded(const std::vector<motion::Move>& moves) {
    job::LoadedJob loaded;
    loaded.job.file = "a.toml";
    loaded.job.cutters.resize(1);
    loaded.job.cutters[0].diameter_mm = 6;
    loaded.job.material.name = "al7075-t6";
    loaded.job.process.spindle_rpm = 6000;
    loaded.blank = job::box_solid({{0, 0, -10}, {40, 30, 0}});
    loaded.program.source = "a.nc";
    for (const motion::Move& move : moves) {
        loaded.program.moves.push_back(move);
        loaded.program.moves.back().feed_mm_per_min = 600;
        loaded.program.moves.back().line = static_cast<int>(loaded.program.moves.size());
    }
    return loaded;
}

std::string fault(const job::LoadedJob& job, const MillOptions& options) {
    Warnings warnings;
    const auto setup = prepare_mill(job, options, warnings);
    return setup ? "" : setup.error().text();
}

motion::Move to(Vec3 tip_mm, Vec3 axis = {0, 0, 1}) {
    motion::Move move;
    move.end = {tip_mm, axis};
    return move;
}

// A kilometre with a turning axis is cut into pieces of 10 mm, a view in time cuts it into pieces of 2 mm,
// and a helix a kilometre wide into millions.
TEST(MillSetup, refuses_moves_that_become_too_many_pieces_at_their_line) {
    const motion::Move near = to({10, 0, 0}), far = to({1e6, 0, 0}), tilting = to({1e6, 0, 0}, {0.6, 0, 0.8});
    motion::Move helix = to({1e6, 0, 10});
    helix.start.tip_mm = {1e6, 0, 0};
    helix.arc = motion::Arc{{0, 0, 0}, {0, 0, 1}, 6e4};
    MillOptions little;
    little.memory_bytes = 1000 * 3 * sizeof(motion::Move);
    const std::string message =
        "a.nc:2: error: up to here the moves are split into more than 1000 pieces; split the program, check "
        "its unit, or allow more memory";
    EXPECT_EQ(fault(loaded({near, far}), little), "");
    EXPECT_EQ(fault(loaded({near, tilting}), little), message);
    EXPECT_EQ(fault(loaded({near, helix}), little), message);
    MillOptions live = little;
    live.longest_piece_mm = LiveMill::kPieceMm;
    EXPECT_EQ(fault(loaded({near, far}), live), message);
    EXPECT_EQ(fault(loaded({near, near}), live), "");
    job::LoadedJob second = loaded({near});
    second.job.stock_from = job::JobStockFrom{"b.toml", 3, 8};
    const job::LoadedJob first = loaded({near, tilting});
    second.earlier.push_back({first.job, first.program, {}});
    EXPECT_EQ(fault(second, little), message);
}

// Half of a sheet's thickness, then all of it, along its length: the corners of the slot and the sheet's own
// faces share cells on a coarse grid.
TEST(MillSetup, chooses_a_grid_for_thin_sheets) {
    for (const double thickness : {0.1, 0.2, 0.5, 1.0}) {
        const double wide = 6, longest = 100 + 100 * thickness;
        job::LoadedJob job =
            loaded({to({-5, 20, 5}), to({-5, 20, -0.5 * thickness}), to({longest + 5, 20, -0.5 * thickness}),
                    to({longest + 5, 40, 5}), to({longest + 5, 40, -2}), to({-5, 40, -2})});
        for (std::size_t n = 1; n < job.program.moves.size(); ++n)
            job.program.moves[n].start = job.program.moves[n - 1].end;
        job.program.moves[0].start = job.program.moves[0].end;
        job.program.moves[0].kind = motion::MoveKind::rapid;
        job.blank = job::box_solid({{0, 0, -thickness}, {longest, 60, 0}});
        Warnings warnings;
        auto setup = prepare_mill(job, {}, warnings);
        ASSERT_TRUE(setup) << setup.error().text();
        MillSession session(*std::move(setup), serial_for);
        session.run({});
        const double exact = 1.5 * longest * wide * thickness;
        EXPECT_NEAR(session.totals().removed_mm3 / exact, 1, 0.006) << thickness;
        EXPECT_TRUE(warnings.empty()) << thickness << ": " << warnings.front().text;
    }
}

TEST(MillSetup, warns_of_a_grid_that_is_too_coarse_for_a_sheet) {
    job::LoadedJob job = loaded({to({10, 0, 0})});
    job.blank = job::box_solid({{0, 0, -0.2}, {100, 100, 0}});
    MillOptions coarse;
    coarse.cell_mm = 0.25;
    Warnings warnings;
    ASSERT_TRUE(prepare_mill(job, coarse, warnings));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].text.find("a stock that is 0.2 mm thick"), std::string::npos) << warnings[0].text;
    EXPECT_NE(warnings[0].text.find("--resolution 0.066"), std::string::npos) << warnings[0].text;
}

}  // namespace
}  // namespace tribo::session
