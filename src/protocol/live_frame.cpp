// SPDX-License-Identifier: MIT
#include "protocol/live_frame.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "protocol/live_fields.hpp"

namespace tribo::protocol {
namespace {

// Kind, version, flags, five zeros, time.
constexpr std::size_t kHeaderBytes = 16, kFlagsAt = 2, kTimeAt = 8;
// Of the longest edge of a mesh's box.
constexpr double kMeshSteps = 65535;

class Writer {
  public:
    static constexpr bool kReads = false;

    Writer(LiveFrame kind, std::vector<std::uint8_t>& out) : out_(out) {
        out_.assign(kHeaderBytes, 0);
        out_[0] = static_cast<std::uint8_t>(kind);
        out_[1] = kLiveFrameVersion;
    }

    template <class Integer>
    void u32(const char*, Integer v) {
        bits(static_cast<std::uint32_t>(v), 4);
    }
    void i32(const char*, std::int32_t v) { bits(static_cast<std::uint32_t>(v), 4); }
    void f32(const char*, double v) { f32(static_cast<float>(v)); }
    void f64(const char*, double v) { bits(std::bit_cast<std::uint64_t>(v), 8); }
    void vec3(const char*, Vec3 v) {
        for (int axis = 0; axis < 3; ++axis) f32(static_cast<float>(v[axis]));
    }
    void point(const char*, const Point3f& p) {
        for (const float v : p) f32(v);
    }
    void complex(const char*, std::complex<float> v) {
        f32(v.real());
        f32(v.imag());
    }
    void quantiles(const char*, const std::array<double, 4>& values) {
        for (const double v : values) f32(static_cast<float>(v));
    }
    void span_s(double start_s, double end_s) {
        f64("", start_s);
        f32(static_cast<float>(end_s - start_s));
    }
    template <class... Flags>
    void flags(Flags... flags) {
        std::uint32_t word = 0, bit = 1;
        ((word |= flags.value ? bit : 0, bit <<= 1), ...);
        bits(word, 4);
    }
    void header_flag(const char*, bool on) { out_[kFlagsAt] = on ? 1 : 0; }
    void time(const char*, double t_s) {
        const auto time = std::bit_cast<std::uint64_t>(t_s);
        for (unsigned n = 0; n < 8; ++n) out_[kTimeAt + n] = static_cast<std::uint8_t>(time >> (8 * n));
    }
    template <class Item>
    void time_of_first(const std::vector<Item>& items) {
        time("", items.empty() ? 0 : items.front().t_s);
    }
    // What readers of earlier versions of the program do not know of.
    void added() {}
    template <class Item>
    void list(const char* name, const std::vector<Item>& items) {
        u32(name, items.size());
        rest(name, items, 0);
    }
    template <class Item>
    void rest(const char*, const std::vector<Item>& items, std::size_t) {
        for (const Item& item : items) fields(*this, item);
    }
    template <class Item, class Visit>
    void each(const char*, const std::vector<Item>& items, const Visit& visit) {
        for (const Item& item : items) visit(*this, item);
    }
    template <class Number>
    void numbers(const char* name, const std::vector<Number>& values) {
        u32(name, values.size());
        out_.reserve(out_.size() + sizeof(Number) * values.size());
        for (const Number v : values) {
            if constexpr (std::is_same_v<Number, float>) {
                f32(v);
            } else {
                f64("", v);
            }
        }
    }
    // Of no values nothing is written, here and in the next two: the frame ends sooner.
    void text(const char*, const std::string& text) {
        u32("", text.size());
        for (const char c : text) bits(static_cast<unsigned char>(c), 1);
        pad();
    }
    template <class Item>
    void last_item(const char* name, const std::optional<Item>& item) {
        if (!item) return;
        u32(name, 1);
        fields(*this, *item);
    }
    // If any item has a value.
    template <class Item, class Has, class Visit>
    void last_each(const char* name, const std::vector<Item>& items, const Has& has, const Visit& visit) {
        if (std::none_of(items.begin(), items.end(), has)) return;
        u32(name, items.size());
        each(name, items, visit);
    }
    void mesh(const TriangleMesh& mesh, double step_mm = 0) {
        assert(mesh.positions.size() <= 65536);
        const Box3 box = bounds(mesh);
        const Vec3 size = mesh.positions.empty() ? Vec3{} : box.size();
        Vec3 origin = mesh.positions.empty() ? Vec3{} : box.min;
        const double longest = std::max({size.x, size.y, size.z});
        const double step = step_mm > 0 ? step_mm : longest > 0 ? longest / kMeshSteps : 1;
        for (int axis = 0; axis < 3 && step_mm > 0; ++axis)
            origin[axis] = step * std::floor(origin[axis] / step);
        u32("", mesh.positions.size());
        u32("", mesh.triangles.size());
        vec3("", origin);
        f32("", step);
        out_.reserve(out_.size() + 6 * mesh.positions.size() + 6 * mesh.triangles.size() + 8);
        for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
            const Vec3 p = (mesh.position(static_cast<std::uint32_t>(n)) - origin) / step;
            for (int axis = 0; axis < 3; ++axis)
                bits(static_cast<std::uint64_t>(std::clamp(p[axis] + 0.5, 0.0, kMeshSteps)), 2);
        }
        pad();
        for (const Triangle& t : mesh.triangles) {
            for (const std::uint32_t v : t) bits(v, 2);
        }
        pad();
    }

