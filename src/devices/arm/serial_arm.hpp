// SPDX-License-Identifier: MIT
// An arm of one's own on a serial port: a HapKit, a paddle, three motors and a microcontroller. It speaks the
// packets of serial_packets.h; examples/serial_arm has a firmware.
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
    int baud = 1'000'000;   // of a true serial line, one of the usual rates; USB takes no notice
    int timeout_ms = 4000;  // for the arm's first line: opening a port resets many a board
    Mounting mounting;
};

// Read and written without waiting, on the servo's thread. The arm's own firmware lets go where no force came
// for 5 ms. Errors say what to do: no port, no rights, nobody who answers, another version.
Result<std::unique_ptr<haptics::Device>> open_serial_arm(const SerialArmOptions& options);

// The arm's first line. Facts that it leaves out stay as they are; one that is no number or out of range
// makes it an error.
struct SerialArmFacts {
    std::string name = "serial arm";
    haptics::DeviceLimits limits{"", 1, 0.3, 0.002, 0.01};
    double rate_hz = 1000;
};
Result<SerialArmFacts> read_serial_arm_facts(std::string_view line);

}  // namespace tribo::devices
