// SPDX-License-Identifier: MIT
#include "files/image/png.hpp"

#include <cassert>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace tribo::files {

std::string png_bytes(const Image& image) {
    assert(image.rgba.size() ==
           std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    std::string bytes;
    if (image.rgba.empty()) return bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   static_cast<std::size_t>(size));
    };
    stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(), 4 * image.width);
    return bytes;
}

FileResult<void> write_png(const std::string& path, const Image& image) {
    return write_file(path, png_bytes(image));
}

}  // namespace tribo::files
