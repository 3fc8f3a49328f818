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
// A block has 32 cells along each axis. Blocks of the next round begin so many cells farther on.
constexpr int kBlockBits = 5, kBlockCells = 1 << kBlockBits, kShiftCells = 8;
// Within so many cells of the border of a block some changes are not possible.
constexpr int kBorderCells = 4;
// For each vertex that may be added.
constexpr std::size_t kTrianglesPerVertex = 2;
// A cell with more triangles is left as it is: each change there would be compared with all of them.
constexpr std::size_t kMostInCell = 400;
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

std::uint64_t key_of(const std::array<int, 3>& cell) {
    std::uint64_t key = 0;
    for (const int at : cell) key = key << kCellBits | (static_cast<std::uint64_t>(at) + kCellsAround);
    return key;
}

// The block that holds a cell, with borders `shift` cells before the multiples of its size.
std::uint64_t block_of(std::uint64_t cell, int shift) {
    constexpr std::uint64_t kEach = (std::uint64_t{1} << 2 * kCellBits) + (std::uint64_t{1} << kCellBits) + 1;
    constexpr std::uint64_t kAlong = ((std::uint64_t{1} << kCellBits) - 1) & ~std::uint64_t{kBlockCells - 1};
    return (cell + static_cast<std::uint64_t>(shift) * kEach) & (kAlong * kEach);
}

}  // namespace

GuardedMesh::GuardedMesh(TriangleMesh& mesh, std::span<const std::uint32_t> vertices, double cell_mm,
                         std::size_t most_new)
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
    const auto add = [](auto& items, std::vector<std::uint32_t>& free, std::size_t count) {
        for (std::size_t n = count; n-- > 0;) free.push_back(static_cast<std::uint32_t>(items.size() + n));
        items.resize(items.size() + count);
    };
    add(mesh.positions, free_vertices_, most_new);
    add(mesh.triangles, free_triangles_, kTrianglesPerVertex * most_new);
}

// Most triangles of a mesh are far from all known cells. Blocks of cells tell it sooner.
void GuardedMesh::enter_all() {
    std::vector<std::uint64_t> blocks;
    for (const std::uint64_t cell : cells_) {
        if (blocks.empty() || blocks.back() != block_of(cell, 0)) blocks.push_back(block_of(cell, 0));
    }
    sort_unique(blocks);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        std::uint64_t last = ~std::uint64_t{0};
        const bool is_far = each_cell(corners(t), [&](std::uint64_t cell) {
            const std::uint64_t block = block_of(cell, 0);
            if (block == last) return true;
            last = block;
            return !std::binary_search(blocks.begin(), blocks.end(), block);
        });
        if (is_far) continue;
        each_cell(corners(t), [&](std::uint64_t cell) {
            if (std::vector<std::uint32_t>* list = list_of(cell)) list->push_back(t);
            return true;
        });
    }
}

std::vector<MeshBlock> GuardedMesh::blocks(std::span<const std::uint32_t> vertices, int round) {
    const int shift = round * kShiftCells % kBlockCells;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> placed;
    for (const std::uint32_t v : vertices)
        placed.emplace_back(block_of(key_of(cell_of(mesh_.position(v))), shift), v);
    std::sort(placed.begin(), placed.end());
    std::vector<MeshBlock> blocks;
    for (const auto& [key, v] : placed) {
        if (blocks.empty() || blocks.back().key_ != key) blocks.push_back(MeshBlock(*this, key, shift));
        blocks.back().vertices_.push_back(v);
    }
    const std::size_t most_vertices = free_vertices_.size(), most_triangles = free_triangles_.size();
    const auto hand_out = [](std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to,
                             std::size_t count) {
        to.assign(from.end() - static_cast<std::ptrdiff_t>(count), from.end());
        from.resize(from.size() - count);
    };
    for (MeshBlock& block : blocks) {
        const std::size_t count = block.vertices_.size();
        hand_out(free_vertices_, block.free_vertices_, most_vertices * count / vertices.size());
        hand_out(free_triangles_, block.free_triangles_, most_triangles * count / vertices.size());
    }
    return blocks;
}

void GuardedMesh::take_back(std::span<MeshBlock> blocks) {
    for (const MeshBlock& block : blocks) {
        free_vertices_.insert(free_vertices_.end(), block.free_vertices_.begin(), block.free_vertices_.end());
        free_triangles_.insert(free_triangles_.end(), block.free_triangles_.begin(),
                               block.free_triangles_.end());
    }
}

std::vector<std::uint32_t>* GuardedMesh::list_of(std::uint64_t cell) {
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), cell);
    return at != cells_.end() && *at == cell ? &lists_[static_cast<std::size_t>(at - cells_.begin())]
                                             : nullptr;
}

GuardedMesh::CellAt GuardedMesh::cell_of(Vec3 p) const {
    const Vec3 q = (p - origin_) / cell_mm_;
    return {static_cast<int>(std::floor(q.x)), static_cast<int>(std::floor(q.y)),
            static_cast<int>(std::floor(q.z))};
}

