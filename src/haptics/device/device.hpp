// SPDX-License-Identifier: MIT
// What the servo asks of a haptic arm, whoever made it: a reading of the hand, and a force for it.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec3.hpp"
#include "haptics/device/device_limits.hpp"

namespace tribo::haptics {

struct HandReading {
    Vec3 position_mm;            // of the probe, stock frame
    Vec3 velocity_mm_per_s;      // as the device says, or differences of its positions
    Vec3 stylus{0, 0, 1};        // unit, from the probe's tip to the hand
    unsigned buttons = 0;        // a bit each
    std::uint64_t sequence = 0;  // rises with every reading that is new; unchanged: the device said nothing
};

enum class DeviceState : std::uint8_t {
    ready,
    silent,   // no new reading this time; the last one stands
    refused,  // no force, but that may pass: motors switched off by a button, too warm, a limit of the
              // device's own
    gone,     // unplugged or closed: nothing will come any more
};

// One thread at a time. read() and write() are real-time safe (no allocation, lock or throw) and return
// without waiting for more than the device's own period.
class Device {
  public:
    virtual ~Device() = default;
    virtual const DeviceLimits& limits() const = 0;
    virtual DeviceState read(HandReading& reading) noexcept = 0;
    // Newtons on the hand, stock frame.
    virtual DeviceState write(Vec3 force_n) noexcept = 0;
    // Whether motors move a person's hand. If not, there is nothing to ramp up for.
    virtual bool has_motors() const { return true; }
    // Whether the hand gives way to a force. If not, no force gives it energy.
    virtual bool yields() const { return true; }
    // What the last state that was not ready means, and what of its safety the device lacks, in words; empty:
    // all is well. Not for the servo's thread.
    virtual std::string trouble() const { return {}; }
};

}  // namespace tribo::haptics
