// SPDX-License-Identifier: MIT
#include "field/mesh/mesh_surfaces.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/groups.hpp"
#include "field/mesh/mesh_parts.hpp"
#include "field/mesh/triangles_apart.hpp"

namespace tribo::field {
namespace {

// Of more triangles at one edge only the first are connected: their pairs are tested.
constexpr std::size_t kMostAtEdge = 64;

// A triangle by its vertices in rising order, and whether it goes round them that way.
struct Known {
    std::array<std::uint32_t, 3> vertices;
    bool rising;
    std::uint32_t triangle;
    auto key() const { return std::tie(vertices, rising, triangle); }
};

std::vector<Known> in_order(const TriangleMesh& mesh) {
    std::vector<Known> all;
    all.reserve(mesh.triangles.size());
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        Triangle t = mesh.triangles[n];
        std::ranges::rotate(t, std::ranges::min_element(t));
        const bool rising = t[1] < t[2];
        if (!rising) std::swap(t[1], t[2]);
        all.push_back({t, rising, n});
    }
    std::ranges::sort(all, {}, &Known::key);
    return all;
}

void keep(TriangleMesh& mesh, const std::vector<bool>& kept) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        if (kept[n]) mesh.triangles[count++] = mesh.triangles[n];
    }
    mesh.triangles.resize(count);
}

// An edge of a triangle, by its ends in rising order.
struct Side {
    std::uint32_t low, high;
    bool forward;
    std::uint32_t triangle, edge;
    auto ends() const { return std::tie(low, high); }
    auto key() const { return std::tie(low, high, triangle, edge); }
};

std::vector<Side> sides_of(const TriangleMesh& mesh) {
    std::vector<Side> all;
    all.reserve(3 * mesh.triangles.size());
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        for (std::uint32_t e = 0; e < 3; ++e) {
            const std::uint32_t a = mesh.triangles[n][e], b = mesh.triangles[n][(e + 1) % 3];
            all.push_back({std::min(a, b), std::max(a, b), a < b, n, e});
        }
    }
    std::ranges::sort(all, {}, &Side::key);
    return all;
}

bool are_equal(const Known& a, const Known& b) {
    return a.vertices == b.vertices && a.rising == b.rising;
}

// Turns closed bodies that are inside out and share a triangle with another: it is there twice with one side,
// which two bodies with their fronts outside cannot have.
void turn_neighbours(TriangleMesh& mesh, const std::vector<Known>& all) {
    TriangleMesh parted = mesh;
    part_at_crowded_edges(parted);
    std::size_t count = 0;
    const std::vector<std::uint32_t> body_of_vertex = components_of(parted, count);
    const auto body_of = [&](std::size_t triangle) { return body_of_vertex[parted.triangles[triangle][0]]; };
    std::vector<bool> shares(count), turns(count);
    for (std::size_t n = 1; n < all.size(); ++n)
        if (are_equal(all[n - 1], all[n]))
            shares[body_of(all[n - 1].triangle)] = shares[body_of(all[n].triangle)] = true;
    std::vector<TriangleMesh> bodies(count);
    for (std::size_t n = 0; n < parted.triangles.size(); ++n)
        if (shares[body_of(n)]) bodies[body_of(n)].triangles.push_back(parted.triangles[n]);
    for (std::size_t n = 0; n < count; ++n) {
        if (!is_watertight(bodies[n])) continue;
        std::swap(bodies[n].positions, parted.positions);
        turns[n] = volume_mm3(bodies[n]) < 0;
        std::swap(bodies[n].positions, parted.positions);
    }
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
        if (turns[body_of(n)]) std::swap(mesh.triangles[n][1], mesh.triangles[n][2]);
}

}  // namespace

bool drop_twins(TriangleMesh& mesh) {
    std::vector<Known> all = in_order(mesh);
    if (std::ranges::adjacent_find(all, are_equal) != all.end()) {
        turn_neighbours(mesh, all);
        all = in_order(mesh);
    }
    std::vector<bool> one(mesh.triangles.size()), rest(mesh.triangles.size());
    bool any = false;
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        bool falling = false, rising = false;
        for (; end < all.size() && all[end].vertices == all[first].vertices; ++end)
            (all[end].rising ? rising : falling) = true;
        one[all[first].triangle] = true;
        rest[all[first].triangle] = !(falling && rising);
        any = any || (falling && rising);
    }
    if (any) {
        TriangleMesh open = mesh;
        keep(open, rest);
        if (!open.triangles.empty() && is_watertight(open)) {
            mesh = std::move(open);
            return false;
        }
    }
    keep(mesh, one);
    return any;
}

void part_at_crowded_edges(TriangleMesh& mesh) {
    const std::vector<Side> all = sides_of(mesh);
    // The corners of triangles, 3 n + k, that are one vertex.
    Groups same(3 * mesh.triangles.size());
    const auto corner_at = [&](const Side& s, std::uint32_t vertex) {
        return 3 * s.triangle + (mesh.triangles[s.triangle][s.edge] == vertex ? s.edge : (s.edge + 1) % 3);
    };
    const auto connect = [&](const Side& a, const Side& b) {
        for (const std::uint32_t vertex : {a.low, a.high}) {
            same.join(corner_at(a, vertex), corner_at(b, vertex));
        }
    };
    const auto normal = [&](const Side& s) {
        return normalized(twice_area(corners(mesh, mesh.triangles[s.triangle])), Vec3{});
    };
    bool crowded = false;
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        while (end < all.size() && all[end].ends() == all[first].ends()) ++end;
        if (end - first == 2) connect(all[first], all[first + 1]);
        if (end - first <= 2) continue;
        crowded = true;
        struct Pair {
            double bend;
            std::size_t a, b;
            auto key() const { return std::tie(bend, a, b); }
        };
        std::vector<Pair> pairs;
        const std::size_t last = std::min(end, first + kMostAtEdge);
        for (std::size_t a = first; a < last; ++a) {
            for (std::size_t b = a + 1; b < last; ++b) {
                if (all[a].forward != all[b].forward)
                    pairs.push_back({-dot(normal(all[a]), normal(all[b])), a, b});
            }
        }
        std::ranges::sort(pairs, {}, &Pair::key);
        std::vector<bool> taken(end - first);
        for (const Pair& pair : pairs) {
            if (taken[pair.a - first] || taken[pair.b - first]) continue;
            taken[pair.a - first] = taken[pair.b - first] = true;
            connect(all[pair.a], all[pair.b]);
        }
    }
    if (!crowded) return;
    TriangleMesh parted;
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    std::vector<std::uint32_t> number(same.size(), kNone);
    for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) {
        Triangle t;
        for (std::uint32_t k = 0; k < 3; ++k) {
            std::uint32_t& vertex = number[same.of(3 * n + k)];
            if (vertex == kNone) {
                vertex = static_cast<std::uint32_t>(parted.positions.size());
                parted.positions.push_back(mesh.positions[mesh.triangles[n][k]]);
            }
            t[k] = vertex;
        }
        parted.triangles.push_back(t);
    }
    mesh = std::move(parted);
}

}  // namespace tribo::field
