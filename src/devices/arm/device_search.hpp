// SPDX-License-Identifier: MIT
// Search for haptic arms. For a missing arm the report says what was searched, where, and the remedy.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

// openhaptics, forcedimension, haply, falcon, serial: the words that open_arm() takes.
const std::vector<std::string>& arm_names();

// Opens an arm by its name in arm_names(). OpenHaptics also accepts the device name of the vendor's set-up
// ("openhaptics:Left Device"). A Falcon takes a firmware file ("falcon:novint.bin"). A serial arm needs its
// port ("serial:/dev/ttyACM0@115200"). "auto" opens the first available arm. The error of an unknown name
// lists the known names.
// True for `auto` and the names of arms, also with a detail behind them: serial:/dev/ttyACM0.
bool is_arm(const std::string& name);
Result<std::unique_ptr<haptics::Device>> open_arm(const std::string& name, const Mounting& mounting);

struct ArmReport {
    std::string name, makes;  // name for open_arm(), and the supported makes
    bool available = false;
    std::string model;               // of an available arm
    haptics::DeviceLimits limits;    // of an available arm; its name is empty
    std::string problem, remedy;     // of an unavailable arm
    std::vector<std::string> ports;  // device files that may belong to an arm, with their problems
};

// Opens and closes each arm in turn. Takes up to a few seconds. No arm may be in use.
std::vector<ArmReport> search_arms();

}  // namespace tribo::devices
