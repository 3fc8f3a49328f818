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

constexpr F8 kHalf{0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
constexpr std::uint64_t kEachByte = 0x0101010101010101;
// What is stored of larger distances, in cells.
constexpr float kMostCells = 1.9999f;
static_assert(kMostCells > Brick::kNearCells && kMostCells * kStepsPerCell < INT16_MAX);

// Returns how full of material the cell around a node is: exact for planes along the grid, without bias for
// others.
TRIBO_LANES F8 filled(F8 cells) {
    return min(max(kHalf - cells, splat(0.0f)), splat(1.0f));
}

TRIBO_LANES double sum(F8 v) {
    return static_cast<double>(((v[0] + v[7]) + (v[1] + v[6])) + ((v[2] + v[5]) + (v[3] + v[4])));
}

TRIBO_LANES F8 load_cells(const NodeSteps* steps) {
    S8 whole;
    __builtin_memcpy(&whole, steps, sizeof whole);
    return (__builtin_convertvector(whole, F8) + kHalf) * splat(1 / kStepsPerCell);
}

// Returns whole numbers; cells: kDeepest to kMostCells.
TRIBO_LANES I8 to_whole_steps(F8 cells) {
    const F8 steps = cells * splat(kStepsPerCell);
    const I8 whole = __builtin_convertvector(steps, I8);  // towards 0
    return whole + (__builtin_convertvector(whole, F8) > steps);
}

TRIBO_LANES void store_steps(NodeSteps* steps, I8 whole) {
    const S8 v = narrow(whole);
    __builtin_memcpy(steps, &v, sizeof v);
}

// One byte of a mask for each lane.
TRIBO_LANES std::uint64_t bytes(I8 mask) {
    const B8 v = __builtin_convertvector(narrow(mask), B8);
    std::uint64_t all;
    __builtin_memcpy(&all, &v, sizeof all);
    return all;
}

TRIBO_LANES std::uint64_t load_bytes(const std::uint8_t* p) {
    std::uint64_t all;
    __builtin_memcpy(&all, p, sizeof all);
    return all;
}

TRIBO_LANES void store_bytes(std::uint8_t* p, std::uint64_t all) {
    __builtin_memcpy(p, &all, sizeof all);
}

// Sets the bytes of a row where `rose` holds: to `byte` where `listed` holds too, else to 0xff.
TRIBO_LANES void set_bytes(std::uint8_t* row, std::uint64_t rose, std::uint64_t listed, unsigned byte) {
    const std::uint64_t named = (listed & kEachByte * byte) | ~listed;
    store_bytes(row, (rose & named) | (~rose & load_bytes(row)));
}

void to_steps(const float* distance_mm, float cell_mm, NodeSteps* steps) {
    const F8 least = splat(kDeepest), most = splat(kMostCells), per_cell = splat(1 / cell_mm);
    for (int n = 0; n < kLatticeNodes; n += kLatticeEdge)
        store_steps(steps + n, to_whole_steps(min(max(load(distance_mm + n) * per_cell, least), most)));
}

CarveResult carve(NodeSteps* steps, std::uint8_t* winner_low, std::uint8_t* winner_high,
                  const float* shape_mm, std::uint16_t index, float cell_mm, float tie_mm) {
    const F8 near = splat(Brick::kNearCells), deep = -near, most = splat(kMostCells), tie = splat(kTieCells);
    const F8 to_cells = splat(-1 / cell_mm), alike = splat(tie_mm / cell_mm);
    F8 least = splat(1e30f), removed = splat(0.0f);
    I8 changed{}, won{}, tied{};
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b) {
            const int row = node_index(0, b, c);
            const F8 before = load_cells(steps + row), carved = min(load(shape_mm + row) * to_cells, most);
            const I8 rises = both(carved > before + tie, carved > deep);
            tied |= both(abs(carved - before) <= alike, abs(before) < near);
            if (any(rises)) {
                const I8 whole = to_whole_steps(select(rises, carved, before));
                const F8 after = (__builtin_convertvector(whole, F8) + kHalf) * splat(1 / kStepsPerCell);
                store_steps(steps + row, whole);
                const I8 wins = both(rises, carved < near);
                const std::uint64_t rose = bytes(rises), listed = bytes(wins);
                set_bytes(winner_low + row, rose, listed, index & 0xffU);
                if (winner_high) set_bytes(winner_high + row, rose, listed, index >> 8U);
                removed += (filled(before) - filled(after)) * splat(kShare[b] * kShare[c]);
                changed |= rises;
                won |= wins;
                least = min(least, after);
            } else {
                least = min(least, before);
            }
        }
    }
    CarveResult result{any(changed), any(won), any(tied), least[0], sum(removed * kShareOfRow)};
    for (int n = 1; n < kLatticeEdge; ++n) result.least_cells = min(result.least_cells, least[n]);
    return result;
}

bool find_near_both(const NodeSteps* steps, const float* shape_mm, float cell_mm, std::uint8_t* near_both) {
    const F8 to_cells = splat(-1 / cell_mm), tie = splat(kTieCells);
    bool found = false;
    for (int row = 0; row < kLatticeEdge * kLatticeEdge; ++row) {
        const F8 own = load_cells(steps + kLatticeEdge * row);
        const F8 other = load(shape_mm + kLatticeEdge * row) * to_cells;
        const I8 near = both(both(abs(own) < kHalf, abs(other) < kHalf), abs(own - other) > tie);
        near_both[row] = 0;
        if (!any(near)) continue;
        found = true;
        for (int n = 0; n < kLatticeEdge; ++n)
            near_both[row] = static_cast<std::uint8_t>(near_both[row] | (near[n] != 0 ? 1 << n : 0));
    }
    return found;
}

void mark_near(const NodeSteps* steps, const float* shape_mm, float cell_mm, float tie_mm,
               std::uint8_t* marks) {
    const F8 per_cell = splat(1 / cell_mm), tie = splat(tie_mm / cell_mm), reach = splat(Brick::kNearCells);
    for (int n = 0; n < kLatticeNodes; n += kLatticeEdge) {
        const F8 own = load_cells(steps + n);
        const I8 near = abs(own) < reach;
        const I8 alone = both(near, abs(own + load(shape_mm + n) * per_cell) > tie);
        store_bytes(marks + n,
                    (bytes(near) & kEachByte * kMarkNear) | (bytes(alone) & kEachByte * kMarkAlone));
    }
}

double volume_cells(const NodeSteps* steps) {
    F8 full = splat(0.0f);
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b)
            full += filled(load_cells(steps + node_index(0, b, c))) * splat(kShare[b] * kShare[c]);
    }
    return sum(full * kShareOfRow);
}

constexpr BrickKernels kKernels{to_steps, carve, find_near_both, mark_near, volume_cells};

}  // namespace
}  // namespace tribo::field
