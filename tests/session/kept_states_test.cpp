// SPDX-License-Identifier: MIT
#include "session/cut/kept_states.hpp"

#include <gtest/gtest.h>

#include "field/shape/box_shape.hpp"
#include "milling/sweep/sweep.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {
namespace {

// A pocket of many layers: every layer changes the same bricks again.
constexpr int kMoves = 1500;
motion::Move layer_move(int n) {
    const double y = n % 30 * 0.4, z = -0.1 * (n / 30);
    motion::Move move;
    move.kind = motion::MoveKind::feed;
    move.start = {{0, y, z}, {0, 0, 1}};
    move.end = {{30, y, z}, {0, 0, 1}};
    return move;
}

field::CarvedField block() {
    return {std::make_unique<field::BoxShape>(Box3{{-5, -5, -10}, {35, 17, 0}}), 0.4};
}

struct Carver {
    explicit Carver(std::size_t most_bytes) : states(stock, most_bytes) {}

    void carve_to(std::size_t moves) {
        milling::Cutter ball;
        ball.kind = milling::CutterKind::ball;
        ball.diameter_mm = 6;
        ball.length_mm = 30;
        for (; carved < moves; ++carved) {
            if (stock.shapes_to_carve_again() > 0) {
                stock.carve_again(1);
            } else {
                stock.carve(milling::make_sweep(ball, layer_move(static_cast<int>(carved))));
            }
            states.offer(stock, carved + 1);
        }
    }
    // Returns the changes of bricks that the way to `moves` takes.
    std::uint64_t go_to(std::size_t moves) {
        const std::uint64_t before = stock.brick_updates();
        carved = states.last(moves);
        states.restore(stock, moves);
        carve_to(moves);
        return stock.brick_updates() - before;
    }

    field::CarvedField stock = block();
    KeptStates states;
    std::size_t carved = 0;
};

TEST(KeptStates, are_never_farther_away_than_the_spacing) {
    Carver mill(std::size_t{1} << 30);
    mill.carve_to(kMoves);
    const std::uint64_t all = mill.stock.brick_updates();
    ASSERT_GT(all, 12 * KeptStates::kSpacing);
    const std::uint64_t one_move = all / kMoves * 4;
    std::uint64_t most = 0;
    for (std::size_t n = 1; n < 40; ++n) most = std::max(most, mill.go_to(n * 977 % kMoves));
    EXPECT_LE(most, KeptStates::kSpacing + one_move);
    EXPECT_GT(most, KeptStates::kSpacing / 2);
    EXPECT_GE(mill.states.count(), all / (KeptStates::kSpacing + one_move));
}

TEST(KeptStates, fill_no_more_than_their_memory) {
    Carver free(std::size_t{1} << 30);
    free.carve_to(kMoves);
    for (const std::size_t part : {2u, 5u, 50u}) {
        Carver bound(free.states.bytes() / part);
        std::size_t most_bytes = 0;
        for (std::size_t n = 10; n <= kMoves; n += 10) {
            bound.carve_to(n);
            most_bytes = std::max(most_bytes, bound.states.bytes());
        }
        EXPECT_LE(most_bytes, free.states.bytes() / part);
        EXPECT_LT(bound.states.count(), free.states.count());
        if (part < 50) {
            EXPECT_GT(4 * bound.states.bytes(), free.states.bytes() / part);
        }
        // Going back and forth fills no more either.
        for (std::size_t n = 1; n < 20; ++n) bound.go_to(n * 977 % kMoves);
        EXPECT_LE(bound.states.bytes(), free.states.bytes() / part);
        bound.go_to(kMoves);
        EXPECT_EQ(bound.stock.shapes_carved(), free.stock.shapes_carved());
    }
}

TEST(KeptStates, of_no_memory_begin_with_the_first_move) {
    Carver mill(0);
    mill.carve_to(300);
    EXPECT_EQ(mill.states.count(), 1u);
    EXPECT_EQ(mill.states.last(299), 0u);
    mill.go_to(100);
    EXPECT_EQ(mill.stock.shapes_carved(), 100u);
}

}  // namespace
}  // namespace tribo::session
