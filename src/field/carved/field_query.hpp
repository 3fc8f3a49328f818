// SPDX-License-Identifier: MIT
// Queries of a carved field. Another object owns the tables: the field itself, or a state that a reader holds
// while carving continues.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "contact/distance_field.hpp"
#include "field/carved/brick_index.hpp"

namespace tribo::field {

using ShapeStore = SteadyArray<std::unique_ptr<const Shape>, 1024>;  // [0] is the blank

// The point of a box that is nearest to another point.
inline Vec3 clamped(const Box3& box, Vec3 p) {
    return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y),
            std::clamp(p.z, box.min.z, box.max.z)};
}

// Refers to its tables. All functions are const and allocate nothing. Their time is bounded by the number of
// shapes in a brick (for clearance and nearest also by the number of bricks within reach).
struct FieldQuery {
    // If all nodes of a brick are farther than this from material (in cells), there is no material between
    // them either: half the diagonal of a cell.
    static constexpr double kClearCells = 0.8661;
    // The error of distances at nodes is less than this share of a cell.
    static constexpr double kRounding = 1e-3;

    Vec3 origin_mm;
    double cell_mm = 1, per_cell = 1, near_mm = 1;
    BrickTable bricks;
    const BrickPool* pool = nullptr;
    const ShapeStore* shapes = nullptr;
    std::uint64_t change = 0;  // grows whenever the field changes

    const Shape& blank() const { return *(*shapes)[0]; }
    const Shape& shape(ShapeId id) const { return *(*shapes)[id]; }
    Lattice lattice(BrickCoord b) const {
        return {origin_mm, cell_mm, kBrickCells * b.i, kBrickCells * b.j, kBrickCells * b.k};
    }
    Box3 box(BrickCoord b) const {
        const Lattice l = lattice(b);
        return {l.node(0, 0, 0), l.node(kBrickCells, kBrickCells, kBrickCells)};
    }
    // Returns the brick that contains the point. Outside the grid: a brick that the table does not contain.
    BrickCoord brick_at(Vec3 point_mm) const {
        const Vec3 q = (point_mm - origin_mm) * (per_cell / kBrickCells);
        // Far points are clamped first, because their conversion would overflow.
        const auto whole = [](double v) {
            const double near = std::clamp(v, -1e9, 1e9);
            const int down = static_cast<int>(near);
            return down - (near < down ? 1 : 0);  // std::floor is a call on older processors
        };
        return {whole(q.x), whole(q.y), whole(q.z)};
    }
    // The node of a brick that is nearest to a point, and the offset of the point from it.
    struct NearNode {
        int index;
        Vec3 off_cells;
    };
    NearNode nearest_node(BrickCoord b, Vec3 point_mm) const {
        const Vec3 q = (point_mm - lattice(b).node(0, 0, 0)) * per_cell;
        const auto nearest = [](double v) {
            return static_cast<int>(std::clamp(v + 0.5, 0.0, static_cast<double>(kBrickCells)));
        };
        const int i = nearest(q.x), j = nearest(q.y), k = nearest(q.z);
        return {node_index(i, j, k),
                q - Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}};
    }

    // The distance at a node. Far from the surface its size is a lower bound.
    double at_node_mm(const Brick& brick, int node) const {
        return cell_mm * static_cast<double>(brick.cells(node));
    }

    // The exact distance at `point_mm` in brick `ref`, and the shape that gives it. With `any_air` the search
    // stops at the first shape that leaves no material there; then its distance is a lower bound.
    struct Exact {
        double distance_mm;
        ShapeId shape;
    };
    Exact exact(BrickRef ref, Vec3 point_mm, bool any_air = false) const;

    // The same with the direction. For a searched shape both come from one search: its distance may differ
    // from that of exact() by rounding.
    contact::SurfaceSample sample_in(BrickRef ref, Vec3 point_mm) const;

    // As in contact::DistanceField.
    double distance_mm(Vec3 point_mm) const;
    contact::SurfaceSample sample(Vec3 point_mm) const;
    contact::SurfaceSample sample_piece(ShapeId id, Vec3 point_mm) const {
        const Shape::Slope s = shape(id).slope(point_mm);
        if (id == 0) return {s.distance_mm, s.gradient, id, s.way_per_mm};
        return {-s.distance_mm, -s.gradient, id, s.way_per_mm};
    }
    double clearance_mm(Vec3 point_mm, double enough_mm) const;
    // The normal of the material at or near the surface of a shape.
    Vec3 outward(ShapeId id, Vec3 point_mm) const {
        return id == 0 ? blank().gradient(point_mm) : -shape(id).gradient(point_mm);
    }
    // As in contact::DistanceField, up to 6 bricks away (42 cells); farther away a lower bound.
    contact::SurfaceSample nearest(Vec3 point_mm, double within_mm,
                                   contact::NearHint& hint) const;  // field_nearest.cpp
    // Near a place that the grid shows (ShownSurface), a place with material behind the surface. None: that
    // is in a gap, between two sides with air all the way from one to the other. It takes some microseconds:
    // kept in `memory`, which may be null.
    std::optional<Vec3> wall_at(Vec3 shown_mm, contact::SearchMemory* memory) const;  // field_nearest.cpp
    // Returns true if distance_mm < -skin_mm (0 <= skin_mm << cell). Measures no exact distance where the
    // grid gives the answer.
    bool is_material(Vec3 point_mm, double skin_mm) const;
    // Returns a carved shape in which the point lies, or less than skin_mm outside; 0 if none of its brick is
    // known to be one.
    ShapeId emptied_by(Vec3 point_mm, double skin_mm) const;
    // Signed like a distance; its size is a lower bound of the distance to any surface. It is at most about
    // `enough_mm`. It is smaller than the true distance where the grid alone gives the side.
    double clear_way_mm(Vec3 point_mm, double enough_mm) const;

  private:
    class NearestSearch;
    // Index of the shape that gives the distance at the nearest node.
    std::uint16_t likely_in(const Brick& brick, Vec3 point_mm) const {
        return brick.winner[static_cast<std::size_t>(nearest_node(brick.coord, point_mm).index)];
    }
    void deepen(Exact& best, ShapeId id, Vec3 point_mm) const;
    double clear_of_nodes(const Brick& brick, Vec3 point_mm) const;
    double clear_among(BrickRef alike, BrickCoord b, Vec3 point_mm, double clear_mm, double enough_mm) const;
    double clear_in_air(BrickCoord b, Vec3 point_mm, double enough_mm) const;
    bool is_clear(BrickRef ref, Vec3 point_mm, double radius_mm) const;
    bool is_nearest(const contact::Foot& foot) const;
    struct Followed {
        contact::Foot foot;
        bool is_proven = false;
        bool is_shallow = false;  // contact::NearHint
    };
    Followed follow(Vec3 point_mm, Vec3 last_mm, const contact::HalfSpaces& sides, bool is_shallow) const;
    contact::Foot below(contact::SurfaceSample depth, Vec3 point_mm) const;
    bool is_skin(const contact::Foot& foot) const;
    bool is_air_behind(Vec3 at_mm) const;
    std::optional<Vec3> find_wall(Vec3 shown_mm) const;
    bool is_listed(ShapeId id, Vec3 point_mm) const;
    Vec3 surface_behind(Vec3 shown_mm, Vec3 point_mm) const;
};

// All contents of a field, at an address that does not change.
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
