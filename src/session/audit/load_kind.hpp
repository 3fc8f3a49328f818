// SPDX-License-Identifier: MIT
// The loads of a cut that are held against limits.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tribo::session {

enum class LoadKind { force, torque, power, stress, deflection, chip, multiplier };
inline constexpr std::size_t kLoadKinds = 7;

struct LoadWords {
    std::string_view name;   // in a sentence
    std::string_view key;    // of files
    std::string_view unit;   // empty: a plain number
    std::string_view fault;  // of what is over its limit, in a sentence
};

// In the order of LoadKind.
inline constexpr std::array<LoadWords, kLoadKinds> kLoadWords{{
    {"force", "peak_force_n", "N", "the force is too large"},
    {"torque", "peak_torque_nm", "N m", "the torque is too large"},
    {"power", "power_w", "W", "the spindle stalls"},
    {"bending stress", "stress_n_per_mm2", "N/mm2", "the cutter breaks"},
    {"deflection", "deflection_mm", "mm", "the tool bends too far"},
    {"chip", "chip_mm", "mm", "the teeth are overloaded"},
    {"multiplier", "multiplier", "", "the cut chatters"},
}};

constexpr std::size_t index_of(LoadKind kind) {
    return static_cast<std::size_t>(kind);
}
// A chip is as thick whatever the force; how a multiplier follows the force is another question.
constexpr bool follows_force(LoadKind kind) {
    return kind != LoadKind::chip && kind != LoadKind::multiplier;
}
constexpr const LoadWords& words_of(LoadKind kind) {
    return kLoadWords[index_of(kind)];
}

}  // namespace tribo::session
