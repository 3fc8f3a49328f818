// SPDX-License-Identifier: MIT
#include "base/text/decimal.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/math.hpp"

namespace tribo {
namespace {

using Wide = unsigned __int128;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// If the rounding of a double depends on a digit, it is one of the first 767. Beyond it, only the presence of
// a further non-zero digit matters (Clinger 1990; the longest halfway case is that of the smallest normal
// double).
constexpr int kDecisiveDigits = 768;
constexpr int kWordDigits = 19;  // fits 64 bits

// A number as read: 0.d1 d2 d3 ... times 10^point, with d1 not 0.
struct Decimal {
    std::string_view text;      // the digits, possibly with the decimal point among them
    std::int64_t point = 0;     // decimal exponent
    std::uint64_t leading = 0;  // at most the first kWordDigits digits
    int leading_count = 0;
    bool more = false;  // digits other than 0 follow the leading ones
};

// mantissa 2^exponent, rounded to nearest, ties to even. The top bit of the mantissa is set; `sticky` means
// that smaller non-zero bits follow.
double rounded(std::uint64_t mantissa, int exponent, bool sticky) {
    const int top = exponent + 63;  // value in [2^top, 2^(top + 1))
    if (top > 1023) return std::numeric_limits<double>::infinity();
    const int dropped = top >= -1022 ? 11 : 11 + (-1022 - top);
    if (dropped > 64) return 0;
    const std::uint64_t kept = dropped == 64 ? 0 : mantissa >> dropped;
    const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
    const std::uint64_t rest = mantissa & ((half << 1) - 1);
    const bool up = rest > half || (rest == half && (sticky || (kept & 1)));
    // A carry out of the mantissa increases the exponent, up to that of infinity.
    const std::uint64_t biased = top >= -1022 ? static_cast<std::uint64_t>(top + 1022) << 52 : 0;
    return std::bit_cast<double>(biased + kept + (up ? 1 : 0));
}

double rounded(Wide value, int exponent, bool sticky) {
    const auto high = static_cast<std::uint64_t>(value >> 64);
    const int leading =
        high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(static_cast<std::uint64_t>(value));
    value <<= leading;
    return rounded(static_cast<std::uint64_t>(value >> 64), exponent - leading + 64,
                   sticky || static_cast<std::uint64_t>(value) != 0);
}

constexpr int kExactFives = 27;  // 5^27 < 2^63
constexpr auto kPowersOfFive = [] {
    std::array<std::uint64_t, kExactFives + 1> powers{};
    powers[0] = 1;
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 5 * powers[i - 1];
    return powers;
}();
constexpr auto kPowersOfTen = [] {
    std::array<double, 23> powers{};  // exact: 10^22 = 5^22 2^22 and 5^22 < 2^53
    powers[0] = 1;
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = 10 * powers[i - 1];
    return powers;
}();

// A non-negative integer of up to 3,840 bits: the largest here is 769 digits or 5^1099 with 66 bits to spare.
class Large {
  public:
    explicit Large(std::uint32_t value) : size_(1) { words_[0] = value; }

    void multiply_add(std::uint32_t factor, std::uint32_t addend) {
        std::uint64_t carry = addend;
        for (int i = 0; i < size_; ++i) {
            carry += std::uint64_t{words_[at(i)]} * factor;
            words_[at(i)] = static_cast<std::uint32_t>(carry);
            carry >>= 32;
        }
        if (carry == 0) return;
        assert(size_ < static_cast<int>(words_.size()));
        words_[at(size_++)] = static_cast<std::uint32_t>(carry);
    }
    void multiply_by_power_of_five(int power) {
        for (; power >= 13; power -= 13) multiply_add(1220703125, 0);  // 5^13
        multiply_add(static_cast<std::uint32_t>(kPowersOfFive[at(power)]), 0);
    }
    void shift_left(int bits) {
        for (; bits >= 31; bits -= 31) multiply_add(std::uint32_t{1} << 31, 0);
        multiply_add(std::uint32_t{1} << bits, 0);
    }
    int bit_length() const {
        int top = size_ - 1;
        while (top > 0 && words_[at(top)] == 0) --top;
        return 32 * top + 32 - std::countl_zero(words_[at(top)]);
    }
    // Subtracts `other` if the result is not below 0. Returns true if it did.
    bool try_subtract(const Large& other) {
        for (int i = std::max(size_, other.size_) - 1; i >= 0; --i) {
            const std::uint32_t a = word(i), b = other.word(i);
            if (a < b) return false;
            if (a > b) break;
        }
        std::int64_t borrow = 0;
        for (int i = 0; i < size_; ++i) {
            borrow += std::int64_t{words_[at(i)]} - other.word(i);
            words_[at(i)] = static_cast<std::uint32_t>(borrow);
            borrow >>= 32;
        }
        return true;
    }
    bool is_zero() const {
        for (int i = 0; i < size_; ++i)
            if (words_[at(i)] != 0) return false;
        return true;
    }

  private:
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    std::uint32_t word(int i) const { return i < size_ ? words_[at(i)] : 0; }

