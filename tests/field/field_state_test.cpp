// SPDX-License-Identifier: MIT
#include "field/carved/field_state.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <vector>

#include "base/noise_hash.hpp"
#include "field/carved/field_reader.hpp"
#include "field/shape/box_shape.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;

CarvedField stored_block() {
    return {std::make_unique<BoxShape>(Box3{{0, 0, -6}, {12, 10, 0}}), 0.25};
}

// Passes that cut deep, shallow or nothing, and overlap.
std::unique_ptr<const Shape> pass(const CounterNoise& noise, std::uint64_t n) {
    const auto draw = [&](std::uint64_t k, double low, double high) {
        return low + (high - low) * noise.uniform(8 * n + k);
    };
    const double radius = draw(0, 0.4, 3);
    const auto point = [&](std::uint64_t k) {
        return Vec3{draw(k, -2, 14), draw(k + 1, -2, 12), draw(k + 2, -6, 1) + radius};
    };
    return std::make_unique<BallPass>(point(1), point(4), radius);
}

void expect_same_bricks(const CarvedField& a, const CarvedField& b) {
    const BrickCoord size = a.size();
    std::size_t bricks = 0;
    for (int k = 0; k < size.k; ++k) {
        for (int j = 0; j < size.j; ++j) {
            for (int i = 0; i < size.i; ++i) {
                const BrickRef ref = a.ref({i, j, k}), other = b.ref({i, j, k});
                ASSERT_EQ(std::min(ref, kFirstBrick), std::min(other, kFirstBrick));
                if (ref < kFirstBrick) continue;
                ++bricks;
                const Brick &one = a.brick(ref), &two = b.brick(other);
                ASSERT_EQ(one.coord, two.coord);
                ASSERT_EQ(one.steps, two.steps);
                ASSERT_TRUE(one.winner == two.winner);
                ASSERT_EQ(one.shapes, two.shapes);
                ASSERT_EQ(one.volume_mm3, two.volume_mm3);
                ASSERT_EQ(one.thin.size(), two.thin.size());
                for (std::size_t n = 0; n < one.thin.size(); ++n) {
                    ASSERT_EQ(one.thin[n].node, two.thin[n].node);
                    ASSERT_EQ(one.thin[n].missing_cells, two.thin[n].missing_cells);
                }
            }
        }
    }
    ASSERT_EQ(bricks, a.bricks_in_use());
    ASSERT_EQ(bricks, b.bricks_in_use());
    ASSERT_NEAR(a.removed_mm3(), b.removed_mm3(), 1e-9 * b.removed_mm3());
}

// In any order of states, and whether or not another thread reads: the bricks are those of a field that never
// went farther.
TEST(FieldState, is_gone_back_to_with_the_same_bits) {
    constexpr std::uint64_t kShapes = 60;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const CounterNoise noise(seed), choice(1000 + seed);
        CarvedField field = stored_block();
        std::optional<FieldReader> reader;
        if (seed % 2 == 1) reader.emplace(field);
        std::vector<FieldState> states{field.state()};
        for (std::uint64_t n = 0; n < kShapes; ++n) {
            field.carve(pass(noise, n));
            if (reader && n % 3 == 0) reader->refresh();
            if (n % 7 == 3) states.push_back(field.state(states[choice.bits(n) % states.size()]));
        }
        for (std::uint64_t n = 0; n < 12; ++n) {
            const FieldState& state = states[choice.bits(100 + n) % states.size()];
            field.restore(state);
            ASSERT_EQ(field.shapes_carved(), state.shapes);
            ASSERT_EQ(field.removed_mm3(), state.removed_mm3);
            const std::size_t again = choice.bits(200 + n) % (field.shapes_to_carve_again() + 1);
            field.carve_again(again);
            CarvedField once = stored_block();
            for (std::uint64_t s = 0; s < state.shapes + again; ++s) once.carve(pass(noise, s));
            if (reader) {
                EXPECT_TRUE(reader->refresh());
                for (std::uint64_t at = 0; at < 300; ++at) {
                    const Vec3 p{12 * choice.uniform(3 * at), 10 * choice.uniform(3 * at + 1),
                                 -6 * choice.uniform(3 * at + 2)};
                    ASSERT_EQ(reader->distance_mm(p), once.distance_mm(p));
                }
                reader.reset();  // the bricks that it kept are given back
            }
            expect_same_bricks(field, once);
            if (seed % 2 == 1) reader.emplace(field);
        }
        field.carve_again(field.shapes_to_carve_again());
        field.carve(pass(noise, kShapes));
        CarvedField once = stored_block();
        for (std::uint64_t s = 0; s <= kShapes; ++s) once.carve(pass(noise, s));
        reader.reset();
        expect_same_bricks(field, once);
    }
}

TEST(FieldState, shares_what_did_not_change) {
    CarvedField field = stored_block();
    field.carve(std::make_unique<BallPass>(Vec3{-2, 2, 1}, Vec3{14, 2, 1}, 2));
    const FieldState first = field.state();
    const std::size_t alone = own_bytes(first);
    EXPECT_GT(alone, field.bricks_in_use() * sizeof(Brick));
    const FieldState same = field.state(first);
    EXPECT_EQ(own_bytes(same), same.chunks.size() * sizeof(same.chunks[0]));
    EXPECT_LT(own_bytes(first), alone);
    // A cut in one corner.
    field.carve(std::make_unique<BallPass>(Vec3{0, 9, 0}, Vec3{0.5, 9, 0}, 1));
    const FieldState other = field.state(first);
    EXPECT_GT(own_bytes(other), sizeof(Brick));
    EXPECT_LT(4 * own_bytes(other), alone);
}

}  // namespace
}  // namespace tribo::field
