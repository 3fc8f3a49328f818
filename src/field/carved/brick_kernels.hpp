// SPDX-License-Identifier: MIT
// Operations on all nodes of a brick at once. The same source is compiled for SSE2 and for x86-64-v3;
// brick_kernels() chooses once, by the processor. Both give the same bits.
#pragma once

#include <cstdint>

#include "field/carved/brick.hpp"

namespace tribo::field {

// A rise of less than this share of a cell is rounding: where two cuts leave the same surface, the first one
// keeps it.
inline constexpr float kTieCells = 1e-4f;

struct BrickKernels {
    // Removes a shape from the material: distance = max(distance, -shape) where that is above -near_mm. At
    // the nodes that moved, `winner` becomes `index` if they are now within near_mm of the surface, else
    // Brick::kUnlisted. Nodes near the surface where both differ by at most `tie_mm` are tied.
    CarveResult (*carve)(float* distance_mm, std::uint16_t* winner, const float* shape_mm,
                         std::uint16_t index, float near_mm, float cell_mm, float tie_mm);
    // Call this before carve. Finds the nodes that are less than half a cell from the surface of the material
    // and from the surface of the shape, if both are not the same surface. Node n is bit n % 8 of near_both[n
    // / 8]. Returns true if there are any.
    bool (*find_near_both)(const float* distance_mm, const float* shape_mm, float cell_mm,
                           std::uint8_t* near_both);
    // Volume of the material in cells.
    double (*volume_cells)(const float* distance_mm, float cell_mm);
};

const BrickKernels& brick_kernels();

// The two builds by name, for the test that compares them. v3 is null if the processor or target lacks it.
const BrickKernels* brick_kernels_sse2();
const BrickKernels* brick_kernels_v3();

}  // namespace tribo::field
