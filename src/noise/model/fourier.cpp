// SPDX-License-Identifier: MIT
#include "noise/model/fourier.hpp"

#include <cassert>
#include <cstddef>
#include <utility>

#include "base/math.hpp"

namespace tribo::noise {

void fourier(std::span<std::complex<double>> x) {
    const std::size_t n = x.size();
    assert(n > 0 && (n & (n - 1)) == 0);
    for (std::size_t i = 1, j = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; j & bit; bit >>= 1) j ^= bit;
        j ^= bit;
        if (i < j) std::swap(x[i], x[j]);
    }
    for (std::size_t length = 2; length <= n; length *= 2) {
        const double angle = -math::kTwoPi / static_cast<double>(length);
        for (std::size_t k = 0; k < length / 2; ++k) {
            double sine = 0, cosine = 0;
            math::sincos(angle * static_cast<double>(k), sine, cosine);
            const std::complex<double> turn(cosine, sine);
            for (std::size_t i = k; i < n; i += length) {
                const std::complex<double> a = x[i], b = x[i + length / 2];
                const std::complex<double> t(b.real() * cosine - b.imag() * sine,
                                             b.real() * sine + b.imag() * cosine);
                x[i] = a + t;
                x[i + length / 2] = a - t;
            }
        }
    }
}

}  // namespace tribo::noise
