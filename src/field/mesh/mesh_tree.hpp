// SPDX-License-Identifier: MIT
// Finds the triangle of a mesh that is closest to a point, by a tree of boxes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::field {

// The place of a point on its triangle: corner i, the edge from corner i to the next, or inside.
enum class TrianglePlace : std::uint8_t { face, edge0, edge1, edge2, corner0, corner1, corner2 };

struct TrianglePoint {
    Vec3 point_mm;
    double squared_mm2 = 0;  // squared distance to the query point
    TrianglePlace place = TrianglePlace::face;
};

// Returns the closest point of a triangle, by the region in which the point projects (Ericson 2005, Real-Time
// Collision Detection, 5.1.5). Triangles without area count as lines or points.
TrianglePoint closest_on_triangle(Vec3 point_mm, Vec3 a, Vec3 b, Vec3 c);

// Built once, then used by any number of threads; queries allocate nothing. The result does not depend on the
// form of the tree or on the start of the search: the smallest distance wins, among equal ones the first
// triangle in the mesh.
class MeshTree {
  public:
    struct Nearest {
        std::uint32_t triangle = 0;
        TrianglePoint at;
    };

    // The mesh has at least one triangle. It is not needed afterwards.
    explicit MeshTree(const TriangleMesh& mesh);

    Nearest nearest(Vec3 point_mm) const;
    // The same result, faster if `guess` is a triangle near the closest one.
    Nearest nearest(Vec3 point_mm, std::uint32_t guess) const;
    // The same result if it is nearer than reach_mm, else nothing. Faster for points far away.
    std::optional<Nearest> nearest_within(Vec3 point_mm, double reach_mm, std::uint32_t guess) const;

    // Which places may be the result. Asked for those only that are nearer than the last one it kept.
    struct Filter {
        virtual ~Filter() = default;
        virtual bool keeps(const Nearest& place) const = 0;
    };
    // The closest point of those triangles whose own closest point is kept, if it is nearer than reach_mm.
    std::optional<Nearest> nearest_kept(Vec3 point_mm, double reach_mm, const Filter& filter) const;

    // Calls `visit` with the number of each triangle whose box overlaps this one.
    void visit_overlapping(const Box3& box, const std::function<void(std::uint32_t)>& visit) const;

    // Returns how often a watertight mesh winds around a point: 1 inside, 0 outside, other values where it
    // overlaps or folds over itself. Counts the triangles above the point, with a sign for the side that
    // faces the point. Triangles that share an edge agree on the side of a point, so that none is missed or
    // counted twice.
    int winding(Vec3 point_mm) const;

    Box3 bounds_mm() const;
    std::size_t bytes() const;

  private:
    // A node with triangles is a leaf. Otherwise its children are the next node and node `first`.
    struct Node {
        Point3f min, max;
        std::uint32_t first = 0, triangles = 0;
    };
    struct Corners {
        Point3f a, b, c;
        std::uint32_t triangle;
    };
    struct Builder;

    template <class Keeps>
    void search(Vec3 point_mm, Nearest& best, const Keeps& keeps) const;
    void search(Vec3 point_mm, Nearest& best) const;
    template <class Meets, class Visit>
    void walk(const Meets& meets, const Visit& visit) const;
    Nearest measure(Vec3 point_mm, const Corners& corners) const;

    std::vector<Node> nodes_;
    std::vector<Corners> corners_;         // leaf by leaf
    std::vector<std::uint32_t> place_of_;  // from triangle of the mesh to index in corners_
};

}  // namespace tribo::field