    std::array<std::uint32_t, 120> words_{};
    int size_;
};

// The exact method: the quotient of two large integers, to 64 bits, and whether there is a remainder.
double from_all_digits(const Decimal& decimal) {
    Large numerator{0};
    std::int64_t count = 0;
    bool more = false;
    for (const char c : decimal.text) {
        if (!is_digit(c) || (count == 0 && c == '0')) continue;
        if (count < kDecisiveDigits) {
            numerator.multiply_add(10, static_cast<std::uint32_t>(c - '0'));
            ++count;
        } else if (c != '0') {
            more = true;
            break;
        }
    }
    if (more) {
        numerator.multiply_add(10, 1);
        ++count;
    }
    // value = numerator 10^power
    const int power = static_cast<int>(decimal.point - count);
    Large denominator{1};
    (power >= 0 ? numerator : denominator).multiply_by_power_of_five(power >= 0 ? power : -power);

    // Scaled so that the quotient lies in (2^63, 2^65).
    const int shift = 64 + denominator.bit_length() - numerator.bit_length();
    (shift >= 0 ? numerator : denominator).shift_left(shift >= 0 ? shift : -shift);
    Wide quotient = 0;
    // Long division by doubling the remainder: the first bit stands for 2^64.
    denominator.shift_left(64);
    for (int bit = 64; bit >= 0; --bit) {
        quotient = (quotient << 1) | (numerator.try_subtract(denominator) ? 1u : 0u);
        if (bit > 0) numerator.multiply_add(2, 0);
    }
    return rounded(quotient, power - shift, !numerator.is_zero());
}

double value_of(const Decimal& decimal) {
    if (decimal.leading_count == 0 || decimal.point < -330) return 0;
    if (decimal.point > 310) return std::numeric_limits<double>::infinity();
    if (!decimal.more) {
        const int power = static_cast<int>(decimal.point) - decimal.leading_count;
        const std::uint64_t digits = decimal.leading;
        if (digits < (std::uint64_t{1} << 53) && power >= -22 && power <= 22) {
            const auto exact = static_cast<double>(digits);  // one rounding: both operands are exact
            return power < 0 ? exact / kPowersOfTen[static_cast<std::size_t>(-power)]
                             : exact * kPowersOfTen[static_cast<std::size_t>(power)];
        }
        if (power >= 0 && power <= kExactFives)
            return rounded(Wide{digits} * kPowersOfFive[static_cast<std::size_t>(power)], power, false);
        if (power < 0 && power >= -kExactFives) {
            const int shift = 64 + std::countl_zero(digits);  // at least 64 bits of quotient: 127 - 63
            const Wide scaled = Wide{digits} << shift;
            const std::uint64_t divisor = kPowersOfFive[static_cast<std::size_t>(-power)];
            return rounded(scaled / divisor, power - shift, scaled % divisor != 0);
        }
    }
    return from_all_digits(decimal);
}

template <class Float, class... Format>
void append_shortest(std::string& text, Float value, Format... format) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format...).ptr;
    text.append(buffer.data(), end);
}

}  // namespace

std::size_t parse_decimal(std::string_view text, double& value, DecimalExponent exponent) {
    std::size_t i = 0;
    const bool negative = !text.empty() && text[0] == '-';
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) ++i;

    Decimal decimal;
    const std::size_t begin = i;
    bool digits = false, after_point = false;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '.') {
            if (after_point) break;
            after_point = true;
            continue;
        }
        if (!is_digit(c)) break;
        digits = true;
        if (decimal.leading_count == 0 && c == '0') {
            if (after_point) --decimal.point;
            continue;
        }
        if (!after_point) ++decimal.point;
        if (decimal.leading_count < kWordDigits) {
            decimal.leading = 10 * decimal.leading + static_cast<std::uint64_t>(c - '0');
            ++decimal.leading_count;
        } else if (c != '0') {
            decimal.more = true;
        }
    }
    if (!digits) return 0;
    decimal.text = text.substr(begin, i - begin);

    if (exponent == DecimalExponent::allowed && i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t j = i + 1;
        const bool down = j < text.size() && text[j] == '-';
        if (j < text.size() && (text[j] == '-' || text[j] == '+')) ++j;
        if (j < text.size() && is_digit(text[j])) {
            constexpr std::int64_t kFarOutside = std::int64_t{1} << 60;  // more than any text has digits
            std::int64_t power = 0;
            for (; j < text.size() && is_digit(text[j]); ++j)
                if (power < kFarOutside / 16) power = 10 * power + (text[j] - '0');
            decimal.point += down ? -power : power;
            i = j;
        }
    }
    const double size = value_of(decimal);
    value = negative ? -size : size;
    return i;
}

void append_decimal(std::string& text, double value) {
    append_shortest(text, value);
}
void append_decimal(std::string& text, float value) {
    append_shortest(text, value);
}
std::string format_digits(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return format_decimal(value);
    const double digit = math::pow(10, std::floor(math::log10(std::abs(value))) - (digits - 1));
    // As a float: the shortest text hides the rounding of the product.
    const auto rounded = static_cast<float>(std::round(value / digit) * digit);
    // All integers of this size are floats.
    if (const float size = std::abs(rounded); size >= 1 && size < 1e7F) {
        std::string text;
        append_shortest(text, rounded, std::chars_format::fixed);
        return text;
    }
    return format_decimal(rounded);
}
std::string format_decimal(double value) {
    std::string text;
    append_decimal(text, value);
    return text;
}
std::string format_decimal(float value) {
    std::string text;
    append_decimal(text, value);
    return text;
}

}  // namespace tribo
