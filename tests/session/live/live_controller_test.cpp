// SPDX-License-Identifier: MIT
// What the commands of a page do to the mill, the finger and the settings.
#include "session/live/live_controller.hpp"

#include <gtest/gtest.h>

#include "milling/tool/materials.hpp"
#include "protocol/live_message.hpp"
#include "session/block_setup.hpp"

namespace tribo::session {
namespace {

Result<MillSetup> controlled_slot() {
    MillSetup s =
        block_setup({{0, 0, -8}, {40, 20, 0}}, {.diameter_mm = 8, .helix_deg = 35, .length_mm = 20}, 1);
    add_cut(s, straight_cut({-5, 10, -2}, {45, 10, -2}, 750));
    return s;
}

class Controlled : public testing::Test {
  protected:
    // The files of the job, as long as nobody edits them.
    double helix_deg = 35;
    std::string material = "al7075-t6";
    Result<LiveInput> read_files() const {
        MillSetup setup = *controlled_slot();
        setup.cutters.front().helix_deg = helix_deg;
        return LiveInput(std::move(setup), {.material = material});
    }

    static protocol::LiveSettings job_settings() {
        protocol::LiveSettings s;
        s.helix_deg = 35;
        s.material = "al7075-t6";
        return s;
    }
    Result<void> say(std::string_view text) {
        const auto command = protocol::parse_live_command(text);
        if (!command) return std::unexpected(command.error());
        auto obeyed = controller.obey(*command);
        controller.apply();
        return obeyed;
    }

