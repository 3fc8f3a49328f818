// SPDX-License-Identifier: MIT
// Packets of a Novint Falcon with the firmware of the vendor: 16 bytes each way, in letters (protocol as
// documented by libnifalcon, FalconFirmwareNovintSDK).
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace tribo::devices::falcon {

inline constexpr std::size_t kPacketBytes = 16;
using Packet = std::array<std::uint8_t, kPacketBytes>;

// Lights of the grip's housing.
enum Light : std::uint8_t { kGreen = 2, kBlue = 4, kRed = 8 };

// Packet to the Falcon: '<', 4 letters per motor, lights and homing, a letter without meaning, '>'. A letter
// is 'A' plus 4 bits; the lowest bits come first. `homing`: the encoders are set to zero at the end of their
// way.
Packet command(const std::array<int, 3>& motors, std::uint8_t lights, bool homing);

struct State {
    std::array<int, 3> counts{};  // of the encoders, -32768 to 32767
    unsigned buttons = 0;         // 4 bits
    bool homed = false;           // all three encoders
};

// Takes packets out of a stream of bytes. Shorter and longer ones, and packets with other letters, are
// dropped. No allocation.
class StateReader {
  public:
    // Returns true if a whole packet ended in `bytes`; state() is the last one.
    bool take(std::span<const std::uint8_t> bytes);
    const State& state() const { return state_; }

  private:
    bool finish();
    Packet packet_{};
    std::size_t count_ = 0;  // bytes of packet_
    State state_;
};

}  // namespace tribo::devices::falcon
