// SPDX-License-Identifier: MIT
// Hashes over what each room computes on fixed inputs. They prove that builds agree to the bit, never that
// they are right: the tests of each room do that. Compiled natively and into golden.wasm; the agreed values
// stand in golden.txt.
#pragma once

#include <cstdint>
#include <span>

namespace tribo::golden {

struct Golden {
    const char* name;  // as in golden.txt
    std::uint64_t (*hash)();
};

std::span<const Golden> goldens();

std::uint64_t math();
std::uint64_t decimal();
std::uint64_t noise_hash();
std::uint64_t motion();
std::uint64_t field();
std::uint64_t force();
std::uint64_t dynamics();
std::uint64_t elastic();
std::uint64_t readers();
std::uint64_t surface();
std::uint64_t haptics();
std::uint64_t learning();
std::uint64_t mill_three_axes();
std::uint64_t mill_five_axes();
std::uint64_t mill_profiles();
std::uint64_t audit();

}  // namespace tribo::golden
