// SPDX-License-Identifier: MIT
// Arms through libraries that export what the vendors' do.
#include <chrono>
#include <cmath>
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <thread>

#include "devices/arm/force_dimension.hpp"
#include "devices/arm/openhaptics.hpp"
#include "fakes/fake_arm.hpp"

namespace tribo::devices {
namespace {

using haptics::DeviceState;
using test::FakeArm;

// The library's own state; loading it again gives the same one, so every test begins by resetting it.
class Driver {
  public:
    explicit Driver(const char* path) : handle_(::dlopen(path, RTLD_NOW | RTLD_LOCAL)) {
        EXPECT_NE(handle_, nullptr) << ::dlerror();
        arm = reinterpret_cast<FakeArm* (*)()>(::dlsym(handle_, "fake_arm"))();
        for (int n = 0; n < 3; ++n) arm->position[n] = arm->velocity[n] = arm->force[n] = 0;
        arm->buttons = arm->error = arm->calibration = arm->watchdog = arm->stall_ms = 0;
        arm->plugged = true;
        arm->version = 3;
        arm->calibrated = arm->forces_on = arm->open = arm->expert = false;
        arm->watchdog_fires = arm->force_off_cause = arm->force_fails = arm->style = 0;
        arm->styles = 4;
        arm->forget();
    }
    ~Driver() { ::dlclose(handle_); }
    FakeArm* arm = nullptr;

