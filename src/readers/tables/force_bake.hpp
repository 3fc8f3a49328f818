// SPDX-License-Identifier: MIT
// A force table as a file: written once, then read and used in place.
//
// All numbers little-endian, every block begins at a multiple of 8 bytes:
//   64 bytes   "TRIBOFT\n", version u32, channels u32, pieces u64, knots u64, key u64, checksum u64, 16 zero
//   pieces + 1 from f64, to f64, first knot u64         (the last one ends the list: its first is `knots`)
//   pieces     phase f64, rate f64, order step f64
//   knots      at f64
//   knots      channels values f32
// The checksum is FNV-1a over all bytes after the header. The key identifies the inputs of the table.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "contact/force_table.hpp"

namespace tribo::readers {

inline constexpr std::uint32_t kForceBakeVersion = 1;

std::string write_force_bake(const contact::ForceTable& table, std::uint64_t key);

// True if the first kForceBakeMagicBytes are those of a baked table of any version, damaged or cut short,
// down to no byte at all. Nothing else may be replaced by a new table.
inline constexpr std::size_t kForceBakeMagicBytes = 8;
bool is_force_bake(std::string_view first_bytes);

struct ForceBake {
    contact::ForceTable table;
    std::uint64_t key = 0;
};

// Returns the table in the bytes. `owner` keeps the bytes alive. The table uses them in place if they are
// aligned to 8 bytes and the machine is little-endian, else it copies them. Linear in the bytes (the
// checksum).
Result<ForceBake> read_force_bake(std::string_view bytes, std::shared_ptr<const void> owner,
                                  const std::string& source_name);

}  // namespace tribo::readers
