// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_normals.hpp"

#include <algorithm>

#include "base/math.hpp"

namespace tribo::field {
namespace {

struct Edge {
    std::uint32_t low, high;
    std::uint32_t number;  // 4 triangle + i
    bool forward;          // runs from low to high in its triangle
    bool operator<(const Edge& o) const {
        return low != o.low ? low < o.low : high != o.high ? high < o.high : number < o.number;
    }
};

std::uint32_t next(std::uint32_t i) {
    return i == 2 ? 0 : i + 1;
}

}  // namespace

MeshNormals::MeshNormals(const TriangleMesh& mesh) {
    find_neighbours(mesh);
    find_face_normals(mesh);
    bridge_flat_triangles(mesh);
    find_corner_normals(mesh);
}

void MeshNormals::find_neighbours(const TriangleMesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][next(i)];
            edges.push_back({std::min(a, b), std::max(a, b), 4 * t + i, a < b});
        }
    }
    std::sort(edges.begin(), edges.end());
    neighbours_.assign(mesh.triangles.size(), {kNone, kNone, kNone});
    border_corners_.assign(mesh.positions.size(), false);
    std::uint32_t first_border = kNone;
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high)
            ++end;
        if (end - i == 2) {
            const Edge &a = edges[i], &b = edges[i + 1];
            neighbours_[a.number / 4][a.number % 4] = b.number;
            neighbours_[b.number / 4][b.number % 4] = a.number;
            turned_edges_ += a.forward == b.forward;
        } else {
            ++border_edges_;
            border_corners_[edges[i].low] = border_corners_[edges[i].high] = true;
            first_border = std::min(first_border, edges[i].number);
        }
    }
    if (first_border == kNone) return;
    const Triangle& t = mesh.triangles[first_border / 4];
    const std::uint32_t i = first_border % 4;
    first_border_ = 0.5 * (mesh.position(t[i]) + mesh.position(t[next(i)]));
}

void MeshNormals::find_face_normals(const TriangleMesh& mesh) {
    faces_.reserve(mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        const Vec3 a = mesh.position(t[0]);
        faces_.push_back(normalized(cross(mesh.position(t[1]) - a, mesh.position(t[2]) - a), {}));
        if (faces_.back() == Vec3{}) flat_.push_back(i);
    }
}

void MeshNormals::bridge_flat_triangles(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> takes_from(flat_.size(), kNone);
    for (std::size_t f = 0; f < flat_.size(); ++f) {
        const std::uint32_t t = flat_[f];
        const Triangle& corners = mesh.triangles[t];
        std::uint32_t longest = 0;
        double longest_mm2 = -1;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const double mm2 = squared_length(mesh.position(corners[next(i)]) - mesh.position(corners[i]));
            if (mm2 > longest_mm2) {
                longest_mm2 = mm2;
                longest = i;
            }
        }
        const std::uint32_t across = neighbours_[t][longest];
        if (across == kNone) continue;
        takes_from[f] = across / 4;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t other = neighbours_[t][i];
            if (i == longest || other == kNone) continue;
            neighbours_[other / 4][other % 4] = across;
            neighbours_[across / 4][across % 4] = other;
        }
    }
    // A flat triangle may take its normal from another flat one: as many rounds as the length of such chains,
    // at most eight.
    for (int round = 0; round < 8; ++round) {
        for (std::size_t f = 0; f < flat_.size(); ++f) {
            if (takes_from[f] != kNone && faces_[flat_[f]] == Vec3{})
                faces_[flat_[f]] = faces_[takes_from[f]];
        }
    }
}

void MeshNormals::find_corner_normals(const TriangleMesh& mesh) {
    corners_.assign(mesh.positions.size(), {});
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const Triangle& t = mesh.triangles[n];
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Vec3 at = mesh.position(t[i]);
            const Vec3 u = mesh.position(t[next(i)]) - at, v = mesh.position(t[next(next(i))]) - at;
            corners_[t[i]] += math::atan2(length(cross(u, v)), dot(u, v)) * faces_[n];
        }
    }
    for (Vec3& normal : corners_) normal = normalized(normal, {});
}

Vec3 MeshNormals::at(const TriangleMesh& mesh, std::uint32_t triangle, TrianglePlace place) const {
    switch (place) {
        case TrianglePlace::face:
            return faces_[triangle];
        case TrianglePlace::edge0:
        case TrianglePlace::edge1:
        case TrianglePlace::edge2: {
            const auto i = static_cast<std::size_t>(place) - static_cast<std::size_t>(TrianglePlace::edge0);
            const std::uint32_t other = neighbours_[triangle][i];
            if (other == kNone) return faces_[triangle];
            return normalized(faces_[triangle] + faces_[other / 4], {});
        }
        default: {
            const auto i = static_cast<std::size_t>(place) - static_cast<std::size_t>(TrianglePlace::corner0);
            return corners_[mesh.triangles[triangle][i]];
        }
    }
}

bool MeshNormals::is_border(const TriangleMesh& mesh, std::uint32_t triangle, TrianglePlace place) const {
    if (place == TrianglePlace::face) return false;
    if (place >= TrianglePlace::corner0) {
        const auto i = static_cast<std::size_t>(place) - static_cast<std::size_t>(TrianglePlace::corner0);
        return border_corners_[mesh.triangles[triangle][i]];
    }
    const auto i = static_cast<std::size_t>(place) - static_cast<std::size_t>(TrianglePlace::edge0);
    return neighbours_[triangle][i] == kNone;
}

}  // namespace tribo::field
