// SPDX-License-Identifier: MIT
#include "files/image/orientation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tribo::files {
namespace {

constexpr std::uint32_t kOrientation = 274, kShort = 3;
constexpr std::size_t kEntryBytes = 12;

}  // namespace

int exif_orientation(std::string_view exif) {
    const bool big = exif.starts_with("MM");
    if (!big && !exif.starts_with("II")) return 1;
    // 0 beyond the end: no entry has the number 0.
    const auto number = [&](std::size_t at, std::size_t count) {
        std::uint32_t value = 0;
        if (at + count > exif.size()) return value;
        for (std::size_t n = 0; n < count; ++n)
            value = value << 8U | static_cast<std::uint8_t>(exif[at + (big ? n : count - 1 - n)]);
        return value;
    };
    const std::size_t first = number(4, 4);
    const std::uint32_t count = number(first, 2);
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t entry = first + 2 + n * kEntryBytes;
        if (number(entry, 2) != kOrientation || number(entry + 2, 2) != kShort) continue;
        const std::uint32_t value = number(entry + 8, 2);
        return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
    }
    return 1;
}

Image turned(Image image, int orientation) {
    if (orientation <= 1 || orientation > 8) return image;
    // From 5 on a stored row is a shown column. The first one is shown at the right or the bottom, or read
    // from its end.
    const bool across = orientation >= 5;
    const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    Image shown{across ? image.height : image.width, across ? image.width : image.height, {}};
    shown.rgba.resize(image.rgba.size());
    std::uint8_t* out = shown.rgba.data();
    for (int y = 0; y < shown.height; ++y) {
        for (int x = 0; x < shown.width; ++x, out += 4) {
            const int along = across ? y : x, down = across ? x : y;
            const int column = from_right ? image.width - 1 - along : along;
            const int row = from_bottom ? image.height - 1 - down : down;
            const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(column);
            std::memcpy(out, image.rgba.data() + 4 * at, 4);
        }
    }
    return shown;
}

}  // namespace tribo::files
