// SPDX-License-Identifier: MIT
#include <bit>
#include <string_view>

#include "base/hash.hpp"
#include "base/math.hpp"
#include "base/noise_hash.hpp"
#include "base/text/decimal.hpp"
#include "golden/golden.hpp"

namespace tribo::golden {

std::uint64_t math() {
    Hash hash;
    const auto add = [&hash](double x, double y) {
        double sine = 0, cosine = 0;
        math::sincos(x, sine, cosine);
        for (const double value :
             {sine, cosine, math::sin(x), math::cos(x), math::tan(x), math::asin(x), math::acos(x),
              math::atan(x), math::atan2(y, x), math::exp(x), math::log(x), math::log10(x), math::pow(x, y),
              math::cbrt(x), math::hypot(x, y)})
            hash.add(value);
    };
    const CounterNoise noise(1);
    for (std::uint64_t i = 0; i < 20'000; i += 2) {
        add(2 * noise.uniform(i) - 1, 8 * noise.uniform(i + 1) - 4);
        add(100 * noise.gaussian(i), noise.gaussian(i + 1));
        // Any bits: every size, subnormals, infinities, NaNs.
        add(std::bit_cast<double>(noise.bits(i)), std::bit_cast<double>(noise.bits(i + 1)));
    }
    return hash.value();
}

std::uint64_t decimal() {
    Hash hash;
    const CounterNoise noise(2);
    for (std::uint64_t i = 0; i < 5'000; ++i) {
        for (const double value : {std::bit_cast<double>(noise.bits(i)), noise.gaussian(i),
                                   1e-3 * static_cast<double>(noise.bits(i) >> 44)}) {
            const std::string text = format_decimal(value);
            hash.add(std::string_view(text));
            hash.add(std::string_view(format_decimal(static_cast<float>(value))));
            // More digits than a double tells apart.
            double back = 0;
            parse_decimal(text.find('e') == text.npos ? text + "00000000000000000000123" : text, back);
            hash.add(back);
        }
    }
    return hash.value();
}

std::uint64_t noise_hash() {
    Hash hash;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const CounterNoise noise(seed * seed);
        for (std::uint64_t i = 0; i < 1'000; ++i) {
            hash.add(noise.bits(i << (seed * 5)));
            hash.add(noise.uniform(i));
            hash.add(noise.gaussian(i));
        }
    }
    return hash.value();
}

}  // namespace tribo::golden
