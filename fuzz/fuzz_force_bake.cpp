// SPDX-License-Identifier: MIT
// Any bytes give a force table that can be looked up everywhere, or an error with a remedy. The checksum is
// put right first: else nothing behind it would ever be reached.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/hash.hpp"
#include "readers/tables/force_bake.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tribo;
    constexpr std::size_t largest = 1 << 20, header = 64, checksum_at = 40;
    if (size > largest) return 0;
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (size >= header) {
        Hash hash;
        hash.add(std::string_view(bytes).substr(header));
        for (std::size_t n = 0; n < 8; ++n)
            bytes[checksum_at + n] = static_cast<char>(static_cast<unsigned char>(hash.value() >> (8 * n)));
    }
    const auto read = readers::read_force_bake(bytes, nullptr, "force.bake");
    if (!read) {
        if (read.error().cause.empty() || read.error().remedy.empty()) std::abort();
        return 0;
    }
    contact::ForceTable::Cursor cursor;
    for (const auto& piece : read->table.table().pieces()) {
        for (const double t_s : {piece.from, 0.5 * (piece.from + piece.to), piece.to}) {
            Vec3 force;
            if (!read->table.force_at(t_s, 1000, cursor, force)) std::abort();
        }
    }
    return 0;
}
