// SPDX-License-Identifier: MIT
#include "field/contour/guarded_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/sort_unique.hpp"

namespace tribo::field {
namespace {

// The cells around the triangles at a vertex in which all is known.
constexpr int kCellsAround = 2;
// A triangle is at least this wide, mm: readers drop thinner ones.
constexpr double kLeastWidthMm = 1e-5;

double width_mm(const Corners& c) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, squared_length(c[(k + 1) % 3] - c[k]));
    return longest > 0 ? length(twice_area(c)) / std::sqrt(longest) : 0;
}

Box3 box_of(const Corners& c) {
    Box3 box;
    for (const Vec3& p : c) box.include(p);
    return box;
}

// A triangle that was replaced uses one vertex only.
constexpr Triangle kGone{0, 0, 0};

}  // namespace

GuardedMesh::GuardedMesh(TriangleMesh& mesh, std::span<const std::uint32_t> vertices, double cell_mm)
    : mesh_(mesh), origin_(bounds(mesh).min), cell_mm_(cell_mm) {
    std::vector<bool> asked(mesh.positions.size(), false);
    for (const std::uint32_t v : vertices) asked[v] = true;
    for (const Triangle& t : mesh.triangles) {
        if (std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return asked[v]; })) continue;
        each_cell(field::corners(mesh, t), kCellsAround, [&](std::uint64_t cell) {
            cells_.try_emplace(cell);
            return true;
        });
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const bool outside =
            each_cell(corners(t), 0, [&](std::uint64_t cell) { return !cells_.contains(cell); });
        if (!outside) enter(t);
    }
}

GuardedMesh::CellAt GuardedMesh::cell_of(Vec3 p) const {
    const Vec3 q = (p - origin_) / cell_mm_;
    return {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
            static_cast<int>(std::floor(q.z))};
}

std::uint64_t GuardedMesh::key(const CellAt& cell) {
    constexpr int kBits = 21;
    std::uint64_t key = 0;
    for (const int at : cell) key = key << kBits | static_cast<std::uint64_t>(at + kCellsAround);
    return key;
}

template <class Visit>
bool GuardedMesh::each_cell(const Corners& c, int more, Visit&& visit) const {
    const Box3 box = box_of(c);
    const CellAt low = cell_of(box.min), high = cell_of(box.max);
    for (int k = low[2] - more; k <= high[2] + more; ++k) {
        for (int j = low[1] - more; j <= high[1] + more; ++j) {
            for (int i = low[0] - more; i <= high[0] + more; ++i) {
                if (!visit(key({i, j, k}))) return false;
            }
        }
    }
    return true;
}

void GuardedMesh::enter(std::uint32_t triangle) {
    each_cell(corners(triangle), 0, [&](std::uint64_t cell) {
        if (const auto at = cells_.find(cell); at != cells_.end()) at->second.push_back(triangle);
        return true;
    });
    for (const std::uint32_t v : mesh_.triangles[triangle]) around_[v].push_back(triangle);
}

void GuardedMesh::leave(std::uint32_t triangle) {
    each_cell(corners(triangle), 0, [&](std::uint64_t cell) {
        if (const auto at = cells_.find(cell); at != cells_.end()) std::erase(at->second, triangle);
        return true;
    });
    for (const std::uint32_t v : mesh_.triangles[triangle]) std::erase(around_[v], triangle);
}

const std::vector<std::uint32_t>& GuardedMesh::around(std::uint32_t v) const {
    static const std::vector<std::uint32_t> kNone;
    const auto at = around_.find(v);
    return at == around_.end() ? kNone : at->second;
}

// The other vertices of the triangles around a vertex, once for each of these, sorted.
std::vector<std::uint32_t> GuardedMesh::others_around(std::uint32_t v) const {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : around(v)) {
        for (const std::uint32_t w : mesh_.triangles[t]) {
            if (w != v) others.push_back(w);
        }
    }
    std::sort(others.begin(), others.end());
    return others;
}

