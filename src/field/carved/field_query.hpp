// SPDX-License-Identifier: MIT
// What is asked of a carved field, on tables that somebody else owns: the field's own, or those of a moment
// that a reader holds on to while carving goes on.
#pragma once

#include <cmath>
#include <memory>
#include <span>

#include "contact/distance_field.hpp"
#include "field/carved/brick_index.hpp"

namespace tribo::field {

using ShapeStore = SteadyArray<std::unique_ptr<const Shape>, 1024>;  // [0] is the blank

// Refers to its tables. Everything is const, allocates nothing, and takes a time that is bounded by the
// number of shapes in a brick (and, for clearance and nearest, the number of bricks within reach).
struct FieldQuery {
    // A brick whose nodes are all further than this from material (in cells) holds none between them either:
    // half the diagonal of a cell.
    static constexpr double kClearCells = 0.8661;

    Vec3 origin_mm;
    double cell_mm = 1, per_cell = 1, near_mm = 1;
    BrickTable bricks;
    const BrickPool* pool = nullptr;
    const ShapeStore* shapes = nullptr;

    const Shape& blank() const { return *(*shapes)[0]; }
    const Shape& shape(ShapeId id) const { return *(*shapes)[id]; }
    Lattice lattice(BrickCoord b) const {
        return {origin_mm, cell_mm, kBrickCells * b.i, kBrickCells * b.j, kBrickCells * b.k};
    }
    Box3 box(BrickCoord b) const {
        const Lattice l = lattice(b);
        return {l.node(0, 0, 0), l.node(kBrickCells, kBrickCells, kBrickCells)};
    }
    // The brick that contains the point; out of the grid: one that the table does not contain.
    BrickCoord brick_at(Vec3 point_mm) const {
        const Vec3 q = (point_mm - origin_mm) * (per_cell / kBrickCells);
        // Far points are clamped before the conversion, which would overflow.
        const auto whole = [](double v) { return static_cast<int>(std::floor(std::clamp(v, -1e9, 1e9))); };
        return {whole(q.x), whole(q.y), whole(q.z)};
    }
    // The node of a brick that is nearest to a point, and where the point lies from it.
    struct NearNode {
        int index;
        Vec3 off_cells;
    };
    NearNode nearest_node(BrickCoord b, Vec3 point_mm) const;

    // Where the exact surface stands, when `point_mm` is in brick `ref`: the distance and the shape that
    // gives it. With `any_air` the first shape that leaves no material there is enough: its distance is then
    // a lower bound.
    struct Exact {
        double distance_mm;
        ShapeId shape;
    };
    Exact exact(BrickRef ref, Vec3 point_mm, bool any_air = false) const;

    // As of contact::DistanceField.
    double distance_mm(Vec3 point_mm) const;
    contact::SurfaceSample sample(Vec3 point_mm) const;
    contact::SurfaceSample sample_piece(ShapeId id, Vec3 point_mm) const {
        return {id == 0 ? blank().distance_mm(point_mm) : -shape(id).distance_mm(point_mm),
                outward(id, point_mm), id};
    }
    double clearance_mm(Vec3 point_mm, double enough_mm) const;
    contact::SurfaceSample nearest(Vec3 point_mm, double within_mm, contact::NearHint& hint) const;
    // Whether distance_mm < -skin_mm (0 <= skin_mm << cell), without the measure where the grid already
    // tells.
    bool is_material(Vec3 point_mm, double skin_mm) const;
    // Signed like a distance: no surface is nearer than its size, which is no more than about `enough_mm` and
    // falls short of the true distance where the grid already tells the side.
    double clear_way_mm(Vec3 point_mm, double enough_mm) const;

  private:
    class Candidates;
    Vec3 outward(ShapeId id, Vec3 point_mm) const {
        return id == 0 ? blank().gradient(point_mm) : -shape(id).gradient(point_mm);
    }
    double clear_of_nodes(const Brick& brick, Vec3 point_mm) const;
    double clear_among(BrickRef alike, BrickCoord b, Vec3 point_mm, double clear_mm, double enough_mm) const;
    double clear_in_air(BrickCoord b, Vec3 point_mm, double enough_mm) const;
    bool is_clear(BrickRef ref, Vec3 point_mm, double radius_mm) const;
    // A place on the surface, and which way it faces.
    struct Seen {
        Vec3 at, normal;
    };
    Seen surface_by(const Brick& brick, int a, int b, int c, Vec3 node_mm) const;
    bool none_nearer(const Seen& place, Vec3 point_mm, double than_mm) const;
    bool near_surface(BrickCoord where, Vec3 point_mm, double within_mm, std::span<const Seen> but,
                      Seen& place) const;
};

// All that a field holds, at an address that does not change.
struct FieldTables {
    ShapeStore shapes;
    BrickIndex index;
    BrickPool pool;
    FieldQuery query;

    explicit FieldTables(BrickCoord size) : index(size) {
        query.bricks = index.table();
        query.pool = &pool;
        query.shapes = &shapes;
    }
};

}  // namespace tribo::field
