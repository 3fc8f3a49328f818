// SPDX-License-Identifier: MIT
// The surface that a part is meant to have: any mesh, open or closed, with a side that is outside.
#pragma once

#include <vector>

#include "base/result.hpp"
#include "field/mesh_distance.hpp"

namespace tribo::surface {

struct SurfaceSample {
    Vec3 point_mm;
    Vec3 normal;                 // unit, of its triangle, to the outside
    double area_mm2 = 0;         // its share of the surface
    std::uint32_t triangle = 0;  // of DesignedSurface::mesh()
};

// Built once, then asked from any number of threads without allocation.
class DesignedSurface {
  public:
    // Equal positions become one vertex. The outside of an open surface is the side to which its triangles
    // point; where they point away from `up` on the whole (by area) they are turned over, for exporters take
    // either side. A closed surface is turned when it is inside out. Refused: no triangle with an area.
    static Result<DesignedSurface> make(TriangleMesh mesh, Vec3 up = {0, 0, 1});

    // The closest point, with the distance negative behind the surface: where material must stay. Beyond the
    // border of an open surface the side is that of the nearest triangle's plane.
    field::MeshPoint closest(Vec3 point_mm) const { return distance_.closest(point_mm); }
    double signed_distance_mm(Vec3 point_mm) const { return distance_.closest(point_mm).distance_mm; }

    // Points spread over the surface, at most spacing_mm > 0 apart within a triangle, and at least one in
    // each.
    std::vector<SurfaceSample> sample(double spacing_mm) const;

    const field::MeshDistance& distance() const { return distance_; }
    const TriangleMesh& mesh() const { return distance_.mesh(); }
    double area_mm2() const { return area_; }
    bool closed() const { return closed_; }
    // Edges whose two triangles point to different sides: there "outside" is not to be trusted.
    std::size_t turned_edges() const { return distance_.normals().turned_edges(); }

  private:
    DesignedSurface(TriangleMesh mesh, bool closed);

    field::MeshDistance distance_;
    double area_;
    bool closed_;
};

}  // namespace tribo::surface
