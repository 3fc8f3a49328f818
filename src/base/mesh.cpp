// SPDX-License-Identifier: MIT
#include "base/mesh.hpp"

#include <algorithm>
#include <bit>
#include <compare>
#include <utility>

namespace tribo {
namespace {

struct KeyedVertex {
    std::array<std::uint32_t, 3> bits;
    std::uint32_t index;
    auto operator<=>(const KeyedVertex&) const = default;
};

std::uint32_t bits_of(float value) {
    return std::bit_cast<std::uint32_t>(value == 0 ? 0.0F : value);
}

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

// Returns the edges sorted; reversed if `turned`.
std::vector<DirectedEdge> directed_edges(const TriangleMesh& mesh, bool turned) {
    std::vector<DirectedEdge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            edges.push_back(turned ? DirectedEdge{b, a} : DirectedEdge{a, b});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace

Box3 bounds(const TriangleMesh& mesh) {
    Box3 box;
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) box.include(mesh.position(i));
    return box;
}

double area_mm2(const TriangleMesh& mesh) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.position(t[0]);
        sum += length(cross(mesh.position(t[1]) - a, mesh.position(t[2]) - a));
    }
    return 0.5 * sum;
}

double volume_mm3(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) return 0;
    const Vec3 origin = mesh.position(0);  // near the mesh, so that the sum does not cancel
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        sum += dot(mesh.position(t[0]) - origin,
                   cross(mesh.position(t[1]) - origin, mesh.position(t[2]) - origin));
    }
    return sum / 6;
}

bool is_closed(const TriangleMesh& mesh) {
    const std::vector<DirectedEdge> edges = directed_edges(mesh, false);
    return !edges.empty() && edges == directed_edges(mesh, true) &&
           std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

bool is_watertight(const TriangleMesh& mesh) {
    return !mesh.triangles.empty() && directed_edges(mesh, false) == directed_edges(mesh, true);
}

void weld_exactly(TriangleMesh& mesh) {
    std::vector<KeyedVertex> sorted(mesh.positions.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) {
        const Point3f& p = mesh.positions[i];
        sorted[i] = {{bits_of(p[0]), bits_of(p[1]), bits_of(p[2])}, i};
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> first(mesh.positions.size());
    for (std::size_t i = 0, group = 0; i < sorted.size(); ++i) {
        if (sorted[i].bits != sorted[group].bits) group = i;
        first[sorted[i].index] = sorted[group].index;
    }
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = first[corner];
    }
    mesh.normals.clear();
}

void drop_unused(TriangleMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) used[v] = true;
    }
    std::vector<std::uint32_t> renamed(used.size());
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v) {
        renamed[v] = kept;
        if (!used[v]) continue;
        mesh.positions[kept] = mesh.positions[v];
        if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[v];
        ++kept;
    }
    mesh.positions.resize(kept);
    if (!mesh.normals.empty()) mesh.normals.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) v = renamed[v];
    }
}

}  // namespace tribo
