// SPDX-License-Identifier: MIT
// How a camera was held: what its picture says of the way in which it is to be shown (Exif 2.32, tag 274).
#pragma once

#include <string_view>

#include "files/image/image.hpp"

namespace tribo::files {

// 1: as it is stored, to 8. `exif`: a block of Exif, from its byte order on. 1 if it says nothing, or is
// damaged.
int exif_orientation(std::string_view exif);

// Returns the picture as it is to be shown.
Image turned(Image image, int orientation);

}  // namespace tribo::files
