// SPDX-License-Identifier: MIT
// A spindle whose speed swings about the stated one, so that no wave meets the next tooth in the same phase
// (Sexton and Stone 1978).
#pragma once

#include <cstdint>

#include "base/math.hpp"

namespace tribo::session {

struct SpindleVariation {
    double share = 0;  // of the speed, up and down; 0: none
    double hz = 0;

    bool is_there() const { return share > 0; }
    double rpm_at(double rpm, double t_s) const {
        return rpm * (1 + share * math::sin(math::kTwoPi * hz * t_s));
    }
};

inline constexpr const char* kVariationWarning =
    "the speed of the spindle varies: the vibration in time follows it, multipliers and limits are those of "
    "the "
    "steady speed";

// Samples after which a varying speed is set anew: a millisecond.
inline constexpr std::int64_t kVariationSamples = 48;

}  // namespace tribo::session
