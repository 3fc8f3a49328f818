// SPDX-License-Identifier: MIT
// Distances of a sweep at all nodes of a lattice, and what bounds a curved one at a point. The same source is
// compiled for SSE2 and for x86-64-v3; sweep_kernels() chooses once, by the processor. Both give the same
// bits.
#pragma once

#include "field/shape/shape.hpp"
#include "milling/sweep/sweep_lines.hpp"

namespace tribo::milling {

// A curved travel as one point sees it. What a search must go below between neighbouring instants (the last
// entry is of no use), and the distance at the instants themselves, both less what single precision may be
// off; what else sweep_search.inl's Instant holds; the least height above the tip among them, mm.
struct Floors {
    float floor[CurvedInstants::kCount];
    float distance[CurvedInstants::kCount], slope[CurvedInstants::kCount];
    float drho[CurvedInstants::kCount], dz[CurvedInstants::kCount], gap[CurvedInstants::kCount];
    float way_squared[CurvedInstants::kCount];
    float lowest;
};

// `reference` is what positions are taken relative to before they become floats: the tip at the start, an
// arc's centre at the height of the tip.
struct SweepKernels {
    // Where a search is needed: exact within `near_mm` of the surface, else beyond it on the right side.
    void (*straight)(const ToolProfile&, const StraightLine&, const Frame&, Vec3 reference,
                     const field::Lattice&, double near_mm, float* out);
    void (*arc)(const ToolProfile&, const ArcLine&, const Frame&, Vec3 reference, const field::Lattice&,
                float* out);
    // Likewise.
    void (*curved)(const ToolProfile&, const CurvedLine&, const CurvedInstants&, Vec3 reference,
                   const field::Lattice&, double near_mm, float* out);
    // `point` relative to the tip at the start.
    void (*floors)(const ToolProfile&, const CurvedInstants&, const TravelBounds&, Vec3 point, Floors& out);
};

const SweepKernels& sweep_kernels();

// The two builds by name, for the test that compares them; v3 is null where the processor or target lacks it.
const SweepKernels* sweep_kernels_sse2();
const SweepKernels* sweep_kernels_v3();

}  // namespace tribo::milling
