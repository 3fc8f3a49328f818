// SPDX-License-Identifier: MIT
// A mesh in which triangles are replaced by others that surely meet no third one, in many places at once.
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
    // A vertex that is new (MeshBlock::new_vertex) or has a new place.
    struct Place {
        std::uint32_t vertex = 0;
        Point3f at{};
    };
    std::vector<Place> places;
};

class MeshBlock;

// Knows the triangles around some vertices. Everything else of the mesh stays as it is.
class GuardedMesh {
  public:
    // `cell_mm`: about the length of an edge. `most_new`: so many vertices may be added.
    GuardedMesh(TriangleMesh& mesh, std::span<const std::uint32_t> vertices, double cell_mm,
                std::size_t most_new);

    // Divides space into blocks, in each round at other places, and returns those with some of the vertices
    // (sorted). What may be added is divided among them by the number of these.
    std::vector<MeshBlock> blocks(std::span<const std::uint32_t> vertices, int round);
    // Takes back what the blocks have not added.
    void take_back(std::span<MeshBlock> blocks);
    // Call it at the end: drops the places of vertices and triangles that are not used.
    void drop_unused();

  private:
    friend class MeshBlock;
    using CellAt = std::array<int, 3>;
    CellAt cell_of(Vec3 p) const;
    // Calls visit(key of the cell) for the cells that a triangle reaches, until it returns false.
    template <class Visit>
    bool each_cell(const Corners& c, Visit&& visit) const;
    void enter_all();
    Corners corners(std::uint32_t triangle) const { return field::corners(mesh_, mesh_.triangles[triangle]); }
    std::vector<std::uint32_t>* list_of(std::uint64_t cell);

    TriangleMesh& mesh_;
    Vec3 origin_;
    double cell_mm_;
    std::vector<std::uint64_t> cells_;               // in which all triangles are known, sorted
    std::vector<std::vector<std::uint32_t>> lists_;  // for each of them: the triangles that reach it
    std::vector<std::uint32_t> free_vertices_, free_triangles_;  // numbers that nothing uses
};

// A part of a guarded mesh. Triangles that lie wholly within it may be changed, by one thread for each block.
// Changes that keep the mesh closed are up to the caller.
class MeshBlock {
  public:
    // Those that the block was asked for, sorted.
    std::span<const std::uint32_t> vertices() const { return vertices_; }
    const Triangle& triangle(std::uint32_t t) const { return mesh().triangles[t]; }
    Vec3 position(std::uint32_t v) const { return mesh().position(v); }
    Corners corners(std::uint32_t t) const { return guarded_->corners(t); }
    // True if all triangles around a vertex are known.
    bool knows(std::uint32_t v) const { return list_of(position(v)) != nullptr; }
    // True near the border: another round may do there what this one may not.
    bool is_near_border(std::uint32_t v) const;
    // The triangles around a vertex that is known.
    std::vector<std::uint32_t> around(std::uint32_t v) const;
    // The vertices beside one that is known, sorted.
    std::vector<std::uint32_t> beside(std::uint32_t v) const;
    // True if each vertex beside `v` is in two of the triangles around it.
    bool has_ring(std::uint32_t v) const;
    // The triangles at an edge of which an end is known; first those that traverse it from `a` to `b`.
    std::vector<std::uint32_t> at_edge(std::uint32_t a, std::uint32_t b) const;

    // True if a change may add a vertex; then its number.
    bool has_new_vertex() const { return !free_vertices_.empty(); }
    std::uint32_t new_vertex() const { return free_vertices_.back(); }
    // The new triangles of a change, in their places.
    std::vector<Facet> facets(const MeshChange& change) const;
    // True if the new triangles surely meet nothing. False also where not all is known that they could meet.
    bool is_free(const MeshChange& change, std::span<const Facet> facets) const;
    // Returns the numbers of the new triangles.
    std::vector<std::uint32_t> make(const MeshChange& change);

  private:
    friend class GuardedMesh;
    MeshBlock(GuardedMesh& guarded, std::uint64_t key, int shift)
        : guarded_(&guarded), key_(key), shift_(shift) {}
    const TriangleMesh& mesh() const { return guarded_->mesh_; }
    std::vector<std::uint32_t> others_around(std::uint32_t v) const;
    // The triangles that reach a cell; null: it is not known, or not of this block.
    std::vector<std::uint32_t>* list_of(std::uint64_t cell) const;
    const std::vector<std::uint32_t>* list_of(Vec3 p) const;
    bool contains(std::uint32_t triangle) const;
    void enter(std::uint32_t triangle);
    void leave(std::uint32_t triangle);

    GuardedMesh* guarded_;
    std::uint64_t key_;
    int shift_;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> free_vertices_, free_triangles_;
};

}  // namespace tribo::field
