// SPDX-License-Identifier: MIT
// Joining the rows of two runs: by line, by removed volume, by time.
#include "session/compare/compared_rows.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>

namespace tribo::session {
namespace {

ComparedRow row(double start_s, double duration_s, int line, double peak_n, double removed_mm3) {
    ComparedRow r;
    r.start_s = start_s;
    r.duration_s = duration_s;
    r.line = line;
    r.tip_mm = {10 * start_s, 0, 0};
    r.spindle_rpm = 6000;
    r.feed_mm_per_min = 600;
    r.mean_n = 0.5 * peak_n;
    r.peak_xy_n = peak_n;
    r.peak_torque_nm = -0.01 * peak_n;
    r.removed_mm3 = removed_mm3;
    return r;
}

// A cut of `lines` lines; every row with its own values.
std::vector<ComparedRow> random_rows(std::mt19937& random, int lines) {
    std::uniform_real_distribution<double> some(0.1, 1);
    std::vector<ComparedRow> rows;
    double t = 0;
    for (int line = 1; line <= lines; ++line) {
        if (some(random) < 0.2) t += some(random);  // in the air
        const int count = 1 + static_cast<int>(5 * some(random));
        for (int n = 0; n < count; ++n) {
            const double seconds = some(random);
            rows.push_back(row(t, seconds, line, 100 * some(random), some(random)));
            t += seconds;
        }
    }
    return rows;
}

double sum_of(const JoinedCuts& joined, Quantity q, bool of_a) {
    double sum = 0;
    for (const CutPair& pair : joined.pairs)
        if (const auto& stretch = of_a ? pair.a : pair.b) sum += stretch->of(q);
    return sum;
}

double largest_of(const JoinedCuts& joined, Quantity q, bool of_a) {
    double most = 0;
    for (const CutPair& pair : joined.pairs)
        if (const auto& stretch = of_a ? pair.a : pair.b) most = std::max(most, stretch->of(q));
    return most;
}

TEST(ComparedRows, join_by_line_where_both_cut_in_the_same_lines) {
    const std::vector<ComparedRow> a{row(0, 1, 3, 50, 5), row(1, 3, 3, 70, 5), row(9, 1, 5, 20, 4)};
    const std::vector<ComparedRow> b{row(0, 2, 3, 90, 10), row(8, 0.5, 5, 40, 4)};
    const auto joined = join(a, b);
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->by, JoinBy::line);
    ASSERT_EQ(joined->pairs.size(), 2u);
    const CutPair& first = joined->pairs[0];
    EXPECT_EQ(first.place, 3);
    EXPECT_EQ(difference(first, Quantity::peak_force), 20);
    // Over the time: (1 x 25 + 3 x 35) / 4 and 45.
    EXPECT_DOUBLE_EQ(difference(first, Quantity::mean_force), 45 - 32.5);
    EXPECT_DOUBLE_EQ(difference(first, Quantity::torque), 0.9 - 0.7);
    EXPECT_EQ(difference(first, Quantity::cutting_time), 2 - 4);
    EXPECT_EQ(difference(first, Quantity::removed), 0);
    EXPECT_TRUE(std::isnan(difference(first, Quantity::multiplier)));
    EXPECT_EQ(first.a->tip_mm.x, 10);  // of the row with the larger force
}

TEST(ComparedRows, join_by_volume_where_the_lines_differ_and_by_time_where_that_differs_too) {
    const std::vector<ComparedRow> a{row(0, 4, 1, 50, 8)};
    const std::vector<ComparedRow> same{row(0, 1, 1, 50, 4), row(1, 3, 2, 80, 4)};
    const std::vector<ComparedRow> more{row(0, 1, 1, 50, 4), row(1, 3, 2, 80, 40)};
    EXPECT_EQ(join(a, same)->by, JoinBy::removed);
    EXPECT_EQ(join(a, more)->by, JoinBy::time);
    // In the second half of the volume B cuts with 80 N.
    const auto joined = join(a, same);
    for (const CutPair& pair : joined->pairs) {
        ASSERT_TRUE(pair.a && pair.b);
        if (std::abs(pair.place - 4) < 0.1) continue;  // a step of both lines
        EXPECT_EQ(difference(pair, Quantity::peak_force), pair.place < 4 ? 0 : 30) << pair.place;
    }
}

TEST(ComparedRows, refuse_a_join_by_line_of_other_lines) {
    const std::vector<ComparedRow> a{row(0, 1, 1, 1, 1)}, b{row(0, 1, 2, 1, 1)};
    EXPECT_FALSE(join(a, b, JoinBy::line));
    EXPECT_TRUE(join(a, b, JoinBy::time));
}

TEST(ComparedRows, of_nothing_are_no_pairs) {
    EXPECT_TRUE(join({}, {})->pairs.empty());
    const std::vector<ComparedRow> b{row(0, 1, 1, 1, 1)};
    const auto joined = join({}, b);
    EXPECT_EQ(joined->by, JoinBy::time);
    EXPECT_EQ(joined->pairs.size(), kJoinSteps);
    EXPECT_FALSE(joined->pairs.front().a);
}

TEST(ComparedRows, keep_sums_and_peaks_of_random_runs_in_every_join) {
    std::mt19937 random(7);
    for (int n = 0; n < 200; ++n) {
        const std::vector<ComparedRow> a = random_rows(random, 1 + n % 40),
                                       b = random_rows(random, 1 + n % 40);
        for (const JoinBy by : {JoinBy::line, JoinBy::removed, JoinBy::time}) {
            const auto joined = join(a, b, by);
            ASSERT_TRUE(joined);
            for (const bool of_a : {true, false}) {
                double seconds = 0, removed = 0, peak = 0;
                for (const ComparedRow& r : of_a ? a : b) {
                    seconds += r.duration_s;
                    removed += r.removed_mm3;
                    peak = std::max(peak, r.peak_xy_n);
                }
                EXPECT_NEAR(sum_of(*joined, Quantity::cutting_time, of_a), seconds, 1e-9 * seconds);
                EXPECT_NEAR(sum_of(*joined, Quantity::removed, of_a), removed, 1e-9 * removed);
                EXPECT_EQ(largest_of(*joined, Quantity::peak_force, of_a), peak);
            }
        }
    }
}

TEST(ComparedRows, of_a_run_with_itself_differ_nowhere) {
    std::mt19937 random(8);
    for (int n = 0; n < 50; ++n) {
        const std::vector<ComparedRow> a = random_rows(random, 1 + n);
        for (const JoinBy by : {JoinBy::line, JoinBy::removed, JoinBy::time}) {
            const auto joined = join(a, a, by);
            for (const CutPair& pair : joined->pairs) {
                ASSERT_TRUE(pair.a && pair.b);
                for (std::size_t q = 0; q < kQuantities; ++q) {
                    const double d = difference(pair, static_cast<Quantity>(q));
                    EXPECT_TRUE(d == 0 || std::isnan(pair.a->value[q])) << kQuantityWords[q].name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace tribo::session
