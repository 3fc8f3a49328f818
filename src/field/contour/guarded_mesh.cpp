// SPDX-License-Identifier: MIT
#include "field/contour/guarded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sort_unique.hpp"

namespace tribo::field {
namespace {

// The cells around the triangles at a vertex in which all is known.
constexpr std::uint64_t kCellsAround = 1;
// Of the number of a cell along each axis.
constexpr int kCellBits = 21;
// A cell with more triangles is left as it is: each change there would be compared with all of them.
constexpr std::size_t kMostInCell = 200;
// A triangle is at least this wide, mm: rounding decides which way a thinner one faces.
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
        each_cell(field::corners(mesh, t), [&](std::uint64_t cell) {
            cells_.push_back(cell);
            return true;
        });
    }
    sort_unique(cells_);
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t step = std::uint64_t{1} << (kCellBits * axis);
        for (std::size_t n = 0, count = cells_.size(); n < count; ++n) {
            const std::uint64_t cell = cells_[n];
            for (std::uint64_t k = 1; k <= kCellsAround; ++k)
                cells_.insert(cells_.end(), {cell - k * step, cell + k * step});
        }
        sort_unique(cells_);
    }
    lists_.resize(cells_.size());
    enter_all();
}

// Most triangles of a mesh are far from all known cells. Blocks of cells tell it sooner.
void GuardedMesh::enter_all() {
    constexpr int kBlockBits = 3;
    const auto block_of = [](std::uint64_t cell) {
        constexpr std::uint64_t kAlong = ((std::uint64_t{1} << (kCellBits - kBlockBits)) - 1) << kBlockBits;
        return cell & (kAlong | kAlong << kCellBits | kAlong << 2 * kCellBits);
    };
    std::vector<std::uint64_t> blocks;
    for (const std::uint64_t cell : cells_) {
        if (blocks.empty() || blocks.back() != block_of(cell)) blocks.push_back(block_of(cell));
    }
    sort_unique(blocks);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        std::uint64_t last = ~std::uint64_t{0};
        const bool is_far = each_cell(corners(t), [&](std::uint64_t cell) {
            const std::uint64_t block = block_of(cell);
            if (block == last) return true;
            last = block;
            return !std::binary_search(blocks.begin(), blocks.end(), block);
        });
        if (!is_far) enter(t);
    }
}

const std::vector<std::uint32_t>* GuardedMesh::list_of(std::uint64_t cell) const {
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), cell);
    return at != cells_.end() && *at == cell ? &lists_[static_cast<std::size_t>(at - cells_.begin())]
                                             : nullptr;
}

std::vector<std::uint32_t>* GuardedMesh::list_of(std::uint64_t cell) {
    return const_cast<std::vector<std::uint32_t>*>(std::as_const(*this).list_of(cell));
}

GuardedMesh::CellAt GuardedMesh::cell_of(Vec3 p) const {
    const Vec3 q = (p - origin_) / cell_mm_;
    return {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
            static_cast<int>(std::floor(q.z))};
}

std::uint64_t GuardedMesh::key(const CellAt& cell) {
    std::uint64_t key = 0;
    for (const int at : cell) key = key << kCellBits | (static_cast<std::uint64_t>(at) + kCellsAround);
    return key;
}

template <class Visit>
bool GuardedMesh::each_cell(const Corners& c, Visit&& visit) const {
    const Box3 box = box_of(c);
    const CellAt low = cell_of(box.min), high = cell_of(box.max);
    for (int k = low[2]; k <= high[2]; ++k) {
        for (int j = low[1]; j <= high[1]; ++j) {
            for (int i = low[0]; i <= high[0]; ++i) {
                if (!visit(key({i, j, k}))) return false;
            }
        }
    }
    return true;
}

void GuardedMesh::enter(std::uint32_t triangle) {
    each_cell(corners(triangle), [&](std::uint64_t cell) {
        if (std::vector<std::uint32_t>* list = list_of(cell)) list->push_back(triangle);
        return true;
    });
}

void GuardedMesh::leave(std::uint32_t triangle) {
    each_cell(corners(triangle), [&](std::uint64_t cell) {
        if (std::vector<std::uint32_t>* list = list_of(cell)) std::erase(*list, triangle);
        return true;
    });
}

std::vector<std::uint32_t> GuardedMesh::around(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    const std::vector<std::uint32_t>* near = list_of(key(cell_of(position(v))));
    if (!near) return found;
    for (const std::uint32_t t : *near) {
        const Triangle& of = mesh_.triangles[t];
        if (of[0] == v || of[1] == v || of[2] == v) found.push_back(t);
    }
    return found;
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
        const bool free = each_cell(facets[n].at, [&](std::uint64_t cell) {
            const std::vector<std::uint32_t>* near = list_of(cell);
            return near && near->size() <= kMostInCell &&
                   std::none_of(near->begin(), near->end(), [&](std::uint32_t t) { return meets(n, t); });
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
