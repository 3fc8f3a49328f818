// SPDX-License-Identifier: MIT
// A mesh in which triangles are replaced by others that surely meet no third one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/mesh/triangles_apart.hpp"

namespace tribo::field {

// Some triangles, and what takes their place.
struct MeshChange {
    std::vector<std::uint32_t> old;
    std::vector<Triangle> now;
    // A vertex that is new (its number is the number of vertices) or has a new place.
    struct Place {
        std::uint32_t vertex = 0;
        Point3f at{};
    };
    std::vector<Place> places;
};

// Knows the triangles around some vertices. Everything else of the mesh stays as it is. Changes that keep the
// mesh closed are up to the caller. One thread.
class GuardedMesh {
  public:
    // `cell_mm`: about the length of an edge.
    GuardedMesh(TriangleMesh& mesh, std::span<const std::uint32_t> vertices, double cell_mm);

    const TriangleMesh& mesh() const { return mesh_; }
    Vec3 position(std::uint32_t v) const { return mesh_.position(v); }
    Corners corners(std::uint32_t triangle) const { return field::corners(mesh_, mesh_.triangles[triangle]); }
    // True if all triangles around a vertex are known.
    bool knows(std::uint32_t v) const { return list_of(key(cell_of(position(v)))) != nullptr; }
    // The triangles around a vertex that is known.
    std::vector<std::uint32_t> around(std::uint32_t v) const;
    // The vertices beside one that is known, sorted.
    std::vector<std::uint32_t> beside(std::uint32_t v) const;
    // True if each vertex beside `v` is in two of the triangles around it.
    bool has_ring(std::uint32_t v) const;
    // The triangles at an edge of which an end is known; first those that traverse it from `a` to `b`.
    std::vector<std::uint32_t> at_edge(std::uint32_t a, std::uint32_t b) const;

    // The new triangles of a change, in their places.
    std::vector<Facet> facets(const MeshChange& change) const;
    // True if the new triangles surely meet nothing. False also where not all is known that they could meet.
    bool is_free(const MeshChange& change, std::span<const Facet> facets) const;
    // Returns the numbers of the new triangles.
    std::vector<std::uint32_t> make(const MeshChange& change);
    // Call it at the end: the triangles that fewer others took the place of are still there, without an area.
    void drop_replaced();

  private:
    std::vector<std::uint32_t> others_around(std::uint32_t v) const;
    using CellAt = std::array<int, 3>;
    CellAt cell_of(Vec3 p) const;
    static std::uint64_t key(const CellAt& cell);
    // Calls visit(key of the cell) for the cells that a triangle reaches, until it returns false.
    template <class Visit>
    bool each_cell(const Corners& c, Visit&& visit) const;
    // The triangles that reach a cell; null: it is not known.
    const std::vector<std::uint32_t>* list_of(std::uint64_t cell) const;
    std::vector<std::uint32_t>* list_of(std::uint64_t cell);
    void enter_all();
    void enter(std::uint32_t triangle);
    void leave(std::uint32_t triangle);

    TriangleMesh& mesh_;
    Vec3 origin_;
    double cell_mm_;
    std::vector<std::uint64_t> cells_;               // in which all triangles are known, sorted
    std::vector<std::vector<std::uint32_t>> lists_;  // for each of them: the triangles that reach it
};

}  // namespace tribo::field
