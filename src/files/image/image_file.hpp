// SPDX-License-Identifier: MIT
// Pictures into the program: PNG and JPEG.
#pragma once

#include <string>
#include <string_view>

#include "files/image/png.hpp"

namespace tribo::files {

// Pixels of a larger image are refused before memory is taken for them.
inline constexpr int kMostImageSide = 16'384;
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{64} << 20;

FileResult<Image> read_image(const std::string& path);
// Heights of a picture, pixel by pixel; refused where they are not as large as it.
FileResult<Image> read_height_map(const std::string& path, const Image& picture);
Result<Image> parse_image(std::string_view bytes, const std::string& source_name);

// The top left square of the image, as large as it can be, at `side` x `side` pixels: means over areas where
// it shrinks, between the nearest four pixels where it grows. The image has pixels (asserted).
Image square_at(const Image& image, int side);

}  // namespace tribo::files
