// SPDX-License-Identifier: MIT
#include "field/carved/brick_kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace tribo::field {
namespace {

using Nodes = std::array<float, kLatticeNodes>;
using Steps = std::array<NodeSteps, kLatticeNodes>;

constexpr float kCell = 0.25f, kTie = 1e-4f, kNear = Brick::kNearCells;
constexpr float kHalfStep = 0.5f / kStepsPerCell;

// Distances of a plane through the brick, sometimes far outside it.
Nodes plane() {
    const double a = 0.01 * *rc::gen::inRange(-100, 101), b = 0.01 * *rc::gen::inRange(-100, 101);
    const double c = 0.01 * *rc::gen::inRange(-100, 101), size = std::sqrt(a * a + b * b + c * c + 1e-9);
    const double offset = 0.01 * *rc::gen::inRange(-300, 300);
    Nodes nodes;
    for (int n = 0; n < kLatticeNodes; ++n) {
        const double along = a * (n % 8 - 3.5) + b * (n / 8 % 8 - 3.5) + c * (n / 64 - 3.5);
        nodes[static_cast<std::size_t>(n)] =
            static_cast<float>(static_cast<double>(kCell) * along / size + offset);
    }
    return nodes;
}

Steps steps_of(const Nodes& nodes) {
    Steps steps;
    brick_kernels().to_steps(nodes.data(), kCell, steps.data());
    return steps;
}

// Node by node, in double precision.
double volume_cells(const Steps& steps) {
    double sum = 0;
    for (int n = 0; n < kLatticeNodes; ++n) {
        double share = 1;
        for (const int at : {n % 8, n / 8 % 8, n / 64}) share *= at == 0 || at == 7 ? 0.5 : 1;
        const auto cells = static_cast<double>(cells_of(steps[static_cast<std::size_t>(n)]));
        sum += share * std::clamp(0.5 - cells, 0.0, 1.0);
    }
    return sum;
}

RC_GTEST_PROP(BrickKernels, steps_keep_sign_and_distance, ()) {
    const Nodes nodes = plane();
    const Steps steps = steps_of(nodes);
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float cells = nodes[n] / kCell, kept = cells_of(steps[n]);
        RC_ASSERT((kept < 0) == (nodes[n] < 0));
        RC_ASSERT((std::abs(kept) < kNear) == (std::abs(cells) < kNear) ||
                  std::abs(std::abs(cells) - kNear) < 2 * kHalfStep);
        if (std::abs(cells) < kNear) RC_ASSERT(std::abs(kept - cells) < 1.01f * kHalfStep);
    }
}

RC_GTEST_PROP(BrickKernels, carve_node_by_node, ()) {
    const Nodes shape = plane();
    const Steps before = steps_of(plane());
    Steps after = before;
    Winners winner;
    const bool many = *rc::gen::arbitrary<bool>();
    const std::uint16_t old = *rc::gen::inRange<std::uint16_t>(0, 255);
    const auto index = *rc::gen::inRange<std::uint16_t>(0, many ? 512 : 255);
    winner.fill(old);
    if (many) winner.make_room(512);
    const CarveResult result =
        brick_kernels().carve(after.data(), winner.low(), winner.high(), shape.data(), index, kCell, kTie);
    bool changed = false, won = false, tied = false;
    float least = 1e30f;
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float was = cells_of(before[n]), is = cells_of(after[n]);
        const float carved = std::min(shape[n] * (-1 / kCell), 1.9999f);
        const bool rises = carved > was + kTieCells && carved > -kNear;
        const bool wins = rises && carved < kNear;
        RC_ASSERT(std::abs(is - (rises ? carved : was)) < 1.01f * kHalfStep);
        RC_ASSERT((is < 0) == (rises ? carved < 0 : was < 0));
        RC_ASSERT(winner[n] == (wins ? index : rises ? Brick::kUnlisted : old));
        changed |= rises;
        won |= wins;
        tied |= std::abs(carved - was) <= kTie / kCell && std::abs(was) < kNear;
        least = std::min(least, is);
    }
    RC_ASSERT(result.changed == changed);
    RC_ASSERT(result.won == won);
    RC_ASSERT(result.tied == tied);
    RC_ASSERT(result.least_cells == least);
    RC_ASSERT(std::abs(result.removed_cells - (volume_cells(before) - volume_cells(after))) < 1e-3);
    RC_ASSERT(std::abs(brick_kernels().volume_cells(after.data()) - volume_cells(after)) < 1e-3);
}

