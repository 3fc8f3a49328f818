// SPDX-License-Identifier: MIT
#include "net/seats.hpp"

#include <gtest/gtest.h>
#include <string>

namespace tribo::net {
namespace {

using namespace std::chrono_literals;

class SeatsTest : public testing::Test {
  protected:
    Seats::Id take(const std::string& address, char name, Seats::Time idle_from) {
        return seats.take(address, idle_from, [this, name] { gone += name; });
    }
    const Seats::Time now{1000s};
    Seats seats{4, 3};
    std::string gone;
};

TEST_F(SeatsTest, TheLongestIdleOneLeaves) {
    take("a", '1', now - 1s);
    const Seats::Id second = take("a", '2', now - 3s);
    take("b", '3', now - 2s);
    EXPECT_TRUE(seats.make_room("b", now));
    EXPECT_EQ(gone, "");
    take("b", '4', now - 1ms);
    EXPECT_TRUE(seats.make_room("c", now));
    EXPECT_EQ(gone, "2");
    seats.leave(second);  // again, when its connection is closed
    EXPECT_EQ(seats.taken(), 3u);
}

TEST_F(SeatsTest, AnAddressMakesRoomForItself) {
    take("a", '1', now - 1s);
    take("a", '2', now - 2s);
    take("a", '3', now - 1s);
    take("b", '4', now - 9s);
    EXPECT_TRUE(seats.make_room("a", now));
    EXPECT_EQ(gone, "2");
    EXPECT_TRUE(seats.make_room("b", now));
    EXPECT_EQ(gone, "2");
}

TEST_F(SeatsTest, NobodyLeavesWhoIsBusy) {
    const Seats::Id busy = take("a", '1', now + 1s);
    take("a", '2', now + 1s);
    take("a", '3', now + 2s);
    EXPECT_FALSE(seats.make_room("a", now));
    EXPECT_TRUE(seats.make_room("b", now));
    seats.set_idle_from(busy, now);
    EXPECT_TRUE(seats.make_room("a", now));
    EXPECT_EQ(gone, "1");
    seats.set_idle_from(busy, now);  // of nobody
}

}  // namespace
}  // namespace tribo::net
