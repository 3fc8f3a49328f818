// SPDX-License-Identifier: MIT
// Short moves that share a row: the same forces as of long ones, however the program is run.
#include "milling/engagement/joined_moves.hpp"

#include <gtest/gtest.h>

#include "motion/path/path.hpp"
#include "session/block_setup.hpp"
#include "session/kept_rows.hpp"
#include "session/random_cut.hpp"

namespace tribo::session {
namespace {

constexpr double kFeed = 10;  // mm/s

motion::Move straight(Vec3 from, Vec3 to) {
    motion::Move move;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    move.feed_mm_per_min = 60 * kFeed;
    return move;
}

bool add(milling::JoinedMoves& joined, const motion::Move& move, const milling::Cutter& cutter,
         double rpm = 6000, double feed = kFeed) {
    return joined.add(move, cutter, rpm, motion::path_length_mm(move) / feed);
}

TEST(JoinedMoves, fill_rows_of_half_a_millimetre_and_begin_anew) {
    milling::Cutter cutter;
    cutter.diameter_mm = 6;
    milling::JoinedMoves joined;
    for (int n = 0; n < 20; ++n) {
        EXPECT_EQ(add(joined, straight({0.1 * n, 0, 0}, {0.1 * n + 0.1, 0, 0}), cutter), n % 5 != 0) << n;
    }
    // A row is half of this one's diameter at most.
    cutter.diameter_mm = 0.6;
    milling::JoinedMoves small;
    for (int n = 0; n < 9; ++n) {
        EXPECT_EQ(add(small, straight({0.1 * n, 0, 0}, {0.1 * n + 0.1, 0, 0}), cutter), n % 3 != 0) << n;
    }
    // Three moves of 0.53 mm take four rows, each of them alone would take two.
    cutter.diameter_mm = 6;
    milling::JoinedMoves uneven;
    for (int n = 0; n < 9; ++n) {
        EXPECT_EQ(add(uneven, straight({0.53 * n, 0, 0}, {0.53 * (n + 1), 0, 0}), cutter), n % 3 != 0) << n;
    }
}

TEST(JoinedMoves, end_where_anything_changes) {
    milling::Cutter cutter, other;
    cutter.diameter_mm = other.diameter_mm = 6;
    const motion::Move first = straight({0, 0, 0}, {0.1, 0, 0}), next = straight({0.1, 0, 0}, {0.2, 0, 0});
    const auto after_first = [&](const motion::Move& move, const milling::Cutter& with, double rpm = 6000,
                                 double feed = kFeed) {
        milling::JoinedMoves joined;
        EXPECT_FALSE(add(joined, first, cutter));
        return add(joined, move, with, rpm, feed);
    };
    EXPECT_TRUE(after_first(next, cutter));
    EXPECT_FALSE(after_first(next, other));
    EXPECT_FALSE(after_first(next, cutter, 7000));
    EXPECT_FALSE(after_first(next, cutter, 6000, 1.1 * kFeed));
    EXPECT_FALSE(after_first(straight({0.1, 0, 0}, {0.2, 0.01, 0}), cutter));
    EXPECT_FALSE(after_first(straight({0.1, 0, 0}, {0, 0, 0}), cutter));
    EXPECT_FALSE(after_first(straight({0.11, 0, 0}, {0.2, 0, 0}), cutter));
    motion::Move turning = next;
    turning.end.axis = normalized(Vec3{0.002, 0, 1});
    EXPECT_FALSE(after_first(turning, cutter));
    motion::Move rapid = next;
    rapid.kind = motion::MoveKind::rapid;
    EXPECT_FALSE(after_first(rapid, cutter));
    motion::Move nowhere = straight({0.1, 0, 0}, {0.1, 0, 0});
    EXPECT_FALSE(after_first(nowhere, cutter));
}

struct Milled {
    MillTotals totals;
    std::vector<KeptRow> rows;
};

Milled mill(MillSetup setup, double step_s) {
    MillSession session(std::move(setup), serial_for);
    Milled out;
    const MillSinks sinks = keep_rows(out.rows);
    for (double t = step_s; session.milled_s() < session.duration_s(); t += step_s) session.run_to(t, sinks);
    out.totals = session.totals();
    return out;
}

// Every feed move in pieces of a third of a row.
MillSetup chopped(const MillSetup& from, MillSetup setup) {
    setup.moves.clear();
    setup.cutter_of_move.clear();
    setup.rpm_of_move.clear();
    for (std::size_t n = 0; n < from.moves.size(); ++n) {
        const milling::Cutter& cutter = from.cutters[from.cutter_of_move[n]];
        const motion::Move& move = from.moves[n];
        const double way = milling::row_way_mm(move, cutter), path = motion::path_length_mm(move);
        const double longest = way > 0 && path > 0 ? milling::longest_row_mm(cutter) / 3 * path / way : 1;
        for (const motion::Move& piece : motion::in_pieces(move, longest)) {
            setup.moves.push_back(piece);
            setup.cutter_of_move.push_back(from.cutter_of_move[n]);
            setup.rpm_of_move.push_back(from.rpm_of_move[n]);
        }
    }
    return setup;
}

TEST(JoinedMoves, cost_what_the_whole_move_costs) {
    std::size_t compared = 0, whole_rows = 0, short_rows = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const RandomCut cut = random_cut(seed);
        const Milled whole = mill(random_cut(seed).setup, 1e9);
        const Milled short_moves = mill(chopped(cut.setup, random_cut(seed).setup), 1e9);
        if (whole.rows.size() < 30) continue;
        ++compared;
        const MillTotals &a = whole.totals, &b = short_moves.totals;
        EXPECT_NEAR(b.fed_mm3, a.fed_mm3, 3e-3 * a.fed_mm3) << seed << ": " << cut.words;
        EXPECT_NEAR(b.shear_work_j, a.shear_work_j, 0.01 * a.shear_work_j) << seed << ": " << cut.words;
        EXPECT_NEAR(b.mean_force_n, a.mean_force_n, 0.04 * a.mean_force_n) << seed << ": " << cut.words;
        whole_rows += whole.rows.size();
        short_rows += short_moves.rows.size();
    }
    EXPECT_GT(compared, 20u);
    // Not a row per piece, of which there are three times as many.
    EXPECT_LT(static_cast<double>(short_rows), 1.6 * static_cast<double>(whole_rows));
}

// The clock may stop anywhere within a row.
TEST(JoinedMoves, are_the_same_rows_however_often_the_run_stops) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const RandomCut cut = random_cut(seed);
        const Milled once = mill(chopped(cut.setup, random_cut(seed).setup), 1e9);
        const Milled often = mill(chopped(cut.setup, random_cut(seed).setup), once.totals.duration_s / 97);
        ASSERT_EQ(often.rows.size(), once.rows.size()) << seed << ": " << cut.words;
        // A sweep that turns is known to its own tolerance before it is carved: a circle more may be looked
        // at.
        const double share = turns(cut.motion) ? 5e-3 : 1e-3;
        for (std::size_t n = 0; n < once.rows.size(); ++n) {
            const KeptRow &a = once.rows[n], &b = often.rows[n];
            const Vec3 was = a.force.peaks.mean_n;
            EXPECT_EQ(a.row.line, b.row.line);
            EXPECT_NEAR(a.row.start_s, b.row.start_s, 1e-9);
            EXPECT_NEAR(length(was - b.force.peaks.mean_n), 0, share * (1 + length(was)))
                << seed << " " << n << ": " << cut.words;
        }
    }
}

