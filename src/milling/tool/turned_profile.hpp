// SPDX-License-Identifier: MIT
// The profile of a cutter as lines and arcs in the half plane (r, z) through its axis.
#pragma once

#include <vector>

#include "milling/tool/cutter.hpp"

namespace tribo::milling {

// A direction or a point of the half plane.
struct PlanePoint {
    double r = 0, z = 0;

    friend PlanePoint operator+(PlanePoint a, PlanePoint b) { return {a.r + b.r, a.z + b.z}; }
    friend PlanePoint operator-(PlanePoint a, PlanePoint b) { return {a.r - b.r, a.z - b.z}; }
    friend PlanePoint operator*(double s, PlanePoint a) { return {s * a.r, s * a.z}; }
};
inline double dot(PlanePoint a, PlanePoint b) {
    return a.r * b.r + a.z * b.z;
}
// Positive if b lies counter-clockwise of a.
inline double cross(PlanePoint a, PlanePoint b) {
    return a.r * b.z - a.z * b.r;
}
double norm(PlanePoint a);

// A line or an arc of the profile with its outward unit normals at both ends. The cutter lies on the side of
// the axis. Along an arc the normal turns from `from_normal` to `to_normal`: counter-clockwise if it is
// convex, else clockwise.
struct ProfileElement {
    PlanePoint from, to;
    PlanePoint from_normal, to_normal;
    PlanePoint centre;     // of an arc
    double radius_mm = 0;  // of an arc: > 0 convex, < 0 concave; 0: a line

    bool is_arc() const { return radius_mm != 0; }
    bool is_level() const { return !is_arc() && from.z == to.z; }
};

// Returns the elements from the axis to the end of the edges at length_mm: a flat bottom where the profile
// does not begin on the axis, the pieces of the profile, and the cylinder above it. Elements shorter than
// kShortest are left out. The vertices must be a profile (check_profile).
std::vector<ProfileElement> profile_elements(const Cutter& cutter);
inline constexpr double kShortest = 1e-9;  // mm

// Returns the largest radius of the elements.
double largest_radius_mm(const std::vector<ProfileElement>& elements);

}  // namespace tribo::milling
