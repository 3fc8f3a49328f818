// SPDX-License-Identifier: MIT
// Haply Inverse3 through its local service (Inverse Service 3.1 and later: JSON over a WebSocket on port
// 10001). Messages as in the tutorials of Haply's Inverse SDK 3.5.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct HaplyOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 10001;
    int timeout_ms = 5000;  // for the first state
    Mounting mounting;
};

// The service answers each message with the next state. The first message asks for the preset
// "arm_front_centered": the zero of the arm is then the middle of its reach. Afterwards a separate thread
// sends the newest force of the servo (zero after 5 ms without one) and receives the state. After 1 s without
// a position, or when the connection closes, the arm is gone. The servo exchanges both through snapshots.
// Errors give a remedy: no service, no arm, not calibrated, another version.
Result<std::unique_ptr<haptics::Device>> open_haply(const HaplyOptions& options);

// Reads one message of the service. A known `id` is kept. False if the message has no position of an
// Inverse3.
struct HaplyState {
    std::string id;
    std::string model;         // inverse3, inverse3x, minverse: only in the first message
    bool has_presets = false;  // version 3.5 or later; known from the first message
    bool calibrated = true;
    Vec3 position_m, velocity_m_per_s;
    unsigned buttons = 0;
    Vec3 stylus{0, 0, 1};
};
bool read_haply_state(std::string_view json, HaplyState& state);
// The messages of a client; their form depends on `has_presets`.
std::string haply_hello(const HaplyState& state);
std::string haply_force_command(const HaplyState& state, Vec3 force_n);

}  // namespace tribo::devices
