// SPDX-License-Identifier: MIT
// Changes of a live mill while it runs: feed, spindle, material and helix, and its files.
#include <gtest/gtest.h>

#include "session/live/live_viewer.hpp"
#include "session/uncertain/force_bands.hpp"

namespace tribo::session {
namespace {

using namespace test;

// Overrides change what was cut and what will be as if the program had been written so.
TEST(LiveChanges, TellsTheForcesOfAChangedCut) {
    const auto changed = []() -> Result<MillSetup> {
        auto s = slot();
        for (motion::Move& move : s->moves) move.feed_mm_per_min *= 1.5;
        for (double& rpm : s->rpm_of_move) rpm *= 0.5;
        for (milling::Cutter& cutter : s->cutters) cutter.helix_deg = 45;
        s->coefficients = milling::find_material("steel")->coefficients;
        return s;
    };
    MillSession alone(*changed(), serial_for);
    std::vector<double> forces;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow&, const milling::RowForce& force) {
        forces.push_back(length(force.peaks.mean_n));
    };
    alone.run(sinks);

    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    FrameCache memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(shared(frame));
        viewer.sink()(frame);
    };
    live->play(true);
    while (live->clock_s() < 0.5 * live->duration_s()) live->tick(1.0 / 60, always, both);
    CutChange change;
    change.feed_factor = 1.5;
    change.speed_factor = 0.5;
    change.helix_deg = 45;
    change.coefficients = milling::find_material("steel")->coefficients;
    live->set_change(change);
    const double before = live->clock_s();
    live->tick(0.1, always, both);
    EXPECT_NEAR(live->clock_s() - before, 0.15, 1e-12);
    while (live->playing()) live->tick(1.0 / 60, always, both);
    EXPECT_EQ(viewer.jobs, 1);
    ASSERT_EQ(viewer.row_forces.size(), forces.size());
    for (std::size_t n = 0; n < forces.size(); ++n)
        ASSERT_NEAR(viewer.row_forces[n], forces[n], 1e-5 * forces[n] + 1e-4) << n;
    Viewer latecomer;
    for (const FrameCache::Frame& frame : memory.replay()) latecomer.sink()(*frame);
    EXPECT_EQ(latecomer.row_forces, viewer.row_forces);
}

// The bands of the rows are those that `render --uncertain` gives.
TEST(LiveChanges, TellsTheBandsFromCases) {
    const auto uncertain = []() -> Result<MillSetup> {
        auto s = slot();
        s->force_low_factor = 0.75;
        s->force_high_factor = 1.5;
        s->cutters.front().runout_mm = 0.02;
        s->cutters.front().runout_spread = 1;
        return s;
    };
    constexpr std::size_t count = 30;
    MillSession alone(*uncertain(), serial_for);
    ForceBands bands(alone.setup(), count, serial_for);
    std::vector<std::array<double, 2>> expected;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        const sweep::Band band = bands.add(row, force.peaks);
        expected.push_back({band.low, band.high});
    };
    alone.run(sinks);

    auto live = *LiveMill::create(uncertain, serial_for);
    std::vector<protocol::LiveRow> rows;
    const protocol::FrameSink keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveRows some;
        if (!protocol::read_frame(frame, some)) return;
        if (some.anew) rows.clear();
        rows.insert(rows.end(), some.rows.begin(), some.rows.end());
    };
    // The first half is cut before the bands are asked for.
    live->play(true);
    while (live->clock_s() < 0.5 * live->duration_s()) live->tick(1.0 / 60, always, keep);
    for (const protocol::LiveRow& row : rows) ASSERT_EQ(row.force_high_factor, 0);
    CutChange change;
    change.uncertain_cases = count;
    live->set_change(change);
    while (live->playing()) live->tick(1.0 / 60, always, keep);
    for (int n = 0; n < 100; ++n) live->tick(1.0 / 60, always, keep);
    ASSERT_EQ(rows.size(), expected.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
        ASSERT_NEAR(rows[n].force_low_factor * rows[n].peak_force_n, expected[n][0], 1e-5 * expected[n][0])
            << n;
        ASSERT_NEAR(rows[n].force_high_factor * rows[n].peak_force_n, expected[n][1], 1e-5 * expected[n][1])
            << n;
    }
    // The same chip has the same band; of a thinner one the run-out is a larger share.
    const std::vector<protocol::LiveRow> written = rows;
    const auto width = [](const protocol::LiveRow& row) {
        return row.force_high_factor / row.force_low_factor;
    };
    const std::size_t middle = rows.size() / 2;
    for (const double feed : {2.0, 0.25}) {
        change.feed_factor = feed;
        change.speed_factor = feed == 2 ? 2 : 1;
        live->set_change(change);
        for (int n = 0; n < 200; ++n) live->tick(1.0 / 60, always, keep);
        if (feed == 2) {
            EXPECT_NEAR(width(rows[middle]) / width(written[middle]), 1, 1e-5);
        } else {
            EXPECT_GT(width(rows[middle]), 1.05 * width(written[middle]));
        }
    }
    change = {};
    live->set_change(change);
    for (int n = 0; n < 200; ++n) live->tick(1.0 / 60, always, keep);
    for (const protocol::LiveRow& row : rows) ASSERT_EQ(row.force_high_factor, 0);
}

