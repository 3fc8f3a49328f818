// SPDX-License-Identifier: MIT
// What the vibration of tool and part adds to the cutting force, for a servo: the part of it that a rate can
// carry.
#pragma once

#include <array>
#include <vector>

#include "contact/force_trace.hpp"
#include "haptics/contact/force_field.hpp"
#include "haptics/servo/force_scaling.hpp"
#include "milling/tool/tool_frame.hpp"

namespace tribo::session {

// Full up to a quarter of the rate, nothing from 0.4 of it on, as haptics::groove_gain has it. 12 bytes per
// sample.
class VibrationTrack {
    using Sample = std::array<float, 3>;

  public:
    // For a program of this duration.
    VibrationTrack(double rate_hz, double duration_s);
    static double bytes(double rate_hz, double duration_s) { return sizeof(Sample) * rate_hz * duration_s; }

    // Adds the trace of a row; `frame` is that of its tool. The rate of traces is above that of the servo.
    void add(const contact::ForceTrace& trace, const milling::ToolFrame& frame);
    // Force on the tool, stock frame. Linear between samples, zero outside the program. Real-time safe.
    Vec3 force_n(double at_s) const noexcept;
    bool empty() const { return force_n_.empty(); }

  private:
    double weight(double from_centre) const;

    double rate_hz_;
    std::vector<Sample> force_n_;
    std::vector<double> kernel_;  // half of it, kSteps per sample of the servo
};

// The force of a table, and the vibration beside it.
class VibratingForce final : public haptics::CuttingForce {
  public:
    // Table and track must outlive this object.
    VibratingForce(haptics::CuttingForce& table, const VibrationTrack& track,
                   const haptics::ForceScaling& scaling)
        : table_(table), track_(track), scaling_(scaling) {}

    // The sum is bounded by the arm's own limit (haptics/servo/safety.hpp).
    Vec3 force_n(double at_s) noexcept override {
        return table_.force_n(at_s) + scaling_.apply(track_.force_n(at_s));
    }

  private:
    haptics::CuttingForce& table_;
    const VibrationTrack& track_;
    haptics::ForceScaling scaling_;
};

}  // namespace tribo::session
