// SPDX-License-Identifier: MIT
// The Falcon through a libusb that has one: firmware, homing, packets, and everything that goes wrong.
#include "devices/arm/falcon/falcon.hpp"

#include <chrono>
#include <cmath>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>

#include "base/math.hpp"
#include "devices/arm/falcon/falcon_kinematics.hpp"
#include "fakes/fake_falcon.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;
namespace fs = std::filesystem;

constexpr double kRadPerCount = 2 * math::kPi / 1280 * 14.25 / 110, kZeroRad = 35 * math::kPi / 180;

class FalconArm : public testing::Test {
  protected:
    FalconArm() : library_(::dlopen(FAKE_USB, RTLD_NOW | RTLD_LOCAL)) {
        EXPECT_NE(library_, nullptr) << ::dlerror();
        falcon = reinterpret_cast<test::FakeFalcon* (*)()>(::dlsym(library_, "fake_falcon"))();
        falcon->reset();
        file_ = fs::temp_directory_path() / ("tribo_falcon_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name());
        options.libusb = FAKE_USB;
        options.homing_ms = 2000;
    }
    ~FalconArm() override {
        fs::remove(file_);
        ::dlclose(library_);
    }
    // Three blocks and a rest.
    void name_firmware() {
        for (int n = 0; n < 200; ++n) firmware.push_back(static_cast<unsigned char>(n * 7));
        std::ofstream(file_, std::ios::binary)
            .write(reinterpret_cast<const char*>(firmware.data()),
                   static_cast<std::streamsize>(firmware.size()));
        options.firmware = file_.string();
    }
    // The encoders of a grip at this place, in the axes of the Falcon, from its middle.
    void put_grip(Vec3 from_middle_mm) {
        const auto angles = falcon::angles_at(falcon::kMiddle + from_middle_mm);
        ASSERT_TRUE(angles.has_value());
        for (std::size_t n = 0; n < 3; ++n)
            falcon->counts[n] = static_cast<int>(std::lround(((*angles)[n] - kZeroRad) / kRadPerCount));
    }
    static bool comes(haptics::Device& device, haptics::HandReading& reading, DeviceState state) {
        for (int n = 0; n < 3000; ++n) {
            if (device.read(reading) == state) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }

    test::FakeFalcon* falcon = nullptr;
    std::vector<unsigned char> firmware;
    fs::path file_;
    FalconOptions options;

  private:
    void* library_;
};

TEST_F(FalconArm, gets_its_firmware_as_libnifalcon_loads_it) {
    name_firmware();
    put_grip({});
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ(falcon->firmware(), firmware);
    device->reset();
    EXPECT_EQ(falcon->transcript(),
              "init, claim, "
              // Is there a firmware already?
              "latency 1, baud 2, purge 1, purge 2, "
              // The question to the loader at 9600 baud, 8N1.
              "purge 1, purge 2, latency 10, baud 4138, data 8, flow 0, line 200, line 100, line 101, out 3, "
              // The firmware at 140,000 baud.
              "line 100, baud 15, out 1, out 62, out 14, "
              "latency 1, baud 2, purge 1, purge 2, release, close, exit");
}

TEST_F(FalconArm, needs_no_firmware_file_where_the_falcon_has_one) {
    falcon->has_firmware = true;
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ(falcon->transcript(), "init, claim, latency 1, baud 2, purge 1, purge 2");
}

TEST_F(FalconArm, loads_again_where_a_load_fails) {
    name_firmware();
    falcon->failing_loads = 4;
    falcon->silent_questions = 3;
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ(falcon->firmware(), firmware);
}

TEST_F(FalconArm, reads_the_grip_and_its_speed_in_the_stocks_axes) {
    falcon->has_firmware = true;
    put_grip({10, 20, -30});
    falcon->buttons = 9;
    options.mounting.origin_mm = {0, 0, 100};
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ((*device)->limits().max_force_n, 8);
    EXPECT_EQ((*device)->limits().max_stiffness_n_per_mm, 3);
    haptics::HandReading reading;
    ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
    // Right, away from the user and up; a count is 0.04 mm of the end of an arm.
    EXPECT_LT(distance(reading.position_mm, {10, 30, 120}), 0.06);
    EXPECT_EQ(reading.buttons, 9U);
}

TEST_F(FalconArm, has_the_speed_of_its_last_readings) {
    falcon->has_firmware = true;
    // All arms turn alike: towards the user, and slowly enough to stay within reach.
    for (auto& count : falcon->counts) count = -400;
    falcon->turn = 1;
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    for (int n = 0; n < 20; ++n) ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
    EXPECT_LT(reading.velocity_mm_per_s.y, 0);
    EXPECT_NEAR(reading.velocity_mm_per_s.x / reading.velocity_mm_per_s.y, 0, 1e-6);
    EXPECT_NEAR(reading.velocity_mm_per_s.z / reading.velocity_mm_per_s.y, 0, 1e-6);
}

TEST_F(FalconArm, sends_the_motors_the_force_by_virtual_work_and_zero_when_the_servo_is_silent) {
    falcon->has_firmware = true;
    put_grip({-15, 5, 20});
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
    // The way of the grip for a turn of one arm alone, from positions.
    const Vec3 force{1, -2, 1.5}, in_falcon{1, 1.5, 2};
    falcon::Angles angles{};
    for (std::size_t n = 0; n < 3; ++n) angles[n] = kZeroRad + kRadPerCount * falcon->counts[n];
    int expected[3];
    for (std::size_t n = 0; n < 3; ++n) {
        falcon::Angles up = angles, down = angles;
        up[n] += 1e-4;
        down[n] -= 1e-4;
        const Vec3 way = *falcon::grip_at(up, falcon::kMiddle) - *falcon::grip_at(down, falcon::kMiddle);
        const double torque_n_m = 1e-3 * dot(in_falcon, way) / 2e-4;
        expected[n] = static_cast<int>(std::lround(-10'000 * torque_n_m));
    }
    const auto sent = [&] {
        return falcon->motors[0] == expected[0] && falcon->motors[1] == expected[1] &&
               falcon->motors[2] == expected[2];
    };
    for (int n = 0; n < 4000 && !sent(); ++n) {
        (*device)->write(force);
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_TRUE(sent()) << falcon->motors[0] << " " << falcon->motors[1] << " " << falcon->motors[2]
                        << ", not " << expected[0] << " " << expected[1] << " " << expected[2];
    EXPECT_GT(std::abs(expected[0]) + std::abs(expected[1]), 100);
    EXPECT_EQ(falcon->status, 2);  // green, no homing
    // Ten times what the motors can do: 4096 at most, in the same ratio.
    for (int n = 0; n < 4000 && falcon->motors[0] == expected[0]; ++n) {
        (*device)->write(100 * force);
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    int largest = 0;
    for (int n = 0; n < 3; ++n) largest = std::max(largest, std::abs(falcon->motors[n]));
    EXPECT_EQ(largest, 4096);
    EXPECT_NEAR(1.0 * falcon->motors[0] / falcon->motors[1], 1.0 * expected[0] / expected[1], 0.05);
    const auto still = [&] {
        return falcon->motors[0] == 0 && falcon->motors[1] == 0 && falcon->motors[2] == 0;
    };
    for (int n = 0; n < 4000 && !still(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_TRUE(still());
}

TEST_F(FalconArm, lets_go_and_puts_its_lights_out_when_it_is_closed) {
    falcon->has_firmware = true;
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    for (int n = 0; n < 4000 && falcon->motors[2] == 0; ++n) {
        (*device)->write({0, 1, 2});
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_NE(falcon->motors[2], 0);
    device->reset();
    for (int n = 0; n < 3; ++n) EXPECT_EQ(falcon->motors[n], 0);
    EXPECT_EQ(falcon->status, 0);
}

TEST_F(FalconArm, takes_packets_in_pieces_and_drops_short_ones) {
    falcon->has_firmware = true;
    falcon->cut_every = 3;
    falcon->split_at = 5;
    put_grip({10, 0, 0});
    auto device = open_falcon(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    haptics::HandReading reading;
    std::uint64_t first = 0;
    for (int n = 0; n < 200; ++n) {
        ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
        if (n == 0) first = reading.sequence;
        ASSERT_LT(distance(reading.position_mm, {10, 0, 0}), 0.06);
        ASSERT_EQ(reading.buttons, 0U);
        if (reading.sequence > first + 20) break;
    }
    EXPECT_GT(reading.sequence, first + 20);
}

TEST_F(FalconArm, is_gone_in_plain_words_when_it_is_unplugged_or_falls_silent) {
    for (const bool unplug : {true, false}) {
        falcon->reset();
        falcon->has_firmware = true;
        auto device = open_falcon(options);
        ASSERT_TRUE(device.has_value()) << device.error().text();
        haptics::HandReading reading;
        ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
        (unplug ? falcon->plugged : falcon->mute) = !unplug;
        ASSERT_TRUE(comes(**device, reading, DeviceState::gone)) << unplug;
        EXPECT_NE((*device)->trouble().find("unplugged"), std::string::npos);
    }
}

TEST_F(FalconArm, says_what_to_do_where_it_does_not_open) {
    struct Case {
        std::string cause, remedy;
        std::function<void()> set;
    };
    const std::vector<Case> cases{
        {"/nowhere/libusb.so", "libusb-1.0-0", [&] { options.libusb = "/nowhere/libusb.so"; }},
        {"has no libusb_bulk_transfer", "libusb 1.0.16", [&] { options.libusb = FAKE_USB_OLD; }},
        {"not plugged in", "plug in", [&] { falcon->plugged = false; }},
        {"no right", "cb48", [&] { falcon->open_code = -3; }},
        {"LIBUSB_ERROR_OTHER", "plug it in again", [&] { falcon->open_code = -99; }},
        {"another program", "close", [&] { falcon->claim_code = -6; }},
        {"no firmware", "falcon:FILE", [] {}},
        {"/nowhere/novint.bin", "another file", [&] { options.firmware = "/nowhere/novint.bin"; }},
        {"is empty", "novint.bin",
         [&] {
             std::ofstream(file_, std::ios::binary).flush();
             options.firmware = file_.string();
         }},
        {"after 10 tries", "without a hub",
         [&] {
             name_firmware();
             falcon->failing_loads = 1'000'000;
         }},
        {"not homed", "pull the grip out",
         [&] {
             falcon->has_firmware = true;
             falcon->homing_packets = 1'000'000;
             options.homing_ms = 20;
         }},
    };
    for (const Case& one : cases) {
        falcon->reset();
        firmware.clear();
        options = {};
        options.libusb = FAKE_USB;
        one.set();
        const auto device = open_falcon(options);
        ASSERT_FALSE(device.has_value()) << one.cause;
        EXPECT_NE(device.error().text().find(one.cause), std::string::npos) << device.error().text();
        EXPECT_NE(device.error().remedy.find(one.remedy), std::string::npos) << device.error().remedy;
    }
}

}  // namespace
}  // namespace tribo::devices
