// SPDX-License-Identifier: MIT
#include "surface/designed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribo::surface {
namespace {

// Longest edge of the triangle of a sample, in spacings. With it, the two halves of a right angle have their
// samples one spacing apart.
constexpr double kReach = 1.5;

// Halves the triangle across its longest edge until it is small, and takes one sample in the middle of each
// part.
void sample_triangle(Vec3 a, Vec3 b, Vec3 c, const SurfaceSample& whole, double longest,
                     std::vector<SurfaceSample>& out) {
    const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
    if (std::max({ab, bc, ca}) <= longest) {
        out.push_back({(a + b + c) / 3, whole.normal, whole.area_mm2, whole.triangle});
        return;
    }
    const bool is_bc = bc >= ab && bc >= ca, is_ca = !is_bc && ca >= ab;
    const Vec3 from = is_bc   ? b
                      : is_ca ? c
                              : a,
               to = is_bc   ? c
                    : is_ca ? a
                            : b,
               tip = is_bc   ? a
                     : is_ca ? b
                             : c;
    const Vec3 middle = 0.5 * (from + to);
    SurfaceSample half = whole;
    half.area_mm2 *= 0.5;
    sample_triangle(from, middle, tip, half, longest, out);
    sample_triangle(middle, to, tip, half, longest, out);
}

// A surface whose openings have a smaller share of its area is closed but for slits and holes.
constexpr double kOpenShare = 0.01;

// Returns a value > 0 if the triangles point to the outside.
double outward(const TriangleMesh& mesh, bool watertight, Vec3 up) {
    if (watertight) return volume_mm3(mesh);
    const Vec3 middle = bounds(mesh).centre();
    Vec3 twice_area;
    double volume = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.position(t[0]);
        const Vec3 normal = cross(mesh.position(t[1]) - a, mesh.position(t[2]) - a);
        twice_area += normal;
        volume += dot(a - middle, normal);
    }
    // The area vector of a surface is that of its openings.
    const bool is_open = length(twice_area) > kOpenShare * 2 * area_mm2(mesh);
    return is_open ? dot(up, twice_area) : volume;
}

}  // namespace

DesignedSurface::DesignedSurface(TriangleMesh mesh, bool watertight)
    : distance_(std::move(mesh)), area_(tribo::area_mm2(distance_.mesh())), watertight_(watertight) {}

field::MeshPoint DesignedSurface::sided(Vec3 point_mm, field::MeshPoint found) const {
    if (!watertight_) return found;
    found.on_border = false;
    const double d = std::abs(found.distance_mm);
    found.distance_mm = distance_.winding(point_mm) > 0 ? -d : d;
    return found;
}

Result<DesignedSurface> DesignedSurface::make(TriangleMesh mesh, Vec3 up) {
    weld_exactly(mesh);
    std::erase_if(mesh.triangles, is_degenerate);
    if (!(tribo::area_mm2(mesh) > 0)) {
        return fail("the designed surface has no area", "check that the model holds a surface");
    }
    const bool watertight = is_watertight(mesh);
    if (outward(mesh, watertight, up) < 0) {
        for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    return DesignedSurface(std::move(mesh), watertight);
}

std::vector<SurfaceSample> DesignedSurface::sample(double spacing_mm) const {
    std::vector<SurfaceSample> samples;
    for (std::uint32_t i = 0; i < mesh().triangles.size(); ++i) {
        const Triangle& t = mesh().triangles[i];
        const Vec3 a = mesh().position(t[0]), b = mesh().position(t[1]), c = mesh().position(t[2]);
        const Vec3 twice_area = cross(b - a, c - a);
        const SurfaceSample whole{{}, normalized(twice_area, {}), 0.5 * length(twice_area), i};
        if (whole.normal != Vec3{}) sample_triangle(a, b, c, whole, kReach * spacing_mm, samples);
    }
    return samples;
}

}  // namespace tribo::surface
