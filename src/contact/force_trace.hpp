// SPDX-License-Identifier: MIT
// A force in time that no spectrum of the spindle describes: what a vibration adds to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace tribo::contact {

// Values at first / rate_hz, (first + 1) / rate_hz ... from the session start.
struct ForceTrace {
    double rate_hz = 48000;
    std::int64_t first = 0;
    std::span<const std::array<float, 2>> force_n;  // x and y in the frame of the tool
};

}  // namespace tribo::contact
