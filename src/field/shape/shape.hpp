// SPDX-License-Identifier: MIT
// A solid that shapes a field: the volume swept by a cutter, a stock blank, a designed part.
#pragma once

#include "base/vec3.hpp"

namespace tribo::field {

// Nodes per edge of the lattice that is sampled at once, and in all.
inline constexpr int kLatticeEdge = 8;
inline constexpr int kLatticeNodes = kLatticeEdge * kLatticeEdge * kLatticeEdge;

// Eight by eight by eight nodes of an infinite grid: node (a, b, c) stands at origin + cell * (i0 + a, j0 +
// b, k0 + c). Two lattices of one grid agree to the last bit on the position of a node that they share.
struct Lattice {
    Vec3 grid_origin_mm;
    double cell_mm = 1;
    int i0 = 0, j0 = 0, k0 = 0;

    Vec3 node(int a, int b, int c) const {
        return {grid_origin_mm.x + cell_mm * (i0 + a), grid_origin_mm.y + cell_mm * (j0 + b),
                grid_origin_mm.z + cell_mm * (k0 + c)};
    }
};

// Distances are in mm, negative inside the solid, zero exactly on its surface, with slope at most 1: near a
// smooth piece of surface the value is the distance, at an edge it may be the largest of the distances to the
// pieces that meet there. Every function is const, allocates nothing and may run on any thread.
class Shape {
  public:
    virtual ~Shape() = default;
    // Contains every point of the solid.
    virtual Box3 bounds_mm() const = 0;
    virtual double distance_mm(Vec3 point_mm) const = 0;
    // distance_mm where that is below `bound_mm`, else something from the bound up: cheaper where the
    // distance takes a search that the bound cuts short.
    virtual double distance_below(Vec3 point_mm, double /*bound_mm*/) const { return distance_mm(point_mm); }
    // Whether a distance takes a search: rather microseconds than tens of nanoseconds.
    virtual bool is_searched() const { return false; }
    // Unit direction in which distance_mm grows fastest.
    virtual Vec3 gradient(Vec3 point_mm) const = 0;
    // distance_mm at all nodes in single precision, out[a + 8 b + 64 c], the same bits whatever the machine.
    virtual void sample(const Lattice& lattice, float* out) const = 0;
    // sample() where the distance is within `near_mm` of zero, else something beyond that on the same side.
    virtual void sample_near(const Lattice& lattice, double /*near_mm*/, float* out) const {
        sample(lattice, out);
    }
};

}  // namespace tribo::field
