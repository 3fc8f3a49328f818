// SPDX-License-Identifier: MIT
#include "field/carved/brick_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace tribo::field {
namespace {

using Nodes = std::array<float, kLatticeNodes>;
using Winners = std::array<std::uint16_t, kLatticeNodes>;

constexpr float kCell = 0.25f, kNear = 0.45f, kTie = 1e-4f;

// Distances of a plane through the brick, sometimes far outside it.
Nodes plane(float low) {
    const double a = 0.01 * *rc::gen::inRange(-100, 101), b = 0.01 * *rc::gen::inRange(-100, 101);
    const double c = 0.01 * *rc::gen::inRange(-100, 101), size = std::sqrt(a * a + b * b + c * c + 1e-9);
    const double offset = 0.01 * *rc::gen::inRange(-300, 300);
    Nodes nodes;
    for (int n = 0; n < kLatticeNodes; ++n) {
        const double along = a * (n % 8 - 3.5) + b * (n / 8 % 8 - 3.5) + c * (n / 64 - 3.5);
        nodes[static_cast<std::size_t>(n)] =
            std::max(low, static_cast<float>(static_cast<double>(kCell) * along / size + offset));
    }
    return nodes;
}

// Node by node, in double precision.
double volume_cells(const Nodes& nodes) {
    double sum = 0;
    for (int n = 0; n < kLatticeNodes; ++n) {
        double share = 1;
        for (const int at : {n % 8, n / 8 % 8, n / 64}) share *= at == 0 || at == 7 ? 0.5 : 1;
        sum += share *
               std::clamp(0.5 - static_cast<double>(nodes[static_cast<std::size_t>(n)] / kCell), 0.0, 1.0);
    }
    return sum;
}

RC_GTEST_PROP(BrickKernels, carve_node_by_node, ()) {
    const Nodes before = plane(-kNear), shape = plane(-10);
    Nodes after = before;
    Winners winner;
    winner.fill(3);
    const CarveResult result =
        brick_kernels().carve(after.data(), winner.data(), shape.data(), 7, kNear, kCell, kTie);
    bool changed = false, won = false, tied = false;
    float least = 1e30f;
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const bool rises = -shape[n] > before[n] + kTieCells * kCell && -shape[n] > -kNear;
        const bool wins = rises && -shape[n] < kNear;
        RC_ASSERT(after[n] == (rises ? -shape[n] : before[n]));
        RC_ASSERT(winner[n] == (wins ? 7 : rises ? Brick::kUnlisted : 3));
        changed |= rises;
        won |= wins;
        tied |= std::abs(-shape[n] - before[n]) <= kTie && std::abs(before[n]) < kNear;
        least = std::min(least, after[n]);
    }
    RC_ASSERT(result.changed == changed);
    RC_ASSERT(result.won == won);
    RC_ASSERT(result.tied == tied);
    RC_ASSERT(result.least_mm == least);
    RC_ASSERT(std::abs(result.removed_cells - (volume_cells(before) - volume_cells(after))) < 1e-3);
    RC_ASSERT(std::abs(brick_kernels().volume_cells(after.data(), kCell) - volume_cells(after)) < 1e-3);
}

RC_GTEST_PROP(BrickKernels, of_old_and_new_processors_give_the_same_bits, ()) {
    if (!brick_kernels_v3()) return;
    const Nodes shape = plane(-10);
    Nodes old_nodes = plane(-kNear), new_nodes = old_nodes;
    Winners old_winner;
    old_winner.fill(1);
    Winners new_winner = old_winner;
    std::array<std::uint8_t, kLatticeNodes / 8> old_both, new_both;
    const bool any =
        brick_kernels_sse2()->find_near_both(old_nodes.data(), shape.data(), kCell, old_both.data());
    RC_ASSERT(any ==
              brick_kernels_v3()->find_near_both(new_nodes.data(), shape.data(), kCell, new_both.data()));
    RC_ASSERT(old_both == new_both);
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float own = old_nodes[n], other = -shape[n];
        const bool both = std::abs(own) < kCell / 2 && std::abs(other) < kCell / 2 &&
                          std::abs(own - other) > kTieCells * kCell;
        RC_ASSERT((old_both[n / 8] >> n % 8 & 1) == (both ? 1 : 0));
    }
    const CarveResult a =
        brick_kernels_sse2()->carve(old_nodes.data(), old_winner.data(), shape.data(), 2, kNear, kCell, kTie);
    const CarveResult b =
        brick_kernels_v3()->carve(new_nodes.data(), new_winner.data(), shape.data(), 2, kNear, kCell, kTie);
    RC_ASSERT(old_nodes == new_nodes);
    RC_ASSERT(old_winner == new_winner);
    RC_ASSERT(a.removed_cells == b.removed_cells);
    RC_ASSERT(a.least_mm == b.least_mm);
    RC_ASSERT(brick_kernels_sse2()->volume_cells(old_nodes.data(), kCell) ==
              brick_kernels_v3()->volume_cells(old_nodes.data(), kCell));
}

}  // namespace
}  // namespace tribo::field
