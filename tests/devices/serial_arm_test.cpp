// SPDX-License-Identifier: MIT
// An arm at the other end of a pseudo-terminal, which speaks by the header that a firmware includes.
#include "devices/arm/serial_arm.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>
#include <unistd.h>

#include "base/noise_hash.hpp"
#include "devices/serial_packets.h"

namespace tribo::devices {
namespace {

using haptics::DeviceState;

class FakeBoard {
  public:
    explicit FakeBoard(std::string hello) : hello_(std::move(hello)) {
        handle_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
        EXPECT_GE(handle_, 0);
        EXPECT_EQ(::grantpt(handle_), 0);
        EXPECT_EQ(::unlockpt(handle_), 0);
        char name[100];
        EXPECT_EQ(::ptsname_r(handle_, name, sizeof name), 0);
        port = name;
        thread_ = std::thread([this] { run(); });
    }
    ~FakeBoard() { unplug(); }
    void unplug() {
        over_ = true;
        if (thread_.joinable()) thread_.join();
        if (handle_ >= 0) ::close(handle_);
        handle_ = -1;
    }

    std::string port;
    std::atomic<int> step[3] = {0, 0, 0};
    std::atomic<int> mn[3] = {0, 0, 0};
    std::atomic<int> moving{0};     // steps of x a tick
    std::atomic<int> missed{0};     // so many of the next positions get lost
    std::atomic<bool> mute{false};  // sends nothing
    std::atomic<bool> noisy{false};
    std::atomic<bool> deaf{false};           // leaves what comes in the port
    std::atomic<int> forces{0}, damaged{0};  // packets that have come

