// SPDX-License-Identifier: MIT
// The triangle of a mesh that is closest to a point, by a tree of boxes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/mesh.hpp"

namespace tribo::field {

// Where on its triangle a point lies: corner i, the edge from corner i to the next, or inside.
enum class TrianglePlace : std::uint8_t { face, edge0, edge1, edge2, corner0, corner1, corner2 };

struct TrianglePoint {
    Vec3 point_mm;
    double squared_mm2 = 0;  // distance to the point that was asked for, squared
    TrianglePlace place = TrianglePlace::face;
};

// The closest point of a triangle, by the region in which the point projects (Ericson 2005, Real-Time
// Collision Detection, 5.1.5). Triangles without area are lines and points, and answer as such.
TrianglePoint closest_on_triangle(Vec3 point_mm, Vec3 a, Vec3 b, Vec3 c);

// Built once, then asked from any number of threads; asking allocates nothing. What it answers does not
// depend on how the tree came out or where the search began: the smallest distance wins, of equal ones the
// triangle that comes first in the mesh.
class MeshTree {
  public:
    struct Nearest {
        std::uint32_t triangle = 0;
        TrianglePoint at;
    };

    // The mesh has at least one triangle; it is not needed afterwards.
    explicit MeshTree(const TriangleMesh& mesh);

    Nearest nearest(Vec3 point_mm) const;
    // The same answer, faster when `guess` is a triangle not far from the closest one.
    Nearest nearest(Vec3 point_mm, std::uint32_t guess) const;
    // The same answer where it is nearer than reach_mm, else none: faster for points far away.
    std::optional<Nearest> nearest_within(Vec3 point_mm, double reach_mm, std::uint32_t guess) const;

    // How often a watertight mesh winds around a point: 1 inside, 0 outside, others where it overlaps or
    // folds over itself. Counts the triangles above the point, with the sign of the side that they show.
    // Triangles that share an edge agree on which side of it a point is, so none is missed and none counted
    // twice.
    int winding(Vec3 point_mm) const;

    Box3 bounds_mm() const;
    std::size_t bytes() const;

  private:
    // A node with triangles is a leaf; else its children are the next node and node `first`.
    struct Node {
        Point3f min, max;
        std::uint32_t first = 0, triangles = 0;
    };
    struct Corners {
        Point3f a, b, c;
        std::uint32_t triangle;
    };
    struct Builder;

    void search(Vec3 point_mm, Nearest& best) const;
    Nearest measure(Vec3 point_mm, const Corners& corners) const;

    std::vector<Node> nodes_;
    std::vector<Corners> corners_;         // leaf by leaf
    std::vector<std::uint32_t> place_of_;  // triangle of the mesh to corners_
};

}  // namespace tribo::field
