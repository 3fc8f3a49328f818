// SPDX-License-Identifier: MIT
#include "session/cut/speed_warnings.hpp"

#include <gtest/gtest.h>

namespace tribo::session {
namespace {

// Feed moves at these speeds, on lines 1, 2, ..., with a cutter of two flutes.
struct Speeds {
    double rpm, feed_mm_per_min;
};
Warnings warnings(double diameter_mm, std::initializer_list<Speeds> all) {
    MillSetup setup;
    setup.cutters.emplace_back().diameter_mm = diameter_mm;
    for (const Speeds& s : all) {
        motion::Move move;
        move.end.tip_mm = {10, 0, 0};
        move.feed_mm_per_min = s.feed_mm_per_min;
        move.line = static_cast<int>(setup.moves.size()) + 1;
        setup.moves.push_back(move);
        setup.cutter_of_move.push_back(0);
        setup.rpm_of_move.push_back(s.rpm);
    }
    return speed_warnings(setup, "p.nc");
}

// A tenth of 5 mm is 0.5 mm per tooth: 1000 mm/min at 1000 rpm.
TEST(SpeedWarnings, begin_at_a_tenth_of_the_diameter_per_tooth) {
    EXPECT_TRUE(warnings(5, {{1000, 1000}}).empty());
    const Warnings told = warnings(5, {{1000, 900}, {1000, 1010}, {1000, 2000}, {1000, 1500}});
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].message(),
              "p.nc:3: warning: 2000 mm/min at 1000 rpm are 1 mm per tooth for a cutter of 5 mm (and 2 more "
              "lines): no cutter takes more than a tenth of its diameter; check F and S");
}

// 100 mm turn at 10,000 m/min with 31,831 rpm.
TEST(SpeedWarnings, begin_at_ten_thousand_metres_a_minute) {
    EXPECT_TRUE(warnings(100, {{31'830, 100}}).empty());
    const Warnings told = warnings(100, {{60'000, 100}});
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].message(),
              "p.nc:1: warning: 60000 rpm move the rim of a cutter of 100 mm at 18800 m/min: no tool stands "
              "more than about 10000; check S");
}

TEST(SpeedWarnings, take_the_feed_of_a_move_from_its_time) {
    MillSetup setup;
    setup.cutters.emplace_back().diameter_mm = 5;
    motion::Move move;
    move.end.tip_mm = {10, 0, 0};
    move.duration_s = 0.1;  // 6000 mm/min, 3 mm per tooth
    setup.moves = {move};
    setup.cutter_of_move = {0};
    setup.rpm_of_move = {1000};
    EXPECT_EQ(speed_warnings(setup, "p.nc").size(), 1u);
}

}  // namespace
}  // namespace tribo::session
