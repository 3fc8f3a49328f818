// SPDX-License-Identifier: MIT
// Pictures as PNG, by libpng.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "files/files.hpp"
#include "files/image/image.hpp"

namespace tribo::files {

// Every kind of PNG as eight bits a channel; of sixteen bits the upper eight. Chunks that are not needed for
// the pixels (texts, profiles) are skipped, not unpacked. An error is the cause, without file and remedy.
std::expected<Image, std::string> parse_png(std::string_view bytes);

// Returns the bytes of a PNG file, always the same for the same image. Empty for an image without pixels.
std::string png_bytes(const Image& image);

FileResult<void> write_png(const std::string& path, const Image& image);

}  // namespace tribo::files
