// SPDX-License-Identifier: MIT
// The rows that a shown cut gives to a comparison against those of a run of the same cut.
#include "session/live/live_compare.hpp"

#include <gtest/gtest.h>

#include "session/audit/audited_cut.hpp"

namespace tribo::session {
namespace {

MillSetup one_slot() {
    MillSetup setup = slot_setup();
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    motion::Move cut = straight_cut({-10, 0, -kSlotDepth}, {40, 0, -kSlotDepth}, 600);
    cut.line = 7;
    add_cut(setup, cut, kSlotRpm);
    return setup;
}

std::unique_ptr<LiveMill> live_slot(const CutChange& change = {}) {
    const auto input = []() -> Result<LiveInput> {
        LiveInput live(one_slot());
        live.extras.limits = cut_limits({}, live.setup);
        return live;
    };
    auto live = LiveMill::create(input, serial_for);
    (*live)->set_change(change);
    (*live)->set_clock(1e9);
    for (int n = 0; n < 100; ++n) (*live)->tick(0, [] { return true; }, [](auto) {});
    return std::move(*live);
}

TEST(LiveCompare, has_the_rows_of_a_run) {
    std::vector<ComparedRow> of_run;
    MillSession session(one_slot(), serial_for);
    const LoadModel loads(session.setup(), cut_limits({}, session.setup()));
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) {
        const RowLoads load = loads.loads(row, force.peaks, force.chip_mm);
        of_run.push_back(compared_row(row, force, {}, *std::ranges::max_element(load.ratio)));
    };
    ASSERT_TRUE(session.run(sinks));
    const std::vector<ComparedRow> shown = compared_rows(*live_slot(), serial_for);
    ASSERT_EQ(shown.size(), of_run.size());
    ASSERT_GT(shown.size(), 10u);
    for (std::size_t n = 0; n < shown.size(); ++n) {
        EXPECT_EQ(shown[n].start_s, of_run[n].start_s);
        EXPECT_EQ(shown[n].peak_xy_n, of_run[n].peak_xy_n);
        EXPECT_EQ(shown[n].load_ratio, of_run[n].load_ratio);
        EXPECT_EQ(shown[n].chip_mm, of_run[n].chip_mm);
        EXPECT_EQ(shown[n].removed_mm3, of_run[n].removed_mm3);
        EXPECT_EQ(shown[n].line, 7);
    }
    const auto joined = join(shown, of_run);
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->by, JoinBy::line);
    EXPECT_EQ(difference(joined->pairs.front(), Quantity::chip), 0);
}

// Twice the feed at the same speed: chips twice as thick.
TEST(LiveCompare, has_the_changes_of_the_viewer) {
    CutChange faster;
    faster.feed_factor = 2;
    const auto plain = compared_rows(*live_slot(), serial_for),
               fast = compared_rows(*live_slot(faster), serial_for);
    ASSERT_EQ(plain.size(), fast.size());
    for (std::size_t n = 0; n < plain.size(); ++n) {
        EXPECT_NEAR(fast[n].feed_mm_per_min, 2 * plain[n].feed_mm_per_min, 1e-9);
        EXPECT_NEAR(*fast[n].chip_mm, 2 * *plain[n].chip_mm, 1e-9 + 1e-6 * *plain[n].chip_mm);
        EXPECT_GT(fast[n].peak_xy_n, plain[n].peak_xy_n);
    }
}

}  // namespace
}  // namespace tribo::session
