// SPDX-License-Identifier: MIT
// Pictures against a second decoder (stb_image), and pictures that were made to do harm.
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <png.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include "base/noise_hash.hpp"
#include "files/image/image_file.hpp"
#include "files/image/png.hpp"

namespace tribo::files {
namespace {

std::vector<std::uint8_t> decoded_by_stb(const std::string& bytes) {
    int width = 0, height = 0, channels = 0;
    stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                            static_cast<int>(bytes.size()), &width, &height, &channels, 4);
    if (pixels == nullptr) return {};
    std::vector<std::uint8_t> all(pixels, pixels + std::size_t{4} * static_cast<std::size_t>(width * height));
    stbi_image_free(pixels);
    return all;
}

// A PNG of any colour type and depth, its bytes at random. Palettes have 2^depth colours, half of them with
// an opacity of their own.
std::string some_png(int colour_type, int depth, bool interlaced, int width, int height, std::uint64_t seed) {
    std::string out;
    CounterNoise noise(seed);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp of, png_bytep data, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(of))->append(reinterpret_cast<char*>(data), size);
        },
        [](png_structp) {});
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth,
                 colour_type, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::array<png_color, 256> palette{};
    std::array<png_byte, 128> opacity{};
    std::uint64_t counter = 0;
    const auto byte = [&] { return static_cast<png_byte>(noise.bits(counter++)); };
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
        for (png_color& c : palette) c = {byte(), byte(), byte()};
        for (png_byte& a : opacity) a = byte();
        png_set_PLTE(png, info, palette.data(), 1 << depth);
        png_set_tRNS(png, info, opacity.data(), 1 << (depth - 1), nullptr);
    }
    png_write_info(png, info);
    const std::size_t row_bytes = png_get_rowbytes(png, info);
    std::vector<std::vector<png_byte>> rows(static_cast<std::size_t>(height));
    std::vector<png_bytep> starts;
    for (auto& row : rows) {
        for (std::size_t n = 0; n < row_bytes; ++n) row.push_back(byte());
        starts.push_back(row.data());
    }
    png_write_image(png, starts.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

// A JPEG of smooth colours: `channels` 1, 3 or 4 (inks as Adobe writes them).
std::string some_jpeg(int channels, bool progressive, int width, int height,
                      const std::function<std::uint8_t(int x, int y, int channel)>& value) {
    jpeg_compress_struct jpeg = {};
    jpeg_error_mgr errors = {};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &memory, &size);
    jpeg.image_width = static_cast<JDIMENSION>(width);
    jpeg.image_height = static_cast<JDIMENSION>(height);
    jpeg.input_components = channels;
    jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<JSAMPLE> row(static_cast<std::size_t>(width * channels));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c)
                row[static_cast<std::size_t>(x * channels + c)] = value(x, y, c);
        }
        JSAMPROW start = row.data();
        jpeg_write_scanlines(&jpeg, &start, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string bytes(reinterpret_cast<char*>(memory), size);
    jpeg_destroy_compress(&jpeg);
    std::free(memory);
    return bytes;
}

std::uint8_t smooth(int x, int y, int channel) {
    return static_cast<std::uint8_t>(40 + 2 * x + y + 30 * channel);
}

