// SPDX-License-Identifier: MIT
// A surface that was only read, for a probe to touch: a closed mesh is a solid, an open one a sheet, one
// whose triangles do not agree on a side a skin.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "contact/distance_field.hpp"
#include "field/mesh/mesh_distance.hpp"

namespace tribo::field {

// A sheet's front is where its normals point (corners counter-clockwise). It is given a thickness behind, so
// that it has a back too and its border is a wall: material is what lies at most that far behind the sheet.
// Its front is exact; where the sheet bends more than the thickness allows, its back is what is left.
//
// A skin has the surface in its middle: material is what lies within half its thickness, on either side.
//
// Distances in air are exact, by a search of a tree of boxes (about a microsecond). Any number of threads; no
// allocation.
class MeshField final : public contact::DistanceField {
  public:
    static constexpr double kThicknessMm = 1;
    // Of a skin, by the model's diagonal, and no more than a sheet's: rooms of a small model stay rooms.
    static constexpr double kSkinOfDiagonal = 0.002;

    // Refused: no triangle with an area. A closed mesh that is inside out is turned.
    static Result<std::unique_ptr<MeshField>> make(TriangleMesh mesh, double thickness_mm = kThicknessMm);

    double distance_mm(Vec3 p) const override { return sample(p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override;
    contact::SurfaceSample nearest(Vec3 p, double /*within_mm*/, contact::NearHint& /*hint*/) const override {
        return sample(p);
    }

    Box3 bounds_mm() const { return distance_.bounds_mm(); }
    bool is_sheet() const { return thickness_ > 0; }
    // 0: it is none.
    double skin_mm() const { return skin_; }

  private:
    // The edges that a sheet ends at, each with the way off it, in the plane of its triangle.
    struct Border {
        TriangleMesh edges;  // triangles without area
        std::vector<Vec3> off;
    };
    MeshField(TriangleMesh mesh, double thickness_mm, double skin_mm);
    static Border border_of(const TriangleMesh& mesh, const MeshNormals& normals);

    MeshDistance distance_;
    double thickness_;  // 0: a solid or a skin
    double skin_;
    Border border_;
    std::optional<MeshTree> border_tree_;
};

}  // namespace tribo::field
