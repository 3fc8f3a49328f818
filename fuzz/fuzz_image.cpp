// SPDX-License-Identifier: MIT
// Any bytes give a picture of the size that it says, or an error with a remedy.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "files/image/image_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    const auto image = files::parse_image({reinterpret_cast<const char*>(data), size}, "fuzz.png");
    if (!image) {
        if (image.error().cause.empty() || image.error().remedy.empty()) std::abort();
        return 0;
    }
    const auto width = static_cast<std::uint32_t>(image->width);
    const auto height = static_cast<std::uint32_t>(image->height);
    if (!files::is_image_size(width, height)) std::abort();
    if (image->rgba.size() != std::size_t{4} * width * height) std::abort();
    return 0;
}