// Bytes of the largest resident memory so far.
std::size_t peak_memory_kb() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        std::size_t kb = 0;
        if (word == "VmHWM:" && status >> kb) return kb;
    }
    return 0;
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const auto big_endian = [](std::uint64_t v) {
        return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                           static_cast<char>(v)};
    };
    const std::string body = type + data;
    return big_endian(data.size()) + body +
           big_endian(
               ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
}
std::string png_of(const std::string& header, const std::string& more, const std::string& packed) {
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + more + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}
std::string zeros_packed(std::size_t count) {
    std::string out(count / 500 + 100, '\0');
    z_stream stream = {};
    deflateInit(&stream, 9);
    std::vector<Bytef> block(1 << 20);
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    for (std::size_t left = count; left > 0;) {
        const std::size_t now = std::min(left, block.size());
        left -= now;
        stream.next_in = block.data();
        stream.avail_in = static_cast<uInt>(now);
        deflate(&stream, left == 0 ? Z_FINISH : Z_NO_FLUSH);
    }
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

RC_GTEST_PROP(PngImage, is_as_a_second_decoder_reads_it, (std::uint64_t seed)) {
    static constexpr std::array<std::array<int, 2>, 15> kinds{{{0, 1},
                                                               {0, 2},
                                                               {0, 4},
                                                               {0, 8},
                                                               {0, 16},
                                                               {2, 8},
                                                               {2, 16},
                                                               {3, 1},
                                                               {3, 2},
                                                               {3, 4},
                                                               {3, 8},
                                                               {4, 8},
                                                               {4, 16},
                                                               {6, 8},
                                                               {6, 16}}};
    const auto [type, depth] = kinds[seed % kinds.size()];
    const int width = 1 + static_cast<int>(seed / 15 % 40), height = 1 + static_cast<int>(seed / 600 % 23);
    const std::string bytes = some_png(type, depth, seed / 13800 % 2 == 1, width, height, seed);
    const Result<Image> image = parse_image(bytes, "a.png");
    RC_ASSERT(image.has_value());
    RC_ASSERT(image->width == width);
    RC_ASSERT(image->height == height);
    RC_ASSERT(image->rgba == decoded_by_stb(bytes));
}

TEST(JpegImage, is_as_a_second_decoder_reads_it) {
    for (const bool progressive : {false, true}) {
        for (const int channels : {1, 3}) {
            const std::string bytes = some_jpeg(channels, progressive, 45, 31, smooth);
            const Result<Image> image = parse_image(bytes, "a.jpg");
            ASSERT_TRUE(image) << image.error().cause;
            const std::vector<std::uint8_t> other = decoded_by_stb(bytes);
            ASSERT_EQ(image->rgba.size(), other.size());
            for (std::size_t n = 0; n < other.size(); ++n) {
                ASSERT_NEAR(image->rgba[n], other[n], 3) << n;
                const int x = static_cast<int>(n / 4 % 45), y = static_cast<int>(n / 4 / 45);
                const int channel = channels == 1 ? 0 : static_cast<int>(n % 4);
                ASSERT_NEAR(image->rgba[n], n % 4 == 3 ? 255 : smooth(x, y, channel), 6) << n;
            }
        }
    }
}

// Inks as Adobe's programs write them: 255 is no ink.
TEST(JpegImage, of_inks_is_the_light_that_they_leave) {
    const std::array<std::uint8_t, 4> inks{200, 100, 50, 128};
    const std::string plain =
        some_jpeg(4, false, 16, 16, [&](int, int, int c) { return inks[static_cast<std::size_t>(c)]; });
    // The writer leaves out the marker that says so; it goes behind the first two bytes.
    const std::string adobe(
        "\xff\xee\x00\x0e"
        "Adobe\x00\x64\x00\x00\x00\x00\x00",
        16);
    for (const bool marked : {false, true}) {
        std::string bytes = plain;
        const bool has = bytes.find("Adobe") != std::string::npos;
        if (marked && !has) bytes.insert(2, adobe);
        if (!marked && has) bytes.erase(bytes.find("\xff\xee"), 16);
        const Result<Image> image = parse_image(bytes, "ink.jpg");
        ASSERT_TRUE(image) << image.error().cause;
        for (std::size_t c = 0; c < 3; ++c) {
            const int light = marked ? inks[c] * inks[3] / 255 : (255 - inks[c]) * (255 - inks[3]) / 255;
            EXPECT_NEAR(image->rgba[c], light, 3) << marked << c;
        }
    }
}

// An Exif block that says nothing but how the picture is to be turned.
std::string exif_block(int orientation, bool big) {
    const auto number = [&](std::uint64_t value, int count) {
        std::string out;
        for (int n = 0; n < count; ++n)
            out += static_cast<char>(value >> 8 * (big ? count - 1 - n : n) & 255U);
        return out;
    };
    std::string block = std::string("Exif\0\0", 6) + (big ? "MM" : "II") + number(42, 2) + number(8, 4) +
                        number(1, 2) + number(274, 2) + number(3, 2) + number(1, 4) +
                        number(static_cast<std::uint64_t>(orientation), 2) + number(0, 6);
    const auto size = static_cast<unsigned>(block.size() + 2);
    return std::string("\xff\xe1") + static_cast<char>(size >> 8U) + static_cast<char>(size & 255U) + block;
}

// By the words of the standard: where the first row and the first column of what is stored are shown.
TEST(JpegImage, is_turned_as_the_camera_was_held) {
    constexpr int kWide = 24, kHigh = 16;  // as it is shown
    const auto scene = [](int x, int y) { return static_cast<std::uint8_t>(3 * x + 9 * y); };  // grey
    struct Held {
        int orientation;
        bool rows_across, from_right, from_bottom;  // rows of what is stored stand upright; the first row
                                                    // and column lie at the right or bottom
    };
    const Held all[] = {{1, false, false, false}, {2, false, true, false}, {3, false, true, true},
                        {4, false, false, true},  {5, true, false, false}, {6, true, true, false},
                        {7, true, true, true},    {8, true, false, true},  {9, false, false, false}};
    for (const Held& held : all) {
        const auto stored = [&](int column, int row, int) {
            int x = held.rows_across ? row : column, y = held.rows_across ? column : row;
            if (held.from_right) x = kWide - 1 - x;
            if (held.from_bottom) y = kHigh - 1 - y;
            return scene(x, y);
        };
        std::string bytes =
            some_jpeg(3, false, held.rows_across ? kHigh : kWide, held.rows_across ? kWide : kHigh, stored);
        bytes.insert(2, exif_block(held.orientation, held.orientation % 2 == 0));
        const Result<Image> image = parse_image(bytes, "a.jpg");
        ASSERT_TRUE(image) << image.error().cause;
        ASSERT_EQ(image->width, kWide) << held.orientation;
        ASSERT_EQ(image->height, kHigh);
        for (int n = 0; n < 3 * kWide * kHigh; ++n) {
            const int x = n / 3 % kWide, y = n / 3 / kWide;
            ASSERT_NEAR(image->rgba[static_cast<std::size_t>(4 * (y * kWide + x) + n % 3)], scene(x, y), 8)
                << held.orientation << ": " << x << ", " << y;
        }
    }
}

TEST(JpegImage, with_a_damaged_note_of_the_camera_is_shown_as_it_is_stored) {
    const std::string plain = some_jpeg(3, false, 24, 16, smooth);
    const std::string whole = exif_block(6, true);
    for (std::size_t kept = 10; kept < whole.size(); ++kept) {
        std::string block = whole.substr(0, kept);
        block[2] = 0;
        block[3] = static_cast<char>(kept - 2);
        std::string bytes = plain;
        bytes.insert(2, block);
        const Result<Image> image = parse_image(bytes, "a.jpg");
        ASSERT_TRUE(image) << kept << image.error().cause;
        EXPECT_EQ(image->width == 24, kept < 30) << kept;
    }
}

TEST(Image, that_is_cut_short_anywhere_is_refused) {
    const std::string png = some_png(6, 8, false, 20, 20, 7), jpeg = some_jpeg(3, false, 20, 20, smooth),
                      scans = some_jpeg(3, true, 20, 20, smooth);
    for (const std::string& whole : {png, jpeg, scans}) {
        ASSERT_TRUE(parse_image(whole, "a"));
        const std::size_t end = whole.size() - (whole == png ? 16 : 2);  // without what only says the end
        for (std::size_t n = 0; n < end; ++n) {
            const Result<Image> image = parse_image(whole.substr(0, n), "a");
            EXPECT_FALSE(image && n < end - 8) << n;
            if (image) continue;
            EXPECT_FALSE(image.error().cause.empty() || image.error().remedy.empty());
        }
    }
}

TEST(Image, that_says_too_much_is_refused_before_it_takes_memory) {
    const std::size_t before_kb = peak_memory_kb();
    const std::string huge("\x00\x00\x40\x00\x00\x00\x40\x00\x08\x06\x00\x00\x00", 13);  // 16384 x 16384
    const std::string wide("\x7f\xff\xff\xff\x00\x00\x00\x01\x08\x06\x00\x00\x00", 13);
    for (const std::string& header : {huge, wide}) {
        const Result<Image> image = parse_image(png_of(header, "", zeros_packed(1000)), "a.png");
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().cause.find("pixels"), std::string::npos) << image.error().cause;
    }
    std::string jpeg = some_jpeg(1, false, 8, 8, smooth);
    const std::size_t frame = jpeg.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    jpeg.replace(frame + 5, 4, "\xff\xff\xff\xff");
    EXPECT_FALSE(parse_image(jpeg, "a.jpg"));
    EXPECT_LT(peak_memory_kb(), before_kb + 20'000);
}

TEST(Image, that_unpacks_to_more_than_it_shows_takes_no_memory_for_it) {
    const std::string one("\x00\x00\x00\x01\x00\x00\x00\x01\x08\x06\x00\x00\x00", 13);
    const std::string bomb = zeros_packed(std::size_t{300} << 20);
    const std::string text = std::string("a\0\0", 3) + bomb;
    const std::size_t before_kb = peak_memory_kb();
    const Result<Image> image = parse_image(png_of(one, "", bomb), "a.png");
    EXPECT_TRUE(!image || image->rgba.size() == 4u);
    EXPECT_TRUE(parse_image(png_of(one, png_chunk("zTXt", text) + png_chunk("iCCP", text), zeros_packed(5)),
                            "a.png"));
    EXPECT_LT(peak_memory_kb(), before_kb + 20'000);
}

// A second table of Huffman codes with more codes than there can be, which older decoders wrote beyond
// their table.
TEST(JpegImage, with_tables_that_are_too_long_is_refused) {
    const std::string good = some_jpeg(1, false, 8, 8, smooth);
    for (const int count : {17, 255}) {
        for (const char table : {'\x00', '\x10', '\x01', '\x11'}) {
            std::string counts(16, static_cast<char>(count));
            std::string body =
                std::string(1, table) + counts + std::string(static_cast<std::size_t>(16 * count), '\x05');
            const std::size_t length = body.size() + 2;
            const std::string segment = std::string("\xff\xc4") + static_cast<char>(length >> 8) +
                                        static_cast<char>(length & 255) + body;
            std::string bytes = good;
            bytes.insert(bytes.find("\xff\xda"), segment);
            EXPECT_FALSE(parse_image(bytes, "a.jpg")) << count << " " << static_cast<int>(table);
        }
    }
}

TEST(JpegImage, of_scans_without_end_is_refused) {
    std::string bytes = some_jpeg(1, true, 64, 64, smooth);
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    ASSERT_TRUE(scan != std::string::npos && end != std::string::npos && scan < end);
    const std::string last = bytes.substr(scan, end - scan);
    for (int n = 0; n < 3000; ++n) bytes.insert(end, last);
    const Result<Image> image = parse_image(bytes, "a.jpg");
    ASSERT_FALSE(image);
    EXPECT_FALSE(image.error().cause.empty());
}

}  // namespace
}  // namespace tribo::files