std::vector<std::uint32_t> GuardedMesh::beside(std::uint32_t v) const {
    std::vector<std::uint32_t> others = others_around(v);
    sort_unique(others);
    return others;
}

bool GuardedMesh::has_ring(std::uint32_t v) const {
    const std::vector<std::uint32_t> others = others_around(v);
    for (std::size_t n = 0; n < others.size(); n += 2) {
        if (n + 1 == others.size() || others[n] != others[n + 1] || (n > 0 && others[n] == others[n - 1]))
            return false;
    }
    return true;
}

std::vector<std::uint32_t> GuardedMesh::at_edge(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> along, against;
    for (const std::uint32_t t : around(knows(a) ? a : b)) {
        const Triangle& of = mesh_.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            if (of[k] == a && of[(k + 1) % 3] == b) along.push_back(t);
            if (of[k] == b && of[(k + 1) % 3] == a) against.push_back(t);
        }
    }
    along.insert(along.end(), against.begin(), against.end());
    return along;
}

std::vector<Facet> GuardedMesh::facets(const MeshChange& change) const {
    std::vector<Facet> facets;
    for (const Triangle& t : change.now) {
        Facet f{t, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto moved =
                std::find_if(change.places.begin(), change.places.end(),
                             [&](const MeshChange::Place& place) { return place.vertex == t[k]; });
            f.at[k] = moved == change.places.end() ? position(t[k])
                                                   : Vec3{moved->at[0], moved->at[1], moved->at[2]};
        }
        facets.push_back(f);
    }
    return facets;
}

bool GuardedMesh::is_free(const MeshChange& change, std::span<const Facet> facets) const {
    std::vector<Box3> boxes;
    for (const Facet& f : facets) {
        if (width_mm(f.at) < kLeastWidthMm) return false;
        boxes.push_back(box_of(f.at).inflated(kLeastWidthMm));
    }
    for (std::size_t n = 0; n < facets.size(); ++n) {
        for (std::size_t m = 0; m < n; ++m) {
            if (!surely_apart(facets[n], facets[m])) return false;
        }
    }
    // A triangle that reaches several cells is looked at in each: few boxes overlap, so that this costs
    // little.
    const auto meets = [&](std::size_t n, std::uint32_t t) {
        const Corners c = corners(t);
        return boxes[n].overlaps(box_of(c)) &&
               std::find(change.old.begin(), change.old.end(), t) == change.old.end() &&
               !surely_apart(facets[n], {mesh_.triangles[t], c});
    };
    for (std::size_t n = 0; n < facets.size(); ++n) {
        const bool free = each_cell(facets[n].at, 0, [&](std::uint64_t cell) {
            const auto at = cells_.find(cell);
            return at != cells_.end() && std::none_of(at->second.begin(), at->second.end(),
                                                      [&](std::uint32_t t) { return meets(n, t); });
        });
        if (!free) return false;
    }
    return true;
}

std::vector<std::uint32_t> GuardedMesh::make(const MeshChange& change) {
    std::vector<std::uint32_t> made;
    for (const std::uint32_t t : change.old) leave(t);
    for (const MeshChange::Place& place : change.places) {
        if (place.vertex == mesh_.positions.size()) mesh_.positions.emplace_back();
        mesh_.positions[place.vertex] = place.at;
    }
    for (std::size_t n = 0; n < change.now.size(); ++n) {
        const bool reuses = n < change.old.size();
        const auto t = reuses ? change.old[n] : static_cast<std::uint32_t>(mesh_.triangles.size());
        if (!reuses) mesh_.triangles.emplace_back();
        mesh_.triangles[t] = change.now[n];
        enter(t);
        made.push_back(t);
    }
    for (std::size_t n = change.now.size(); n < change.old.size(); ++n)
        mesh_.triangles[change.old[n]] = kGone;
    return made;
}

void GuardedMesh::drop_replaced() {
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return is_degenerate(t); });
    drop_unused(mesh_);
}

}  // namespace tribo::field
