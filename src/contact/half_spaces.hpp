// SPDX-License-Identifier: MIT
// Nearest point in the intersection of up to four half-spaces, and which of them hold it there. They are the
// tangent planes of a body; where two of them meet, the edge bends as the body's sides do.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec3.hpp"

namespace tribo::contact {

// Points y with dot(normal, y) <= offset.
struct HalfSpace {
    Vec3 normal;  // unit
    double offset = 0;
    std::uint32_t piece = 0;
    // Of the surface along its edge with the piece `beside`, 1/mm: positive where the body is convex; 0: not
    // known.
    double bend = 0;
    std::uint32_t beside = 0;

    double above(Vec3 y) const { return dot(normal, y) - offset; }
};

struct HalfSpaces {
    static constexpr int kMost = 4;
    std::array<HalfSpace, kMost> side;
    int count = 0;

    // Moves the half-space of the same piece whose normal is most alike (product above `alike`), which keeps
    // its bend, else adds one. A full set drops the oldest one.
    void put(const HalfSpace& h, double alike);
    // If the set is full, drops the one that a point is deepest in.
    void make_room(Vec3 at);
    // Returns the nearest point to y in all half-spaces; if their intersection is empty, in the last one.
    Vec3 nearest(Vec3 y) const;

    // The line on which a point stands where just two sides hold it.
    struct Edge {
        Vec3 along;  // unit; zero where the point is not on such a line
        std::array<std::size_t, 2> sides{};
    };
    Edge edge_at(Vec3 at) const;
    // Over a way s on an edge from its nearest place to y, the rest of the way to there grows by this share
    // of s: 1 on a straight edge, 0 on a circle about y. `flat`, `seen`: as below.
    double rest_on_bend(Vec3 y, const Edge& edge, Vec3 flat, Vec3 seen) const;
    // Returns the nearest point to y on an edge that bends, from `flat`, the nearest one on its line. The
    // planes are tangents at `seen`. Where the edge bends about y nearly as a circle does: a point farther
    // along.
    Vec3 nearest_on_bend(Vec3 y, const Edge& edge, Vec3 flat, Vec3 seen) const;

    // A direction as a sum of one to three normals, each times a weight of 0 or more.
    struct Cone {
        std::array<int, 3> index{};  // of the sides
        std::array<double, 3> weight{};
        int count = 0;    // 0: no side
        double miss = 1;  // length of direction - sum
    };
    // Returns the sum that misses the direction (unit) least.
    Cone cone_to(Vec3 direction) const;

  private:
    Vec3 aside_on_bend(const Edge& edge) const;
};

}  // namespace tribo::contact
