// SPDX-License-Identifier: MIT
// The two length units of machining files.
#pragma once

#include <string_view>

namespace tribo::readers {

enum class LengthUnit { millimetre, inch };

constexpr double mm_per(LengthUnit unit) {
    return unit == LengthUnit::inch ? 25.4 : 1.0;
}
constexpr std::string_view plural(LengthUnit unit) {
    return unit == LengthUnit::inch ? "inches" : "millimetres";
}

// Larger coordinates count as a typing error, mm: no machine is a kilometre long, and products of larger
// values would lose the micrometre.
inline constexpr double kLargestCoordinateMm = 1e6;

}  // namespace tribo::readers
