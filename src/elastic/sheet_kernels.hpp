// SPDX-License-Identifier: MIT
// Operations on many nodes of a sheet at once. The same source is compiled for SSE2 and for x86-64-v3;
// sheet_kernels() chooses once, by the processor. All builds give the same bits.
//
// Planes are rows of float with `stride` floats from row to row. Kernels may access eight floats before and
// after the nodes of each row.
#pragma once

#include <cstddef>
#include <cstdint>

#include "elastic/pressure.hpp"

namespace tribo::elastic {

inline constexpr int kTileWidth = 16, kTileHeight = 16;
// Largest number of tiles in one row of tiles that a kernel processes in one call.
inline constexpr int kMostRunTiles = 32;
// Displacements below this become 0, so that no number of the sheet is ever subnormal.
inline constexpr float kLeastMm = 1e-9f;

// A uniform material for one step: E += (P compliance - E) share.
struct UniformStep {
    float compliance_mm_per_n = 0, share = 0;
};
// A material that varies from node to node: a level of 0..255 per node is the index into tables of 256.
struct MappedStep {
    const std::uint8_t* levels = nullptr;  // of the first node; same stride as the planes
    const float* compliance_mm_per_n = nullptr;
    const float* share = nullptr;
};
// Result of a step in a tile: the largest distance of a node from its target, in mm, and whether any node has
// moved.
struct TileMotion {
    float way_mm = 0;
    bool moved = false;
};

struct NormalRows {
    std::ptrdiff_t stride = 0;
    int columns = 0;  // a multiple of 8
    int rows = 0;
    bool has_above = false, has_below = false;  // true if there is a row before the first or after the last
    float rise_mm = 0;                          // 2 node spacings, 1e-9 .. 1e9
};

// Columns first .. last - 1, multiples of 8 except where the row ends; empty: first = last.
struct ColumnRange {
    int first = 0, last = 0;
};

// The pressure of one contact over a row of nodes. In half axes of the contact the row is a line that passes
// its centre at the square root of `miss2`. Node x is `start + (x - middle) step` along this line from there.
// With the middle near that place, little is lost to rounding where the pressure is steep.
struct PressRow {
    int middle = 0;
    float start = 0, step = 0, miss2 = 0;
    ColumnRange reached;  // contains all nodes within the reach
    ColumnRange within;   // contains all nodes within the contact's edge; inside `reached`
    bool over = false;    // the old values are replaced, not added to
    float force_n = 0;
    ShareLaw law;
};

struct SheetKernels {
    void (*step)(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, UniformStep law,
                 TileMotion* motion);
    void (*step_mapped)(float* e, const float* p, std::ptrdiff_t stride, int tiles, int rows, MappedStep law,
                        TileMotion* motion);
    // x and y of the unit normals (-dE/dx, -dE/dy, 1) / length, by central differences. At the border of the
    // image the border's own value replaces the missing one.
    void (*normals)(const float* e, float* nx, float* ny, NormalRows rows);
    void (*press)(float* p, int columns, PressRow row);
};

const SheetKernels& sheet_kernels();

// The two builds by name, for the test that compares them. v3 is null if the processor or target lacks it.
const SheetKernels* sheet_kernels_sse2();
const SheetKernels* sheet_kernels_v3();

}  // namespace tribo::elastic
