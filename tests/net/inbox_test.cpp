// SPDX-License-Identifier: MIT
#include "net/inbox.hpp"

#include <gtest/gtest.h>

namespace tribo::net {
namespace {

using Kind = Inbox::Event::Kind;

TEST(Inbox, KeepsTheOrder) {
    Inbox inbox;
    ServerHandlers handlers;
    inbox.attach(handlers);
    handlers.on_connect(7, {false, "token"});
    EXPECT_EQ(handlers.on_message(7, "play"), Taken::yes);
    handlers.on_overflow(7);
    const auto events = inbox.take_all();
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events[0].resume.token, "token");
    EXPECT_EQ(events[1].text, "play");
    EXPECT_EQ(events[2].kind, Kind::overflowed);
    EXPECT_TRUE(inbox.take_all().empty());
}

TEST(Inbox, RefusesMessagesBeyondItsLimits) {
    Inbox inbox;
    for (std::size_t n = 0; n < Inbox::kMostMessages; ++n)
        ASSERT_EQ(inbox.put({Kind::message, 1, "x"}), Taken::yes);
    EXPECT_EQ(inbox.put({Kind::message, 1, "x"}), Taken::too_many);
    // Another client has its own room.
    const std::string half(Inbox::kMostBytes / 2, 'x');
    EXPECT_EQ(inbox.put({Kind::message, 2, half}), Taken::yes);
    EXPECT_EQ(inbox.put({Kind::message, 2, half}), Taken::yes);
    EXPECT_EQ(inbox.put({Kind::message, 2, "x"}), Taken::too_much);
    EXPECT_EQ(inbox.take_all().size(), Inbox::kMostMessages + 2);
    EXPECT_EQ(inbox.put({Kind::message, 1, "x"}), Taken::yes);
    EXPECT_EQ(inbox.put({Kind::message, 2, "x"}), Taken::yes);
}

TEST(Inbox, ForgetsWhoHasGone) {
    Inbox inbox;
    inbox.put({Kind::connected, 1});
    inbox.put({Kind::message, 1, "play"});
    inbox.put({Kind::message, 2, "pause"});
    inbox.put({Kind::disconnected, 1});
    const auto events = inbox.take_all();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].text, "pause");
    EXPECT_EQ(events[1].kind, Kind::disconnected);
}

}  // namespace
}  // namespace tribo::net
