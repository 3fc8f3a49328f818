// SPDX-License-Identifier: MIT
// Reads pictures: PNG and JPEG.
#pragma once

#include <string>
#include <string_view>

#include "files/files.hpp"
#include "files/image/image.hpp"

namespace tribo::files {

FileResult<Image> read_image(const std::string& path);
// Reads heights for the pixels of a picture. Refuses heights of another size.
FileResult<Image> read_height_map(const std::string& path, const Image& picture);
Result<Image> parse_image(std::string_view bytes, const std::string& source_name);

// Returns the largest top left square of the image at `side` x `side` pixels: area means when shrinking,
// bilinear interpolation when enlarging. The image must have pixels (asserted).
Image square_at(const Image& image, int side);

}  // namespace tribo::files
