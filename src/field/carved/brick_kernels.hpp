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

// The distance of a node deep in material, in cells: the next one that is not near the surface.
inline constexpr float kDeepest = -1.0001f * Brick::kNearCells;

// What mark_near() tells of a node: it is near the surface; a shape does not give the distance there.
inline constexpr std::uint8_t kMarkNear = 1, kMarkAlone = 2;

// Near the surface: less than Brick::kNearCells.
struct BrickKernels {
    // The distances of a surface as steps, at least those of kDeepest.
    void (*to_steps)(const float* distance_mm, float cell_mm, NodeSteps* steps);
    // Removes a shape from the material: distance = max(distance, -shape) where that is above -kNearCells. At
    // the nodes that moved, the winner becomes `index` if they are now near the surface, else
    // Brick::kUnlisted. `winner_high`: null if no index has a second byte. Nodes near the surface where both
    // differ by at most `tie_mm` are tied.
    CarveResult (*carve)(NodeSteps* steps, std::uint8_t* winner_low, std::uint8_t* winner_high,
                         const float* shape_mm, std::uint16_t index, float cell_mm, float tie_mm);
    // Call this before carve. Finds the nodes that are less than half a cell from the surface of the material
    // and from the surface of the shape, if both are not the same surface. Node n is bit n % 8 of near_both[n
    // / 8]. Returns true if there are any.
    bool (*find_near_both)(const NodeSteps* steps, const float* shape_mm, float cell_mm,
                           std::uint8_t* near_both);
    // Marks the nodes near the surface, and those of them where a shape does not give the distance within
    // `tie_mm`. All other marks become 0.
    void (*mark_near)(const NodeSteps* steps, const float* shape_mm, float cell_mm, float tie_mm,
                      std::uint8_t* marks);
    // Volume of the material in cells.
    double (*volume_cells)(const NodeSteps* steps);
};

const BrickKernels& brick_kernels();

// The two builds by name, for the test that compares them. v3 is null if the processor or target lacks it.
const BrickKernels* brick_kernels_sse2();
const BrickKernels* brick_kernels_v3();

}  // namespace tribo::field
