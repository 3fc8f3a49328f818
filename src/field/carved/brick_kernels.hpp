// SPDX-License-Identifier: MIT
// What is done to all nodes of a brick at once. The same source is compiled for SSE2 and for x86-64-v3;
// brick_kernels() chooses once, by the processor. Both give the same bits.
#pragma once

#include <cstdint>

#include "field/carved/brick.hpp"

namespace tribo::field {

// Rises of less than this share of a cell are rounding: where two cuts leave the same surface, the first
// keeps it.
inline constexpr float kTieCells = 1e-4f;

struct BrickKernels {
    // Lowers the material to the complement of a shape: distance = max(distance, -shape) where that is above
    // -near_mm. `winner` becomes `index` at the nodes that moved and are now within near_mm of the surface,
    // Brick::kUnlisted at those that moved further out.
    CarveResult (*carve)(float* distance_mm, std::uint16_t* winner, const float* shape_mm,
                         std::uint16_t index, float near_mm, float cell_mm);
    // To be asked before that: which nodes are less than half a cell from both the surface of the material
    // and that of the shape, and these not one surface, in bits: node n is bit n % 8 of near_both[n / 8].
    // Whether any is.
    bool (*find_near_both)(const float* distance_mm, const float* shape_mm, float cell_mm,
                           std::uint8_t* near_both);
    // Volume of the material in cells.
    double (*volume_cells)(const float* distance_mm, float cell_mm);
};

const BrickKernels& brick_kernels();

// The two builds by name, for the test that compares them; v3 is null where the processor or target lacks it.
const BrickKernels* brick_kernels_sse2();
const BrickKernels* brick_kernels_v3();

}  // namespace tribo::field
