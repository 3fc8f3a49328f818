// SPDX-License-Identifier: MIT
// The surface that a part is meant to have: any mesh, open or closed, with a side that is outside.
#pragma once

#include <optional>
#include <vector>

#include "base/result.hpp"
#include "field/mesh/mesh_distance.hpp"

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

    // The closest point, with the distance negative behind the surface: where material must stay. The side of
    // a watertight surface is told by its winding number, so folds and slivers of its mesh do not mislead it,
    // and it has no border. Beyond the border of an open surface the side is that of the nearest triangle's
    // plane.
    field::MeshPoint closest(Vec3 point_mm) const { return sided(point_mm, distance_.closest(point_mm)); }
    // The same, faster where `guess` is the triangle of an answer near by.
    field::MeshPoint closest(Vec3 point_mm, std::uint32_t guess) const {
        return sided(point_mm, distance_.closest(point_mm, guess));
    }
    // The same where it is nearer than reach_mm, else none.
    std::optional<field::MeshPoint> closest_within(Vec3 point_mm, double reach_mm,
                                                   std::uint32_t guess) const {
        const auto found = distance_.closest_within(point_mm, reach_mm, guess);
        if (!found) return std::nullopt;
        return sided(point_mm, *found);
    }
    double signed_distance_mm(Vec3 point_mm) const { return closest(point_mm).distance_mm; }

    // Points spread over the surface, at most spacing_mm > 0 apart within a triangle, and at least one in
    // each.
    std::vector<SurfaceSample> sample(double spacing_mm) const;

    const TriangleMesh& mesh() const { return distance_.mesh(); }
    double area_mm2() const { return area_; }
    bool watertight() const { return watertight_; }
    // Edges whose two triangles point to different sides: there the side of an open surface is not to be
    // trusted.
    std::size_t turned_edges() const { return distance_.normals().turned_edges(); }

  private:
    DesignedSurface(TriangleMesh mesh, bool watertight);
    field::MeshPoint sided(Vec3 point_mm, field::MeshPoint found) const;

    field::MeshDistance distance_;
    double area_;
    bool watertight_;
};

}  // namespace tribo::surface
