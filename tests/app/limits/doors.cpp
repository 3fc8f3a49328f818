// SPDX-License-Identifier: MIT
#include "app/limits/doors.hpp"

#include <charconv>

namespace tribo::test {

std::string written(double value) {
    char text[400];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
    return {text, end.ptr};
}

}  // namespace tribo::test
