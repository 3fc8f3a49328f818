// SPDX-License-Identifier: MIT
// Triangles to samples. Neighbours have no gaps and no overlaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tribo::report {

// A projected point: sample coordinates, y down, and a nearness that is linear on the screen (1 / depth in
// perspective). Only what is nearer than 0 is seen.
struct Seen {
    double x = 0, y = 0, nearness = 0;
};

inline constexpr std::uint32_t kNothing = std::numeric_limits<std::uint32_t>::max();

// For each sample the nearest triangle and its depth.
struct Buffer {
    int width = 0, height = 0;  // samples
    std::vector<float> nearness;
    std::vector<std::uint32_t> triangle;  // kNothing: none

    Buffer(int width, int height);

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

// Fills the samples of a triangle where it is the nearest.
void fill(Buffer& buffer, std::uint32_t triangle, Seen a, Seen b, Seen c);

}  // namespace tribo::report
