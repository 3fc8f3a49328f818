// SPDX-License-Identifier: MIT
// The point of an intersection of up to four half-spaces that is nearest to a given one.
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

    // Renews the half-space of the same piece (normals within acos(alike)), else adds one; a full set loses
    // the oldest.
    void put(const HalfSpace& h, double alike);
    // Nearest point to y that is in all of them; where they leave nothing, in the last one.
    Vec3 nearest(Vec3 y) const;
};

}  // namespace tribo::contact
