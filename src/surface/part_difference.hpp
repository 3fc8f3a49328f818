// SPDX-License-Identifier: MIT
// The difference of two parts: volumes that only one of them has, and the signed distance between their
// surfaces. Positive: B leaves more material than A.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/mesh.hpp"
#include "base/parallel.hpp"
#include "field/carved/carved_field.hpp"
#include "field/mesh/mesh_distance.hpp"

namespace tribo::surface {

// The volume of the material that only one of two parts has, mm3. It is measured by the filled shares of the
// cells of one grid, so `only_b - only_a` is the difference of the volumes on this grid, and equal parts give
// exactly 0. Where the surfaces of both parts pass through one cell, only the difference of its shares
// counts.
struct VolumeDifference {
    double only_a_mm3 = 0, only_b_mm3 = 0;
    double a_mm3 = 0, b_mm3 = 0;  // the parts, on the same grid
    double cell_mm = 0;
};

// On a grid of the finer of both spacings over both blanks, or a coarser one where that has too many cells.
// Bits do not depend on `parallel`.
VolumeDifference volume_difference(const field::CarvedField& a, const field::CarvedField& b,
                                   const ParallelFor& parallel = serial_for);

// A part as this comparison needs it: its field and a closed mesh of its surface. Both must outlive it.
class ComparedPart {
  public:
    ComparedPart(const field::CarvedField& field, TriangleMesh mesh)
        : field_(&field), distance_(std::move(mesh)) {}

    // Signed, negative inside. Within half a cell of the surface it is that of the exact level, at a concave
    // or convex edge a lower bound; elsewhere it is that of the mesh.
    double distance_mm(Vec3 point_mm) const;
    // The point of the surface nearest to it.
    Vec3 nearest_mm(Vec3 point_mm) const { return distance_.closest(point_mm).point_mm; }
    const TriangleMesh& mesh() const { return distance_.mesh(); }
    const field::CarvedField& field() const { return *field_; }

  private:
    const field::CarvedField* field_;
    field::MeshDistance distance_;
};

// A smaller distance is rounding and counts as 0: a nanometre.
inline constexpr double kSameMm = 1e-6;

// The signed difference at each position of a mesh of A or of B, mm: the distance of the other part there.
std::vector<float> differences_at(const TriangleMesh& mesh, const ComparedPart& a, const ComparedPart& b,
                                  const ParallelFor& parallel = serial_for);

// A place where the surfaces are apart.
struct DifferencePlace {
    double mm = 0;  // signed
    Vec3 on_a_mm, on_b_mm;
};

struct SurfaceDifference {
    // The largest of all vertices of both meshes; absent: there is none of that sign.
    std::optional<DifferencePlace> more, less;  // B leaves more, B leaves less
};

// Measured both ways: from the surface of A to that of B, and back.
SurfaceDifference surface_difference(const ComparedPart& a, const ComparedPart& b,
                                     const ParallelFor& parallel = serial_for);

}  // namespace tribo::surface
