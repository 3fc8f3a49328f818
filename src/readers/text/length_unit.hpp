// SPDX-License-Identifier: MIT
// The two units that machining files count lengths in.
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

// Coordinates beyond this are taken for a slip of the pen, mm: no machine is a kilometre long, and products
// of larger ones would lose the micrometre.
inline constexpr double kLargestCoordinateMm = 1e6;

}  // namespace tribo::readers
