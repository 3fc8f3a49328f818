// SPDX-License-Identifier: MIT
// The allowed range of a number in a file. Plain data.
#pragma once

#include <limits>

namespace tribo {

// Both ends belong to the range; if `above` is true, the lower end does not.
struct Range {
    double min = -std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::max();
    bool above = false;

    // False for NaN.
    constexpr bool contains(double value) const {
        return value <= max && (above ? value > min : value >= min);
    }
};

}  // namespace tribo