  private:
    void run() {
        std::array<std::uint8_t, 256> bytes{};
        std::vector<std::uint8_t> held;
        tribo_place place{};
        CounterNoise noise(3);
        std::uint64_t drawn = 0;
        bool asked = false;
        while (!over_) {
            const ssize_t count = deaf ? 0 : ::read(handle_, bytes.data(), bytes.size());
            for (ssize_t n = 0; n < count; ++n) {
                if (bytes[static_cast<std::size_t>(n)] == TRIBO_ARM_ASK && !asked) {
                    asked = true;
                    const std::string text = "Starting...\r\n" + hello_ + "\r\n";
                    (void)!::write(handle_, text.data(), text.size());
                    continue;
                }
                held.push_back(bytes[static_cast<std::size_t>(n)]);
                if (held.front() != TRIBO_FORCE_MARK) held.clear();
                if (held.size() < TRIBO_FORCE_BYTES) continue;
                tribo_force_mn force;
                const bool good = tribo_read_force(held.data(), &force) != 0;
                ++(good ? forces : damaged);
                for (int i = 0; good && i < 3; ++i) mn[i] = force.mn[i];
                held.clear();
            }
            if (asked && !mute) {
                ++place.sequence;
                step[0] += moving;
                for (int i = 0; i < 3; ++i) place.step[i] = static_cast<std::int16_t>(step[i].load());
                place.buttons = 2;
                if (missed > 0) {
                    --missed;
                    std::this_thread::sleep_for(std::chrono::milliseconds(1));
                    continue;
                }
                std::array<std::uint8_t, TRIBO_PLACE_BYTES> packet;
                tribo_write_place(&place, packet.data());
                std::size_t size = packet.size();
                if (noisy) {
                    // A byte that is wrong, one that is lost, or half of the mark's byte by chance.
                    const auto what = noise.bits(drawn++) % 4;
                    if (what == 0) packet[noise.bits(drawn++) % size] ^= 0x40;
                    if (what == 1) --size;
                    const std::uint8_t mark = TRIBO_PLACE_MARK;
                    if (what == 2) (void)!::write(handle_, &mark, 1);
                }
                (void)!::write(handle_, packet.data(), size);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    std::string hello_;
    int handle_ = -1;
    std::atomic<bool> over_{false};
    std::thread thread_;
};

constexpr const char* kHello =
    "tribo-arm 1;name=Paddle;max_n=3;max_n_per_mm=0.4;max_ns_per_mm=0.001;resolution_mm=0.02;rate_hz=500";

std::unique_ptr<haptics::Device> opened(const FakeBoard& board, Mounting mounting = {}) {
    SerialArmOptions options;
    options.port = board.port;
    options.mounting = mounting;
    auto device = open_serial_arm(options);
    EXPECT_TRUE(device.has_value()) << (device ? "" : device.error().text());
    return device ? std::move(*device) : nullptr;
}

template <class Done>
bool read_until(haptics::Device& device, haptics::HandReading& reading, const Done& done) {
    for (int n = 0; n < 3000; ++n) {
        if (device.read(reading) == DeviceState::ready && done()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

TEST(SerialArm, says_what_it_can_where_the_hand_is_and_gets_its_force) {
    FakeBoard board(kHello);
    board.step[0] = 100;
    board.step[1] = -50;
    board.step[2] = 32767;
    auto device = opened(board, {{1, 2, 3}, 2});
    ASSERT_NE(device, nullptr);
    EXPECT_EQ(device->limits().name, "Paddle");
    EXPECT_EQ(device->limits().max_force_n, 3);
    // Two millimetres of the stock are one of the hand.
    EXPECT_EQ(device->limits().resolution_mm, 0.04);
    EXPECT_EQ(device->limits().max_stiffness_n_per_mm, 0.2);
    EXPECT_EQ(device->limits().max_damping_n_s_per_mm, 0.0005);
    haptics::HandReading reading;
    ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
    EXPECT_NEAR(distance(reading.position_mm, {1 + 4, 2 - 2, 3 + 2 * 655.34}), 0, 1e-9);
    EXPECT_EQ(reading.buttons, 2U);
    ASSERT_TRUE(read_until(*device, reading, [&] {
        device->write({0.5, -1.25, 99});
        return board.mn[0] == 500;
    }));
    EXPECT_EQ(board.mn[1], -1250);
    EXPECT_EQ(board.mn[2], 32767);
    device.reset();
    for (int n = 0; n < 2000 && board.mn[2] != 0; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(board.mn[2], 0);
}

TEST(SerialArm, takes_the_speed_from_the_arms_own_ticks) {
    FakeBoard board(kHello);
    board.moving = 5;  // 0.1 mm a tick of 2 ms
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    haptics::HandReading reading;
    int ready = 0;
    ASSERT_TRUE(read_until(*device, reading, [&] { return ++ready > 50; }));
    EXPECT_NEAR(reading.velocity_mm_per_s.x, 50, 1e-6);
}

// The numbers of the positions go round after 256: then two positions far apart would seem to be neighbours.
TEST(SerialArm, knows_no_speed_over_a_gap_in_which_the_numbers_go_round) {
    FakeBoard board(kHello);
    board.moving = 5;
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    haptics::HandReading reading;
    for (const int missed : {3, 200, 250, 255, 511}) {
        int ready = 0;
        ASSERT_TRUE(read_until(*device, reading, [&] { return ++ready > 20; }));
        EXPECT_NEAR(reading.velocity_mm_per_s.x, 50, 1e-6);
        board.missed = missed;
        while (board.missed > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        for (int n = 0; n < 20; ++n) {
            ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
            if (reading.velocity_mm_per_s.x != 0) {
                ASSERT_NEAR(reading.velocity_mm_per_s.x, 50, 1e-6) << missed;
            }
        }
    }
}

TEST(SerialArm, finds_the_next_packet_behind_a_damaged_one) {
    FakeBoard board(kHello);
    board.step[0] = 1234;
    board.noisy = true;
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    haptics::HandReading reading;
    for (int n = 0; n < 300; ++n) {
        ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
        ASSERT_NEAR(reading.position_mm.x, 24.68, 1e-9);
    }
}

// A byte has ten bits on the line, and no force waits for longer than a packet takes there.
TEST(SerialArm, leaves_out_the_forces_that_its_line_cannot_carry) {
    FakeBoard board(kHello);
    SerialArmOptions options;
    options.port = board.port;
    options.baud = 115'200;
    auto device = open_serial_arm(options);
    ASSERT_TRUE(device.has_value()) << device.error().text();
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    while (seconds() < 0.3) (*device)->write({0, 0, 1});
    EXPECT_NE((*device)->trouble().find("baud"), std::string::npos);
    device->reset();
    const double carried = 115'200 * seconds() / (10 * TRIBO_FORCE_BYTES);
    for (int n = 0; n < 2000 && board.mn[2] != 0; ++n)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(board.mn[2], 0);
    // One is under way at the end, one waits.
    EXPECT_LE(board.forces, carried + 2);
}

TEST(SerialArm, sends_all_forces_or_none_of_their_bytes_and_refuses_while_none_go_out) {
    FakeBoard board(kHello);
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    for (int n = 0; n < 250; ++n) {
        EXPECT_EQ(device->write({0, 0, 1}), DeviceState::ready);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(device->trouble(), "");
    board.deaf = true;
    DeviceState state = DeviceState::ready;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (state == DeviceState::ready && std::chrono::steady_clock::now() < end)
        state = device->write({0, 0, 1});
    EXPECT_EQ(state, DeviceState::refused);
    board.deaf = false;
    ASSERT_TRUE([&] {
        for (int n = 0; n < 3000 && board.mn[2] != 2000; ++n) {
            state = device->write({0, 0, 2});
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return board.mn[2] == 2000;
    }());
    EXPECT_EQ(state, DeviceState::ready);
    EXPECT_EQ(board.damaged, 0);
}

TEST(SerialArm, is_gone_where_its_port_closes) {
    FakeBoard board(kHello);
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    haptics::HandReading reading;
    ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
    board.unplug();
    DeviceState state = DeviceState::ready;
    for (int n = 0; n < 100 && state != DeviceState::gone; ++n) state = device->read(reading);
    EXPECT_EQ(state, DeviceState::gone);
    EXPECT_NE(device->trouble().find("gone"), std::string::npos);
}

TEST(SerialArm, is_gone_where_it_sends_nothing_for_a_second) {
    FakeBoard board(kHello);
    auto device = opened(board);
    ASSERT_NE(device, nullptr);
    haptics::HandReading reading;
    ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
    // Half of that is bearable.
    board.mute = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    (void)device->read(reading);
    EXPECT_EQ(device->read(reading), DeviceState::silent);
    board.mute = false;
    ASSERT_TRUE(read_until(*device, reading, [] { return true; }));
    board.mute = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    (void)device->read(reading);  // what had come before
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_EQ(device->read(reading), DeviceState::gone);
    EXPECT_NE(device->trouble().find("no position has come for 1 s"), std::string::npos) << device->trouble();
    board.mute = false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(device->read(reading), DeviceState::gone);  // for good
    EXPECT_EQ(device->write({1, 0, 0}), DeviceState::gone);
}

TEST(SerialArm, says_what_to_do_where_there_is_no_port_no_arm_or_nonsense) {
    SerialArmOptions options;
    EXPECT_NE(open_serial_arm(options).error().remedy.find("serial:/dev/"), std::string::npos);
    options.port = "/dev/no-such-port";
    EXPECT_NE(open_serial_arm(options).error().cause.find("/dev/no-such-port"), std::string::npos);
    options.port = "/dev/null";
    EXPECT_NE(open_serial_arm(options).error().cause.find("not a serial port"), std::string::npos);
    options.baud = 123'456;
    EXPECT_NE(open_serial_arm(options).error().cause.find("123456 baud"), std::string::npos);
    options.baud = 1'000'000;
    FakeBoard silent("ok M105");
    options.port = silent.port;
    options.timeout_ms = 300;
    EXPECT_NE(open_serial_arm(options).error().cause.find("nobody"), std::string::npos);
    FakeBoard newer("tribo-arm 2;name=X");
    options.port = newer.port;
    EXPECT_NE(open_serial_arm(options).error().cause.find("answers 'tribo-arm 2;name=X'"), std::string::npos);
    FakeBoard mute(kHello);
    mute.missed = 1'000'000;
    options.port = mute.port;
    EXPECT_NE(open_serial_arm(options).error().cause.find("sends no position"), std::string::npos);
    for (const char* line :
         {"tribo-arm 2;", "", "tribo-arm 1;max_n=x", "tribo-arm 1;max_n=-3", "tribo-arm 1;max_n=nan",
          "tribo-arm 1;rate_hz=1e9", "tribo-arm 1;resolution_mm="})
        EXPECT_FALSE(read_serial_arm_facts(line).has_value()) << line;
    EXPECT_EQ(read_serial_arm_facts("tribo-arm 1;rate_hz=499").error().cause,
              "the arm says 'rate_hz=499': rate_hz is a number from 500 to 20000");
    EXPECT_EQ(read_serial_arm_facts("tribo-arm 1;rate_hz=500").value().rate_hz, 500);
    const auto plain = read_serial_arm_facts(
        "tribo-arm 1;name=\x01"
        "a;what=ever;;max_n=2\r");
    EXPECT_FALSE(plain.has_value());
    const auto good = read_serial_arm_facts(
        "tribo-arm 1;name=\x01"
        "a;what=ever;;max_n=2");
    ASSERT_TRUE(good.has_value());
    EXPECT_EQ(good->name, "?a");
}

}  // namespace
}  // namespace tribo::devices
