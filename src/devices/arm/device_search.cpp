// SPDX-License-Identifier: MIT
#include "devices/arm/device_search.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

#include "devices/arm/falcon/falcon.hpp"
#include "devices/arm/force_dimension.hpp"
#include "devices/arm/haply.hpp"
#include "devices/arm/openhaptics.hpp"
#include "devices/arm/serial_arm.hpp"

namespace tribo::devices {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOpenHaptics = "openhaptics";
constexpr const char* kForceDimension = "forcedimension";
constexpr const char* kHaply = "haply";
constexpr const char* kFalcon = "falcon";
constexpr const char* kSerial = "serial";

// Time for the service of an Inverse3, and for a person who homes a Falcon.
struct Patience {
    int haply_ms = HaplyOptions{}.timeout_ms, homing_ms = FalconOptions{}.homing_ms;
};
constexpr int kHaplySearchMs = 1000;

// A Touch is a serial port or, in newer versions, a raw HID device.
std::vector<std::string> touch_ports() {
    std::vector<std::string> ports;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator("/dev", error)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("ttyACM") && !name.starts_with("hidraw")) continue;
        const bool ours = ::access(entry.path().c_str(), R_OK | W_OK) == 0;
        ports.push_back(entry.path().string() +
                        (ours ? "" : ": no right to read and write it; add a udev rule"));
    }
    if (ports.empty()) ports.emplace_back("/dev: neither ttyACM* nor hidraw*: no Touch is plugged in");
    return ports;
}

const char* makes(const std::string& name) {
    if (name == kOpenHaptics) return "3D Systems Touch, Touch X, Phantom";
    if (name == kForceDimension) return "Force Dimension omega, delta, sigma, lambda; Novint Falcon";
    if (name == kFalcon) return "Novint Falcon";
    if (name == kSerial) return "HapKit and others with a firmware like examples/serial_arm";
    return "Haply Inverse3";
}

// What stands behind the first colon of a name; empty if there is none.
std::string detail_of(const std::string& name) {
    const std::size_t colon = name.find(':');
    return colon == std::string::npos ? std::string() : name.substr(colon + 1);
}

bool may_be_named(const std::string& arm) {
    return arm == kOpenHaptics || arm == kFalcon || arm == kSerial;
}

// serial:/dev/ttyACM0@115200
SerialArmOptions serial_options(const std::string& name, const Mounting& mounting) {
    SerialArmOptions options;
    options.mounting = mounting;
    options.port = detail_of(name);
    if (const std::size_t at = options.port.rfind('@'); at != std::string::npos) {
        options.baud = std::atoi(options.port.c_str() + at + 1);
        options.port.resize(at);
    }
    return options;
}

Result<std::unique_ptr<haptics::Device>> open_one(const std::string& name, const Mounting& mounting,
                                                  const Patience& patience) {
    if (name.starts_with(kOpenHaptics)) {
        OpenHapticsOptions options;
        options.mounting = mounting;
        options.device = detail_of(name);
        return open_openhaptics(options);
    }
    if (name.starts_with(kFalcon)) {
        FalconOptions options;
        options.mounting = mounting;
        options.firmware = detail_of(name);
        options.homing_ms = patience.homing_ms;
        return open_falcon(options);
    }
    if (name == kForceDimension) {
        ForceDimensionOptions options;
        options.mounting = mounting;
        return open_force_dimension(options);
    }
    if (name.starts_with(kSerial)) return open_serial_arm(serial_options(name, mounting));
    HaplyOptions options;
    options.mounting = mounting;
    options.timeout_ms = patience.haply_ms;
    return open_haply(options);
}

}  // namespace

const std::vector<std::string>& arm_names() {
    static const std::vector<std::string> names{kOpenHaptics, kForceDimension, kHaply, kFalcon, kSerial};
    return names;
}

bool is_arm(const std::string& name) {
    return name == "auto" || std::ranges::any_of(arm_names(), [&](const std::string& each) {
               return each == name || (may_be_named(each) && name.starts_with(each + ":"));
           });
}

Result<std::unique_ptr<haptics::Device>> open_arm(const std::string& name, const Mounting& mounting) {
    assert(is_arm(name));
    if (name == "auto") {
        for (const std::string& each : arm_names()) {
            // Other devices on serial ports are not opened.
            if (each == kSerial) continue;
            if (auto device = open_one(each, mounting, {.haply_ms = kHaplySearchMs})) return device;
        }
        return fail("no haptic arm was found", "run 'tribo devices' to see why, or use --device simulated");
    }
    return open_one(name, mounting, {});
}

std::vector<ArmReport> search_arms() {
    std::vector<ArmReport> reports;
    for (const std::string& name : arm_names()) {
        ArmReport report;
        report.name = name;
        report.makes = makes(name);
        if (auto device = open_one(name, {}, {kHaplySearchMs, 0})) {
            report.available = true;
            report.limits = (*device)->limits();
            report.model = std::string(report.limits.name);
            report.limits.name = {};
        } else {
            report.problem = device.error().cause;
            report.remedy = device.error().remedy;
            if (name == kOpenHaptics) report.ports = touch_ports();
        }
        reports.push_back(std::move(report));
    }
    return reports;
}

}  // namespace tribo::devices
