// SPDX-License-Identifier: MIT
// A surface that was only read from a file, for a probe to touch. A closed mesh is a solid, an open mesh is a
// sheet. A mesh whose triangles do not agree on a side is a skin.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "contact/distance_field.hpp"
#include "field/mesh/mesh_distance.hpp"

namespace tribo::field {

// The front of a sheet is the side to which its normals point (corners counter-clockwise). The sheet gets a
// thickness behind its front, so that it also has a back: material is everything at most that far behind the
// sheet, up to a wall along its border. The front is exact. Where the sheet bends more than the thickness
// allows, the back is what remains.
//
// A skin has the surface in its middle: material is everything within half its thickness on either side.
//
// Distances in air are exact, by a search in a tree of boxes (about a microsecond), but beyond the border of
// a bent sheet: there they are those to its wall (sheet_wall.hpp), although its back may be a little nearer.
// Any number of threads; no allocation.
class MeshField final : public contact::DistanceField {
  public:
    static constexpr double kThicknessMm = 1;
    // Thickness of a skin as a share of the model's diagonal, at most that of a sheet. It is small, so that
    // the rooms of a small model stay open.
    static constexpr double kSkinOfDiagonal = 0.002;

    // Refuses a mesh without a triangle with an area. Turns a closed mesh that is inside out.
    static Result<std::unique_ptr<MeshField>> make(TriangleMesh mesh, double thickness_mm = kThicknessMm);

    double distance_mm(Vec3 p) const override { return sample(p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override;
    contact::SurfaceSample nearest(Vec3 p, double /*within_mm*/, contact::NearHint& /*hint*/) const override {
        return sample(p);
    }

    Box3 bounds_mm() const { return distance_.bounds_mm(); }
    bool is_sheet() const { return thickness_ > 0; }
    // 0: not a skin.
    double skin_mm() const { return skin_; }

  private:
    MeshField(TriangleMesh mesh, double thickness_mm, double skin_mm);

    MeshDistance distance_;
    double thickness_;  // 0: a solid or a skin
    double skin_;
    std::vector<Vec3> off_;  // of the wall of a sheet, by triangle
    std::optional<MeshTree> wall_tree_;
};

}  // namespace tribo::field
