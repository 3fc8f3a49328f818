// SPDX-License-Identifier: MIT
// Pictures from JPEG, by libjpeg-turbo.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "files/image/image.hpp"

namespace tribo::files {

// Baseline and progressive, grey, colour and CMYK. A picture that is cut short or damaged is refused. It is
// turned as the camera notes, as browsers do. An error is the cause, without file and remedy.
std::expected<Image, std::string> parse_jpeg(std::string_view bytes);

}  // namespace tribo::files