// A slider that moves with every picture: each picture costs a slice of the rows, and all rows are sent four
// times a second.
TEST(LiveChanges, ComputesTheForcesOfAChangedCutInSlices) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    live->set_clock(live->duration_s());
    live->tick(0, always, viewer.sink());
    const std::vector<double> written = viewer.row_forces;
    ASSERT_GT(written.size(), 300u);
    int anew = 0;
    const protocol::FrameSink count = [&](std::span<const std::uint8_t> frame) {
        anew += protocol::frame_kind(frame) == protocol::LiveFrame::rows && protocol::header_flag(frame);
        viewer.sink()(frame);
    };
    const auto never = [] { return false; };
    constexpr double picture_s = 1.0 / 60;
    CutChange change;
    for (int n = 0; n < 120; ++n) {
        change.feed_factor = 1 + 0.01 * n;
        live->set_change(change);
        live->tick(picture_s, never, count);
    }
    EXPECT_GE(anew, 4);
    EXPECT_LE(anew, 8);
    for (int n = 0; n < 120; ++n) live->tick(picture_s, never, count);
    // As one change would have made them.
    auto alone = *LiveMill::create(slot, serial_for);
    alone->set_clock(alone->duration_s());
    alone->set_change(change);
    Viewer other;
    alone->tick(0, always, other.sink());
    EXPECT_EQ(viewer.row_forces, other.row_forces);
    EXPECT_NE(viewer.row_forces, written);
    EXPECT_EQ(viewer.row_times, other.row_times);
    const int before = anew;
    for (int n = 0; n < 60; ++n) live->tick(picture_s, always, count);
    EXPECT_EQ(anew, before);
}

TEST(LiveChanges, MillsTheOldSetupAgainWhileTheNewOneIsWrong) {
    bool good = true;
    double feed_factor = 1;
    const auto from_files = [&]() -> Result<MillSetup> {
        if (!good) return fail_at("p.nc", 3, 1, "no word 'H1'", "correct it");
        auto setup = slot();
        for (motion::Move& move : setup->moves) move.feed_mm_per_min *= feed_factor;
        return setup;
    };
    auto live = *LiveMill::create(from_files, serial_for);
    Viewer viewer;
    const auto mill_all = [&] {
        live->set_clock(0);
        live->tick(0, always, viewer.sink());
        live->set_clock(live->duration_s());
        settle(*live, viewer);
        return viewer.row_times;
    };
    const std::vector<double> times = mill_all();
    good = false;
    EXPECT_FALSE(live->input_error());
    for (int n = 0; n < 2; ++n) {
        EXPECT_EQ(mill_all(), times);
        ASSERT_TRUE(live->input_error());
        EXPECT_EQ(live->input_error()->line, 3);
        EXPECT_NEAR(viewer.part_volume_mm3() / live->session().totals().remaining_mm3, 1, 2e-3);
    }
    good = true;
    feed_factor = 2;
    mill_all();
    EXPECT_FALSE(live->input_error());
    EXPECT_NEAR(viewer.duration_s, 0.5 * 5 * 50.0 / 20, 1e-9);
}

TEST(LiveChanges, WaitsForFilesThatAreReadElsewhere) {
    int ticks_to_read = 0, calls = 0;
    const auto from_files = [&]() -> std::optional<Result<LiveInput>> {
        ++calls;
        if (ticks_to_read-- > 0) return std::nullopt;
        return slot();
    };
    auto live = *LiveMill::create(from_files, serial_for);
    Viewer viewer;
    live->set_clock(live->duration_s());
    settle(*live, viewer);
    const double volume_mm3 = viewer.part_volume_mm3();

    ticks_to_read = 3;
    live->set_clock(0.5);
    live->play(true);
    for (int n = 0; n < 3; ++n) {
        live->tick(0.1, always, viewer.sink());
        EXPECT_EQ(live->sessions(), 1);
        EXPECT_EQ(live->clock_s(), 0.5);
        EXPECT_EQ(viewer.part_volume_mm3(), volume_mm3);
    }
    live->tick(0.1, always, viewer.sink());
    EXPECT_EQ(live->sessions(), 2);
    EXPECT_NEAR(live->clock_s(), 0.6, 1e-9);
    EXPECT_GT(viewer.part_volume_mm3(), 1.01 * volume_mm3);

    // A later time is that of the new program.
    live->set_clock(live->duration_s());
    live->tick(0, always, viewer.sink());
    ticks_to_read = 2;
    calls = 0;
    live->set_clock(0.5);
    live->tick(0, always, viewer.sink());
    live->set_clock(2 * live->duration_s());
    for (int n = 0; n < 5; ++n) live->tick(0, always, viewer.sink());
    settle(*live, viewer);
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(live->sessions(), 3);
    EXPECT_EQ(live->clock_s(), live->duration_s());
    EXPECT_NEAR(viewer.part_volume_mm3() / volume_mm3, 1, 1e-9);
}

}  // namespace
}  // namespace tribo::session
