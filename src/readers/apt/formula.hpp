// SPDX-License-Identifier: MIT
// The arithmetic of APT: X*2+SINF(30), (A .LT. 5) .AND. (B .EQ. 2). Operators bind as in FORTRAN: ** first,
// then * /, + -, comparisons, .NOT., .AND., .OR.; a comparison is 1 or 0. Angles are in degrees.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tribo::readers::apt {

// Values that differ by less are equal in comparisons and in the arithmetic IF: a step of 0.1 added up ten
// times is 1.
inline constexpr double kEqualValues = 1e-9;

// Returns none for a text that is no formula, for a name without a value, and for a value that is not finite.
// `value_of_name`: of a name in upper case.
std::optional<double> value_of(
    std::string_view formula,
    const std::function<std::optional<double>(const std::string& name)>& value_of_name);

}  // namespace tribo::readers::apt
