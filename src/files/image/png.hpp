// SPDX-License-Identifier: MIT
// Writes pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/files.hpp"

namespace tribo::files {

// Rows from the top, four bytes a pixel: red, green, blue (sRGB) and opacity, not premultiplied.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // 4 width height
};

// Returns the bytes of a PNG file, always the same for the same image. Empty for an image without pixels.
std::string png_bytes(const Image& image);

FileResult<void> write_png(const std::string& path, const Image& image);

}  // namespace tribo::files