  private:
    void f32(float v) { bits(std::bit_cast<std::uint32_t>(v), 4); }
    // To a multiple of four bytes.
    void pad() {
        while (out_.size() % 4 != 0) out_.push_back(0);
    }
    void bits(std::uint64_t v, unsigned bytes) {
        for (unsigned n = 0; n < bytes; ++n) out_.push_back(static_cast<std::uint8_t>(v >> (8 * n)));
    }

    std::vector<std::uint8_t>& out_;
};

// Gives zeros beyond the end.
class Reader {
  public:
    static constexpr bool kReads = true;

    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    // Whether all was there but what was added later.
    bool whole() const { return whole_; }

    template <class Integer>
    void u32(const char*, Integer& v) {
        const auto word = static_cast<std::uint32_t>(bits(4));
        if constexpr (std::is_enum_v<Integer>) {
            v = static_cast<Integer>(std::min(word, 255U));
        } else {
            v = static_cast<Integer>(word);
        }
    }
    void i32(const char*, std::int32_t& v) { v = static_cast<std::int32_t>(bits(4)); }
    template <class Float>
    void f32(const char*, Float& v) {
        v = static_cast<Float>(f32());
    }
    void f64(const char*, double& v) { v = std::bit_cast<double>(bits(8)); }
    void vec3(const char*, Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<double>(f32());
    }
    void point(const char*, Point3f& p) {
        for (float& v : p) v = f32();
    }
    void complex(const char*, std::complex<float>& v) {
        const float real = f32(), imag = f32();
        v = {real, imag};
    }
    void quantiles(const char*, std::array<double, 4>& values) {
        for (double& v : values) v = static_cast<double>(f32());
    }
    void span_s(double& start_s, double& end_s) {
        f64("", start_s);
        end_s = start_s + static_cast<double>(f32());
    }
    template <class... Flags>
    void flags(Flags... flags) {
        auto word = static_cast<std::uint32_t>(bits(4));
        ((flags.value = (word & 1) != 0, word >>= 1), ...);
    }
    void header_flag(const char*, bool& on) { on = (bytes_[kFlagsAt] & 1) != 0; }
    void time(const char*, double& t_s) {
        const std::size_t kept = std::exchange(at_, kTimeAt);
        t_s = std::bit_cast<double>(bits(8));
        at_ = kept;
    }
    template <class Item>
    void time_of_first(const std::vector<Item>&) {}
    void added() { added_ = true; }
    template <class Item>
    void list(const char*, std::vector<Item>& items) {
        std::uint32_t told = 0;
        u32("", told);
        read_while(items, [&](std::size_t n) { return n < told && whole_ && (has(1) || !added_); });
    }
    template <class Item>
    void rest(const char*, std::vector<Item>& items, std::size_t item_bytes) {
        read_while(items, [&](std::size_t) { return has(item_bytes); });
    }
    template <class Item, class Visit>
    void each(const char*, std::vector<Item>& items, const Visit& visit) {
        for (Item& item : items) visit(*this, item);
    }
    template <class Number>
    void numbers(const char*, std::vector<Number>& values) {
        std::uint32_t told = 0;
        u32("", told);
        const bool there = has(sizeof(Number) * std::uint64_t{told});
        whole_ = whole_ && (there || added_);
        values.resize(there ? told : 0);
        for (Number& v : values) {
            if constexpr (std::is_same_v<Number, float>) {
                v = f32();
            } else {
                f64("", v);
            }
        }
    }
    void text(const char*, std::string& text) {
        std::uint32_t told = 0;
        u32("", told);
        whole_ = whole_ && has(told);
        text.clear();
        if (!whole_) return;
        for (std::uint32_t n = 0; n < told; ++n) text += static_cast<char>(bits(1));
        pad();
    }
    template <class Item>
    void last_item(const char*, std::optional<Item>& item) {
        std::uint32_t told = 0;
        u32("", told);
        item.reset();
        if (told != 1) return;
        Item there;
        fields(*this, there);
        if (at_ <= bytes_.size()) item = std::move(there);
    }
    // Values that are cut off are none.
    template <class Item, class Has, class Visit>
    void last_each(const char*, std::vector<Item>& items, const Has&, const Visit& visit) {
        std::uint32_t told = 0;
        u32("", told);
        const bool told_all = told == items.size();
        for (Item& item : items) {
            if (!told_all) at_ = bytes_.size() + 1;
            visit(*this, item);
        }
    }
    void mesh(TriangleMesh& mesh, double /*step_mm*/ = 0) {
        std::uint32_t vertices = 0, triangles = 0;
        Vec3 origin;
        double step = 0;
        u32("", vertices);
        u32("", triangles);
        vec3("", origin);
        f32("", step);
        whole_ = whole_ && has(6 * (std::uint64_t{vertices} + triangles));
        if (!whole_) return;
        mesh = {};
        mesh.positions.resize(vertices);
        for (Point3f& p : mesh.positions) {
            for (int axis = 0; axis < 3; ++axis) {
                p[static_cast<std::size_t>(axis)] =
                    static_cast<float>(origin[axis] + step * static_cast<double>(bits(2)));
            }
        }
        pad();
        mesh.triangles.resize(triangles);
        for (Triangle& t : mesh.triangles) {
            for (std::uint32_t& v : t) {
                v = static_cast<std::uint32_t>(bits(2));
                whole_ = whole_ && v < vertices;
            }
        }
        pad();
    }

