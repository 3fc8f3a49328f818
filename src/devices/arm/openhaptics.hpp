// SPDX-License-Identifier: MIT
// 3D Systems arms (Touch, Touch X, Phantom) through the HD layer of OpenHaptics, libHD.so, loaded at run time
// (OpenHaptics API reference 3.5; this code declares only the types and constants it needs).
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

struct OpenHapticsOptions {
    std::string driver;                     // path; empty: libHD.so and libHD.so.3 in the loader path
    std::string device = "Default Device";  // name in the vendor's set-up; not empty (NULL in HD
                                            // failed for many users)
    Mounting mounting;
};

// HD allows forces only in the callback of its own scheduler. The callback exchanges readings and forces with
// the servo through snapshots. It sends zero after 5 ms without a new force.
// Errors give a remedy: driver missing, wrong version, unplugged, not calibrated.
Result<std::unique_ptr<haptics::Device>> open_openhaptics(const OpenHapticsOptions& options);

}  // namespace tribo::devices
