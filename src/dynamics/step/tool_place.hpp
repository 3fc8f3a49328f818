// SPDX-License-Identifier: MIT
// Where a tool stands, with x and y in lanes: the two are computed at once.
#pragma once

#include "base/vec3.hpp"

namespace tribo::dynamics {

// Two doubles in lanes (base/simd.hpp has those of floats). The same bits on every compiler.
using D2 = double __attribute__((vector_size(16)));

inline D2 both(double value) {
    return D2{value, value};
}

inline D2 swapped(D2 lanes) {
    return D2{lanes[1], lanes[0]};
}

// Turns (sine, cosine) of an angle to that of the angle plus a constant one, or makes of it another vector
// that turns with the angle.
struct Turner {
    D2 same{}, crossed{};

    Turner() = default;
    // Of an angle with that sine and cosine, times the same number.
    Turner(double sine, double cosine) : same(both(cosine)), crossed(D2{sine, -sine}) {}
    D2 operator()(D2 turning) const { return same * turning + crossed * swapped(turning); }
};

// A vector; frame and units are those of its use.
struct LaneVec3 {
    D2 xy{};
    double z = 0;

    Vec3 vec3() const { return {xy[0], xy[1], z}; }
};

// Where the tool stands against the part, by its feed and by its displacement.
struct ToolPlace {
    LaneVec3 tip_mm{};
    D2 turn_rad{};  // change of the unit axis along x and y
};

}  // namespace tribo::dynamics
