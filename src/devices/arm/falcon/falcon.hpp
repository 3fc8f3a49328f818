// SPDX-License-Identifier: MIT
// Novint Falcon on USB, without a driver of the vendor: libusb, loaded at run time, and the protocol that
// libnifalcon documents. The Falcon needs a firmware after each power-up. Tribo has none: the user names a
// file (firmware of the vendor, for example novint.bin of libnifalcon).
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct FalconOptions {
    std::string firmware;   // file; empty: works if another program has loaded one since power-up
    std::string libusb;     // path; empty: libusb-1.0.so.0 in the loader path
    int homing_ms = 15000;  // time for the hand to home the encoders
    Mounting mounting;      // the zero of the arm is the middle of its workspace
};

// Loads the firmware if the Falcon has none; a failed load is repeated, up to 10 times. Then the hand must
// pull the grip out as far as it goes and push it in, while the lights are red: this homes the encoders.
// Afterwards the lights are green. A separate thread exchanges packets: it sends the newest force of the
// servo, or zero if the servo has been silent for 5 ms.
//
// Errors give a remedy: no libusb, not plugged in, no rights, no firmware, damaged firmware file, not homed.
Result<std::unique_ptr<haptics::Device>> open_falcon(const FalconOptions& options);

}  // namespace tribo::devices
