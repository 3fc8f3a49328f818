// SPDX-License-Identifier: MIT
#include "readers/tables/force_bake.hpp"

#include <bit>
#include <cmath>

#include "base/hash.hpp"

namespace tribo::readers {
namespace {

constexpr std::string_view kMagic = "TRIBOFT\n";
constexpr std::size_t kHeaderBytes = 64, kChecksumAt = 40;
constexpr std::uint32_t kMostChannels = 3 + 6 * contact::ForceTable::kMostHarmonics;
using Piece = contact::PerceptualTable::Piece;
using contact::ForcePiece;
static_assert(sizeof(Piece) == 24 && sizeof(ForcePiece) == 24 && sizeof(double) == 8 && sizeof(float) == 4);

template <class Unsigned>
void append(std::string& bytes, Unsigned value) {
    for (std::size_t n = 0; n < sizeof value; ++n)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * n)));
}
void append(std::string& bytes, double value) {
    append(bytes, std::bit_cast<std::uint64_t>(value));
}

template <class Unsigned>
Unsigned number_at(std::string_view bytes, std::size_t at) {
    Unsigned value = 0;
    for (std::size_t n = 0; n < sizeof value; ++n)
        value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<unsigned char>(bytes[at + n]))
                                                  << (8 * n));
    return value;
}
double double_at(std::string_view bytes, std::size_t at) {
    return std::bit_cast<double>(number_at<std::uint64_t>(bytes, at));
}

std::uint64_t checksum_of(std::string_view payload) {
    Hash hash;
    hash.add(payload);
    return hash.value();
}

// Data of a table whose bytes cannot be used in place.
struct Copy {
    std::vector<Piece> pieces;
    std::vector<ForcePiece> forces;
    std::vector<double> at;
    std::vector<float> values;
};

struct Layout {
    std::size_t channels = 0, pieces = 0, knots = 0;
    std::size_t pieces_at() const { return kHeaderBytes; }
    std::size_t forces_at() const { return pieces_at() + 24 * (pieces + 1); }
    std::size_t knots_at() const { return forces_at() + 24 * pieces; }
    std::size_t values_at() const { return knots_at() + 8 * knots; }
    std::size_t end() const { return values_at() + 4 * knots * channels; }
};

Copy copied(std::string_view bytes, const Layout& l) {
    Copy copy;
    for (std::size_t n = 0; n <= l.pieces; ++n) {
        const std::size_t at = l.pieces_at() + 24 * n;
        copy.pieces.push_back(
            {double_at(bytes, at), double_at(bytes, at + 8), number_at<std::uint64_t>(bytes, at + 16)});
    }
    for (std::size_t n = 0; n < l.pieces; ++n) {
        const std::size_t at = l.forces_at() + 24 * n;
        copy.forces.push_back({double_at(bytes, at), double_at(bytes, at + 8), double_at(bytes, at + 16)});
    }
    for (std::size_t n = 0; n < l.knots; ++n) copy.at.push_back(double_at(bytes, l.knots_at() + 8 * n));
    for (std::size_t n = 0; n < l.knots * l.channels; ++n)
        copy.values.push_back(std::bit_cast<float>(number_at<std::uint32_t>(bytes, l.values_at() + 4 * n)));
    return copy;
}

}  // namespace

std::string write_force_bake(const contact::ForceTable& table, std::uint64_t key) {
    const contact::PerceptualTable::Parts& parts = table.table().parts();
    std::string payload;
    // An empty table has only the end of the list.
    const std::size_t pieces = table.table().pieces().size();
    for (std::size_t n = 0; n < pieces; ++n) {
        append(payload, parts.pieces[n].from);
        append(payload, parts.pieces[n].to);
        append(payload, parts.pieces[n].first);
    }
    append(payload, 0.0);
    append(payload, 0.0);
    append(payload, std::uint64_t{parts.at.size()});
    for (const ForcePiece& p : table.pieces()) {
        append(payload, p.phase_rad);
        append(payload, p.rate_rad_per_s);
        append(payload, p.order_step);
    }
    for (const double at : parts.at) append(payload, at);
    for (const float value : parts.values) append(payload, std::bit_cast<std::uint32_t>(value));
    std::string bytes(kMagic);
    append(bytes, kForceBakeVersion);
    append(bytes, static_cast<std::uint32_t>(parts.channels));
    append(bytes, std::uint64_t{pieces});
    append(bytes, std::uint64_t{parts.at.size()});
    append(bytes, key);
    append(bytes, checksum_of(payload));
    bytes.resize(kHeaderBytes, '\0');
    return bytes + payload;
}

