// SPDX-License-Identifier: MIT
#include "haptics/contact/probe_shape.hpp"

#include <gtest/gtest.h>

#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

class Floor final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return p.z; }
    Vec3 normal(Vec3) const override { return {0, 0, 1}; }
};

// How deep the probe's position may be before it touches the floor z = 0: minus its height at touch.
double lowest(const ProbeShape& shape, Vec3 stylus) {
    std::vector<Vec3> balls(shape.size());
    shape.turned(stylus, balls);
    double low = 1e9;
    for (const Vec3 b : balls) low = std::min(low, b.z);
    return low;
}

TEST(ProbeShape, turns_with_the_stylus_and_keeps_its_size) {
    const Vec3 down = normalized(Vec3{1, 2, -3});
    EXPECT_EQ(ProbeShape().size(), 1U);
    EXPECT_EQ(lowest(ProbeShape(), down), 0);
    // A stylus that hangs down reaches its own length below the tip; a lying finger its radius.
    EXPECT_NEAR(lowest(ProbeShape::ray(20), {0, 0, -1}), -20, 1e-12);
    EXPECT_NEAR(lowest(ProbeShape::ray(20), {0, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(lowest(ProbeShape::cylinder(8, 20), {1, 0, 0}), -8, 1e-9);
    EXPECT_NEAR(lowest(ProbeShape::ray(20), down), 20 * down.z, 1e-12);
}

TEST(ProbeShape, fits_the_contact_and_is_held_where_it_is_lowest) {
    Floor floor;
    for (const ProbeShape& shape : {ProbeShape::ray(20), ProbeShape::cylinder(8, 20)}) {
        ASSERT_LE(shape.size(), ProbeGap::kMostBalls);
        const Vec3 stylus = normalized(Vec3{0.6, 0, -0.8});
        std::vector<Vec3> balls(shape.size());
        shape.turned(stylus, balls);
        const double reach = -lowest(shape, stylus);
        FieldContact contact(floor);
        contact.update({0, 0, reach + 1}, balls);
        ProbeContact felt;
        for (int n = 0; n < 20; ++n) felt = contact.update({0, 0, reach - 0.4}, balls);
        EXPECT_TRUE(felt.in_contact);
        EXPECT_NEAR(felt.force_n.z, 0.5 * 0.4, 1e-3);
    }
}

}  // namespace
}  // namespace tribo::haptics
