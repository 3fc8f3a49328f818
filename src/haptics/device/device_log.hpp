// SPDX-License-Identifier: MIT
// Records what any device says and is told: where the hand was, what it got. A log can be played back as a
// stroke.
#pragma once

#include <span>
#include <vector>

#include "haptics/device/device.hpp"

namespace tribo::haptics {

struct DeviceLogRow {
    std::uint64_t tick = 0;  // of read(), from 0
    HandReading reading;
    DeviceState state = DeviceState::ready;
    Vec3 force_n;  // written after that reading
};

// In place of the device that it refers to. Real-time safe: room for the rows is taken at the start; when it
// is used up the log ends and the device goes on.
class DeviceLog final : public Device {
  public:
    DeviceLog(Device& device, std::size_t most_rows) : device_(device) { rows_.reserve(most_rows); }

    const DeviceLimits& limits() const override { return device_.limits(); }
    DeviceState read(HandReading& reading) noexcept override {
        const DeviceState state = device_.read(reading);
        if (rows_.size() < rows_.capacity()) rows_.push_back({tick_, reading, state, {}});
        ++tick_;
        return state;
    }
    DeviceState write(Vec3 force_n) noexcept override {
        if (!rows_.empty() && rows_.back().tick + 1 == tick_) rows_.back().force_n = force_n;
        return device_.write(force_n);
    }
    bool has_motors() const override { return device_.has_motors(); }
    bool yields() const override { return device_.yields(); }
    std::string trouble() const override { return device_.trouble(); }

    std::span<const DeviceLogRow> rows() const { return rows_; }

  private:
    Device& device_;
    std::vector<DeviceLogRow> rows_;
    std::uint64_t tick_ = 0;
};

}  // namespace tribo::haptics
