// SPDX-License-Identifier: MIT
// 3D Systems arms (Touch, Touch X, Phantom) through OpenHaptics' HD layer, libHD.so, loaded while the program
// runs (OpenHaptics API reference 3.5; only the types and constants of its interface are written here).
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct OpenHapticsOptions {
    std::string driver;                     // path; empty: libHD.so and libHD.so.3 where the loader looks
    std::string device = "Default Device";  // as the vendor's set-up named it; never empty (HD's NULL
                                            // failed for many)
    Mounting mounting;
};

// HD allows forces only in its own scheduler's callback: that exchanges the newest reading and force with the
// servo through snapshots, and sends zero itself where the servo has been silent for 5 ms.
// The errors say what to do: driver missing, wrong version, unplugged, not calibrated.
Result<std::unique_ptr<haptics::Device>> open_openhaptics(const OpenHapticsOptions& options);

}  // namespace tribo::devices
