// SPDX-License-Identifier: MIT
// Distances of a sweep at all nodes of a lattice, and the bounds of a curved sweep at a point. The same
// source is compiled for SSE2 and for x86-64-v3; sweep_kernels() chooses once, by the processor. Both give
// the same bits.
#pragma once

#include <span>

#include "field/shape/shape.hpp"
#include "milling/sweep/sweep_lines.hpp"

namespace tribo::milling {

// A curved travel as seen from one point. `floor` is the value that a search must go below between
// neighbouring instants (the last entry has no use); `distance` is the distance at the instants. Both are
// reduced by the largest error of single precision. The other arrays are the fields of Instant in
// sweep_search.inl. `lowest` is the least height above the tip, mm.
struct Floors {
    float floor[CurvedInstants::kCount];
    float distance[CurvedInstants::kCount], slope[CurvedInstants::kCount];
    float drho[CurvedInstants::kCount], dz[CurvedInstants::kCount], gap[CurvedInstants::kCount];
    float way_squared[CurvedInstants::kCount];
    float lowest;
};

// Positions become floats after `reference` is subtracted. `reference` is the tip at the start or, for an
// arc, its centre at the height of the tip.
struct SweepKernels {
    // If a search is needed: exact within `near_mm` of the surface, beyond that only on the right side of it.
    void (*straight)(const ToolProfile&, const StraightLine&, const Frame&, Vec3 reference,
                     const field::Lattice&, double near_mm, float* out);
    // The union of several straight sweeps; only the side is exact beyond `near_mm`.
    void (*joined_straight)(const ToolProfile&, std::span<const StraightPart>, const Frame&, Vec3 reference,
                            const field::Lattice&, double near_mm, float* out);
    void (*arc)(const ToolProfile&, const ArcLine&, const Frame&, Vec3 reference, const field::Lattice&,
                float* out);
    // The same accuracy. With `known`, the distances of another sweep at the nodes, exact only where it is
    // less than these: the lesser of both is the distance of the two together.
    void (*curved)(const ToolProfile&, const CurvedLine&, const CurvedInstants&, Vec3 reference,
                   const field::Lattice&, double near_mm, const float* known, float* out);
    // The same of a flat or ball cutter on a path that `upright` describes, too, in a frame of its own.
    void (*upright)(const ToolProfile&, const UprightLine& upright, const Frame&, const CurvedLine&,
                    Vec3 reference, const field::Lattice&, double near_mm, const float* known, float* out);
    // `point` is relative to the tip at the start.
    void (*floors)(const ToolProfile&, const CurvedInstants&, const TravelBounds&, Vec3 point, Floors& out);
    // Writes a lower bound of the distance to each of eight sweeps, without their flat tops. `point` is
    // relative to the same point as they are.
    void (*lower_bounds)(const ToolProfile&, const TravelMiddles&, Vec3 point, float* out);
};

const SweepKernels& sweep_kernels();

// The two builds by name, for the test that compares them. v3 is null if the processor or target lacks it.
const SweepKernels* sweep_kernels_sse2();
const SweepKernels* sweep_kernels_v3();

}  // namespace tribo::milling
