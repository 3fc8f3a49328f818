// SPDX-License-Identifier: MIT
#include "files/image/jpeg.hpp"

#include <csetjmp>
#include <cstdio>
#include <jerror.h>
#include <jpeglib.h>

#include "files/image/orientation.hpp"

namespace tribo::files {
namespace {

// A progressive picture may name any number of scans, each a few bytes that cost a look at every pixel.
// Cameras and editors write about ten.
constexpr std::uint64_t kMostScanPixels = std::uint64_t{1} << 30;
constexpr int kMostScans = 200;
constexpr std::string_view kExif("Exif\0\0", 6);

bool is_harmless(int warning) {
    return warning == JWRN_EXTRANEOUS_DATA || warning == JWRN_JFIF_MAJOR || warning == JWRN_TOO_MUCH_DATA;
}

// libjpeg leaves an error by a jump (longjmp) to the last setjmp. So a function that calls setjmp has no
// local with a destructor: everything lives here.
struct Decoder {
    jpeg_decompress_struct jpeg = {};
    jpeg_error_mgr errors = {};
    jpeg_progress_mgr progress = {};
    std::jmp_buf out;
    std::string cause;
    Image image;
    int orientation = 1;

    ~Decoder() { jpeg_destroy_decompress(&jpeg); }

    static Decoder& of(j_common_ptr jpeg) { return *static_cast<Decoder*>(jpeg->client_data); }
    void note_damage() {
        char message[JMSG_LENGTH_MAX];
        errors.format_message(reinterpret_cast<j_common_ptr>(&jpeg), message);
        cause = std::string("the image is damaged: ") + message;
    }
    static void damaged(j_common_ptr jpeg) {
        of(jpeg).note_damage();
        std::longjmp(of(jpeg).out, 1);
    }
    static void warn(j_common_ptr jpeg, int level) {
        if (level < 0 && !is_harmless(jpeg->err->msg_code)) damaged(jpeg);
    }
    static void count_scans(j_common_ptr jpeg) {
        Decoder& self = of(jpeg);
        const int scans = self.jpeg.input_scan_number;
        const std::uint64_t pixels = std::uint64_t{self.jpeg.image_width} * self.jpeg.image_height;
        if (scans <= kMostScans && static_cast<std::uint64_t>(scans) * pixels <= kMostScanPixels) return;
        self.cause = "the image has more scans than any program writes";
        std::longjmp(self.out, 1);
    }

    // Four channels of ink: as Adobe writes them, inverted, else as the standard says.
    void ink_to_light(std::uint8_t* pixel) const {
        const auto light = [&](std::uint8_t v) { return jpeg.saw_Adobe_marker != FALSE ? v : 255 - v; };
        const int black = light(pixel[3]);
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>((light(pixel[c]) * black + 127) / 255);
        pixel[3] = 255;
    }

    int noted_orientation() const {
        for (jpeg_saved_marker_ptr block = jpeg.marker_list; block != nullptr; block = block->next) {
            const std::string_view data(reinterpret_cast<const char*>(block->data), block->data_length);
            if (data.starts_with(kExif)) return exif_orientation(data.substr(kExif.size()));
        }
        return 1;
    }

    bool decode(std::string_view bytes) {
        jpeg.err = jpeg_std_error(&errors);
        errors.error_exit = damaged;
        errors.emit_message = warn;
        jpeg.client_data = this;
        if (setjmp(out) != 0) return false;
        jpeg_create_decompress(&jpeg);
        progress.progress_monitor = count_scans;
        jpeg.progress = &progress;
        jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
        jpeg_save_markers(&jpeg, JPEG_APP0 + 1, 0xFFFF);
        jpeg_read_header(&jpeg, TRUE);
        orientation = noted_orientation();
        if (!is_image_size(jpeg.image_width, jpeg.image_height)) {
            cause = too_large_image(jpeg.image_width, jpeg.image_height);
            return false;
        }
        const bool ink = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
        jpeg.out_color_space = ink ? JCS_CMYK : JCS_EXT_RGBA;
        jpeg_start_decompress(&jpeg);
        const std::size_t row_bytes = std::size_t{4} * jpeg.output_width;
        image.width = static_cast<int>(jpeg.output_width);
        image.height = static_cast<int>(jpeg.output_height);
        image.rgba.resize(row_bytes * jpeg.output_height);
        while (jpeg.output_scanline < jpeg.output_height) {
            JSAMPROW row = image.rgba.data() + row_bytes * jpeg.output_scanline;
            jpeg_read_scanlines(&jpeg, &row, 1);
        }
        if (ink) {
            for (std::size_t n = 0; n < image.rgba.size(); n += 4) ink_to_light(image.rgba.data() + n);
        }
        jpeg_finish_decompress(&jpeg);
        return true;
    }
};

}  // namespace

std::expected<Image, std::string> parse_jpeg(std::string_view bytes) {
    Decoder decoder;
    if (!decoder.decode(bytes)) return std::unexpected(std::move(decoder.cause));
    return turned(std::move(decoder.image), decoder.orientation);
}

}  // namespace tribo::files
