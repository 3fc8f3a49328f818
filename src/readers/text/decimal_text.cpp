// SPDX-License-Identifier: MIT
#include "readers/text/decimal_text.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace tribo::readers {
namespace {

constexpr std::array<std::uint64_t, 16> kPowerOfTen = [] {
    std::array<std::uint64_t, 16> powers{1};
    for (std::size_t n = 1; n < powers.size(); ++n) powers[n] = 10 * powers[n - 1];
    return powers;
}();
constexpr double kLargestPlain = 1e15;

}  // namespace

void append_fixed(std::string& text, double value, int decimals) {
    assert(decimals >= 0 && decimals < static_cast<int>(kPowerOfTen.size()));
    if (std::isnan(value)) {
        text += "nan";
        return;
    }
    if (std::isinf(value)) {
        text += value < 0 ? "-inf" : "inf";
        return;
    }
    const double size = std::abs(value);
    if (size >= kLargestPlain) {
        double mantissa = size;
        int exponent = 0;
        for (; mantissa >= 10; ++exponent) mantissa /= 10;
        append_fixed(text, value < 0 ? -mantissa : mantissa, decimals);
        text += "e+" + std::to_string(exponent);
        return;
    }
    // Whole part and fraction separately: the difference is exact, so only the scaling of the fraction
    // rounds.
    const std::uint64_t scale = kPowerOfTen[static_cast<std::size_t>(decimals)];
    const double floor = std::floor(size);
    auto whole = static_cast<std::uint64_t>(floor);
    auto fraction = static_cast<std::uint64_t>((size - floor) * static_cast<double>(scale) + 0.5);
    if (fraction >= scale) {
        ++whole;
        fraction -= scale;
    }
    if (value < 0 && (whole != 0 || fraction != 0)) text += '-';
    text += std::to_string(whole);
    if (decimals == 0) return;
    text += '.';
    for (int place = decimals - 1; place >= 0; --place) {
        text += static_cast<char>('0' + fraction / kPowerOfTen[static_cast<std::size_t>(place)] % 10);
    }
}

std::string short_decimal(double value, int decimals) {
    std::string text;
    append_fixed(text, value, decimals);
    if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string mm_text(double value) {
    return short_decimal(value) + " mm";
}

}  // namespace tribo::readers
