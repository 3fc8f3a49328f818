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

}  // namespace tribo::readers
