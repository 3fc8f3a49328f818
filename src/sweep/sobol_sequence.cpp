// SPDX-License-Identifier: MIT
#include "sweep/sobol_sequence.hpp"

#include <array>
#include <cassert>

namespace tribo::sweep {
namespace {

constexpr std::size_t kBits = 32, kMostDegree = 8;

// A primitive polynomial over the integers modulo 2 and the first direction numbers: Joe and Kuo 2008, table
// new-joe-kuo-6. Bit i of `middle` is the coefficient of x^(i+1); those of x^degree and 1 are 1.
struct Seed {
    std::uint32_t degree, middle;
    std::array<std::uint32_t, kMostDegree> first;
};

constexpr Seed kSeeds[]{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
    {7, 7, {1, 1, 3, 13, 7, 35, 63}},
    {7, 8, {1, 3, 5, 9, 1, 25, 53}},
    {7, 14, {1, 3, 1, 13, 9, 35, 107}},
    {7, 19, {1, 3, 1, 5, 27, 61, 31}},
    {7, 21, {1, 1, 5, 11, 19, 41, 61}},
    {7, 28, {1, 3, 5, 3, 3, 13, 69}},
    {7, 31, {1, 1, 7, 13, 1, 19, 1}},
    {7, 32, {1, 3, 7, 5, 13, 19, 59}},
    {7, 37, {1, 1, 3, 9, 25, 29, 41}},
    {7, 41, {1, 3, 5, 13, 23, 1, 55}},
    {7, 42, {1, 3, 7, 3, 13, 59, 17}},
    {7, 50, {1, 3, 1, 3, 5, 53, 69}},
    {7, 55, {1, 1, 5, 5, 23, 33, 13}},
    {7, 56, {1, 1, 7, 7, 1, 61, 123}},
    {7, 59, {1, 1, 7, 9, 13, 61, 49}},
    {7, 62, {1, 3, 3, 5, 3, 55, 33}},
    {8, 14, {1, 3, 1, 15, 31, 13, 49, 245}},
    {8, 21, {1, 3, 5, 15, 31, 59, 63, 97}},
    {8, 22, {1, 3, 1, 11, 11, 11, 77, 249}},
};

using Directions = std::array<std::uint32_t, kBits>;

// Directions as fractions of 2^32, the largest first (Bratley and Fox 1988).
constexpr Directions directions_of(const Seed& seed) {
    Directions v{};
    for (std::size_t n = 0; n < seed.degree; ++n) v[n] = seed.first[n] << (kBits - 1 - n);
    for (std::size_t n = seed.degree; n < kBits; ++n) {
        v[n] = v[n - seed.degree] ^ (v[n - seed.degree] >> seed.degree);
        for (std::size_t k = 1; k < seed.degree; ++k) {
            if ((seed.middle >> (seed.degree - 1 - k)) & 1) v[n] ^= v[n - k];
        }
    }
    return v;
}

constexpr auto kDirections = [] {
    std::array<Directions, kMostSobolDimensions> all{};
    for (std::size_t n = 0; n < kBits; ++n) all[0][n] = std::uint32_t{1} << (kBits - 1 - n);
    for (std::size_t d = 1; d < all.size(); ++d) all[d] = directions_of(kSeeds[d - 1]);
    return all;
}();

}  // namespace

double sobol_coordinate(std::uint32_t index, std::size_t dimension, std::uint32_t shift) {
    assert(dimension < kMostSobolDimensions);
    std::uint32_t cell = shift;
    for (std::size_t n = 0; index >> n != 0; ++n) {
        if ((index >> n) & 1) cell ^= kDirections[dimension][n];
        if (n + 1 == kBits) break;
    }
    return (static_cast<double>(cell) + 0.5) / 4294967296.0;
}

}  // namespace tribo::sweep
