// SPDX-License-Identifier: MIT
// A surface that was only read from a file, for a probe to touch. A closed mesh is a solid, an open mesh is a
// sheet. A mesh whose triangles do not agree on a side, or that is there with both, is a skin.
#pragma once

#include <memory>
#include <vector>

#include "base/result.hpp"
#include "contact/distance_field.hpp"
#include "field/mesh/mesh_body.hpp"

namespace tribo::field {

// The union of what the mesh holds: bodies may overlap, as modellers leave them, and closed and open ones may
// be mixed (mesh_parts.hpp, mesh_body.hpp). A closed body that passes through itself is all that it winds
// around (mesh_outside.hpp). The front of a sheet is the side to which its normals point (corners
// counter-clockwise). Triangles that are there twice count once, and where more than two meet at an edge
// those that go on into each other are one surface (mesh_surfaces.hpp).
//
// Any number of threads; no allocation. Where bodies overlap a query asks up to kMostParts trees.
class MeshField final : public contact::DistanceField {
  public:
    static constexpr double kThicknessMm = 1;
    // Thickness of a skin as a share of the model's diagonal, at most that of a sheet. It is small, so that
    // the rooms of a small model stay open.
    static constexpr double kSkinOfDiagonal = 0.002;

    // Refuses a mesh without a triangle with an area. Turns closed bodies that are inside out.
    static Result<std::unique_ptr<MeshField>> make(TriangleMesh mesh, double thickness_mm = kThicknessMm);

    double distance_mm(Vec3 p) const override { return sample(p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    // The piece is the part of the mesh that is nearest.
    contact::SurfaceSample sample(Vec3 p) const override;
    contact::SurfaceSample nearest(Vec3 p, double /*within_mm*/, contact::NearHint& /*hint*/) const override {
        return sample(p);
    }

    Box3 bounds_mm() const;
    // Some of it is.
    bool is_sheet() const;
    bool is_solid() const;
    // Of a skin: the surface was there with both sides.
    bool is_two_sided() const { return two_sided_; }
    // 0: not a skin.
    double skin_mm() const { return skin_; }

  private:
    MeshField(std::vector<MeshBody> bodies, double skin_mm, bool two_sided)
        : bodies_(std::move(bodies)), skin_(skin_mm), two_sided_(two_sided) {}

    std::vector<MeshBody> bodies_;
    double skin_;
    bool two_sided_;
};

}  // namespace tribo::field