  private:
    bool has(std::uint64_t bytes) const { return at_ <= bytes_.size() && bytes <= bytes_.size() - at_; }
    float f32() { return std::bit_cast<float>(static_cast<std::uint32_t>(bits(4))); }
    void pad() { (void)bits((4 - at_ % 4) % 4); }
    std::uint64_t bits(std::size_t bytes) {
        std::uint64_t v = 0;
        if (has(bytes)) {
            for (std::size_t n = 0; n < bytes; ++n) v |= std::uint64_t{bytes_[at_ + n]} << (8 * n);
        } else {
            whole_ = whole_ && added_;
        }
        at_ += bytes;
        return v;
    }
    // Items that are there already keep their room.
    template <class Item, class More>
    void read_while(std::vector<Item>& items, const More& more) {
        std::size_t n = 0;
        for (; more(n); ++n) {
            if (n == items.size()) items.resize(n + 1);
            fields(*this, items[n]);
        }
        items.resize(n);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = kHeaderBytes;
    bool whole_ = true, added_ = false;
};

}  // namespace

std::optional<LiveFrame> frame_kind(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kHeaderBytes || bytes[1] != kLiveFrameVersion) return std::nullopt;
    return static_cast<LiveFrame>(bytes[0]);
}

bool header_flag(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= kHeaderBytes && (bytes[kFlagsAt] & 1) != 0;
}

double step_of_chunks_mm(double longest_edge_mm, double farthest_mm) {
    const double least = std::max(longest_edge_mm / (kMeshSteps - 2),
                                  std::ldexp(farthest_mm, -std::numeric_limits<float>::digits));
    int exponent = 0;
    const double share = std::frexp(least, &exponent);
    return std::ldexp(1.0, share == 0.5 ? exponent - 1 : exponent);
}

template <class Frame>
void write_frame(const Frame& frame, std::vector<std::uint8_t>& out) {
    Writer writer(kKindOf<Frame>, out);
    fields(writer, frame);
}

template <class Frame>
bool read_frame(std::span<const std::uint8_t> bytes, Frame& frame) {
    if (frame_kind(bytes) != kKindOf<Frame>) return false;
    Reader reader(bytes);
    fields(reader, frame);
    return reader.whole();
}

#define TRIBO_FRAME(Frame)                                               \
    template void write_frame(const Frame&, std::vector<std::uint8_t>&); \
    template bool read_frame(std::span<const std::uint8_t>, Frame&)
TRIBO_FRAME(LiveJob);
TRIBO_FRAME(LiveChunk);
TRIBO_FRAME(LiveDesigned);
TRIBO_FRAME(LiveState);
TRIBO_FRAME(LiveRows);
TRIBO_FRAME(LiveCollision);
TRIBO_FRAME(LiveSoundPieces);
TRIBO_FRAME(LiveTouch);
TRIBO_FRAME(LiveServo);
TRIBO_FRAME(LiveTexture);
TRIBO_FRAME(job::Listening);
TRIBO_FRAME(LivePath);
TRIBO_FRAME(LiveProgram);
TRIBO_FRAME(LiveBending);
TRIBO_FRAME(LiveMultipliers);
TRIBO_FRAME(LiveChart);
template bool read_frame(std::span<const std::uint8_t>, LiveChunkPlace&);
#undef TRIBO_FRAME

}  // namespace tribo::protocol
