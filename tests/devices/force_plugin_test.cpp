// SPDX-License-Identifier: MIT
// A force that a library of the user's gives: the example of docs/feel.md, and libraries that are none.
#include "devices/arm/force_plugin.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "places.hpp"

namespace tribo::devices {
namespace {

class Inner final : public haptics::ForceSource {
  public:
    haptics::RenderedForce render(const haptics::HandReading&, double now_s, double) noexcept override {
        return {{0, 0, 1}, {2, 0, 0}, true, now_s};
    }
};

TEST(ForcePlugin, gets_the_hand_and_what_tribo_would_give) {
    Inner inner;
    auto plugin = ForcePlugin::open(MAGNET, 1000);
    ASSERT_TRUE(plugin.has_value()) << plugin.error().text();
    (*plugin)->set_inner(inner);
    haptics::HandReading hand;
    hand.position_mm = {40, 30, 12};
    const haptics::RenderedForce near = (*plugin)->render(hand, 0.5, 1e-3);
    EXPECT_EQ(near.contact_n, (Vec3{0, 0, 1}));
    EXPECT_NEAR(near.driven_n.z, -0.7, 1e-12);
    EXPECT_NEAR(near.driven_n.x, 2, 1e-12);
    EXPECT_TRUE(near.touching);
    EXPECT_EQ(near.simulation_s, 0.5);
    hand.position_mm = {40, 30, 16};
    EXPECT_EQ((*plugin)->render(hand, 0.6, 1e-3).driven_n, (Vec3{2, 0, 0}));
}

TEST(ForcePlugin, says_why_a_library_is_none) {
    const auto none = ForcePlugin::open("no-such.so", 1000);
    ASSERT_FALSE(none.has_value());
    EXPECT_NE(none.error().text().find("no-such.so"), std::string::npos);
    const auto other = ForcePlugin::open(FAKE_HD, 1000);
    ASSERT_FALSE(other.has_value());
    EXPECT_NE(other.error().text().find("tribo_force_open"), std::string::npos);
    const auto refuses = ForcePlugin::open(MAGNET, 0);
    ASSERT_FALSE(refuses.has_value());
    EXPECT_NE(refuses.error().text().find("NULL"), std::string::npos);
}

TEST(ForcePlugin, is_named_where_it_does_what_it_should_not) {
    const auto none = ForcePlugin::open(FAKE_FORCE, 666);
    ASSERT_FALSE(none.has_value());
    EXPECT_NE(none.error().text().find("tribo_force_open threw"), std::string::npos);
    Inner inner;
    auto plugin = ForcePlugin::open(FAKE_FORCE, 1000);
    ASSERT_TRUE(plugin.has_value()) << plugin.error().text();
    (*plugin)->set_inner(inner);
    haptics::HandReading hand;
    hand.position_mm = {1, 0, -1};
    EXPECT_EQ((*plugin)->render(hand, 0, 1e-3).contact_n, (Vec3{1, 0, 0}));
    EXPECT_EQ((*plugin)->trouble(), "");
    hand.position_mm = {1, 0, 1};
    EXPECT_FALSE(is_finite((*plugin)->render(hand, 1e-3, 1e-3).contact_n));
    EXPECT_NE((*plugin)->trouble().find("1 forces that are not finite"), std::string::npos);
    hand.position_mm = {-1, 0, -1};
    EXPECT_EQ((*plugin)->render(hand, 2e-3, 1e-3).contact_n, Vec3{});
    EXPECT_NE((*plugin)->trouble().find("threw an exception"), std::string::npos);
    hand.position_mm = {1, 0, -1};
    EXPECT_EQ((*plugin)->render(hand, 3e-3, 1e-3).contact_n, Vec3{});
}

// What the docs print is what is built here.
TEST(ForcePlugin, is_what_the_docs_say) {
    std::ostringstream docs, source;
    docs << std::ifstream(TRIBO_SOURCE_DIR "/docs/feel.md").rdbuf();
    source << std::ifstream(TRIBO_SOURCE_DIR "/examples/source/magnet.c").rdbuf();
    const std::string text = source.str();
    EXPECT_NE(docs.str().find(text.substr(text.find("#include"))), std::string::npos);
}

}  // namespace
}  // namespace tribo::devices
