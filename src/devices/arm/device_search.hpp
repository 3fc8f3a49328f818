// SPDX-License-Identifier: MIT
// Which arms there are, and for those there are not: what was looked for, where, and what to do.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "devices/arm/mounting.hpp"
#include "haptics/device/device.hpp"

namespace tribo::devices {

// openhaptics, forcedimension, haply, serial: the words that open_arm() takes.
const std::vector<std::string>& arm_names();

// Opens an arm by its word, for OpenHaptics also with the name that the vendor's set-up gave it
// ("openhaptics:Left Device"), for a serial arm with its port ("serial:/dev/ttyACM0@115200"); "auto": the
// first that opens. The error of an unknown word names the known ones.
Result<std::unique_ptr<haptics::Device>> open_arm(const std::string& name, const Mounting& mounting);

struct ArmReport {
    std::string name, makes;  // the word, and whose arms it drives
    bool available = false;
    std::string model;               // where it is available
    haptics::DeviceLimits limits;    // likewise; its name is empty
    std::string problem, remedy;     // where it is not
    std::vector<std::string> ports;  // device files that look like an arm's, with what is wrong with them
};

// Opens and closes each in turn. Takes up to a few seconds; not while one is in use.
std::vector<ArmReport> search_arms();

}  // namespace tribo::devices
