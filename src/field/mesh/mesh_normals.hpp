// SPDX-License-Identifier: MIT
// Finds the triangles that share an edge, and the pseudo-normals that separate inside from outside.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/mesh.hpp"
#include "field/mesh/mesh_tree.hpp"

namespace tribo::field {

// Angle-weighted pseudo-normals (Baerentzen and Aanaes 2005, "Signed distance computation using the angle
// weighted pseudonormal"). A face has its own normal. An edge has the sum of the normals of its two faces. A
// corner has the sum of the normals of all its faces, weighted by their angles there. Then the vector from
// the closest point to any point has a positive product with the pseudo-normal exactly if that point is
// outside.
//
// A triangle without area has no normal. It takes the normal of the triangle across its longest edge, and the
// triangles on its two sides count as neighbours.
class MeshNormals {
  public:
    explicit MeshNormals(const TriangleMesh& mesh);

    // Unit, or zero if the faces around it cancel out.
    Vec3 at(const TriangleMesh& mesh, std::uint32_t triangle, TrianglePlace place) const;
    // True at an edge that does not have exactly two triangles, and at the ends of such an edge.
    bool is_border(const TriangleMesh& mesh, std::uint32_t triangle, TrianglePlace place) const;

    std::size_t border_edges() const { return border_edges_; }
    // Number of edges that both triangles traverse in the same direction: one of the two is turned over.
    std::size_t turned_edges() const { return turned_edges_; }
    // A point on the first border edge in the order of triangles. Undefined if there is none.
    Vec3 first_border_mm() const { return first_border_; }

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFF;

    void find_neighbours(const TriangleMesh& mesh);
    void find_face_normals(const TriangleMesh& mesh);
    void bridge_flat_triangles(const TriangleMesh& mesh);
    void find_corner_normals(const TriangleMesh& mesh);

    // Edges are numbered 4 triangle + i; neighbours_[triangle][i] is the number of the same edge in the other
    // triangle, or kNone.
    std::vector<std::array<std::uint32_t, 3>> neighbours_;
    std::vector<Vec3> faces_, corners_;
    std::vector<bool> border_corners_;
    std::vector<std::uint32_t> flat_;  // triangles without area
    std::size_t border_edges_ = 0, turned_edges_ = 0;
    Vec3 first_border_;
};

}  // namespace tribo::field
