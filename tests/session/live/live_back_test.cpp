// SPDX-License-Identifier: MIT
// The clock of a live mill is set back while the files stay the same: against a mill that never went farther.
#include <algorithm>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "session/live/live_viewer.hpp"
#include "session/random_cut.hpp"

namespace tribo::session {
namespace {

using namespace test;

constexpr double kPicture = 1.0 / 60;

bool same_files() {
    return false;
}

TEST(LiveBack, shows_the_part_of_the_time_and_forgets_nothing) {
    auto live = *LiveMill::create(slot, serial_for, same_files);
    Viewer viewer;
    live->set_clock(live->duration_s());
    settle(*live, viewer);
    const std::vector<double> times = viewer.row_times, forces = viewer.row_forces;
    const double whole_mm3 = live->session().stock().removed_mm3();
    const CounterNoise noise(3);
    for (std::uint64_t n = 0; n < 12; ++n) {
        // Back, and forward again without reaching the end.
        const double t_s = noise.uniform(n) * live->duration_s();
        live->set_clock(t_s);
        settle(*live, viewer);
        auto fresh = *LiveMill::create(slot, serial_for);
        Viewer other;
        fresh->set_clock(t_s);
        settle(*fresh, other);
        EXPECT_DOUBLE_EQ(live->session().stock().removed_mm3(), fresh->session().stock().removed_mm3());
        EXPECT_DOUBLE_EQ(viewer.part_volume_mm3(), other.part_volume_mm3());
        EXPECT_EQ(viewer.state.t_s, other.state.t_s);
        EXPECT_EQ(viewer.state.tip_mm, other.state.tip_mm);
        EXPECT_EQ(viewer.state.removed_mm3, other.state.removed_mm3);
        EXPECT_EQ(viewer.state.peak_force_n, other.state.peak_force_n);
        // What is known ahead stays known.
        EXPECT_FLOAT_EQ(static_cast<float>(viewer.state.milled_s), static_cast<float>(live->duration_s()));
    }
    live->set_clock(live->duration_s());
    settle(*live, viewer);
    EXPECT_EQ(viewer.jobs, 1);
    EXPECT_EQ(live->sessions(), 1);
    EXPECT_EQ(viewer.row_times, times);
    EXPECT_EQ(viewer.row_forces, forces);
    EXPECT_DOUBLE_EQ(live->session().stock().removed_mm3(), whole_mm3);
}

// In the middle of the program: what follows is as if nobody had gone back.
TEST(LiveBack, mills_on_from_where_it_was) {
    MillSession alone(*slot(), serial_for);
    std::vector<double> times;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) { times.push_back(row.start_s); };
    alone.run(sinks);
    auto live = *LiveMill::create(slot, serial_for, same_files);
    Viewer viewer;
    live->set_clock(0.6 * live->duration_s());
    settle(*live, viewer);
    live->set_clock(0.2 * live->duration_s());
    live->play(true);
    while (live->playing()) live->tick(kPicture, always, viewer.sink());
    EXPECT_EQ(viewer.row_times, times);
    EXPECT_DOUBLE_EQ(live->session().totals().removed_mm3, alone.totals().removed_mm3);
    EXPECT_EQ(live->session().totals().rows, alone.totals().rows);
    EXPECT_NEAR(live->session().totals().work_j / alone.totals().work_j, 1, 1e-9);
}

// Played once, then again from a third of it: both times each piece sounds once, in order.
TEST(LiveBack, sounds_again_from_there) {
    auto live = *LiveMill::create(slot, serial_for, same_files);
    Viewer viewer;
    live->play(true);
    while (live->playing()) live->tick(kPicture, always, viewer.sink());
    const std::vector<double> first = viewer.sound_times;
    EXPECT_EQ(first, viewer.row_times);
    viewer.sound_times.clear();
    const double from_s = live->duration_s() / 3;
    live->set_clock(from_s);
    live->play(true);
    while (live->playing()) live->tick(kPicture, always, viewer.sink());
    const auto begin = std::ranges::lower_bound(first, from_s);
    std::vector<double> expected(begin, first.end());
    // The row that is cut at that time begins before it.
    if (viewer.sound_times.size() > expected.size()) expected.insert(expected.begin(), *(begin - 1));
    EXPECT_EQ(viewer.sound_times, expected);
}

// A change while the clock is back: all rows follow, those ahead too.
TEST(LiveBack, takes_a_change_there) {
    auto live = *LiveMill::create(slot, serial_for, same_files);
    Viewer viewer;
    live->set_clock(live->duration_s());
    settle(*live, viewer);
    const std::vector<double> written = viewer.row_forces;
    live->set_clock(0.3 * live->duration_s());
    settle(*live, viewer);
    CutChange change;
    change.feed_factor = 2;
    live->set_change(change);
    for (int n = 0; n < 100; ++n) live->tick(kPicture, always, viewer.sink());
    auto other = *LiveMill::create(slot, serial_for);
    Viewer from_begin;
    other->set_change(change);
    other->set_clock(other->duration_s());
    settle(*other, from_begin);
    ASSERT_EQ(viewer.row_forces.size(), written.size());
    for (std::size_t n = 0; n < written.size(); ++n)
        ASSERT_NEAR(viewer.row_forces[n], from_begin.row_forces[n], 1e-5 * written[n] + 1e-4) << n;
}

// Of a part with many chunks only those are sent again that were cut since.
TEST(LiveBack, sends_only_what_changed) {
    auto live = *LiveMill::create(slot, serial_for, same_files);
    std::size_t chunks = 0;
    const protocol::FrameSink count = [&](std::span<const std::uint8_t> frame) {
        chunks += protocol::frame_kind(frame) == protocol::LiveFrame::chunk ? 1 : 0;
    };
    live->set_clock(live->duration_s());
    for (int n = 0; n < 50; ++n) live->tick(0, always, count);
    const std::size_t all = std::exchange(chunks, 0);
    live->set_clock(0.95 * live->duration_s());
    for (int n = 0; n < 50; ++n) live->tick(0, always, count);
    EXPECT_GT(chunks, 0u);
    EXPECT_LT(2 * chunks, all);
}

TEST(LiveBack, reads_files_that_changed) {
    bool changed = false;
    int reads = 0;
    const auto input = [&]() -> Result<LiveInput> {
        ++reads;
        return LiveInput(*slot());
    };
    auto live = *LiveMill::create(input, serial_for, [&] { return std::exchange(changed, false); });
    Viewer viewer;
    live->set_clock(2);
    settle(*live, viewer);
    live->set_clock(1);
    settle(*live, viewer);
    EXPECT_EQ(reads, 1);
    EXPECT_EQ(viewer.jobs, 1);
    changed = true;
    live->set_clock(0.5);
    settle(*live, viewer);
    EXPECT_EQ(reads, 2);
    EXPECT_EQ(viewer.jobs, 2);
    EXPECT_EQ(live->sessions(), 2);
}

double end_of_move_at(const MillSession& session, double t_s) {
    return session.schedule().moves[session.schedule().move_at(t_s)].end_s;
}

// Whatever cutter, motion and stock, and however few states are kept: a stock that was set back is that of a
// session that milled only so far.
TEST(MillSession, carves_again_what_it_milled) {
    const CounterNoise noise(8);
    std::size_t compared = 0, states = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        RandomCut cut = random_cut(seed), same = random_cut(seed);
        SCOPED_TRACE(cut.words);
        MillSession back(std::move(cut.setup), serial_for), once(std::move(same.setup), serial_for);
        // None, some and many states.
        back.keep_states(seed % 3 * 500'000, 60);
        back.run({});
        const double removed_mm3 = back.stock().removed_mm3();
        const std::size_t rows = back.totals().rows;
        states += back.kept_states()->count();
        // Farther and farther for the session that never goes back; back and forth for the other one.
        for (std::uint64_t step = 1; step <= 3; ++step) {
            const double to_s =
                (static_cast<double>(step) - noise.uniform(4 * seed + step)) / 3 * back.duration_s();
            back.set_back(to_s);
            EXPECT_LE(back.milled_s(), end_of_move_at(back, to_s));
            EXPECT_EQ(back.known_s(), back.duration_s());
            ASSERT_TRUE(back.run_to(to_s, {}));
            const double milled_s = back.milled_s();
            while (once.milled_s() < milled_s) ASSERT_TRUE(once.run_to(milled_s, {}));
            // A session takes moves that share rows together.
            if (once.milled_s() == milled_s) {
                EXPECT_NEAR(back.stock().removed_mm3(), once.stock().removed_mm3(),
                            1e-9 * removed_mm3 + 1e-9);
                ++compared;
            }
            ASSERT_TRUE(back.run_to(noise.uniform(4 * seed) * back.duration_s(), {}));
        }
        ASSERT_TRUE(back.run({}));
        EXPECT_NEAR(back.stock().removed_mm3(), removed_mm3, 1e-9 * removed_mm3);
        EXPECT_EQ(back.totals().rows, rows);
    }
    EXPECT_GT(compared, 50u);
    EXPECT_GT(states, 50u);
}

}  // namespace
}  // namespace tribo::session
