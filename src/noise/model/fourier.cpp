// SPDX-License-Identifier: MIT
#include "noise/model/fourier.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "base/math.hpp"

namespace tribo::noise {
namespace {

// Neighbouring butterflies that are computed together, so that memory is read in order.
constexpr std::size_t kTogether = 64;

}  // namespace

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
        const std::size_t half = length / 2;
        for (std::size_t first = 0; first < half; first += kTogether) {
            const std::size_t count = std::min(kTogether, half - first);
            std::array<double, kTogether> sine, cosine;
            for (std::size_t k = 0; k < count; ++k)
                math::sincos(angle * static_cast<double>(first + k), sine[k], cosine[k]);
            for (std::size_t i = first; i < n; i += length) {
                for (std::size_t k = 0; k < count; ++k) {
                    const std::complex<double> a = x[i + k], b = x[i + k + half];
                    const std::complex<double> t(b.real() * cosine[k] - b.imag() * sine[k],
                                                 b.real() * sine[k] + b.imag() * cosine[k]);
                    x[i + k] = a + t;
                    x[i + k + half] = a - t;
                }
            }
        }
    }
}

}  // namespace tribo::noise
