// SPDX-License-Identifier: MIT
#include "io/live_message.hpp"

#include <gtest/gtest.h>

namespace tribo::io {
namespace {

TEST(LiveMessage, CommandsAreRead) {
    EXPECT_EQ(parse_live_command(R"({"op":"play"})")->op, LiveOp::play);
    EXPECT_EQ(parse_live_command(R"({"op":"resync","more":1})")->op, LiveOp::resync);
    const auto speed = parse_live_command(R"({"op":"speed","value":2.5})");
    ASSERT_TRUE(speed);
    EXPECT_EQ(speed->op, LiveOp::speed);
    EXPECT_EQ(speed->value, 2.5);
    EXPECT_EQ(parse_live_command(R"({"op":"seek","t_s":-1})")->value, -1);
}

TEST(LiveMessage, WhatIsNoCommandIsRefused) {
    for (const char* text :
         {"", "play", "[]", "{}", "null", R"({"op":1})", R"({"op":"fly"})", R"({"op":"speed"})",
          R"({"op":"speed","value":"2"})", R"({"op":"seek","t_s":1e999})", R"({"op":"seek","t_s":null})",
          "{\"op\":\"\xff\"}", R"({"op":"play")"}) {
        const auto command = parse_live_command(text);
        ASSERT_FALSE(command) << text;
        EXPECT_FALSE(command.error().remedy.empty());
        EXPECT_NE(live_refusal(command.error()).find("\"op\":\"refused\""), std::string::npos);
    }
    const std::string deep(100'000, '[');
    EXPECT_FALSE(parse_live_command(deep));
}

TEST(LiveMessage, TheServerSaysWhatItShows) {
    const std::string text = live_server_info("1.2.3", "a \"b\".toml", {{"p.nc", 3, "look"}});
    EXPECT_EQ(
        text,
        R"({"op":"serverInfo","version":"1.2.3","job":"a \"b\".toml","warnings":["p.nc:3: warning: look"]})");
}

}  // namespace
}  // namespace tribo::io
