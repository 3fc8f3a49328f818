// SPDX-License-Identifier: MIT
// A triangle mesh for a probe to touch: a solid, a sheet or a skin.
#pragma once

#include <optional>
#include <vector>

#include "contact/distance_field.hpp"
#include "field/mesh/mesh_distance.hpp"

namespace tribo::field {

// A closed mesh is a solid. An open mesh is a sheet: it gets a thickness behind its front, so that it also
// has a back: material is everything at most that far behind the sheet, up to a wall along its border. The
// front is exact. Where the sheet bends more than the thickness allows, the back is what remains.
//
// A skin has the surface in its middle: material is everything within half its thickness on either side.
//
// A closed mesh may pass through itself (mesh_outside.hpp). Of a sheet and a skin the nearest place decides
// on which side a point is: where surfaces cross, that is wrong. Distances in air are exact, by a search in a
// tree of boxes (about a microsecond), but beyond the border of a bent sheet: there they are those to its
// wall (sheet_wall.hpp), although its back may be a little nearer. Any number of threads; no allocation.
class MeshBody {
  public:
    // The mesh is welded and has a triangle. `thickness_mm` of a sheet, `skin_mm`; 0: it is none.
    MeshBody(TriangleMesh mesh, double thickness_mm, double skin_mm);

    contact::SurfaceSample sample(Vec3 point_mm) const;
    // Holds all of its material.
    const Box3& box_mm() const { return box_; }
    Box3 bounds_mm() const { return distance_.bounds_mm(); }
    bool is_sheet() const { return thickness_ > 0; }

  private:
    Vec3 normal_on(const MeshPoint& at) const;

    MeshDistance distance_;
    double thickness_, skin_;
    Box3 box_;
    std::vector<Vec3> off_;  // of the wall of a sheet, by triangle
    std::optional<MeshTree> wall_tree_;
};

}  // namespace tribo::field
