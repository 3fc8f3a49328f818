// SPDX-License-Identifier: MIT
#include "protocol/live_message.hpp"

#include <gtest/gtest.h>

namespace tribo::protocol {
namespace {

TEST(LiveMessage, CommandsAreRead) {
    EXPECT_EQ(parse_live_command(R"({"op":"play"})")->op, LiveOp::play);
    EXPECT_EQ(parse_live_command(R"({"op":"resync","more":1})")->op, LiveOp::resync);
    const auto speed = parse_live_command(R"({"op":"speed","value":2.5})");
    ASSERT_TRUE(speed);
    EXPECT_EQ(speed->op, LiveOp::speed);
    EXPECT_EQ(speed->value, 2.5);
    EXPECT_EQ(parse_live_command(R"({"op":"seek","t_s":-1})")->value, -1);
    const auto finger = parse_live_command(R"({"op":"finger","position_mm":[1,-2,3.5],"down":true})");
    ASSERT_TRUE(finger);
    EXPECT_TRUE(finger->on);
    EXPECT_EQ(finger->position_mm, (Vec3{1, -2, 3.5}));
    EXPECT_FALSE(parse_live_command(R"({"op":"finger","down":false})")->on);
    EXPECT_EQ(parse_live_command(R"({"op":"mode","value":"inspect"})")->word, "inspect");
    EXPECT_FALSE(parse_live_command(R"({"op":"force","value":false})")->on);
    EXPECT_EQ(parse_live_command(R"({"op":"stop"})")->op, LiveOp::stop);
    const auto set = parse_live_command(R"({"op":"set","key":"helix_deg","value":45})");
    ASSERT_TRUE(set);
    EXPECT_EQ(set->word, "helix_deg");
    EXPECT_EQ(set->value, 45);
    EXPECT_EQ(parse_live_command(R"({"op":"material","value":"x"})")->word, "x");
}

TEST(LiveMessage, SettingsStayWithinTheirBounds) {
    for (const LiveNumber& n : kLiveNumbers) {
        const auto set = [&](double value) {
            return parse_live_command(R"({"op":"set","key":")" + std::string(n.key) + R"(","value":)" +
                                      std::to_string(value) + "}");
        };
        const auto [least, most, above] = n.limit.range;
        EXPECT_TRUE(set(most)) << n.key;
        EXPECT_TRUE(set(0.5 * (least + most))) << n.key;
        EXPECT_FALSE(set(1.01 * most)) << n.key;
        EXPECT_FALSE(set(least - 0.01)) << n.key;
    }
}

TEST(LiveMessage, WhatIsNoCommandIsRefused) {
    for (const char* text : {"",
                             "play",
                             "[]",
                             "{}",
                             "null",
                             R"({"op":1})",
                             R"({"op":"fly"})",
                             R"({"op":"speed"})",
                             R"({"op":"speed","value":"2"})",
                             R"({"op":"seek","t_s":1e999})",
                             R"({"op":"seek","t_s":null})",
                             "{\"op\":\"\xff\"}",
                             R"({"op":"play")",
                             R"({"op":"finger","down":true})",
                             R"({"op":"finger","down":true,"position_mm":[1,2]})",
                             R"({"op":"finger","down":true,"position_mm":[1,2,null]})",
                             R"({"op":"mode","value":"fly"})",
                             R"({"op":"force","value":1})",
                             R"({"op":"set","value":1})",
                             R"({"op":"set","key":"mass","value":1})",
                             R"({"op":"set","key":"jnd"})",
                             R"({"op":"material"})"}) {
        const auto command = parse_live_command(text);
        ASSERT_FALSE(command) << text;
        EXPECT_FALSE(command.error().remedy.empty());
        EXPECT_NE(live_refusal(command.error()).find("\"op\":\"refused\""), std::string::npos);
    }
    const std::string deep(100'000, '[');
    EXPECT_FALSE(parse_live_command(deep));
}

TEST(LiveMessage, TheServerSaysWhatItShows) {
    LiveServerInfo info;
    info.version = "1.2.3";
    info.job = "a \"b\".toml";
    info.warnings = {{"p.nc", 3, "look"}};
    info.materials = {"al"};
    info.device = "hand";
    info.max_force_n = 3.5;
    info.rate_hz = 1000;
    info.resume = "f00d";
    EXPECT_EQ(
        live_server_info(info),
        R"({"op":"serverInfo","version":"1.2.3","warnings":["p.nc:3: warning: look"],"job":"a \"b\".toml",)"
        R"("materials":["al"],"audio":"browser","device":{"name":"hand","max_force_n":3.5,"rate_hz":1000.0,"arm":false},)"
        R"("resume":"f00d","resumed":false})");
    LiveServerInfo bench;
    bench.version = "1.2.3";
    bench.resume = "f00d";
    bench.resumed = true;
    EXPECT_EQ(live_server_info(bench),
              R"({"op":"serverInfo","version":"1.2.3","warnings":[],"resume":"f00d","resumed":true})");
}

TEST(LiveMessage, TheSettingsAreSaid) {
    LiveSettings settings;
    settings.material = "al";
    settings.cut_mode = false;
    settings.helix_deg = 45;
    EXPECT_EQ(
        live_settings(settings),
        R"({"op":"settings","feed_percent":100,"spindle_percent":100,"helix_deg":45,"force_scale":0.01,)"
        R"("jnd":0.5,"material":"al","mode":"inspect","force":true,"stopped":false,)"
        R"("has_spread":false,"cases":0})");
    settings.has_spread = settings.cases = true;
    EXPECT_TRUE(live_settings(settings).ends_with(R"("has_spread":true,"cases":40})"));
}

}  // namespace
}  // namespace tribo::protocol
