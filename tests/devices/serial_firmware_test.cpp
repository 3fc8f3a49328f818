// SPDX-License-Identifier: MIT
// The firmware of examples/serial_arm on a board of which only pins, clock and port are there.
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <gtest/gtest.h>

#include "devices/serial_packets.h"

namespace tribo::devices {
namespace {

class HapKit {
  public:
    HapKit() { setup(); }
    // A tick of 1 ms of the board.
    void tick() {
        now_us_ += 1000;
        loop();
    }
    void receive(std::uint8_t byte) { Serial.in.push_back(byte); }
    // Of 255.
    int power() const { return power_; }

  private:
    struct SerialPort {
        std::deque<std::uint8_t> in;
        void begin(long) {}
        int available() const { return static_cast<int>(in.size()); }
        int read() {
            const int byte = in.front();
            in.pop_front();
            return byte;
        }
        void println(const char*) {}
        void write(const std::uint8_t*, int) {}
    };
    SerialPort Serial;
    unsigned long now_us_ = 0;
    int power_ = -1;

    static constexpr int OUTPUT = 1, HIGH = 1, LOW = 0, A2 = 2;
    unsigned long micros() const { return now_us_; }
    static void pinMode(int, int) {}
    static void digitalWrite(int, int) {}
    void analogWrite(int, int value) { power_ = value; }
    static int analogRead(int) { return 360; }
    static const char* F(const char* text) { return text; }
#include <serial_arm.ino>
};

// The same force in every packet, as of a hand that rests on a wall. Its bytes may hold the mark a second
// time.
TEST(SerialFirmware, has_the_force_again_after_any_lost_byte) {
    for (int mn = 20; mn < 4000; ++mn) {
        const tribo_force_mn force{{0, 0, static_cast<std::int16_t>(mn)}};
        std::array<std::uint8_t, TRIBO_FORCE_BYTES> packet;
        tribo_write_force(&force, packet.data());
        for (std::size_t lost = 0; lost < packet.size(); ++lost) {
            HapKit board;
            for (int n = 0; n < 12; ++n) {
                for (std::size_t at = 0; at < packet.size(); ++at) {
                    if (n != 1 || at != lost) board.receive(packet[at]);
                }
                board.tick();
            }
            // 4 N are full power.
            ASSERT_EQ(board.power(), 255 * mn / 4000) << mn << " mN, byte " << lost;
        }
    }
}

TEST(SerialFirmware, lets_go_after_5_ms_without_a_force) {
    const tribo_force_mn force{{0, 0, 2000}};
    std::array<std::uint8_t, TRIBO_FORCE_BYTES> packet;
    tribo_write_force(&force, packet.data());
    HapKit board;
    for (const std::uint8_t byte : packet) board.receive(byte);
    board.tick();
    for (int n = 0; n < 5; ++n) board.tick();
    EXPECT_EQ(board.power(), 127);
    board.tick();
    EXPECT_EQ(board.power(), 0);
}

}  // namespace
}  // namespace tribo::devices
