// SPDX-License-Identifier: MIT
// The three kinds of elementary travel that have sweeps, in their own frames.
#pragma once

#include "base/vec3.hpp"
#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// The cutter in the distance formulas: a cylinder with a rounded bottom edge.
struct ToolProfile {
    CutterKind kind = CutterKind::flat;
    double radius_mm = 0, corner_mm = 0, length_mm = 0;

    explicit ToolProfile(const Cutter& c)
        : kind(c.kind), radius_mm(c.radius_mm()), corner_mm(c.corner_radius_mm()), length_mm(c.length_mm) {}
};

// Orthonormal axes of a frame in stock coordinates.
struct Frame {
    Vec3 x, y, z;
    Vec3 into(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    Vec3 out_of(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

// Travel (across, 0, rise) in a frame whose z is the tool axis.
struct StraightLine {
    double across = 0, rise = 0, per_across = 0, per_length_squared = 0;  // 0 if the travel has no length

    StraightLine() = default;
    StraightLine(double a, double r) : across(a), rise(r) {
        if (a > 0) per_across = 1 / a;
        if (a > 0 || r != 0) per_length_squared = 1 / (a * a + r * r);
    }
};

// Largest number of moves whose sweep has a form of its own.
inline constexpr std::size_t kMostParts = 16;

// One of several straight travels with the same axis, in a frame that all of them share: the tip at its
// start, and the unit direction (along_x, along_y) of its part across the axis.
struct StraightPart {
    Vec3 start;
    double along_x = 1, along_y = 0;
    StraightLine line;
};

// Travel about the frame's z (parallel or opposite to the tool axis), from (radius, 0) to the left by at most
// half a turn.
struct ArcLine {
    double radius = 0, end_x = 1, end_y = 0;
};

// Travel along a quadratic with one axis and an even rise, in a frame whose z is the axis: the tip is at
// (across t + bend_x t^2, bend_y t^2, rise t).
struct UprightLine {
    double across = 0, bend_x = 0, bend_y = 0, rise = 0;
    // The square of the distance to the axis is convex in t for points (x, y) with bend_x x + bend_y y below
    // this.
    double convex_below = 0;
};

// Bounds of the motion of the tool over t in 0..1, from the control points of tip and axis. Derivatives by t,
// mm and radians. A point at the distance d from `middle` is at most d + spread away from the tip.
struct TravelBounds {
    Vec3 middle;  // of the tip path, relative to its start
    double spread = 0, speed = 0, tip_bend = 0, turn = 0, turn_rate = 0;
};

// Tip and axis as coefficients of t^0, t^1, t^2 in stock coordinates. The tip is relative to its start; the
// axis is normalised after evaluation.
struct CurvedLine {
    Vec3 tip1, tip2, axis0, axis1, axis2;
    int stretches = 4;  // number of parts of t that are searched one by one
    TravelBounds bounds{};

    CurvedLine(Vec3 tip_1, Vec3 tip_2, Vec3 axis_0, Vec3 axis_1, Vec3 axis_2);
};

// The tool and its motion at evenly spaced instants of a curved travel. With them, single precision finds
// where along the travel a point may be nearest.
struct CurvedInstants {
    static constexpr int kCount = 8;
    float tip[3][kCount], axis[3][kCount];            // unit axis
    float tip_rate[3][kCount], axis_rate[3][kCount];  // derivatives by t

    CurvedInstants() = default;
    explicit CurvedInstants(const CurvedLine& line);
    // Puts the tool at the instant t of a travel that begins at `start` into the place k.
    void put(int k, const CurvedLine& line, double t, Vec3 start);
};

// Eight curved travels at the middle of each, relative to one point, and what bounds the distance around the
// middle: TravelBounds, with |q''| = bend + bend_per_mm * reach (sweep_search.inl).
struct TravelMiddles {
    static constexpr int kCount = CurvedInstants::kCount;
    CurvedInstants at;
    float middle[3][kCount], spread[kCount], speed[kCount], turn[kCount], bend[kCount], bend_per_mm[kCount];

    // Puts a travel that begins at `start` into the place k.
    void put(int k, const CurvedLine& line, Vec3 start);
};

}  // namespace tribo::milling
