// SPDX-License-Identifier: MIT
// Reads pictures: PNG and JPEG.
#pragma once

#include <string>
#include <string_view>

#include "files/image/png.hpp"

namespace tribo::files {

// Larger images are refused before memory is allocated for them, pixels.
inline constexpr int kMostImageSide = 16'384;
inline constexpr std::uint64_t kMostImagePixels = std::uint64_t{64} << 20;

FileResult<Image> read_image(const std::string& path);
// Reads heights for the pixels of a picture. Refuses heights of another size.
FileResult<Image> read_height_map(const std::string& path, const Image& picture);
Result<Image> parse_image(std::string_view bytes, const std::string& source_name);

// Returns the largest top left square of the image at `side` x `side` pixels: area means when shrinking,
// bilinear interpolation when enlarging. The image must have pixels (asserted).
Image square_at(const Image& image, int side);

}  // namespace tribo::files
