// SPDX-License-Identifier: MIT
// Nearest point in the intersection of up to four half-spaces.
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
};

}  // namespace tribo::contact
