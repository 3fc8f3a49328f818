// SPDX-License-Identifier: MIT
// What a carved field is at one moment, kept to go back to. States share the bricks that did not change
// between them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "field/carved/brick.hpp"

namespace tribo::field {

struct KeptChunk {
    struct Place {
        std::uint16_t at;                    // BrickTable::place
        std::shared_ptr<const Brick> brick;  // null: air
    };
    std::uint64_t change = 0;   // number of the last carve that changed it
    std::vector<Place> places;  // those that are touched, in order
};

struct FieldState {
    std::size_t shapes = 0;  // carved so far
    double removed_mm3 = 0;
    std::vector<std::shared_ptr<const KeptChunk>> chunks;  // of the whole box; null: untouched
};

// Bytes that no other state shares.
std::size_t own_bytes(const FieldState& state);

}  // namespace tribo::field