template <class Visit>
bool GuardedMesh::each_cell(const Corners& c, Visit&& visit) const {
    const Box3 box = box_of(c);
    const CellAt low = cell_of(box.min), high = cell_of(box.max);
    for (int k = low[2]; k <= high[2]; ++k) {
        for (int j = low[1]; j <= high[1]; ++j) {
            for (int i = low[0]; i <= high[0]; ++i) {
                if (!visit(key_of({i, j, k}))) return false;
            }
        }
    }
    return true;
}

void GuardedMesh::drop_unused() {
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return is_degenerate(t); });
    tribo::drop_unused(mesh_);
}

std::vector<std::uint32_t>* MeshBlock::list_of(std::uint64_t cell) const {
    return block_of(cell, shift_) == key_ ? guarded_->list_of(cell) : nullptr;
}

const std::vector<std::uint32_t>* MeshBlock::list_of(Vec3 p) const {
    return list_of(key_of(guarded_->cell_of(p)));
}

bool MeshBlock::is_near_border(std::uint32_t v) const {
    const GuardedMesh::CellAt cell = guarded_->cell_of(position(v));
    return std::any_of(cell.begin(), cell.end(), [&](int at) {
        const int within = (at + static_cast<int>(kCellsAround) + shift_) % kBlockCells;
        return within < kBorderCells || within >= kBlockCells - kBorderCells;
    });
}

bool MeshBlock::contains(std::uint32_t triangle) const {
    return guarded_->each_cell(corners(triangle),
                               [&](std::uint64_t cell) { return list_of(cell) != nullptr; });
}

void MeshBlock::enter(std::uint32_t triangle) {
    guarded_->each_cell(corners(triangle), [&](std::uint64_t cell) {
        list_of(cell)->push_back(triangle);
        return true;
    });
}

void MeshBlock::leave(std::uint32_t triangle) {
    guarded_->each_cell(corners(triangle), [&](std::uint64_t cell) {
        std::erase(*list_of(cell), triangle);
        return true;
    });
}

std::vector<std::uint32_t> MeshBlock::around(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    const std::vector<std::uint32_t>* near = list_of(position(v));
    if (!near) return found;
    for (const std::uint32_t t : *near) {
        const Triangle& of = triangle(t);
        if (of[0] == v || of[1] == v || of[2] == v) found.push_back(t);
    }
    return found;
}

// The other vertices of the triangles around a vertex, once for each of these, sorted.
std::vector<std::uint32_t> MeshBlock::others_around(std::uint32_t v) const {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t t : around(v)) {
        for (const std::uint32_t w : triangle(t)) {
            if (w != v) others.push_back(w);
        }
    }
    std::sort(others.begin(), others.end());
    return others;
}

std::vector<std::uint32_t> MeshBlock::beside(std::uint32_t v) const {
    std::vector<std::uint32_t> others = others_around(v);
    sort_unique(others);
    return others;
}

bool MeshBlock::has_ring(std::uint32_t v) const {
    const std::vector<std::uint32_t> others = others_around(v);
    for (std::size_t n = 0; n < others.size(); n += 2) {
        if (n + 1 == others.size() || others[n] != others[n + 1] || (n > 0 && others[n] == others[n - 1]))
            return false;
    }
    return true;
}

std::vector<std::uint32_t> MeshBlock::at_edge(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> along, against;
    for (const std::uint32_t t : around(knows(a) ? a : b)) {
        const Triangle& of = triangle(t);
        for (std::size_t k = 0; k < 3; ++k) {
            if (of[k] == a && of[(k + 1) % 3] == b) along.push_back(t);
            if (of[k] == b && of[(k + 1) % 3] == a) against.push_back(t);
        }
    }
    along.insert(along.end(), against.begin(), against.end());
    return along;
}

std::vector<Facet> MeshBlock::facets(const MeshChange& change) const {
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

bool MeshBlock::is_free(const MeshChange& change, std::span<const Facet> facets) const {
    if (!std::all_of(change.old.begin(), change.old.end(), [&](std::uint32_t t) { return contains(t); }))
        return false;
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
               !surely_apart(facets[n], {triangle(t), c});
    };
    for (std::size_t n = 0; n < facets.size(); ++n) {
        const bool free = guarded_->each_cell(facets[n].at, [&](std::uint64_t cell) {
            const std::vector<std::uint32_t>* near = list_of(cell);
            return near && near->size() <= kMostInCell &&
                   std::none_of(near->begin(), near->end(), [&](std::uint32_t t) { return meets(n, t); });
        });
        if (!free) return false;
    }
    return true;
}

std::vector<std::uint32_t> MeshBlock::make(const MeshChange& change) {
    TriangleMesh& mesh = guarded_->mesh_;
    std::vector<std::uint32_t> made;
    for (const std::uint32_t t : change.old) {
        leave(t);
        mesh.triangles[t] = kGone;
        free_triangles_.push_back(t);
    }
    for (const MeshChange::Place& place : change.places) {
        if (has_new_vertex() && place.vertex == new_vertex()) free_vertices_.pop_back();
        mesh.positions[place.vertex] = place.at;
    }
    for (const Triangle& now : change.now) {
        const std::uint32_t t = free_triangles_.back();
        free_triangles_.pop_back();
        mesh.triangles[t] = now;
        enter(t);
        made.push_back(t);
    }
    return made;
}

}  // namespace tribo::field
