// SPDX-License-Identifier: MIT
// The surface that a circle of the cutter sweeps under a rational motion, exactly: the motion of degree n
// takes every point on a rational curve of degree 2 n, the circle is a rational quadratic, so the surface is
// a rational patch of bidegree (2 n, 2). With the bottom circle of a flat end mill it is the exact effective
// cutting shape of Xia & Ge 2001. The envelope of the flank is not rational; it is given point by point.
// Allocates its result; any thread. Source: Juttler & Wagner 1996, J. Mech. Des. 118; Xia & Ge 2001, ICRA.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "motion/made_motions.hpp"

namespace tribo::milling {

// A rational tensor-product Bezier patch over 0..1 x 0..1: net[i * 3 + j] for i = 0..degree_u along the
// motion and j = 0..2 round the circle, mm.
struct SweptPatch {
    std::size_t degree_u = 0;
    std::vector<motion::HomogeneousPoint> net;

    Vec3 point(double u, double v) const;
    // Unit, to one side (the cross product of the derivatives by u and v); zero where they are parallel.
    Vec3 normal(double u, double v) const;
};

// The circle of this radius about the tool axis at this height above the tip, in four quarters in order:
// v = 0 of quarter k lies k quarter turns about the axis (right-handed) from the tool's x axis.
std::array<SweptPatch, 4> swept_circle(const motion::BezierMotion& motion, double radius_mm,
                                       double height_mm = 0);

// Likewise for every piece of a spline motion, in order.
std::vector<std::array<SweptPatch, 4>> swept_circle(const motion::BSplineMotion& motion, double radius_mm,
                                                    double height_mm = 0);

// The two points at this height of a cylinder's flank that the envelope touches just now: where the flank
// moves along itself, p + s u +- R (u x v) / |u x v| with v = p' + s u'. None while that height moves along
// the axis.
std::optional<std::array<Vec3, 2>> flank_grazing_points(const motion::testing::PoseRates& rates,
                                                        double radius_mm, double height_mm);

}  // namespace tribo::milling
