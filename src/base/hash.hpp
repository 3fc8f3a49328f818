// SPDX-License-Identifier: MIT
// A hash of results, to prove that two builds computed the same bits: FNV-1a, 64 bits (Fowler, Noll, Vo
// 1991), over little-endian bytes. Not for tables that an opponent fills. No allocation.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>

#include "base/vec3.hpp"

namespace tribo {

class Hash {
  public:
    // Integers count as 64 bits, whatever their type, so that a size_t of 32 bits gives the same hash.
    template <std::integral Integer>
    constexpr void add(Integer value) {
        add_bits(static_cast<std::uint64_t>(value), 8);
    }
    // Floating-point numbers count by their bits: -0 differs from 0; all NaNs count as the same one.
    constexpr void add(double value) {
        add_bits(value == value ? std::bit_cast<std::uint64_t>(value) : 0x7ff8000000000000, 8);
    }
    constexpr void add(float value) {
        add_bits(value == value ? std::bit_cast<std::uint32_t>(value) : 0x7fc00000, 4);
    }
    constexpr void add(Vec3 value) {
        add(value.x);
        add(value.y);
        add(value.z);
    }
    // The characters, then their number.
    constexpr void add(std::string_view text) {
        for (const char c : text) add_bits(static_cast<unsigned char>(c), 1);
        add(text.size());
    }
    // The elements, then their number.
    template <class Range>
        requires(!std::convertible_to<const Range&, std::string_view>) &&
                requires(const Range& r) { r.begin() != r.end(); }
    constexpr void add(const Range& range) {
        std::uint64_t count = 0;
        for (const auto& element : range) {
            add(element);
            ++count;
        }
        add(count);
    }

    constexpr std::uint64_t value() const { return state_; }

  private:
    constexpr void add_bits(std::uint64_t bits, int bytes) {
        for (int i = 0; i < bytes; ++i) {
            state_ ^= (bits >> (8 * i)) & 0xff;
            state_ *= 0x100000001b3;
        }
    }
    std::uint64_t state_ = 0xcbf29ce484222325;
};

}  // namespace tribo
