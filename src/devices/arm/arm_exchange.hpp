// SPDX-License-Identifier: MIT
// What the servo exchanges with an arm that has a thread of its own. Real-time safe on both sides.
#pragma once

#include <cstdint>

#include "base/hand_over.hpp"
#include "devices/servo/tick_clock.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

// The force that the servo asks for, in the axes of the arm. A servo that is silent for 5 ms asks for none.
class ForceCommand {
  public:
    // Servo.
    void send(Vec3 force_n) noexcept {
        newest_.back() = {force_n, wall_ns()};
        newest_.publish();
    }
    // Thread of the arm.
    Vec3 force_n() noexcept {
        const Sent& sent = newest_.read();
        return wall_ns() - sent.ns < kSilentNs ? sent.force_n : Vec3{};
    }

  private:
    static constexpr std::uint64_t kSilentNs = 5'000'000;
    struct Sent {
        Vec3 force_n;
        std::uint64_t ns = 0;
    };
    Snapshot<Sent> newest_;
};

// Copies what the thread of the arm read last. Silent: nothing new since `reading`.
inline haptics::DeviceState take_newest(Snapshot<haptics::HandReading>& readings,
                                        haptics::HandReading& reading) noexcept {
    const haptics::HandReading& newest = readings.read();
    if (newest.sequence == reading.sequence) return haptics::DeviceState::silent;
    reading = newest;
    return haptics::DeviceState::ready;
}

}  // namespace tribo::devices
