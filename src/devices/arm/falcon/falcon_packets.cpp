// SPDX-License-Identifier: MIT
#include "devices/arm/falcon/falcon_packets.hpp"

namespace tribo::devices::falcon {
namespace {

constexpr std::uint8_t kBegin = '<', kEnd = '>', kLetter = 'A';
constexpr std::size_t kLettersPerMotor = 4, kStatus = 13;  // place of lights, homing, buttons
constexpr unsigned kHoming = 1, kAllHomed = 7;

}  // namespace

Packet command(const std::array<int, 3>& motors, std::uint8_t lights, bool homing) {
    Packet packet;
    packet.fill(kLetter);
    packet.front() = kBegin;
    packet.back() = kEnd;
    for (std::size_t motor = 0; motor < 3; ++motor) {
        const auto bits = static_cast<std::uint16_t>(motors[motor]);
        for (std::size_t n = 0; n < kLettersPerMotor; ++n) {
            const unsigned four = (bits >> (4 * n)) & 15U;
            packet[1 + kLettersPerMotor * motor + n] = static_cast<std::uint8_t>(kLetter + four);
        }
    }
    packet[kStatus] = static_cast<std::uint8_t>(kLetter + (lights | (homing ? kHoming : 0U)));
    return packet;
}

bool StateReader::take(std::span<const std::uint8_t> bytes) {
    bool any = false;
    for (const std::uint8_t byte : bytes) {
        if (byte == kBegin) count_ = 0;
        if (byte != kBegin && count_ == 0) continue;  // the rest of a packet that was dropped
        packet_[count_++] = byte;
        if (byte == kEnd) {
            any = (count_ == kPacketBytes && finish()) || any;
            count_ = 0;
        } else if (count_ == kPacketBytes) {
            count_ = 0;
        }
    }
    return any;
}

bool StateReader::finish() {
    State state;
    for (std::size_t motor = 0; motor < 3; ++motor) {
        unsigned bits = 0;
        for (std::size_t n = 0; n < kLettersPerMotor; ++n) {
            const unsigned four = packet_[1 + kLettersPerMotor * motor + n] - unsigned{kLetter};
            if (four > 15) return false;
            bits |= four << (4 * n);
        }
        state.counts[motor] = static_cast<std::int16_t>(bits);
    }
    const unsigned status = packet_[kStatus] - unsigned{kLetter};
    if (status > 127) return false;
    state.buttons = status & 15U;
    state.homed = (status >> 4) == kAllHomed;
    state_ = state;
    return true;
}

}  // namespace tribo::devices::falcon
