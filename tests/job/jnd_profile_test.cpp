// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <numbers>

#include "job/memory_source.hpp"
#include "job/toml/jnd_profile_toml.hpp"

namespace tribo::job {
namespace {

TEST(JndProfile, reads_what_a_user_says_and_keeps_the_rest) {
    const auto p = parse_jnd_profile("force_magnitude = 0.1\nforce_direction_deg = 30\n", "me.toml");
    ASSERT_TRUE(p.has_value()) << p.error().text();
    EXPECT_EQ(p->force_magnitude, 0.1);
    EXPECT_NEAR(p->force_direction_rad, std::numbers::pi / 6, 1e-12);
    EXPECT_EQ(p->vibration_amplitude, contact::JndProfile{}.vibration_amplitude);
    const auto none = parse_jnd_profile("", "me.toml");
    ASSERT_TRUE(none.has_value());
    EXPECT_NEAR(none->force_direction_rad, contact::JndProfile{}.force_direction_rad, 1e-15);
}

TEST(JndProfile, refuses_what_nobody_can_mean_with_its_line) {
    for (const char* bad :
         {"x = 1\nforce_magnitud = 0.1\n", "\nforce_magnitude = 0\n", "\nforce_magnitude = 7\n",
          "\nforce_direction_deg = 91\n", "\nforce_floor_n = -1\n", "\npitch = \"high\"\n", "\npitch = nan\n",
          "\npitch ="}) {
        const auto p = parse_jnd_profile(bad, "me.toml");
        ASSERT_FALSE(p.has_value()) << bad;
        EXPECT_EQ(p.error().file, "me.toml");
        EXPECT_GE(p.error().line, 1);
    }
}

TEST(JndProfile, comes_from_a_file) {
    MemorySource files;
    files.put("me.toml", "pitch = 0.02\n");
    EXPECT_EQ(read_jnd_profile(files, "me.toml")->pitch, 0.02);
    EXPECT_EQ(read_jnd_profile(files, "you.toml").error().file, "you.toml");
}

}  // namespace
}  // namespace tribo::job
