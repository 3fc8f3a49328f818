// SPDX-License-Identifier: MIT
// Friction against closed forms: a probe at depth d under a plane is pushed by N = k d and held by a force
// along it of up to mu N, which is a way of mu d behind.
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "groove_field.hpp"
#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

using namespace test;

ContactOptions rough(double mu_static, double mu_kinetic, double stick_mm_per_s = 10) {
    ContactOptions o;
    o.stiffness_n_per_mm = 1;
    o.friction_static = mu_static;
    o.friction_kinetic = mu_kinetic;
    o.stick_mm_per_s = stick_mm_per_s;
    return o;
}

TEST(Friction, holds_the_proxy_until_the_static_cone_is_left) {
    const Floor floor;
    FieldContact contact(floor, rough(0.5, 0.3));
    contact.update({0, 0, 1});
    contact.update({0, 0, -0.4});
    for (int n = 0; n <= 39; ++n) {
        const double x = 0.2 * n / 40;
        const ProbeContact c = contact.update({x, 0, -0.4});
        EXPECT_NEAR(c.proxy_mm.x, 0, 1e-12);
        EXPECT_NEAR(c.force_n.x, -x, 1e-12);
        EXPECT_FALSE(c.sliding);
    }
    // Out of it: down to the kinetic cone at once.
    const ProbeContact slip = contact.update({0.205, 0, -0.4});
    EXPECT_NEAR(slip.force_n.x, -0.3 * 0.4, 1e-3);
    EXPECT_NEAR(slip.proxy_mm.x, 0.205 - 0.3 * 0.4, 1e-3);
}

TEST(Friction, drags_with_the_kinetic_force_while_it_slides_fast) {
    const Floor floor;
    FieldContact contact(floor, rough(0.5, 0.3));
    contact.update({0, 0, 1});
    for (int n = 0; n < 200; ++n) {
        const ProbeContact c = contact.update({0.08 * n, 0, -0.4});  // 80 mm/s
        if (n > 5) {
            EXPECT_NEAR(c.force_n.x, -0.12, 1e-3);
            EXPECT_TRUE(c.sliding);
        }
    }
}

// Pulled slowly it sticks again after each slip: teeth from mu_k N to mu_s N, one every (mu_s - mu_k) d.
TEST(Friction, sticks_and_slips_when_it_is_pulled_slowly) {
    const Floor floor;
    FieldContact contact(floor, rough(0.5, 0.3));
    contact.update({0, 0, 1});
    contact.update({0, 0, -0.4});
    int slips = 0;
    double least = 1, most = 0, last = 0;
    const double step = 0.001;  // 1 mm/s
    for (int n = 1; n <= 2000; ++n) {
        const ProbeContact c = contact.update({step * n, 0, -0.4});
        const double drag = -c.force_n.x;
        if (drag < last) ++slips;
        last = drag;
        if (n < 300) continue;
        least = std::min(least, drag);
        most = std::max(most, drag);
    }
    EXPECT_NEAR(most, 0.5 * 0.4, 2 * step);
    EXPECT_NEAR(least, 0.3 * 0.4, 2 * step);
    EXPECT_NEAR(slips, (2.0 - 0.2) / ((0.5 - 0.3) * 0.4), 2);
}

RC_GTEST_PROP(Friction, never_leaves_the_static_cone, ()) {
    const Floor floor;
    const double mu = 0.01 * *rc::gen::inRange(1, 100);
    FieldContact contact(floor, rough(mu, 0.7 * mu));
    Vec3 probe{0, 0, 0.5};
    contact.update(probe);
    const auto moves = *rc::gen::container<std::vector<int>>(60, rc::gen::inRange(-300, 300));
    for (std::size_t n = 0; n + 2 < moves.size(); n += 3) {
        probe = probe + 0.001 * Vec3{1.0 * moves[n], 1.0 * moves[n + 1], 1.0 * moves[n + 2]};
        const ProbeContact c = contact.update(probe);
        const double drag = std::hypot(c.force_n.x, c.force_n.y);
        RC_ASSERT(c.force_n.z >= 0);
        RC_ASSERT(drag <= mu * c.force_n.z * (1 + 1e-9) + 1e-12);
        RC_ASSERT(std::abs(c.force_n.z - std::max(0.0, -probe.z)) < 1e-3);
    }
}

}  // namespace
}  // namespace tribo::haptics
