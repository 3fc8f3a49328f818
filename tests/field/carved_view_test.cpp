// SPDX-License-Identifier: MIT
// A field with shapes that are still to be carved, against the shapes themselves.
#include "field/carved/carved_view.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <rapidcheck/gtest.h>
#include <vector>

#include "field/shape/box_shape.hpp"
#include "test_shapes.hpp"

namespace tribo::field {
namespace {

using test::BallPass;

// A pass that says no more than it must: from `known` on any value.
class GuardedPass final : public test::PlainShape {
  public:
    explicit GuardedPass(const BallPass& pass) : pass_(pass) {}
    Box3 bounds_mm() const override { return pass_.bounds_mm(); }
    double distance_mm(Vec3 p) const override { return pass_.distance_mm(p); }
    double distance_below(Vec3 p, double bound) const override {
        const double d = pass_.distance_mm(p);
        return d < bound ? d : bound;
    }
    Vec3 gradient(Vec3 p) const override { return pass_.gradient(p); }
    void sample_below(const Lattice& lattice, double near_mm, const float* known, float* out) const override {
        sample_near(lattice, near_mm, out);
        for (int n = 0; known != nullptr && n < kLatticeNodes; ++n)
            if (out[n] >= known[n]) out[n] = known[n];
    }

  private:
    BallPass pass_;
};

// Level: only then BallPass is a distance everywhere.
BallPass any_pass() {
    const auto along = [] { return 0.01 * *rc::gen::inRange(-200, 1400); };
    const double ax = along(), ay = along(), bx = along(), by = along();
    const double z = 0.01 * *rc::gen::inRange(-300, 300), radius = 0.01 * *rc::gen::inRange(50, 300);
    return {{ax, ay, z}, {bx + 0.001, by, z}, radius};
}

RC_GTEST_PROP(CarvedView, finds_an_overlap_where_material_is_left_within_a_solid, ()) {
    constexpr double kDepth = 0.05, kRounding = 1e-3, kCell = 0.5;
    CarvedField field(std::make_unique<BoxShape>(Box3{{0, 0, -6}, {12, 12, 0}}), kCell);
    std::vector<BallPass> carved, later;
    const int before = *rc::gen::inRange(0, 4), after = *rc::gen::inRange(0, 5);
    for (int n = 0; n < before; ++n) {
        carved.push_back(any_pass());
        field.carve(std::make_unique<BallPass>(carved.back()));
    }
    std::vector<GuardedPass> guarded;
    for (int n = 0; n < after; ++n) {
        later.push_back(any_pass());
        guarded.emplace_back(later.back());
    }
    std::vector<PendingShape> pending;
    for (const GuardedPass& pass : guarded) pending.push_back({&pass, pass.bounds_mm()});
    const BallPass solid = any_pass();
    const auto shared = [&](Vec3 p) {
        double d = std::max(solid.distance_mm(p), field.blank().distance_mm(p));
        for (const BallPass& pass : carved) d = std::max(d, -pass.distance_mm(p));
        for (const BallPass& pass : later) d = std::max(d, -pass.distance_mm(p));
        return d;
    };

    const std::optional<Vec3> place = CarvedView(field, pending).overlap(solid, kDepth);
    double least = 0;
    const Lattice nodes = field.lattice({});
    for (int c = 0; c <= 14; ++c)
        for (int b = 0; b <= 26; ++b)
            for (int a = 0; a <= 26; ++a) least = std::min(least, shared(nodes.node(a, b, c)));
    if (place) {
        RC_ASSERT(shared(*place) < -kDepth + kRounding);
    } else {
        RC_ASSERT(least > -kDepth - kRounding);
    }
}

// A shank 0.15 mm in a wall: deeper than the depth that the nodes of a fine grid know.
TEST(CarvedView, finds_an_overlap_on_a_fine_grid) {
    CarvedField field(std::make_unique<BoxShape>(Box3{{0, 0, -1}, {1, 1, 0}}), 0.02);
    field.carve(std::make_unique<BoxShape>(Box3{{-1, -1, -0.5}, {0.5, 2, 1}}));
    const BoxShape shank({{0.2, 0.2, -0.4}, {0.65, 0.8, 1}});
    const std::optional<Vec3> place = CarvedView(field).overlap(shank, 0.05);
    ASSERT_TRUE(place);
    EXPECT_LT(std::max(0.5 - place->x, shank.distance_mm(*place)), -0.035);
    EXPECT_FALSE(CarvedView(field).overlap(BoxShape({{0.2, 0.2, -0.4}, {0.5, 0.8, 1}}), 0.05));
}

}  // namespace
}  // namespace tribo::field
