// SPDX-License-Identifier: MIT
#include "devices/arm/device_search.hpp"

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

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
constexpr const char* kSerial = "serial";
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
    if (name == kSerial) return "HapKit and others with a firmware like examples/serial_arm";
    return "Haply Inverse3";
}

// serial:/dev/ttyACM0@115200
SerialArmOptions serial_options(const std::string& name, const Mounting& mounting) {
    SerialArmOptions options;
    options.mounting = mounting;
    const std::size_t colon = name.find(':'), at = name.rfind('@');
    if (colon == std::string::npos) return options;
    options.port = name.substr(colon + 1, at == std::string::npos ? at : at - colon - 1);
    if (at != std::string::npos) options.baud = std::atoi(name.c_str() + at + 1);
    return options;
}

Result<std::unique_ptr<haptics::Device>> open_one(const std::string& name, const Mounting& mounting,
                                                  int haply_ms) {
    if (name.starts_with(kOpenHaptics)) {
        OpenHapticsOptions options;
        options.mounting = mounting;
        if (const std::size_t colon = name.find(':'); colon != std::string::npos)
            options.device = name.substr(colon + 1);
        return open_openhaptics(options);
    }
    if (name == kForceDimension) {
        ForceDimensionOptions options;
        options.mounting = mounting;
        return open_force_dimension(options);
    }
    if (name.starts_with(kSerial)) return open_serial_arm(serial_options(name, mounting));
    HaplyOptions options;
    options.mounting = mounting;
    options.timeout_ms = haply_ms;
    return open_haply(options);
}

}  // namespace

const std::vector<std::string>& arm_names() {
    static const std::vector<std::string> names{kOpenHaptics, kForceDimension, kHaply, kSerial};
    return names;
}

Result<std::unique_ptr<haptics::Device>> open_arm(const std::string& name, const Mounting& mounting) {
    if (name == "auto") {
        for (const std::string& each : arm_names()) {
            // Other devices on serial ports are not opened.
            if (each == kSerial) continue;
            if (auto device = open_one(each, mounting, kHaplySearchMs)) return device;
        }
        return fail("no haptic arm was found", "run 'tribo devices' to see why, or use --device simulated");
    }
    for (const std::string& each : arm_names()) {
        const bool may_be_named = each == kOpenHaptics || each == kSerial;
        if (each == name || (may_be_named && name.starts_with(each + ":")))
            return open_one(name, mounting, HaplyOptions{}.timeout_ms);
    }
    return fail("there is no device '" + name + "'",
                "try simulated, playback, openhaptics, forcedimension, haply, serial:PORT or auto");
}

std::vector<ArmReport> search_arms() {
    std::vector<ArmReport> reports;
    for (const std::string& name : arm_names()) {
        ArmReport report;
        report.name = name;
        report.makes = makes(name);
        if (auto device = open_one(name, {}, kHaplySearchMs)) {
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
