// SPDX-License-Identifier: MIT
// A triangle mesh: the output of readers and meshing, the input of writers. Positions in mm unless a name
// says otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.hpp"

namespace tribo {

using Point3f = std::array<float, 3>;
inline Point3f to_float(Vec3 p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}
inline Vec3 to_double(const Point3f& p) {
    return {p[0], p[1], p[2]};
}
using Triangle = std::array<std::uint32_t, 3>;  // counter-clockwise seen from outside

struct TriangleMesh {
    std::vector<Point3f> positions;
    std::vector<Triangle> triangles;  // every index < positions.size()
    std::vector<Point3f> normals;     // unit, one per position; or empty

    Vec3 position(std::uint32_t i) const { return to_double(positions[i]); }
};

Box3 bounds(const TriangleMesh& mesh);
double area_mm2(const TriangleMesh& mesh);
// Signed volume by the divergence theorem; meaningful for a closed mesh only.
double volume_mm3(const TriangleMesh& mesh);
// True if every edge is shared by exactly two triangles that traverse it in opposite directions.
bool is_closed(const TriangleMesh& mesh);
// True if every edge is traversed equally often in both directions, by any number of triangles. This is
// enough for a winding number.
bool is_watertight(const TriangleMesh& mesh);
// True for a triangle that uses a vertex twice.
constexpr bool is_degenerate(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}
// Makes triangles use the first one of all positions with equal value (-0 equals 0). Drops the normals. Keeps
// all positions, also unused ones, and all triangles, also those that then use a vertex twice. It sorts;
// therefore neither the result nor the time (n log n) depends on the order of the values.
void weld_exactly(TriangleMesh& mesh);
// Drops the positions, with their normals, that no triangle uses. The others keep their order.
void drop_unused(TriangleMesh& mesh);

}  // namespace tribo
