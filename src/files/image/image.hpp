// SPDX-License-Identifier: MIT
// A picture in memory, and how large one may be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tribo::files {

// Rows from the top, four bytes a pixel: red, green, blue (sRGB) and opacity, not premultiplied.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // 4 width height
};

// A larger picture is refused by what its header says, before memory is taken for its pixels.
inline constexpr std::uint32_t kMostImageSide = 16'384;
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{64} << 20;

inline bool is_image_size(std::uint32_t width, std::uint32_t height) {
    return width >= 1 && height >= 1 && width <= kMostImageSide && height <= kMostImageSide &&
           std::uint64_t{width} * height <= kMostImagePixels;
}

// Why a picture of another size is refused.
std::string too_large_image(std::uint32_t width, std::uint32_t height);

}  // namespace tribo::files
