// SPDX-License-Identifier: MIT
// Meshes of known solids.
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "base/mesh.hpp"

namespace tribo::field::test {

inline TriangleMesh box_mesh(const Box3& box) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back(to_float(
            {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z}));
    }
    const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

// Inside out.
inline TriangleMesh turned(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

// An octahedron, each face cut in four `levels` times, its corners on the sphere: 8 * 4^levels triangles.
inline TriangleMesh sphere_mesh(Vec3 centre, double radius, int levels) {
    std::vector<Vec3> corners{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<Triangle> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(corners.size()));
            if (fresh) corners.push_back(normalized(corners[a] + corners[b]));
            return at->second;
        };
        std::vector<Triangle> finer;
        for (const Triangle& t : faces) {
            const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    TriangleMesh mesh;
    for (const Vec3 c : corners) mesh.positions.push_back(to_float(centre + radius * c));
    mesh.triangles = std::move(faces);
    return mesh;
}

// How often a mesh winds around a point: solid angles of its triangles seen from there, in full turns (van
// Oosterom and Strackee 1983).
inline double turns_about(const TriangleMesh& mesh, Vec3 p) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.position(t[0]) - p, b = mesh.position(t[1]) - p, c = mesh.position(t[2]) - p;
        const double la = length(a), lb = length(b), lc = length(c);
        sum += 2 * std::atan2(dot(a, cross(b, c)),
                              la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (4 * 3.14159265358979323846);
}

}  // namespace tribo::field::test
