// SPDX-License-Identifier: MIT
#include "field/brick.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::field {

CarveResult carve_nodes(Brick& brick, const float* shape_mm, std::uint16_t index, float near_mm) {
    float* const distance = brick.distance_mm.data();
    int rises = 0;
    for (int n = 0; n < kLatticeNodes; ++n) {
        const float carved = -shape_mm[n];
        rises += static_cast<int>(carved > distance[n]) & static_cast<int>(carved > -near_mm);
    }
    if (rises == 0) return {};
    CarveResult result{true, false, distance[0]};
    int wins = 0;
    float least = std::max(distance[0], -shape_mm[0]);
    for (int n = 0; n < kLatticeNodes; ++n) {
        const float carved = -shape_mm[n];
        const bool rise = carved > distance[n] && carved > -near_mm;
        distance[n] = rise ? carved : distance[n];
        brick.winner[static_cast<std::size_t>(n)] = rise ? index : brick.winner[static_cast<std::size_t>(n)];
        wins += static_cast<int>(rise) & static_cast<int>(carved < near_mm);
        least = std::min(least, distance[n]);
    }
    result.won = wins > 0;
    result.least_mm = least;
    return result;
}

double brick_volume_mm3(const float* distance_mm, double cell_mm) {
    const float per_cell = static_cast<float>(1 / cell_mm);
    double sum = 0;
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b) {
            const float* row = distance_mm + node_index(0, b, c);
            float filled[kLatticeEdge];
            for (int a = 0; a < kLatticeEdge; ++a) {
                filled[a] = std::min(1.0f, std::max(0.0f, 0.5f - row[a] * per_cell));
            }
            const float ends = 0.5f * (filled[0] + filled[7]);
            const float inner = ((filled[1] + filled[2]) + (filled[3] + filled[4])) + (filled[5] + filled[6]);
            const double weight = (b == 0 || b == 7 ? 0.5 : 1.0) * (c == 0 || c == 7 ? 0.5 : 1.0);
            sum += weight * static_cast<double>(ends + inner);
        }
    }
    return sum * cell_mm * cell_mm * cell_mm;
}

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
