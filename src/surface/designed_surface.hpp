// SPDX-License-Identifier: MIT
// The surface that a part is meant to have: any mesh, open or closed, with a defined outside.
#pragma once

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "field/mesh/mesh_distance.hpp"

namespace tribo::surface {

struct SurfaceSample {
    Vec3 point_mm;
    Vec3 normal;                 // unit normal of its triangle, to the outside
    double area_mm2 = 0;         // its share of the surface
    std::uint32_t triangle = 0;  // of DesignedSurface::mesh()
};

// Built once, then used by any number of threads without allocation.
class DesignedSurface {
  public:
    // Equal positions become one vertex. The outside of an open surface is the side to which its triangles
    // point. If they point away from `up` on the whole (by area), they are turned over, because exporters use
    // either side. A closed surface is turned if it is inside out; likewise one with slits or small holes,
    // which points nowhere on the whole. Refuses a mesh without a triangle with an area.
    static Result<DesignedSurface> make(TriangleMesh mesh, Vec3 up = {0, 0, 1});

    // Returns the closest point. The distance is negative behind the surface, where material must stay. The
    // side of a watertight surface comes from its winding number, so that folds and slivers of its mesh do
    // not change it; a watertight surface has no border. Beyond the border of an open surface the side is
    // that of the plane of the nearest triangle.
    field::MeshPoint closest(Vec3 point_mm) const { return sided(point_mm, distance_.closest(point_mm)); }
    // The same result, faster if `guess` is the triangle of a result near by.
    field::MeshPoint closest(Vec3 point_mm, std::uint32_t guess) const {
        return sided(point_mm, distance_.closest(point_mm, guess));
    }
    // The same result if it is nearer than reach_mm, else nothing.
    std::optional<field::MeshPoint> closest_within(Vec3 point_mm, double reach_mm,
                                                   std::uint32_t guess) const {
        const auto found = distance_.closest_within(point_mm, reach_mm, guess);
        if (!found) return std::nullopt;
        return sided(point_mm, *found);
    }
    double signed_distance_mm(Vec3 point_mm) const { return closest(point_mm).distance_mm; }

    // Returns points spread over the surface: at most spacing_mm > 0 apart within a triangle, at least one in
    // each triangle.
    std::vector<SurfaceSample> sample(double spacing_mm) const;

    const TriangleMesh& mesh() const { return distance_.mesh(); }
    double area_mm2() const { return area_; }
    bool watertight() const { return watertight_; }
    // Number of edges whose two triangles point to different sides. The side of an open surface is not
    // reliable there.
    std::size_t turned_edges() const { return distance_.normals().turned_edges(); }

  private:
    DesignedSurface(TriangleMesh mesh, bool watertight);
    field::MeshPoint sided(Vec3 point_mm, field::MeshPoint found) const;

    field::MeshDistance distance_;
    double area_;
    bool watertight_;
};

}  // namespace tribo::surface
