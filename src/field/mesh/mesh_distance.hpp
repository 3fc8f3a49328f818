// SPDX-License-Identifier: MIT
// Signed distance to a triangle mesh.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "field/mesh/mesh_normals.hpp"
#include "field/mesh/mesh_outside.hpp"

namespace tribo::field {

struct MeshPoint {
    Vec3 point_mm;           // on the mesh
    Vec3 normal;             // pseudo-normal there, unit
    double distance_mm = 0;  // exact; negative behind the surface (inside, if the mesh is closed)
    std::uint32_t triangle = 0;
    bool on_border = false;  // at the edge of an open mesh: the sign has no meaning beyond it
};

// Built once (about 1.5 us and 120 bytes for each triangle), then used by any number of threads without
// allocation. The results have the same bits on every machine and do not depend on earlier queries.
class MeshDistance {
  public:
    // The mesh needs at least one triangle. Edges are found by vertex numbers: use weld_exactly to make equal
    // positions one vertex if the mesh must be connected.
    explicit MeshDistance(TriangleMesh mesh) : MeshDistance(std::move(mesh), false) {}
    // Of a closed mesh: all around which it winds is material. Where it passes through itself, results are
    // the closest places of the outside (mesh_outside.hpp).
    static MeshDistance of_solid(TriangleMesh mesh) { return MeshDistance(std::move(mesh), true); }

    MeshPoint closest(Vec3 point_mm) const { return describe(point_mm, tree_.nearest(point_mm)); }
    // The same result, faster if `guess` is the triangle of a result near by.
    MeshPoint closest(Vec3 point_mm, std::uint32_t guess) const {
        return describe(point_mm, tree_.nearest(point_mm, guess));
    }
    // The same result if it is nearer than reach_mm, else nothing.
    std::optional<MeshPoint> closest_within(Vec3 point_mm, double reach_mm, std::uint32_t guess) const {
        const auto nearest = tree_.nearest_within(point_mm, reach_mm, guess);
        if (!nearest) return std::nullopt;
        const MeshPoint found = describe(point_mm, *nearest);
        if (!(std::abs(found.distance_mm) < reach_mm)) return std::nullopt;
        return found;
    }

    // Of a solid that passes through itself or holds bodies within others each place counts once; else that
    // of the mesh.
    double volume_mm3() const { return outside_ ? outside_->volume_mm3() : tribo::volume_mm3(mesh_); }
    // As in MeshTree.
    int winding(Vec3 point_mm) const { return tree_.winding(point_mm); }

    const TriangleMesh& mesh() const { return mesh_; }
    const MeshNormals& normals() const { return normals_; }
    Box3 bounds_mm() const { return tree_.bounds_mm(); }

  private:
    MeshDistance(TriangleMesh mesh, bool is_solid);
    MeshPoint describe(Vec3 point_mm, const MeshTree::Nearest& nearest) const;
    MeshPoint describe_outside(Vec3 point_mm, MeshPoint nearest, TrianglePlace place) const;

    TriangleMesh mesh_;
    MeshTree tree_;
    MeshNormals normals_;
    std::optional<MeshOutside> outside_;  // of a solid that passes through itself
};

}  // namespace tribo::field
