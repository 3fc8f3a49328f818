// SPDX-License-Identifier: MIT
// Force Dimension arms (omega, delta, sigma, lambda) and Novint Falcon through libdrd or libdhd, loaded at
// run time (interface of SDK 3.17; this code declares only the types and constants it needs).
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct ForceDimensionOptions {
    std::string driver;  // path; empty: libdrd.so.3, libdrd.so, libdhd.so.3, libdhd.so in the loader path
    Mounting mounting;
};

// The first command switches the motors on, with a watchdog of 5 ms in the firmware. After a watchdog stop
// the motors are switched on again, up to three times; then the arm is gone. If a person or the safety of the
// arm has switched them off, the arm refuses until they are on again. Errors give a remedy: driver missing,
// wrong version, unplugged, no rights, not calibrated.
Result<std::unique_ptr<haptics::Device>> open_force_dimension(const ForceDimensionOptions& options);

}  // namespace tribo::devices
