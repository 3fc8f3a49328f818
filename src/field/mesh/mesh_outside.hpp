// SPDX-License-Identifier: MIT
// The outside of a closed mesh that passes through itself, or has bodies within others.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "field/mesh/mesh_tree.hpp"

namespace tribo::field {

// Material is everything around which the mesh winds, whichever way and however often. Parts of the surface
// then lie within the material. Knows which, and finds the nearest of the rest.
//
// Built once; then used by any number of threads without allocation.
class MeshOutside {
  public:
    // How a triangle lies: on the outside with its front, or with its back (where the mesh is inside out);
    // within the material; or crossed by others, so that each place of it has to be looked at.
    enum class Side : std::uint8_t { front, back, within, crossed };

    // Nothing if the whole mesh is outside with its front, and of a tangle, in which each triangle crosses
    // many. `tree` is that of the mesh.
    static std::optional<MeshOutside> of(const TriangleMesh& mesh, const MeshTree& tree);

    // Of a place on a triangle: at a corner or an edge a crossed neighbour counts.
    Side side(std::uint32_t triangle, TrianglePlace place) const {
        return place != TrianglePlace::face && near_crossed_[triangle] ? Side::crossed : side_[triangle];
    }
    // The place of the outside that is nearest to a point in material, and the normal of its triangle there,
    // out of the material.
    struct Place {
        MeshTree::Nearest nearest;
        Vec3 normal;
    };
    Place nearest(const TriangleMesh& mesh, const MeshTree& tree, Vec3 point_mm) const;

    // Of the material: each place counts once.
    double volume_mm3() const { return volume_mm3_; }

  private:
    struct Seam {
        Vec3 from, to;
        std::uint32_t triangles[2];
    };
    struct Crossings;
    class Outer;

    MeshOutside() = default;
    bool find_crossings(const TriangleMesh& mesh, const MeshTree& tree, Crossings& found);
    void find_sides(const TriangleMesh& mesh, const MeshTree& tree);
    void keep_outer(const TriangleMesh& mesh, const MeshTree& tree, const std::vector<Seam>& seams);
    void measure(const TriangleMesh& mesh, const MeshTree& tree, Crossings& found);
    static Side side_from(const TriangleMesh& mesh, const MeshTree& tree, std::uint32_t triangle, Vec3 at,
                          double beside_mm);
    Side side_at(const TriangleMesh& mesh, const MeshTree& tree, std::uint32_t triangle, Vec3 at) const;

    double beside_mm_ = 0;  // so far beside a triangle is one of its sides
    double volume_mm3_ = 0;
    std::vector<Side> side_;
    std::vector<bool> near_crossed_;  // has a corner of a crossed triangle
    // Where two triangles cross, as far as that is outside: as triangles without an area, and one of the two.
    std::optional<MeshTree> seams_;
    std::vector<std::uint32_t> seam_triangle_;
};

}  // namespace tribo::field
