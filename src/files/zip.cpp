// SPDX-License-Identifier: MIT
#include "files/zip.hpp"

#include <optional>
#include <zlib.h>

namespace tribo::files {
namespace {

// Record sizes and signatures of APPNOTE 4.3.
constexpr std::string_view kLocal = "PK\x03\x04", kCentral = "PK\x01\x02", kEnd = "PK\x05\x06";
constexpr std::size_t kLocalSize = 30, kCentralSize = 46, kEndSize = 22, kLongestComment = 65535;
constexpr unsigned kStored = 0, kDeflated = 8;
constexpr unsigned kEncrypted = 1;

std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i > 0; --i)
        value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

struct Entry {
    unsigned flags = 0, method = 0;
    std::uint32_t checksum = 0, packed = 0, size = 0, place = 0;
};

// Finds an entry in the directory at the end of the archive. None: there is none; an error: the directory is
// broken.
Result<std::optional<Entry>> find(std::string_view bytes, std::string_view suffix,
                                  const std::string& source_name) {
    const auto broken = [&]() {
        return fail_at(source_name, 0, 0, "the packed file (zip) is damaged or cut short",
                       "copy or pack it again");
    };
    if (bytes.size() < kEndSize) return broken();
    const std::size_t last = bytes.size() - kEndSize;
    std::size_t end = bytes.rfind(kEnd, last);
    if (end == std::string_view::npos || last - end > kLongestComment) return broken();
    const std::size_t count = number_at(bytes, end + 10, 2);
    std::size_t at = number_at(bytes, end + 16, 4);
    for (std::size_t i = 0; i < count; ++i) {
        if (at > bytes.size() || bytes.size() - at < kCentralSize || !bytes.substr(at).starts_with(kCentral))
            return broken();
        const std::size_t name = number_at(bytes, at + 28, 2), extra = number_at(bytes, at + 30, 2),
                          comment = number_at(bytes, at + 32, 2);
        if (bytes.size() - at - kCentralSize < name + extra + comment) return broken();
        if (bytes.substr(at + kCentralSize, name).ends_with(suffix)) {
            Entry entry;
            entry.flags = number_at(bytes, at + 8, 2);
            entry.method = number_at(bytes, at + 10, 2);
            entry.checksum = number_at(bytes, at + 16, 4);
            entry.packed = number_at(bytes, at + 20, 4);
            entry.size = number_at(bytes, at + 24, 4);
            entry.place = number_at(bytes, at + 42, 4);
            return entry;
        }
        at += kCentralSize + name + extra + comment;
    }
    return std::optional<Entry>();
}

// Unpacks raw deflate into exactly `size` bytes; false if they are more, fewer or none.
bool inflate_to(std::string_view packed, std::string& out) {
    z_stream z = {};
    if (inflateInit2(&z, -MAX_WBITS) != Z_OK) return false;
    // The interface of zlib is not const; it does not write there.
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    z.avail_in = static_cast<uInt>(packed.size());
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    const int status = inflate(&z, Z_FINISH);
    const bool whole = status == Z_STREAM_END && z.avail_out == 0;
    inflateEnd(&z);
    return whole;
}

}  // namespace

bool is_zip(std::string_view bytes) {
    return bytes.starts_with(kLocal);
}

Result<std::string> unzip(std::string_view bytes, std::string_view suffix, std::uint64_t limit_bytes,
                          const std::string& source_name) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return fail_at(source_name, 0, 0, std::move(cause), std::move(remedy));
    };
    const auto found = find(bytes, suffix, source_name);
    if (!found) return std::unexpected(found.error());
    if (!*found)
        return refuse("the packed file (zip) holds no " + std::string(suffix),
                      "unpack it and give the right file");
    const Entry& entry = **found;
    if ((entry.flags & kEncrypted) != 0)
        return refuse("the packed file (zip) is encrypted", "unpack it first");
    if (entry.method != kStored && entry.method != kDeflated)
        return refuse("the packed file (zip) is packed in a rare way", "unpack it first");
    if (entry.size > limit_bytes) {
        return refuse("it unpacks to more than " + std::to_string(limit_bytes / (1024 * 1024)) + " MB",
                      "check that it is the right file");
    }
    constexpr const char* kDamaged = "the packed file (zip) is damaged or cut short";
    if (entry.place > bytes.size() || bytes.size() - entry.place < kLocalSize ||
        !bytes.substr(entry.place).starts_with(kLocal))
        return refuse(kDamaged, "copy or pack it again");
    const std::size_t head =
        kLocalSize + number_at(bytes, entry.place + 26, 2) + number_at(bytes, entry.place + 28, 2);
    if (bytes.size() - entry.place < head || bytes.size() - entry.place - head < entry.packed)
        return refuse(kDamaged, "copy or pack it again");
    const std::string_view packed = bytes.substr(entry.place + head, entry.packed);
    std::string out;
    if (entry.method == kStored) {
        out = packed;
    } else {
        out.resize(entry.size);
        if (entry.size > 0 && !inflate_to(packed, out)) return refuse(kDamaged, "copy or pack it again");
    }
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(out.data()), static_cast<uInt>(out.size()));
    if (out.size() != entry.size || sum != entry.checksum) return refuse(kDamaged, "copy or pack it again");
    return out;
}

}  // namespace tribo::files
