// SPDX-License-Identifier: MIT
#include "files/image/image_file.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "files/image/jpeg.hpp"
#include "files/image/png.hpp"

namespace tribo::files {
namespace {

// The pixels that one pixel of the result covers along one side of the source, with their shares (sum 1).
struct Cover {
    int first = 0;
    std::vector<float> shares;
};

std::vector<Cover> covers(int from, int to) {
    std::vector<Cover> all(static_cast<std::size_t>(to));
    const double scale = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
        Cover& cover = all[static_cast<std::size_t>(i)];
        if (scale >= 1) {
            const double begin = i * scale, end = std::min((i + 1) * scale, static_cast<double>(from));
            cover.first = static_cast<int>(begin);
            for (int k = cover.first; k < end; ++k) {
                const double part = std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k));
                cover.shares.push_back(static_cast<float>(part / (end - begin)));
            }
        } else {
            const double at = std::clamp((i + 0.5) * scale - 0.5, 0.0, from - 1.0);
            cover.first = std::min(static_cast<int>(at), std::max(from - 2, 0));
            const auto part = static_cast<float>(at - cover.first);
            cover.shares = {1 - part};
            if (from > 1) cover.shares.push_back(part);
        }
    }
    return all;
}

}  // namespace

std::string too_large_image(std::uint32_t width, std::uint32_t height) {
    return "the image has " + std::to_string(width) + " x " + std::to_string(height) +
           " pixels, more than the " + std::to_string(kMostImagePixels >> 20) + " million, or " +
           std::to_string(kMostImageSide) + " a side, that are read";
}

Result<Image> parse_image(std::string_view bytes, const std::string& source_name) {
    const auto refuse = [&](const std::string& cause) -> Result<Image> {
        return fail_at(source_name, 0, 0, cause, "give a PNG or JPEG image");
    };
    std::expected<Image, std::string> image;
    if (bytes.starts_with("\x89PNG")) {
        image = parse_png(bytes);
    } else if (bytes.starts_with("\xff\xd8")) {
        image = parse_jpeg(bytes);
    } else {
        return refuse("is not an image that can be read");
    }
    if (!image) return refuse(image.error());
    return *std::move(image);
}

FileResult<Image> read_image(const std::string& path) {
    const FileResult<std::string> bytes = read_file(path, kMostImagePixels * 4);
    if (!bytes) return std::unexpected(bytes.error());
    Result<Image> image = parse_image(*bytes, path);
    if (!image) return std::unexpected(FileFailure(image.error()));
    return *std::move(image);
}

FileResult<Image> read_height_map(const std::string& path, const Image& picture) {
    FileResult<Image> map = read_image(path);
    if (!map || (map->width == picture.width && map->height == picture.height)) return map;
    const auto size = [](const Image& i) {
        return std::to_string(i.width) + " x " + std::to_string(i.height) + " pixels";
    };
    return std::unexpected(FileFailure(Error{path, 0, 0, "the height map has " + size(*map),
                                             "give one of " + size(picture) + ", as the image"}));
}

Image square_at(const Image& image, int side) {
    assert(image.width > 0 && image.height > 0 && side > 0);
    const std::vector<Cover> cover = covers(std::min(image.width, image.height), side);
    Image square;
    square.width = square.height = side;
    square.rgba.resize(std::size_t{4} * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    std::uint8_t* out = square.rgba.data();
    for (const Cover& rows : cover) {
        for (const Cover& columns : cover) {
            float sum[4] = {};
            for (std::size_t j = 0; j < rows.shares.size(); ++j) {
                const auto row = static_cast<std::size_t>(rows.first) + j;
                const std::uint8_t* pixel =
                    image.rgba.data() + 4 * (row * static_cast<std::size_t>(image.width) +
                                             static_cast<std::size_t>(columns.first));
                for (const float share : columns.shares) {
                    for (int c = 0; c < 4; ++c)
                        sum[c] += share * rows.shares[j] * static_cast<float>(*pixel++);
                }
            }
            for (const float value : sum)
                *out++ = static_cast<std::uint8_t>(std::lround(std::min(value, 255.0F)));
        }
    }
    return square;
}

}  // namespace tribo::files
