// SPDX-License-Identifier: MIT
// Where a number of a file may lie. Plain data.
#pragma once

#include <limits>

namespace tribo {

// Both ends belong to it unless `above` says that the lower one does not.
struct Range {
    double min = -std::numeric_limits<double>::max();
    double max = std::numeric_limits<double>::max();
    bool above = false;

    // False for what is not a number.
    constexpr bool contains(double value) const {
        return value <= max && (above ? value > min : value >= min);
    }
};

}  // namespace tribo