// Also where the time ends within a move, so that what is left of it is short.
TEST(JoinedMoves, are_carved_again_and_name_the_move_that_made_a_place) {
    milling::Cutter ball;
    ball.kind = milling::CutterKind::ball;
    ball.diameter_mm = 2;
    ball.length_mm = 6;
    for (const double piece_mm : {0.05, 0.3}) {
        for (const double until_s : {0.3003, 0.317, 0.9}) {
            MillSetup setup = block_setup({{0, -3, -4}, {12, 3, 0}}, ball, 0.1);
            add_cut_in_pieces(setup, straight_cut({1, 0, -0.5}, {10, 0, -0.7}, 60 * kFeed), piece_mm);
            setup.until_s = until_s;
            const std::vector<motion::Move> moves = setup.moves;
            MillSession session(std::move(setup), serial_for);
            session.keep_states();
            session.run({});
            const double removed = session.totals().removed_mm3;
            EXPECT_GT(removed, 0);
            for (std::size_t n = 0; n < moves.size(); ++n) {
                const Vec3 middle = 0.5 * (moves[n].start.tip_mm + moves[n].end.tip_mm);
                if (middle.x > 1 + kFeed * until_s) break;
                EXPECT_EQ(session.move_at(middle), n) << piece_mm << " " << until_s;
            }
            session.set_back(0);
            session.run({});
            EXPECT_EQ(session.totals().removed_mm3, removed);
        }
    }
}

}  // namespace
}  // namespace tribo::session
