// SPDX-License-Identifier: MIT
#include "files/image/png.hpp"

#include <cassert>
#include <csetjmp>
#include <cstring>
#include <png.h>

namespace tribo::files {
namespace {

// libpng leaves an error by a jump (longjmp) to the last setjmp. So a function that calls setjmp has no
// local with a destructor: everything lives in these two.
struct PngDecoder {
    std::string_view left;
    std::string cause;
    Image image;
    std::vector<png_bytep> rows;
    png_structp png = nullptr;
    png_infop info = nullptr;

    ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }

    static void read(png_structp png, png_bytep out, std::size_t size) {
        auto& left = static_cast<PngDecoder*>(png_get_io_ptr(png))->left;
        if (size > left.size()) png_error(png, "it ends too soon");
        std::memcpy(out, left.data(), size);
        left.remove_prefix(size);
    }
    static void keep(png_structp png, png_const_charp message) {
        static_cast<PngDecoder*>(png_get_error_ptr(png))->cause =
            std::string("the image is damaged: ") + message;
        png_longjmp(png, 1);
    }
    static void ignore(png_structp, png_const_charp) {}

    bool decode() {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, keep, ignore);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) {
            cause = "there is no memory for the image";
            return false;
        }
        if (setjmp(png_jmpbuf(png)) != 0) return false;
        png_set_read_fn(png, this, read);
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours are looked at below
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png, info);
        const png_uint_32 width = png_get_image_width(png, info), height = png_get_image_height(png, info);
        if (!is_image_size(width, height)) {
            cause = too_large_image(width, height);
            return false;
        }
        png_set_expand(png);
        png_set_strip_16(png);
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
        png_set_interlace_handling(png);
        png_read_update_info(png, info);
        const std::size_t row_bytes = std::size_t{4} * width;
        assert(png_get_rowbytes(png, info) == row_bytes);
        image.width = static_cast<int>(width);
        image.height = static_cast<int>(height);
        image.rgba.resize(row_bytes * height);
        rows.resize(height);
        for (std::size_t y = 0; y < height; ++y) rows[y] = image.rgba.data() + row_bytes * y;
        png_read_image(png, rows.data());
        return true;
    }
};

struct Encoder {
    std::string bytes;
    png_structp png = nullptr;
    png_infop info = nullptr;

    ~Encoder() { png_destroy_write_struct(&png, &info); }

    static void write(png_structp png, png_bytep data, std::size_t size) {
        static_cast<Encoder*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
    }
    static void flush(png_structp) {}

    bool encode(const Image& image) {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) return false;
        png_set_write_fn(png, this, write, flush);
        png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
                     8, PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png, info);
        const std::size_t row_bytes = std::size_t{4} * static_cast<std::size_t>(image.width);
        for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
            png_write_row(png, image.rgba.data() + row_bytes * y);
        png_write_end(png, info);
        return true;
    }
};

}  // namespace

std::expected<Image, std::string> parse_png(std::string_view bytes) {
    PngDecoder decoder;
    decoder.left = bytes;
    if (!decoder.decode()) return std::unexpected(std::move(decoder.cause));
    return std::move(decoder.image);
}

std::string png_bytes(const Image& image) {
    assert(image.rgba.size() ==
           std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    if (image.rgba.empty()) return {};
    Encoder encoder;
    [[maybe_unused]] const bool done = encoder.encode(image);
    assert(done);  // nothing but memory can be missing
    return std::move(encoder.bytes);
}

FileResult<void> write_png(const std::string& path, const Image& image) {
    return write_file(path, png_bytes(image));
}

}  // namespace tribo::files
