// SPDX-License-Identifier: MIT
// What is done to many nodes of a sheet at once. The same source is compiled for SSE2 and for x86-64-v3;
// sheet_kernels() chooses once, by the processor. All builds give the same bits.
//
// Planes are rows of float with `stride` floats from row to row; eight floats before and after each row's
// nodes may be touched.
#pragma once

#include <cstddef>
#include <cstdint>

#include "elastic/pressure.hpp"

namespace tribo::elastic {

inline constexpr int kTileWidth = 16, kTileHeight = 16;
// Tiles of one row of tiles that a kernel takes in one call.
inline constexpr int kMostRunTiles = 32;
// Displacements below this are nothing: no number of the sheet ever becomes subnormal.
inline constexpr float kLeastMm = 1e-9f;

// A uniform material for one step: E += (P compliance - E) share.
struct UniformStep {
    float compliance_mm_per_n = 0, share = 0;
};
// One that differs from node to node: a level of 0..255 per node chooses from tables of 256.
struct MappedStep {
    const std::uint8_t* levels = nullptr;  // of the first node; as the planes, same stride
    const float* compliance_mm_per_n = nullptr;
    const float* share = nullptr;
};
// What a step found in a tile: how far the farthest node was from where its pressure leads, in mm, and
// whether any node is not where it was.
struct TileMotion {
    float way_mm = 0;
    bool moved = false;
};

struct NormalRows {
    std::ptrdiff_t stride = 0;
    int columns = 0;  // a multiple of 8
    int rows = 0;
    bool has_above = false, has_below = false;  // whether there is a row beyond the first and the last
    float per_mm = 0;                           // 1 / (2 node spacing)
};

// The pressure of one contact over a row of nodes.
struct PressRow {
    float dx0 = 0, spacing = 0;            // of the first node from the contact's centre; mm
    float dx_last = 0;                     // nodes further right count as being here
    float ux = 0, u0 = 0, vx = 0, v0 = 0;  // u = ux dx + u0, v = vx dx + v0: in half axes
    float force_n = 0;
    ShareLaw law;
};

struct SheetKernels {
    void (*step)(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, UniformStep law,
                 TileMotion* motion);
    void (*step_mapped)(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, MappedStep law,
                        TileMotion* motion);
    // x and y of the unit normals (-dE/dx, -dE/dy, 1) / length, within 5e-6; central differences, at the
    // border of the image with the border's own value for the one beyond it.
    void (*normals)(const float* e, float* nx, float* ny, NormalRows rows);
    void (*press)(float* p, int columns, PressRow row);
};

const SheetKernels& sheet_kernels();

// The two builds by name, for the test that compares them; v3 is null where the processor or target lacks it.
const SheetKernels* sheet_kernels_sse2();
const SheetKernels* sheet_kernels_v3();

}  // namespace tribo::elastic
