// SPDX-License-Identifier: MIT
#include "files/gzip.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <zlib.h>

namespace tribo::files {
namespace {

constexpr int kGzipOnly = 16 + MAX_WBITS;

// Ends the stream when the function returns.
struct Inflater {
    z_stream stream = {};
    bool ready = false;

    Inflater() { ready = inflateInit2(&stream, kGzipOnly) == Z_OK; }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() {
        if (ready) inflateEnd(&stream);
    }
};

}  // namespace

bool is_gzip(std::string_view bytes) {
    return bytes.starts_with("\x1f\x8b");
}

Result<std::string> gunzip(std::string_view bytes, std::uint64_t limit_bytes,
                           const std::string& source_name) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return fail_at(source_name, 0, 0, std::move(cause), std::move(remedy));
    };
    Inflater inflater;
    if (!inflater.ready) return refuse("there is no memory to unpack the file", "close other programs");
    z_stream& z = inflater.stream;
    std::string out;
    std::array<char, 1 << 16> piece;
    std::size_t at = 0;
    for (;;) {
        const std::size_t given = std::min<std::size_t>(bytes.size() - at, std::numeric_limits<uInt>::max());
        // The interface of zlib is not const; it does not write there.
        z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
        z.avail_in = static_cast<uInt>(given);
        z.next_out = reinterpret_cast<Bytef*>(piece.data());
        z.avail_out = static_cast<uInt>(piece.size());
        const int status = inflate(&z, Z_NO_FLUSH);
        at += given - z.avail_in;
        out.append(piece.data(), piece.size() - z.avail_out);
        if (out.size() > limit_bytes) {
            return refuse("it unpacks to more than " + std::to_string(limit_bytes / (1024 * 1024)) + " MB",
                          "unpack it with gunzip, or simplify it");
        }
        if (status == Z_STREAM_END) {
            // Another member may follow. Other bytes after a member are padding.
            if (!is_gzip(bytes.substr(at)) || inflateReset(&z) != Z_OK) return out;
        } else if (status == Z_BUF_ERROR || (status == Z_OK && at == bytes.size() && z.avail_out > 0)) {
            return refuse("the packed file is cut short", "copy it again");
        } else if (status != Z_OK) {
            return refuse("the packed file is damaged", "copy it again, or pack it again");
        }
    }
}

}  // namespace tribo::files
