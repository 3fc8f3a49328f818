// SPDX-License-Identifier: MIT
// Nearest point in the intersection of up to four half-spaces, and which of them hold it there.
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

    double above(Vec3 y) const { return dot(normal, y) - offset; }
};

struct HalfSpaces {
    static constexpr int kMost = 4;
    std::array<HalfSpace, kMost> side;
    int count = 0;

    // Replaces the half-space of the same piece (angle of the normals within acos(alike)), else adds one. A
    // full set drops the oldest one.
    void put(const HalfSpace& h, double alike);
    // Returns the nearest point to y in all half-spaces; if their intersection is empty, in the last one.
    Vec3 nearest(Vec3 y) const;

    // A direction as a sum of one to three normals, each times a weight of 0 or more.
    struct Cone {
        std::array<int, 3> index{};  // of the sides
        std::array<double, 3> weight{};
        int count = 0;    // 0: no side
        double miss = 1;  // length of direction - sum
    };
    // Returns the sum that misses the direction (unit) least.
    Cone cone_to(Vec3 direction) const;
};

}  // namespace tribo::contact
