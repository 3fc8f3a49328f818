// SPDX-License-Identifier: MIT
#include "field/carved/brick.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "field/carved/brick_kernels.hpp"

namespace tribo::field {
namespace {

// Surfaces at one node are the two sides of a wall if the cosine between their normals is below this.
constexpr float kOpposite = -0.7f;
// A list holds at most one shape for each node, and the shapes since it was pruned.
constexpr std::size_t kMostListed = kLatticeNodes + 16;

// Returns how full of material the cell around a node is, as in brick_kernels.inl.
float filled(float distance_mm, float cell_mm) {
    return std::clamp(0.5f - distance_mm / cell_mm, 0.0f, 1.0f);
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
std::array<float, 3> growth(const float* value, int node) {
    std::array<float, 3> g{};
    const int at[3] = {node % kLatticeEdge, node / kLatticeEdge % kLatticeEdge,
                       node / (kLatticeEdge * kLatticeEdge)};
    int step = 1;
    for (std::size_t axis = 0; axis < 3; ++axis, step *= kLatticeEdge) {
        const bool low = at[axis] == 0, high = at[axis] == kBrickCells;
        const float rise = value[high ? node : node + step] - value[low ? node : node - step];
        g[axis] = low || high ? 2 * rise : rise;
    }
    return g;
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

// Between the two sides of a wall the remaining material is what both sides leave: 1 - (1 - a) - (1 - b) of a
// cell. It is at most what remained before, so that the same cut again removes nothing. Elsewhere the larger
// distance decides, as in the kernels.
void ThinWalls::find(const Brick& brick, const float* shape, float cell) {
    nodes_.clear();
    std::array<std::uint8_t, kLatticeNodes / 8> near_both;
    const bool any = brick_kernels().find_near_both(brick.distance_mm.data(), shape, cell, near_both.data());
    if (!any && brick.thin.empty()) return;
    auto old = brick.thin.begin();
    const auto look = [&](int n, bool is_near) {
        const auto node = static_cast<std::size_t>(n);
        const bool was_thin = old != brick.thin.end() && old->node == n;
        if (!is_near && !was_thin) return;
        const float missing = was_thin ? (old++)->missing_cells : 0;
        const float whole = filled(brick.distance_mm[node], cell), before = whole - missing;
        const float left = filled(-shape[n], cell);
        bool wall = false;
        if (is_near) {
            const std::array<float, 3> own = growth(brick.distance_mm.data(), n), other = growth(shape, n);
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

double ThinWalls::update(Brick& brick, float cell) const {
    if (nodes_.empty() && brick.thin.empty()) return 0;
    double removed = 0;
    brick.thin.clear();
    for (const Node& n : nodes_) {
        const float missing = std::max(0.0f, filled(brick.distance_mm[n.node], cell) - n.filled);
        removed += share_of(n.node) * static_cast<double>(missing - n.missing);
        if (missing > 0) brick.thin.push_back({n.node, missing});
    }
    return removed;
}

// Without branches, because the shape that gives the distance at a node is hard to predict.
void prune_shapes(Brick& brick, const float* newest_mm, float near_mm, float tie_mm) {
    const std::size_t count = brick.shapes.size();
    const auto newest = static_cast<std::uint16_t>(count - 1);
    // Bits: the shape gives the distance at some node near the surface; it does so where the newest does not.
    // One more place for unlisted nodes.
    constexpr std::uint8_t kNear = 1, kAlone = 2;
    std::array<std::uint8_t, kMostListed> use;
    assert(count < use.size());
    std::fill_n(use.begin(), count + 1, std::uint8_t{0});
    const auto listed = [&](std::uint16_t w) { return std::min<std::size_t>(w, count); };
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float d = brick.distance_mm[n];
        const int near = std::abs(d) < near_mm ? 1 : 0, alone = std::abs(d + newest_mm[n]) > tie_mm ? 1 : 0;
        use[listed(brick.winner[n])] |= static_cast<std::uint8_t>(near * (kNear | alone * kAlone));
    }
    std::array<std::uint16_t, kMostListed> renamed;
    renamed[count] = Brick::kUnlisted;
    std::uint16_t kept = 0;
    for (std::uint16_t s = 0; s < count; ++s) {
        const bool keeps = s == newest ? use[s] != 0 : (use[s] & kAlone) != 0;
        if (keeps) brick.shapes[kept] = brick.shapes[s];
        renamed[s] = keeps ? kept++ : Brick::kUnlisted;
    }
    brick.shapes.resize(kept);
    for (std::uint16_t s = 0; s < newest; ++s) {
        if (use[s] == kNear) renamed[s] = renamed[newest];
    }
    for (std::uint16_t& w : brick.winner) w = renamed[listed(w)];
}

}  // namespace tribo::field
