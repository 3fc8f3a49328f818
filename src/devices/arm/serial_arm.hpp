// SPDX-License-Identifier: MIT
// A self-made arm on a serial port, such as a HapKit. It uses the packets of serial_packets.h;
// examples/serial_arm has a firmware.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct SerialArmOptions {
    std::string port;       // /dev/ttyACM0
    int baud = 1'000'000;   // a standard rate of a real serial line; no more forces are sent than it carries
    int timeout_ms = 4000;  // for the first line of the arm (opening a port resets many boards), then for its
                            // first position
    Mounting mounting;
};

// Reads and writes on the servo thread, without waiting. A force that would have to wait for the line is
// left out, and the next one is newer. After 5 ms without one the arm refuses. After 1 s without a position
// the arm is gone. The firmware of the arm switches the force off after 5 ms without a force packet. Errors
// give a remedy: no port, no rights, no answer, another version, no position.
Result<std::unique_ptr<haptics::Device>> open_serial_arm(const SerialArmOptions& options);

// The first line of the arm. Missing values keep their defaults. A value that is no number or out of range is
// an error, which names the range.
struct SerialArmFacts {
    std::string name = "serial arm";
    haptics::DeviceLimits limits{"", 1, 0.3, 0.002, 0.01};
    double rate_hz = 1000;  // of its positions, 500 to 20,000: the servo bears no longer silence
};
Result<SerialArmFacts> read_serial_arm_facts(std::string_view line);

}  // namespace tribo::devices