  private:
    void* handle_;
};

// Reads until `state` comes, for at most two seconds.
bool comes(haptics::Device& device, haptics::HandReading& reading, DeviceState state) {
    for (int n = 0; n < 2000; ++n) {
        if (device.read(reading) == state) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

TEST(OpenHaptics, reads_the_hand_and_sets_forces_in_the_stocks_axes) {
    Driver driver(FAKE_HD);
    driver.arm->position[0] = 10;
    driver.arm->position[1] = 20;
    driver.arm->position[2] = 30;
    driver.arm->velocity[1] = 5;
    driver.arm->buttons = 1;
    driver.arm->calibration = 1;
    OpenHapticsOptions options;
    options.driver = FAKE_HD;
    options.mounting.origin_mm = {0, 0, 100};
    auto device = open_openhaptics(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ((*device)->limits().max_force_n, 3.3);
    EXPECT_EQ((*device)->limits().max_stiffness_n_per_mm, 0.4);
    EXPECT_TRUE(driver.arm->calibrated);
    EXPECT_TRUE(driver.arm->forces_on);
    haptics::HandReading reading;
    ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
    EXPECT_EQ(reading.position_mm, (Vec3{10, -30, 120}));
    EXPECT_EQ(reading.velocity_mm_per_s, (Vec3{0, 0, 5}));
    EXPECT_EQ(reading.stylus, (Vec3{0, 0, 1}));
    EXPECT_EQ(reading.buttons, 1U);
    // A force up is the arm's +y; it is kept up by writing it again.
    for (int n = 0; n < 2000 && driver.arm->force[1] != 1.5; ++n) {
        (*device)->write({0, 0.25, 1.5});
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    EXPECT_EQ(driver.arm->force[1], 1.5);
    EXPECT_EQ(driver.arm->force[2], -0.25);
    // A servo that falls silent: the driver's own thread lets go.
    for (int n = 0; n < 2000 && driver.arm->force[1] != 0; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(driver.arm->force[1], 0);
    device->reset();
    EXPECT_FALSE(driver.arm->open);
}

// As the vendor's calibration example has it: the scheduler runs, the arm says which styles it knows, and is
// asked again.
TEST(OpenHaptics, calls_the_driver_as_the_vendors_examples_do) {
    for (const int styles : {1, 2, 4, 7}) {
        Driver driver(FAKE_HD);
        driver.arm->calibration = 1;
        driver.arm->styles = styles;
        OpenHapticsOptions options;
        options.driver = FAKE_HD;
        auto device = open_openhaptics(options);
        ASSERT_TRUE(device.has_value()) << device.error().text();
        EXPECT_EQ(driver.arm->style, styles == 7 ? 2 : styles);
        device->reset();
        EXPECT_EQ(driver.arm->calls(),
                  "hdInitDevice hdMakeCurrentDevice hdGetString hdEnable hdScheduleAsynchronous "
                  "hdStartScheduler hdCheckCalibration hdUpdateCalibration hdCheckCalibration "
                  "hdStopScheduler hdUnschedule hdDisableDevice");
    }
}

TEST(OpenHaptics, tells_silence_errors_and_unplugging_apart) {
    Driver driver(FAKE_HD);
    OpenHapticsOptions options;
    options.driver = FAKE_HD;
    auto device = open_openhaptics(options);
    ASSERT_TRUE(device.has_value());
    haptics::HandReading reading;
    ASSERT_TRUE(comes(**device, reading, DeviceState::ready));
    driver.arm->stall_ms = 50;
    ASSERT_TRUE(comes(**device, reading, DeviceState::silent));
    driver.arm->stall_ms = 0;
    driver.arm->error = 0x200;
    ASSERT_TRUE(comes(**device, reading, DeviceState::refused));
    EXPECT_EQ((*device)->trouble(), "warm motors");
    driver.arm->error = 0x302;
    ASSERT_TRUE(comes(**device, reading, DeviceState::gone));
    EXPECT_EQ((*device)->trouble(), "communication error");
}

TEST(OpenHaptics, says_what_to_do_where_there_is_no_driver_no_arm_or_another_version) {
    OpenHapticsOptions options;
    options.driver = "/nowhere/libHD.so";
    auto device = open_openhaptics(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("/nowhere/libHD.so"), std::string::npos);
    EXPECT_NE(device.error().remedy.find("OpenHaptics"), std::string::npos);

    options.driver = FAKE_HD_OLD;
    device = open_openhaptics(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("has no hdScheduleAsynchronous"), std::string::npos);

    Driver driver(FAKE_HD);
    options.driver = FAKE_HD;
    options.device = "Left Arm";
    EXPECT_FALSE(open_openhaptics(options).has_value());
    options.device = "";
    driver.arm->plugged = false;
    device = open_openhaptics(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("communication error"), std::string::npos);
    EXPECT_NE(device.error().remedy.find("/dev/hidraw"), std::string::npos);
    driver.arm->plugged = true;
    driver.arm->calibration = 2;
    device = open_openhaptics(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().remedy.find("inkwell"), std::string::npos);
}

TEST(ForceDimension, reads_metres_and_sets_newtons_in_the_stocks_axes) {
    Driver driver(FAKE_DRD);
    driver.arm->position[0] = 0.01;
    driver.arm->position[1] = 0.02;
    driver.arm->position[2] = 0.03;
    driver.arm->velocity[0] = 0.1;
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_EQ((*device)->limits().max_force_n, 12);
    haptics::HandReading reading;
    ASSERT_EQ((*device)->read(reading), DeviceState::ready);
    // Right is the arm's y, away from the user its -x.
    EXPECT_NEAR(distance(reading.position_mm, {20, -10, 30}), 0, 1e-12);
    EXPECT_NEAR(distance(reading.velocity_mm_per_s, {0, -100, 0}), 0, 1e-12);
    EXPECT_EQ((*device)->write({1, 2, 3}), DeviceState::ready);
    EXPECT_EQ(driver.arm->force[0], -2);
    EXPECT_EQ(driver.arm->force[1], 1);
    EXPECT_EQ(driver.arm->force[2], 3);
    device->reset();
    EXPECT_EQ(driver.arm->force[2], 0);
    EXPECT_FALSE(driver.arm->forces_on);
}

TEST(ForceDimension, tells_codes_that_are_no_errors_from_those_that_are) {
    Driver driver(FAKE_DRD);
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value());
    driver.arm->error = 1;  // TIMEGUARD: too early
    EXPECT_EQ((*device)->write({0, 0, 1}), DeviceState::ready);
    driver.arm->error = 2;  // motor saturated: it gives what it can
    EXPECT_EQ((*device)->write({0, 0, 1}), DeviceState::ready);
    driver.arm->error = -1;
    haptics::HandReading reading;
    EXPECT_EQ((*device)->read(reading), DeviceState::silent);
    driver.arm->error = 0;
    EXPECT_EQ((*device)->read(reading), DeviceState::ready);
    driver.arm->open = false;  // unplugged
    for (int n = 0; n < 30; ++n) (*device)->read(reading);
    EXPECT_EQ((*device)->read(reading), DeviceState::gone);
    EXPECT_NE((*device)->trouble().find("not connected"), std::string::npos);
}

// An arm whose positions come and whose forces do not.
TEST(ForceDimension, refuses_while_no_force_is_taken_and_is_gone_where_that_goes_on) {
    Driver driver(FAKE_DRD);
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value());
    haptics::HandReading reading;
    const auto tick = [&] {
        EXPECT_EQ((*device)->read(reading), DeviceState::ready);
        return (*device)->write({0, 0, 1});
    };
    EXPECT_EQ(tick(), DeviceState::ready);
    EXPECT_EQ((*device)->trouble(), "");
    driver.arm->force_fails = 3;
    for (int n = 0; n < 3; ++n) EXPECT_EQ(tick(), DeviceState::refused);
    EXPECT_EQ(tick(), DeviceState::ready);
    EXPECT_NE((*device)->trouble().find("has not taken its forces"), std::string::npos);
    driver.arm->force_fails = 1000;
    DeviceState state = DeviceState::refused;
    for (int n = 0; n < 100 && state == DeviceState::refused; ++n) state = tick();
    EXPECT_EQ(state, DeviceState::gone);
    EXPECT_NE((*device)->trouble().find("has not taken its forces"), std::string::npos);
}

// As the SDK's own examples have it: open, look, and forces on when the loop begins; the watchdog, which is
// expert's, before them.
TEST(ForceDimension, calls_the_driver_as_the_vendors_examples_do) {
    Driver driver(FAKE_DRD);
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    EXPECT_FALSE(driver.arm->forces_on);
    haptics::HandReading reading;
    (*device)->read(reading);
    (*device)->write({});
    (*device)->read(reading);
    (*device)->write({0, 0, 1});
    EXPECT_EQ(driver.arm->watchdog, 40);
    EXPECT_TRUE(driver.arm->forces_on);
    EXPECT_EQ((*device)->trouble(), "");
    device->reset();
    const std::string read = "dhdGetPosition dhdGetLinearVelocity dhdGetOrientationFrame dhdGetButtonMask ";
    EXPECT_EQ(driver.arm->calls(),
              "dhdGetSDKVersion dhdOpen dhdGetStatus dhdGetSystemName dhdGetStatus " + read +
                  "dhdEnableExpertMode dhdSetWatchdog dhdDisableExpertMode dhdEnableForce dhdSetForce " +
                  read + "dhdSetForce dhdStop dhdClose");
    // 30 degrees about the arm's y, which is the stock's x: up from the user's side.
    EXPECT_NEAR(distance(reading.stylus, {0, -0.8660254037844387, -0.5}), 0, 1e-12);
}

// Commands go on while the arm gives no force: that is heard, mended, and in the end said.
TEST(ForceDimension, switches_on_again_what_its_watchdog_switched_off_and_gives_up_where_that_goes_on) {
    Driver driver(FAKE_DRD);
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value());
    const auto run = [&](int commands) {
        int refused = 0;
        for (int n = 0; n < commands; ++n) {
            const DeviceState state = (*device)->write({0, 0, 1});
            if (state == DeviceState::gone) return -1;
            refused += state == DeviceState::refused ? 1 : 0;
        }
        return refused;
    };
    EXPECT_EQ(run(200), 0);
    driver.arm->watchdog_fires = 1;
    EXPECT_GT(run(200), 0);
    EXPECT_TRUE(driver.arm->forces_on);
    EXPECT_EQ(run(200), 0);
    driver.arm->watchdog_fires = 1000;
    EXPECT_EQ(run(1002), -1);
    EXPECT_NE((*device)->trouble().find("by its watchdog"), std::string::npos) << (*device)->trouble();
}

TEST(ForceDimension, leaves_off_what_a_person_switched_off) {
    Driver driver(FAKE_DRD);
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    auto device = open_force_dimension(options);
    ASSERT_TRUE(device.has_value());
    (*device)->write({});
    driver.arm->forces_on = false;
    driver.arm->force_off_cause = 1;
    DeviceState state = DeviceState::ready;
    for (int n = 0; n < 1000; ++n) state = (*device)->write({0, 0, 1});
    EXPECT_EQ(state, DeviceState::refused);
    EXPECT_FALSE(driver.arm->forces_on);
    EXPECT_NE((*device)->trouble().find("force button"), std::string::npos);
    driver.arm->forces_on = true;
    driver.arm->force_off_cause = 0;
    for (int n = 0; n < 100; ++n) state = (*device)->write({0, 0, 1});
    EXPECT_EQ(state, DeviceState::ready);
    EXPECT_EQ((*device)->trouble(), "");
}

TEST(ForceDimension, refuses_an_arm_that_does_not_know_where_it_is) {
    Driver driver(FAKE_DRD);
    driver.arm->calibration = 1;
    ForceDimensionOptions options;
    options.driver = FAKE_DRD;
    const auto device = open_force_dimension(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("not calibrated"), std::string::npos);
    EXPECT_FALSE(driver.arm->open);
}

TEST(ForceDimension, says_what_to_do_where_there_is_no_driver_no_arm_or_another_version) {
    ForceDimensionOptions options;
    options.driver = "/nowhere/libdrd.so";
    EXPECT_FALSE(open_force_dimension(options).has_value());
    options.driver = FAKE_DRD_OLD;
    auto device = open_force_dimension(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("has no dhdSetWatchdog"), std::string::npos);
    Driver driver(FAKE_DRD);
    options.driver = FAKE_DRD;
    driver.arm->version = 2;
    device = open_force_dimension(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().cause.find("version 2.17"), std::string::npos);
    driver.arm->version = 3;
    driver.arm->plugged = false;
    device = open_force_dimension(options);
    ASSERT_FALSE(device.has_value());
    EXPECT_NE(device.error().remedy.find("1451"), std::string::npos);
}

}  // namespace
}  // namespace tribo::devices
