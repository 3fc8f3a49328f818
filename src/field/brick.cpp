// SPDX-License-Identifier: MIT
#include "field/brick.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::field {

void prune_shapes(Brick& brick, float near_mm) {
    std::vector<std::uint16_t> renamed(brick.shapes.size(), Brick::kUnlisted);
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const std::uint16_t w = brick.winner[n];
        if (w != Brick::kUnlisted && std::abs(brick.distance_mm[n]) < near_mm) renamed[w] = 0;
    }
    std::uint16_t kept = 0;
    for (std::size_t s = 0; s < renamed.size(); ++s) {
        if (renamed[s] == Brick::kUnlisted) continue;
        renamed[s] = kept;
        brick.shapes[kept++] = brick.shapes[s];
    }
    brick.shapes.resize(kept);
    for (std::uint16_t& w : brick.winner) {
        if (w != Brick::kUnlisted) w = renamed[w];
    }
}

}  // namespace tribo::field