bool is_force_bake(std::string_view first_bytes) {
    static_assert(kMagic.size() == kForceBakeMagicBytes);
    return kMagic.starts_with(first_bytes.substr(0, kMagic.size()));
}

Result<ForceBake> read_force_bake(std::string_view bytes, std::shared_ptr<const void> owner,
                                  const std::string& source_name) {
    const auto refuse = [&](const char* cause) {
        return fail_at(source_name, 0, 0, cause, "delete it and bake again");
    };
    if (bytes.size() < kHeaderBytes || !bytes.starts_with(kMagic))
        return refuse("this is not a baked force table");
    if (number_at<std::uint32_t>(bytes, 8) != kForceBakeVersion)
        return refuse("this force table was baked by another version");
    Layout l;
    l.channels = number_at<std::uint32_t>(bytes, 12);
    const auto pieces = number_at<std::uint64_t>(bytes, 16), knots = number_at<std::uint64_t>(bytes, 24);
    // Checked before any multiplication: no count exceeds the number of bytes.
    if (l.channels < 3 - 2 * (knots == 0) || l.channels > kMostChannels || pieces > bytes.size() ||
        knots > bytes.size())
        return refuse("the header of this force table is damaged");
    l.pieces = static_cast<std::size_t>(pieces);
    l.knots = static_cast<std::size_t>(knots);
    if (l.end() != bytes.size()) return refuse("this force table is cut short or too long");
    if (checksum_of(bytes.substr(kHeaderBytes)) != number_at<std::uint64_t>(bytes, kChecksumAt))
        return refuse("the checksum of this force table is wrong: its bytes are damaged");
    ForceBake bake;
    bake.key = number_at<std::uint64_t>(bytes, 32);
    if (l.knots == 0) return bake;

    contact::PerceptualTable::Parts parts;
    std::span<const ForcePiece> forces;
    parts.channels = l.channels;
    const bool in_place = std::endian::native == std::endian::little &&
                          reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(std::uint64_t) == 0;
    if (in_place) {
        const char* base = bytes.data();
        parts.pieces = {reinterpret_cast<const Piece*>(base + l.pieces_at()), l.pieces + 1};
        parts.at = {reinterpret_cast<const double*>(base + l.knots_at()), l.knots};
        parts.values = {reinterpret_cast<const float*>(base + l.values_at()), l.knots * l.channels};
        forces = {reinterpret_cast<const ForcePiece*>(base + l.forces_at()), l.pieces};
    } else {
        auto copy = std::make_shared<Copy>(copied(bytes, l));
        parts.pieces = copy->pieces;
        parts.at = copy->at;
        parts.values = copy->values;
        forces = copy->forces;
        owner = std::move(copy);
    }
    parts.owner = owner;
    if (!contact::parts_are_sound(parts)) return refuse("this force table does not hold together");
    for (const ForcePiece& p : forces) {
        if (!(std::abs(p.phase_rad) <= 1e12) || !(p.rate_rad_per_s >= 0 && p.rate_rad_per_s <= 1e9) ||
            !(p.order_step >= 1 && p.order_step <= 1e4))
            return refuse("this force table does not hold together");
    }
    bake.table = contact::ForceTable(contact::PerceptualTable(std::move(parts)), forces, std::move(owner));
    return bake;
}

}  // namespace tribo::readers
