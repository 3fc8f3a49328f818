// SPDX-License-Identifier: MIT
// Force Dimension arms (omega, delta, sigma, lambda) and Novint Falcon through libdrd or libdhd, loaded while
// the program runs (interface of the SDK 3.17; only its types and constants are written here).
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct ForceDimensionOptions {
    std::string driver;  // path; empty: libdrd.so.3, libdrd.so, libdhd.so.3, libdhd.so where the loader looks
    Mounting mounting;
};

// Motors are switched on with the first command, behind the firmware's own watchdog of 5 ms. Where that
// fires, they are switched on again up to three times, then the arm is gone; where a person or the arm's own
// safety has switched them off, the arm refuses until they are on again. The errors say what to do: driver
// missing, wrong version, unplugged, no rights, not calibrated.
Result<std::unique_ptr<haptics::Device>> open_force_dimension(const ForceDimensionOptions& options);

}  // namespace tribo::devices
