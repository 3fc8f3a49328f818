// SPDX-License-Identifier: MIT
// A solid that shapes a field: the volume swept by a cutter, a stock blank, a designed part.
#pragma once

#include "base/vec3.hpp"

namespace tribo::field {

// Number of nodes along an edge of the lattice that is sampled at once, and in total.
inline constexpr int kLatticeEdge = 8;
inline constexpr int kLatticeNodes = kLatticeEdge * kLatticeEdge * kLatticeEdge;

// Eight by eight by eight nodes of an infinite grid: node (a, b, c) is at origin + cell * (i0 + a, j0 + b, k0
// + c). Two lattices of one grid agree to the last bit on the position of a shared node.
struct Lattice {
    Vec3 grid_origin_mm;
    double cell_mm = 1;
    int i0 = 0, j0 = 0, k0 = 0;

    Vec3 node(int a, int b, int c) const {
        return {grid_origin_mm.x + cell_mm * (i0 + a), grid_origin_mm.y + cell_mm * (j0 + b),
                grid_origin_mm.z + cell_mm * (k0 + c)};
    }
};

// Distances are in mm, negative inside the solid, zero exactly on its surface, with slope at most 1. Near a
// smooth piece of surface the value is the distance; at an edge it may be the largest of the distances to the
// pieces that meet there. All functions are const, allocate nothing and may run on any thread.
class Shape {
  public:
    virtual ~Shape() = default;
    // Contains every point of the solid.
    virtual Box3 bounds_mm() const = 0;
    virtual double distance_mm(Vec3 point_mm) const = 0;
    // Returns distance_mm if it is below `bound_mm`, else any value from the bound up. This is cheaper if the
    // distance needs a search, because the bound ends the search early.
    virtual double distance_below(Vec3 point_mm, double /*bound_mm*/) const { return distance_mm(point_mm); }
    // True if a distance needs a search: microseconds rather than tens of nanoseconds.
    virtual bool is_searched() const { return false; }
    // Unit direction in which distance_mm grows fastest.
    virtual Vec3 gradient(Vec3 point_mm) const = 0;
    // Both of them: cheaper if they share a search. Along the gradient the distance grows by 1 mm per
    // `way_per_mm`: per more than 1 where it is mitred, as it is below the edge of a flat cutter on its way.
    struct Slope {
        double distance_mm;
        Vec3 gradient;
        float way_per_mm = 1;
    };
    virtual Slope slope(Vec3 point_mm) const { return {distance_mm(point_mm), gradient(point_mm)}; }
    // True if the solid meets each line along this unit direction in one piece.
    virtual bool is_whole_along(Vec3 /*direction*/) const { return false; }
    // Computes distance_mm at all nodes in single precision, out[a + 8 b + 64 c]: the same bits on every
    // machine.
    virtual void sample(const Lattice& lattice, float* out) const = 0;
    // Like sample() where the distance is within `near_mm` of zero, else any value beyond that on the same
    // side.
    virtual void sample_near(const Lattice& lattice, double /*near_mm*/, float* out) const {
        sample(lattice, out);
    }
    // Like sample_near(). Where the distance is not less than `known`, of one value a node, any value from
    // there on will do.
    virtual void sample_below(const Lattice& lattice, double near_mm, const float* /*known*/,
                              float* out) const {
        sample_near(lattice, near_mm, out);
    }
};

}  // namespace tribo::field
