// SPDX-License-Identifier: MIT
#include "field/carved/brick.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "field/carved/brick_kernels.hpp"

namespace tribo::field {
namespace {

// Surfaces at one node are the two sides of a wall if the cosine between their normals is below this.
constexpr float kOpposite = -0.7f;
// A list holds at most one shape for each node, and the shapes since it was pruned.
constexpr std::size_t kMostListed = kLatticeNodes + 16;

// Returns how full of material the cell around a node is, as in brick_kernels.inl.
float filled(float cells) {
    return std::clamp(0.5f - cells, 0.0f, 1.0f);
}

// Returns the share of all the cells around a node that belongs to the brick.
double share_of(int node) {
    double share = 1;
    for (const int at :
         {node % kLatticeEdge, node / kLatticeEdge % kLatticeEdge, node / (kLatticeEdge * kLatticeEdge)})
        share *= at == 0 || at == kBrickCells ? 0.5 : 1;
    return share;
}

// Returns the direction in which the values at nodes grow; its length has no meaning.
template <class Value>
std::array<float, 3> growth(const Value& value, int node) {
    std::array<float, 3> g{};
    const int at[3] = {node % kLatticeEdge, node / kLatticeEdge % kLatticeEdge,
                       node / (kLatticeEdge * kLatticeEdge)};
    int step = 1;
    for (std::size_t axis = 0; axis < 3; ++axis, step *= kLatticeEdge) {
        const bool low = at[axis] == 0, high = at[axis] == kBrickCells;
        const float rise = value(high ? node : node + step) - value(low ? node : node - step);
        g[axis] = low || high ? 2 * rise : rise;
    }
    return g;
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

void Winners::fill(std::uint16_t index) {
    high_.reset();
    low_.fill(static_cast<std::uint8_t>(index));
}

void Winners::make_room(std::size_t count) {
    if (count <= kUnlistedByte || high_) return;
    Bytes high;
    for (std::size_t n = 0; n < kLatticeNodes; ++n) high[n] = low_[n] == kUnlistedByte ? kUnlistedByte : 0;
    high_ = high;
}

void Winners::rename(std::span<const std::uint16_t> to, std::size_t count) {
    if (!high_) {
        std::array<std::uint8_t, kUnlistedByte + 1> byte;
        for (std::size_t n = 0; n < to.size(); ++n) byte[n] = static_cast<std::uint8_t>(to[n]);
        byte[kUnlistedByte] = kUnlistedByte;
        for (std::uint8_t& index : low_) index = byte[index];
        return;
    }
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const std::uint16_t old = (*this)[n], index = old == kUnlisted ? kUnlisted : to[old];
        low_[n] = static_cast<std::uint8_t>(index);
        (*high_)[n] = static_cast<std::uint8_t>(index >> 8);
    }
    if (count <= kUnlistedByte) high_.reset();
}

bool Winners::operator==(const Winners& other) const {
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        if ((*this)[n] != other[n]) return false;
    }
    return true;
}

// Between the two sides of a wall the remaining material is what both sides leave: 1 - (1 - a) - (1 - b) of a
// cell. It is at most what remained before, so that the same cut again removes nothing. Elsewhere the larger
// distance decides, as in the kernels.
void ThinWalls::find(const Brick& brick, const float* shape, float cell) {
    nodes_.clear();
    std::array<std::uint8_t, kLatticeNodes / 8> near_both;
    const bool any = brick_kernels().find_near_both(brick.steps.data(), shape, cell, near_both.data());
    if (!any && brick.thin.empty()) return;
    auto old = brick.thin.begin();
    const auto look = [&](int n, bool is_near) {
        const bool was_thin = old != brick.thin.end() && old->node == n;
        if (!is_near && !was_thin) return;
        const float missing = was_thin ? (old++)->missing_cells : 0;
        const float whole = filled(brick.cells(n)), before = whole - missing;
        const float left = filled(-shape[n] / cell);
        bool wall = false;
        if (is_near) {
            const std::array<float, 3> own = growth([&](int m) { return brick.cells(m); }, n),
                                       other = growth([&](int m) { return shape[m]; }, n);
            const float turn = -dot(own, other);
            wall = turn < 0 && turn * turn > kOpposite * kOpposite * dot(own, own) * dot(other, other);
        }
        if (!wall && !was_thin) return;
        const float after = std::min(before, wall ? std::max(0.0f, whole + left - 1) : left);
        nodes_.push_back({static_cast<std::uint16_t>(n), after, missing});
    };
    if (!any) {
        for (const Brick::Thin& t : brick.thin) look(t.node, false);
        return;
    }
    for (int row = 0; row < kLatticeNodes / 8; ++row) {
        const bool thin = old != brick.thin.end() && old->node / 8 == row;
        if (near_both[static_cast<std::size_t>(row)] == 0 && !thin) continue;
        for (int n = 0; n < 8; ++n)
            look(8 * row + n, (near_both[static_cast<std::size_t>(row)] >> n & 1) != 0);
    }
}

double ThinWalls::update(Brick& brick) const {
    if (nodes_.empty() && brick.thin.empty()) return 0;
    double removed = 0;
    brick.thin.clear();
    for (const Node& n : nodes_) {
        const float missing = std::max(0.0f, filled(brick.cells(n.node)) - n.filled);
        removed += share_of(n.node) * static_cast<double>(missing - n.missing);
        if (missing > 0) brick.thin.push_back({n.node, missing});
    }
    return removed;
}

void prune_shapes(Brick& brick, const float* newest_mm, float cell_mm, float tie_mm) {
    const std::size_t count = brick.shapes.size(), newest = count - 1;
    std::array<std::uint8_t, kLatticeNodes> marks;
    brick_kernels().mark_near(brick.steps.data(), newest_mm, cell_mm, tie_mm, marks.data());
    // The marks of all nodes at which a shape gives the distance; one more place for unlisted nodes. Without
    // branches at a node, because the shape there is hard to predict.
    std::array<std::uint8_t, kMostListed> use;
    assert(count < use.size());
    std::fill_n(use.begin(), count + 1, std::uint8_t{0});
    for (std::size_t row = 0; row < kLatticeNodes; row += kLatticeEdge) {
        std::uint64_t any;
        std::memcpy(&any, &marks[row], sizeof any);
        if (any == 0) continue;
        for (std::size_t n = row; n < row + kLatticeEdge; ++n)
            use[std::min<std::size_t>(brick.winner[n], count)] |= marks[n];
    }
    // Where the newest one gives no node near the surface, it cannot take the place of another one.
    const std::uint8_t needed = use[newest] != 0 ? kMarkAlone : kMarkAlone | kMarkNear;
    std::array<std::uint16_t, kMostListed> renamed;
    std::uint16_t kept = 0;
    for (std::size_t s = 0; s < count; ++s) {
        const bool keeps = s == newest ? use[s] != 0 : (use[s] & needed) != 0;
        if (keeps) brick.shapes[kept] = brick.shapes[s];
        renamed[s] = keeps ? kept++ : Brick::kUnlisted;
    }
    if (kept == count) return;
    brick.shapes.resize(kept);
    for (std::size_t s = 0; s < newest; ++s) {
        if (use[s] == kMarkNear) renamed[s] = renamed[newest];
    }
    brick.winner.rename({renamed.data(), count}, kept);
}

}  // namespace tribo::field