RC_GTEST_PROP(BrickKernels, mark_node_by_node, ()) {
    const Nodes shape = plane();
    const Steps steps = steps_of(plane());
    std::array<std::uint8_t, kLatticeNodes> marks;
    brick_kernels().mark_near(steps.data(), shape.data(), kCell, kTie, marks.data());
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float own = cells_of(steps[n]);
        const bool near = std::abs(own) < kNear;
        const bool alone = near && std::abs(own + shape[n] * (1 / kCell)) > kTie / kCell;
        RC_ASSERT(marks[n] == (near ? kMarkNear : 0) + (alone ? kMarkAlone : 0));
    }
}

// Against one number of two bytes for each node.
RC_GTEST_PROP(Winners, of_any_number_of_shapes, ()) {
    constexpr std::size_t kMost = 520;
    Winners winner;
    std::array<std::uint16_t, kLatticeNodes> expected;
    winner.fill(Brick::kUnlisted);
    expected.fill(Brick::kUnlisted);
    std::size_t count = 0;
    for (int round = 0; round < 12; ++round) {
        for (int grows = *rc::gen::inRange(1, 200); grows > 0 && count < kMost; --grows) {
            winner.make_room(++count);
            Nodes shape;
            shape.fill(1);
            const auto node = *rc::gen::inRange<std::size_t>(0, kLatticeNodes);
            shape[node] = 0;
            Steps steps;
            steps.fill(-1000);
            const auto index = static_cast<std::uint16_t>(count - 1);
            brick_kernels().carve(steps.data(), winner.low(), winner.high(), shape.data(), index, kCell,
                                  kTie);
            expected[node] = index;
        }
        std::vector<std::uint16_t> to(count);
        const int one_of = *rc::gen::inRange(1, 5);
        std::uint16_t kept = 0;
        for (std::uint16_t& t : to) t = *rc::gen::inRange(0, one_of) == 0 ? kept++ : Brick::kUnlisted;
        winner.rename(to, kept);
        for (std::uint16_t& w : expected) w = w == Brick::kUnlisted ? w : to[w];
        count = kept;
        for (std::size_t n = 0; n < kLatticeNodes; ++n) RC_ASSERT(winner[n] == expected[n]);
        RC_ASSERT((winner.high() == nullptr) || count > 255);
    }
}

RC_GTEST_PROP(BrickKernels, of_old_and_new_processors_give_the_same_bits, ()) {
    if (!brick_kernels_v3()) return;
    const BrickKernels &older = *brick_kernels_sse2(), &newer = *brick_kernels_v3();
    const Nodes first = plane(), shape = plane();
    Steps old_steps, new_steps;
    older.to_steps(first.data(), kCell, old_steps.data());
    newer.to_steps(first.data(), kCell, new_steps.data());
    RC_ASSERT(old_steps == new_steps);
    std::array<std::uint8_t, kLatticeNodes / 8> old_both, new_both;
    const bool any = older.find_near_both(old_steps.data(), shape.data(), kCell, old_both.data());
    RC_ASSERT(any == newer.find_near_both(new_steps.data(), shape.data(), kCell, new_both.data()));
    RC_ASSERT(old_both == new_both);
    for (std::size_t n = 0; n < kLatticeNodes; ++n) {
        const float own = cells_of(old_steps[n]), other = shape[n] * (-1 / kCell);
        const bool both = std::abs(own) < 0.5f && std::abs(other) < 0.5f && std::abs(own - other) > kTieCells;
        RC_ASSERT((old_both[n / 8] >> n % 8 & 1) == (both ? 1 : 0));
    }
    std::array<std::uint8_t, kLatticeNodes> old_marks, new_marks;
    older.mark_near(old_steps.data(), shape.data(), kCell, kTie, old_marks.data());
    newer.mark_near(new_steps.data(), shape.data(), kCell, kTie, new_marks.data());
    RC_ASSERT(old_marks == new_marks);
    Winners old_winner, new_winner;
    old_winner.fill(1);
    new_winner.fill(1);
    const CarveResult a =
        older.carve(old_steps.data(), old_winner.low(), old_winner.high(), shape.data(), 2, kCell, kTie);
    const CarveResult b =
        newer.carve(new_steps.data(), new_winner.low(), new_winner.high(), shape.data(), 2, kCell, kTie);
    RC_ASSERT(old_steps == new_steps);
    RC_ASSERT(old_winner == new_winner);
    RC_ASSERT(a.removed_cells == b.removed_cells);
    RC_ASSERT(a.least_cells == b.least_cells);
    RC_ASSERT(older.volume_cells(old_steps.data()) == newer.volume_cells(old_steps.data()));
}

}  // namespace
}  // namespace tribo::field
