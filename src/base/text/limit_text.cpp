// SPDX-License-Identifier: MIT
#include "base/text/limit_text.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/text/decimal.hpp"

namespace tribo {
namespace {

std::string with_unit(std::string number, const Limit& limit) {
    return *limit.unit == '\0' ? number : number + " " + limit.unit;
}

}  // namespace

std::string plain_number(double value) {
    constexpr double kMostDigits = 1e15;
    if (std::abs(value) < kMostDigits && value == std::floor(value))
        return std::to_string(static_cast<std::int64_t>(value));
    std::string text = format_decimal(value);
    const std::size_t exponent = text.find('e');
    if (exponent != std::string::npos && text[exponent + 2] == '0') text.erase(exponent + 2, 1);
    return text;
}

std::string out_of_range(const Limit& limit, double value) {
    return std::string("the ") + limit.quantity + " of " + with_unit(plain_number(value), limit) +
           " is out of range";
}

std::string range_remedy(const Limit& limit) {
    return std::string("keep the ") + limit.quantity + " within " + plain_number(limit.range.min) + " to " +
           with_unit(plain_number(limit.range.max), limit);
}

}  // namespace tribo
