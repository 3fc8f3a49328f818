// SPDX-License-Identifier: MIT
// The kernels of sweep_kernels.hpp; included by sweep_kernels_sse2.cpp and sweep_kernels_v3.cpp.
#include "base/simd.hpp"
#include "milling/sweep_kernels.hpp"

namespace tribo::milling {
namespace {

using namespace simd;
using field::kLatticeEdge;

// Each builds on the one before.
// clang-format off
#include "milling/sweep_search.inl"
#include "milling/sweep_distance.inl"
#include "milling/sweep_curved.inl"
// clang-format on

// Node coordinates relative to the reference, float only after the subtraction; node n along each axis.
struct Offsets {
    F8 x;
    float y[kLatticeEdge], z[kLatticeEdge];

    Offsets(const field::Lattice& lattice, Vec3 reference) {
        float along_x[kLatticeEdge];
        for (int n = 0; n < kLatticeEdge; ++n) {
            const Vec3 d = lattice.node(n, n, n) - reference;
            along_x[n] = static_cast<float>(d.x);
            y[n] = static_cast<float>(d.y);
            z[n] = static_cast<float>(d.z);
        }
        x = load(along_x);
    }
};

// Calls distance(x, y, z) with the coordinates of each row of nodes in the frame.
template <class F>
TRIBO_LANES void over_rows(const Offsets& at, const Frame& frame, float* out, const F& distance) {
    const auto part = [](double u) { return static_cast<float>(u); };
    const F8 along_x = at.x * splat(part(frame.x.x)), along_y = at.x * splat(part(frame.y.x)),
             along_z = at.x * splat(part(frame.z.x));
    for (int c = 0; c < kLatticeEdge; ++c) {
        const float z[3] = {at.z[c] * part(frame.x.z), at.z[c] * part(frame.y.z), at.z[c] * part(frame.z.z)};
        for (int b = 0; b < kLatticeEdge; ++b) {
            const float y = at.y[b];
            store(out, distance(along_x + splat(y * part(frame.x.y) + z[0]),
                                along_y + splat(y * part(frame.y.y) + z[1]),
                                along_z + splat(y * part(frame.z.y) + z[2])));
            out += kLatticeEdge;
        }
    }
}

template <CutterKind kind>
void straight_of(const ToolProfile& tool, const StraightLine& line, const Frame& frame, const Offsets& at,
                 float* out) {
    const Profile<F8> p(tool);
    const Line<F8> l(line);
    if (line.rise == 0) {
        over_rows(at, frame, out, [&](F8 x, F8 y, F8 z) { return level_distance<kind>(p, l, x, y, z); });
    } else {
        over_rows(at, frame, out, [&](F8 x, F8 y, F8 z) { return ramp_distance<kind>(p, l, x, y, z); });
    }
}

void straight(const ToolProfile& tool, const StraightLine& line, const Frame& frame, Vec3 reference,
              const field::Lattice& lattice, float* out) {
    const Offsets at(lattice, reference);
    switch (tool.kind) {
        case CutterKind::flat:
            return straight_of<CutterKind::flat>(tool, line, frame, at, out);
        case CutterKind::ball:
            return straight_of<CutterKind::ball>(tool, line, frame, at, out);
        case CutterKind::bull:
            return straight_of<CutterKind::bull>(tool, line, frame, at, out);
    }
}

template <CutterKind kind>
void arc_of(const ToolProfile& tool, const ArcLine& line, const Frame& frame, const Offsets& at, float* out) {
    const Profile<F8> p(tool);
    const Round<F8> a(line);
    over_rows(at, frame, out, [&](F8 x, F8 y, F8 z) { return arc_distance<kind>(p, a, x, y, z); });
}

void arc(const ToolProfile& tool, const ArcLine& line, const Frame& frame, Vec3 reference,
         const field::Lattice& lattice, float* out) {
    const Offsets at(lattice, reference);
    switch (tool.kind) {
        case CutterKind::flat:
            return arc_of<CutterKind::flat>(tool, line, frame, at, out);
        case CutterKind::ball:
            return arc_of<CutterKind::ball>(tool, line, frame, at, out);
        case CutterKind::bull:
            return arc_of<CutterKind::bull>(tool, line, frame, at, out);
    }
}

// A row all of whose nodes lie beyond `near` of the surface, as the slope of at most 1 tells from a row
// beside it. `known` bounds the distance from below where it is more than near, from above where less than
// -near.
TRIBO_LANES bool is_far_row(F8 known, F8 step, F8 near, F8& row) {
    const F8 above = known - step, below = known + step;
    row = select(above >= near, above, below);
    return !any(both(above<near, below> - near));
}

template <CutterKind kind>
void curved_of(const ToolProfile& tool, const CurvedLine& line, const Offsets& at, double cell_mm,
               double near_mm, float* out) {
    const Profile<F8> p(tool);
    const SeenFrame frame(line);
    const F8 near = broadcast<F8>(near_mm), step = broadcast<F8>(cell_mm + 2 * kProven<F8>);
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b, out += kLatticeEdge) {
            F8 row;
            if ((b > 0 && is_far_row(load(out - kLatticeEdge), step, near, row)) ||
                (c > 0 && is_far_row(load(out - kLatticeEdge * kLatticeEdge), step, near, row))) {
                store(out, row);
                continue;
            }
            PointBounds<F8> bounds = bounds_of(p, line.bounds, at.x, splat(at.y[b]), splat(at.z[c]));
            bounds.way_error = splat(frame.spin) * bounds.speed * bounds.reach;
            SeenRow seen(frame, at.x, at.y[b], at.z[c]);
            store(out, curved_row<kind>(p, seen, bounds, near));
        }
    }
}

void curved(const ToolProfile& tool, const CurvedLine& line, Vec3 reference, const field::Lattice& lattice,
            double near_mm, float* out) {
    const Offsets at(lattice, reference);
    switch (tool.kind) {
        case CutterKind::flat:
            return curved_of<CutterKind::flat>(tool, line, at, lattice.cell_mm, near_mm, out);
        case CutterKind::ball:
            return curved_of<CutterKind::ball>(tool, line, at, lattice.cell_mm, near_mm, out);
        case CutterKind::bull:
            return curved_of<CutterKind::bull>(tool, line, at, lattice.cell_mm, near_mm, out);
    }
}

void floors(const ToolProfile& tool, const CurvedInstants& at, const TravelBounds& travel, Vec3 point,
            Floors& out) {
    const Profile<F8> p(tool);
    const float seen[3] = {static_cast<float>(point.x), static_cast<float>(point.y),
                           static_cast<float>(point.z)};
    switch (tool.kind) {
        case CutterKind::flat:
            return curved_floors<CutterKind::flat>(p, at, travel, seen, out);
        case CutterKind::ball:
            return curved_floors<CutterKind::ball>(p, at, travel, seen, out);
        case CutterKind::bull:
            return curved_floors<CutterKind::bull>(p, at, travel, seen, out);
    }
}

constexpr SweepKernels kKernels{straight, arc, curved, floors};

}  // namespace
}  // namespace tribo::milling
