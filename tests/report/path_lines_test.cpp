// SPDX-License-Identifier: MIT
#include "report/picture/path_lines.hpp"

#include <gtest/gtest.h>

namespace tribo::report {
namespace {

motion::Move way(motion::MoveKind kind, Vec3 from, Vec3 to) {
    motion::Move move;
    move.kind = kind;
    move.start.tip_mm = from;
    move.end.tip_mm = to;
    return move;
}

TEST(PathLines, end_at_rapids_and_start_where_the_feed_starts) {
    using enum motion::MoveKind;
    const Vec3 a{0, 0, 5}, b{0, 0, -1}, c{9, 0, -1}, d{9, 0, 5}, e{0, 7, 5}, f{0, 7, -1};
    PathLines lines;
    for (const motion::Move& move : {way(rapid, {}, a), way(feed, a, b), way(dwell, b, b), way(feed, b, c),
                                     way(rapid, c, d), way(rapid, d, e), way(feed, e, f)})
        lines.add(move);
    const std::vector<PictureLine> found = lines.take();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].points_mm, (std::vector<Vec3>{a, b, c}));
    EXPECT_EQ(found[1].points_mm, (std::vector<Vec3>{e, f}));
}

// As after a tool change, or after a return to a place that the program does not know.
TEST(PathLines, end_where_the_next_feed_starts_elsewhere) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{5, 5, 0}, d{6, 5, 0};
    PathLines lines;
    lines.add(way(motion::MoveKind::feed, a, b));
    lines.add(way(motion::MoveKind::feed, c, d));
    const std::vector<PictureLine> found = lines.take();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[1].points_mm, (std::vector<Vec3>{c, d}));
}

TEST(PathLines, follow_an_arc) {
    motion::Move half = way(motion::MoveKind::feed, {10, 0, 0}, {-10, 0, 0});
    half.arc = motion::Arc{{0, 0, 0}, {0, 0, 1}, 3.14159265358979};
    PathLines lines;
    lines.add(half);
    const std::vector<PictureLine> found = lines.take();
    ASSERT_EQ(found.size(), 1u);
    for (const Vec3 p : found[0].points_mm) {
        EXPECT_NEAR(length(p), 10, 1e-9);
        EXPECT_GE(p.y, -1e-9);
    }
    EXPECT_NEAR(found[0].points_mm[found[0].points_mm.size() / 2].y, 10, 1e-9);
}

}  // namespace
}  // namespace tribo::report
