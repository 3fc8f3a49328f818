// SPDX-License-Identifier: MIT
// Haply Inverse3 through its local service (Inverse Service 3.5 and later: JSON over a WebSocket on port
// 10001).
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

// The service answers each command with the next state. A separate thread sends the newest force of the servo
// (zero after 5 ms without one) and receives the state. The servo exchanges both through snapshots. Errors
// give a remedy: no service, no arm, another version.
Result<std::unique_ptr<haptics::Device>> open_haply(const HaplyOptions& options);

// Reads one message of the service. A known `id` is kept. False if the message has no position of an
// Inverse3.
struct HaplyState {
    std::string id;
    Vec3 position_m, velocity_m_per_s;
    unsigned buttons = 0;
    Vec3 stylus{0, 0, 1};
};
bool read_haply_state(std::string_view json, HaplyState& state);
std::string haply_force_command(const std::string& id, Vec3 force_n);

}  // namespace tribo::devices