    std::unique_ptr<LiveMill> mill = *LiveMill::create([this] { return read_files(); }, serial_for);
    LiveController controller{*mill, {}, nullptr, {}};
};

TEST_F(Controlled, TheClockObeys) {
    ASSERT_TRUE(say(R"({"op":"play"})"));
    EXPECT_TRUE(mill->playing());
    ASSERT_TRUE(say(R"({"op":"speed","value":2.5})"));
    EXPECT_EQ(controller.scene().pace, 2.5);
    ASSERT_TRUE(say(R"({"op":"seek","t_s":1.5})"));
    EXPECT_EQ(controller.scene().program_s, 1.5);
    ASSERT_TRUE(say(R"({"op":"pause"})"));
    EXPECT_EQ(controller.scene().pace, 0);
    EXPECT_EQ(controller.settings(), job_settings());
    EXPECT_EQ(controller.force_changes(), 0);
}

TEST_F(Controlled, BandsComeFromCasesAndNoForceIsBuiltAgain) {
    ASSERT_TRUE(say(R"({"op":"cases","value":true})"));
    EXPECT_EQ(mill->change().uncertain_cases, protocol::kBandCases);
    EXPECT_EQ(controller.force_changes(), 0);
    ASSERT_TRUE(say(R"({"op":"cases","value":false})"));
    EXPECT_EQ(mill->change().uncertain_cases, 0u);
    EXPECT_FALSE(say(R"({"op":"cases","value":40})"));
}

TEST_F(Controlled, TheCutIsChangedAgainstTheJobs) {
    ASSERT_TRUE(say(R"({"op":"set","key":"feed_percent","value":150})"));
    ASSERT_TRUE(say(R"({"op":"set","key":"spindle_percent","value":50})"));
    ASSERT_TRUE(say(R"({"op":"set","key":"helix_deg","value":45})"));
    ASSERT_TRUE(say(R"({"op":"material","value":"ti6al4v"})"));
    EXPECT_EQ(controller.force_changes(), 4);
    EXPECT_EQ(mill->change().feed_factor, 1.5);
    EXPECT_EQ(mill->change().speed_factor, 0.5);
    EXPECT_EQ(mill->change().helix_deg, 45);
    EXPECT_EQ(mill->change().coefficients->ktc, milling::find_material("ti6al4v")->coefficients.ktc);
    for (const char* back :
         {R"({"op":"set","key":"feed_percent","value":100})",
          R"({"op":"set","key":"spindle_percent","value":100})",
          R"({"op":"set","key":"helix_deg","value":35})", R"({"op":"material","value":"al7075-t6"})"})
        ASSERT_TRUE(say(back));
    EXPECT_TRUE(mill->change().none());
    EXPECT_EQ(controller.settings(), job_settings());
}

TEST_F(Controlled, OfASliderTheNewestValueWins) {
    for (int percent = 10; percent <= 300; ++percent) {
        const auto command = protocol::parse_live_command(R"({"op":"set","key":"feed_percent","value":)" +
                                                          std::to_string(percent) + "}");
        ASSERT_TRUE(controller.obey(*command));
    }
    EXPECT_EQ(controller.settings().feed_percent, 300);
    EXPECT_TRUE(mill->change().none());
    controller.apply();
    EXPECT_EQ(mill->change().feed_factor, 3);
    EXPECT_EQ(controller.force_changes(), 1);
    controller.apply();
    EXPECT_EQ(controller.force_changes(), 1);
}

TEST_F(Controlled, MaterialAndHelixFollowTheFiles) {
    const auto read_again = [&] {
        mill->set_clock(1);
        mill->tick(0, [] { return true; }, [](auto) {});
        mill->set_clock(0);
        mill->tick(0, [] { return true; }, [](auto) {});
        controller.apply();
    };
    helix_deg = 20;
    material = "ti6al4v";
    read_again();
    EXPECT_EQ(controller.settings().helix_deg, 20);
    EXPECT_EQ(controller.settings().material, "ti6al4v");
    EXPECT_TRUE(mill->change().none());
    EXPECT_EQ(controller.force_changes(), 0);
    // What a viewer chose stays.
    ASSERT_TRUE(say(R"({"op":"set","key":"helix_deg","value":45})"));
    helix_deg = 10;
    material = "";
    read_again();
    EXPECT_EQ(controller.settings().helix_deg, 45);
    EXPECT_EQ(mill->change().helix_deg, 45);
    EXPECT_EQ(controller.settings().material, "");
    ASSERT_TRUE(say(R"({"op":"set","key":"helix_deg","value":10})"));
    EXPECT_TRUE(mill->change().none());
}

TEST_F(Controlled, WhatIsRefusedChangesNothing) {
    for (const char* text :
         {R"({"op":"material","value":"unobtainium"})", R"({"op":"set","key":"feed_percent","value":301})",
          R"({"op":"set","key":"mass","value":1})", R"({"op":"mode","value":"fly"})"})
        EXPECT_FALSE(say(text)) << text;
    EXPECT_EQ(controller.settings(), job_settings());
    EXPECT_TRUE(mill->change().none());
    EXPECT_EQ(controller.force_changes(), 0);
}

TEST_F(Controlled, TheFingerAndItsForceObey) {
    ASSERT_TRUE(say(R"({"op":"mode","value":"inspect"})"));
    ASSERT_TRUE(say(R"({"op":"force","value":false})"));
    ASSERT_TRUE(say(R"({"op":"stop"})"));
    EXPECT_FALSE(controller.scene().cut_mode);
    EXPECT_FALSE(controller.scene().cutting_force);
    EXPECT_TRUE(controller.scene().stopped);
    EXPECT_EQ(controller.force_changes(), 0);
    ASSERT_TRUE(say(R"({"op":"release"})"));
    EXPECT_FALSE(controller.scene().stopped);
    ASSERT_TRUE(say(R"({"op":"set","key":"force_scale","value":0.5})"));
    ASSERT_TRUE(say(R"({"op":"set","key":"jnd","value":2})"));
    EXPECT_EQ(controller.table_options().hand_per_tool, 0.5);
    EXPECT_EQ(controller.table_options().most_jnd, 2);
    EXPECT_EQ(controller.force_changes(), 2);
    EXPECT_TRUE(mill->change().none());
    ASSERT_TRUE(say(R"({"op":"finger","position_mm":[20,4,-1],"down":true})"));
    protocol::LiveTouch touch;
    for (int n = 0; n < 1000; ++n) {
        if (n % 16 == 0)
            controller.finger().show(controller.scene(), {},
                                     [&](auto frame) { (void)protocol::read_frame(frame, touch); });
        controller.finger().tick(1e-3 * n);
    }
    EXPECT_TRUE(touch.hand);
    EXPECT_GT(touch.force_n.z, 0.1);
}

}  // namespace
}  // namespace tribo::session
