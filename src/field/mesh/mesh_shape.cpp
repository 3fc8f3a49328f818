// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_shape.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "base/text/decimal.hpp"

namespace tribo::field {
namespace {

// Nearer to the mesh than this, the direction to it is rounding noise and the normal of the mesh is used, mm.
constexpr double kOnFace = 1e-6;

std::string place(Vec3 p) {
    return format_decimal(static_cast<float>(p.x)) + ", " + format_decimal(static_cast<float>(p.y)) + ", " +
           format_decimal(static_cast<float>(p.z));
}

}  // namespace

Result<std::unique_ptr<MeshShape>> MeshShape::make(TriangleMesh mesh) {
    if (!is_closed(mesh)) {
        weld_exactly(mesh);
        std::erase_if(mesh.triangles, is_degenerate);
        if (!is_closed(mesh)) {
            const MeshNormals normals(mesh);
            if (normals.border_edges() == 0) {
                return fail("the mesh has triangles that are turned over",
                            "make its normals consistent in the program that made it");
            }
            return fail("the mesh is not closed: " + std::to_string(normals.border_edges()) +
                            " edges do not have two triangles, the first at " +
                            place(normals.first_border_mm()) + " mm",
                        "close its holes in the program that made it");
        }
    }
    const double volume = tribo::volume_mm3(mesh);
    if (!(volume != 0)) return fail("the mesh encloses no volume", "check that it is a solid");
    if (volume < 0) {
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    return std::unique_ptr<MeshShape>(new MeshShape(std::move(mesh)));
}

Vec3 MeshShape::gradient(Vec3 point_mm) const {
    const MeshPoint found = distance_->closest(point_mm);
    if (std::abs(found.distance_mm) <= kOnFace) return found.normal;
    return (point_mm - found.point_mm) / found.distance_mm;
}

void MeshShape::sample(const Lattice& lattice, float* out) const {
    std::uint32_t plane_guess = distance_->closest(lattice.node(0, 0, 0)).triangle;
    for (int c = 0; c < kLatticeEdge; ++c) {
        std::uint32_t row_guess = plane_guess;
        for (int b = 0; b < kLatticeEdge; ++b) {
            std::uint32_t guess = row_guess;
            for (int a = 0; a < kLatticeEdge; ++a) {
                const MeshPoint found = distance_->closest(lattice.node(a, b, c), guess);
                *out++ = static_cast<float>(found.distance_mm);
                guess = found.triangle;
                if (a == 0) row_guess = guess;
                if (a == 0 && b == 0) plane_guess = guess;
            }
        }
    }
}

}  // namespace tribo::field
