// SPDX-License-Identifier: MIT
// The kernels of brick_kernels.hpp; included by brick_kernels_sse2.cpp and brick_kernels_v3.cpp.
#include "base/simd.hpp"
#include "field/carved/brick_kernels.hpp"

namespace tribo::field {
namespace {

using namespace simd;

// Nodes on faces, edges and corners of a brick count for a half, a quarter and an eighth: the share of the
// cells around them that lies in the brick.
constexpr F8 kShareOfRow{0.5f, 1, 1, 1, 1, 1, 1, 0.5f};
constexpr float kShare[kLatticeEdge] = {0.5f, 1, 1, 1, 1, 1, 1, 0.5f};

// Returns how full of material the cell around a node is: exact for planes along the grid, without bias for
// others.
TRIBO_LANES F8 filled(F8 distance, F8 per_cell) {
    return min(max(splat(0.5f) - distance * per_cell, splat(0.0f)), splat(1.0f));
}

TRIBO_LANES double sum(F8 v) {
    return static_cast<double>(((v[0] + v[7]) + (v[1] + v[6])) + ((v[2] + v[5]) + (v[3] + v[4])));
}

CarveResult carve(float* distance, std::uint16_t* winner, const float* shape, std::uint16_t index,
                  float near_mm, float cell, float tie_mm) {
    const F8 near = splat(near_mm), deep = splat(-near_mm), tie = splat(kTieCells * cell);
    const F8 alike = splat(tie_mm);
    const F8 per_cell = splat(1 / cell);
    F8 least = splat(1e30f), removed = splat(0.0f);
    I8 changed{}, won{}, tied{};
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b) {
            const int row = node_index(0, b, c);
            const F8 before = load(distance + row), carved = -load(shape + row);
            const I8 rises = both(carved > before + tie, carved > deep);
            tied |= both(abs(carved - before) <= alike, abs(before) < near);
            if (any(rises)) {
                const F8 after = select(rises, carved, before);
                store(distance + row, after);
                const I8 wins = both(rises, carved < near);
                const S8 rose = narrow(rises), listed = narrow(wins);
                const S8 named = (listed & splat(index)) | ~listed;
                store(winner + row, (rose & named) | (~rose & load(winner + row)));
                removed +=
                    (filled(before, per_cell) - filled(after, per_cell)) * splat(kShare[b] * kShare[c]);
                changed |= rises;
                won |= wins;
                least = min(least, after);
            } else {
                least = min(least, before);
            }
        }
    }
    CarveResult result{any(changed), any(won), any(tied), least[0], sum(removed * kShareOfRow)};
    for (int n = 1; n < kLatticeEdge; ++n) result.least_mm = min(result.least_mm, least[n]);
    return result;
}

bool find_near_both(const float* distance, const float* shape, float cell, std::uint8_t* near_both) {
    const F8 half = splat(0.5f * cell), tie = splat(kTieCells * cell);
    bool found = false;
    for (int row = 0; row < kLatticeEdge * kLatticeEdge; ++row) {
        const F8 own = load(distance + kLatticeEdge * row), other = -load(shape + kLatticeEdge * row);
        const I8 near = both(both(abs(own) < half, abs(other) < half), abs(own - other) > tie);
        near_both[row] = 0;
        if (!any(near)) continue;
        found = true;
        for (int n = 0; n < kLatticeEdge; ++n)
            near_both[row] = static_cast<std::uint8_t>(near_both[row] | (near[n] != 0 ? 1 << n : 0));
    }
    return found;
}

double volume_cells(const float* distance, float cell) {
    const F8 per_cell = splat(1 / cell);
    F8 full = splat(0.0f);
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b) {
            full += filled(load(distance + node_index(0, b, c)), per_cell) * splat(kShare[b] * kShare[c]);
        }
    }
    return sum(full * kShareOfRow);
}

constexpr BrickKernels kKernels{carve, find_near_both, volume_cells};

}  // namespace
}  // namespace tribo::field
