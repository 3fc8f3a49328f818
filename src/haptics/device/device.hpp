// SPDX-License-Identifier: MIT
// Interface of a haptic arm for the servo: read the hand, write a force.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec3.hpp"
#include "haptics/device/device_limits.hpp"

namespace tribo::haptics {

struct HandReading {
    Vec3 position_mm;            // of the probe, stock frame
    Vec3 velocity_mm_per_s;      // from the device, or differences of its positions
    Vec3 stylus{0, 0, 1};        // unit, from the probe's tip to the hand
    unsigned buttons = 0;        // one bit each
    std::uint64_t sequence = 0;  // increases with every new reading
};

enum class DeviceState : std::uint8_t {
    ready,
    silent,   // no new reading; the last one is kept
    refused,  // no force for now: motors switched off by a button, too warm, or a limit of the
              // device
    gone,     // unplugged or closed, for good
};

// One thread at a time. read() and write() are real-time safe (no allocation, lock or throw). They wait for
// at most one period of the device.
class Device {
  public:
    virtual ~Device() = default;
    // In the frame of its readings, as it is mounted.
    virtual const DeviceLimits& limits() const = 0;
    virtual DeviceState read(HandReading& reading) noexcept = 0;
    // Force on the hand in N, stock frame. Any other answer than `ready` means that the hand does not feel
    // it.
    virtual DeviceState write(Vec3 force_n) noexcept = 0;
    // Whether motors move the hand of a person. If not, the servo needs no ramp.
    virtual bool has_motors() const { return true; }
    // Whether forces move the hand. If not, no energy can reach it.
    virtual bool yields() const { return true; }
    // Explains the last state that was not `ready` and missing safety functions of the device. Empty: no
    // problem. Not for the servo thread.
    virtual std::string trouble() const { return {}; }
};

}  // namespace tribo::haptics
