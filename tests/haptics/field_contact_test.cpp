// SPDX-License-Identifier: MIT
#include "haptics/contact/field_contact.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "groove_field.hpp"

namespace tribo::haptics {
namespace {

using namespace test;

ContactOptions spring_options(double stiffness, double radius = 0) {
    ContactOptions o;
    o.stiffness_n_per_mm = stiffness;
    o.probe_radius_mm = radius;
    return o;
}

TEST(FieldContact, a_flat_floor_pushes_back_by_stiffness_times_depth) {
    const Floor floor;
    for (const double radius : {0.0, 0.5, 2.0}) {
        FieldContact contact(floor, spring_options(0.8, radius));
        EXPECT_FALSE(contact.update({0, 0, 3}).in_contact);
        for (int n = 0; n < 50; ++n) {
            const Vec3 probe{0.02 * n, 0.01 * n, radius - 0.3};
            const ProbeContact c = contact.update(probe);
            ASSERT_TRUE(c.in_contact);
            EXPECT_NEAR(c.force_n.z, 0.8 * 0.3, 1e-6);
            EXPECT_NEAR(c.force_n.x, 0, 1e-4);
            EXPECT_NEAR(c.proxy_mm.z, radius, 1e-5);
        }
        EXPECT_FALSE(contact.update({1, 0.5, radius + 0.1}).in_contact);
    }
}

TEST(FieldContact, a_probe_that_begins_in_the_material_is_brought_to_the_surface) {
    const Floor floor;
    FieldContact contact(floor, spring_options(1));
    EXPECT_NEAR(contact.update({0, 0, -0.4}).force_n.z, 0.4, 1e-4);
}

TEST(FieldContact, a_corner_holds_the_proxy_by_both_its_sides) {
    const Corner corner;
    FieldContact contact(corner, spring_options(1));
    contact.update({0.5, 0, 0.5});
    ProbeContact c;
    for (int n = 0; n < 100; ++n) c = contact.update({0.5 - 0.01 * n, 0.002 * n, 0.5 - 0.008 * n});
    EXPECT_NEAR(c.proxy_mm.x, 0, 1e-5);
    EXPECT_NEAR(c.proxy_mm.z, 0, 1e-5);
    EXPECT_NEAR(c.proxy_mm.y, 0.198, 1e-3);
    EXPECT_NEAR(c.force_n.x, 0.49, 1e-3);
    EXPECT_NEAR(c.force_n.z, 0.292, 1e-3);
}

// Material where x > 0 and z < 0: at its edge both faces are equally near.
class Step final : public contact::DistanceField {
  public:
    double distance_mm(Vec3 p) const override { return std::max(-p.x, p.z); }
    Vec3 normal(Vec3 p) const override { return -p.x >= p.z ? Vec3{-1, 0, 0} : Vec3{0, 0, 1}; }
};

TEST(FieldContact, an_edge_holds_no_probe_that_moves_on_the_face_behind_it) {
    const Step step;
    for (const double height : {0.0, 5e-7, -5e-7}) {
        for (const double pace : {1e-3, 0.015, 0.4}) {
            FieldContact contact(step, spring_options(1));
            for (const double way : {1.0, -1.0}) {
                for (int n = 0; n <= 100; ++n) {
                    const ProbeContact c = contact.update({way * pace * (n - 50), 0.1 * pace * n, height});
                    EXPECT_LT(length(c.force_n), 1e-5) << height << " " << pace << " " << way << " " << n;
                }
            }
        }
    }
    // A little below it the other face does hold.
    FieldContact contact(step, spring_options(1));
    ProbeContact c;
    for (int n = -50; n <= 50; ++n) c = contact.update({0.002 * n, 0, -1e-3});
    EXPECT_NEAR(c.force_n.x, -0.1, 1e-6);
}

// In the hollow of a groove the nearest surface point lies on the line from the axis through the probe.
// A groove along y with its bottom at z = 0, between two planes that lean by `half_rad` from upright.
class SharpGroove final : public contact::DistanceField {
  public:
    explicit SharpGroove(double half_rad) : across_(std::cos(half_rad)), up_(std::sin(half_rad)) {}
    double distance_mm(Vec3 p) const override { return up_ * p.z - across_ * std::abs(p.x); }
    Vec3 normal(Vec3 p) const override { return {p.x > 0 ? -across_ : across_, 0, up_}; }

  private:
    double across_, up_;
};

TEST(FieldContact, a_sharp_groove_leads_the_proxy_along) {
    for (const double half_deg : {12, 15, 20, 25, 30, 40, 50}) {
        for (const double aside : {-0.1, 0.0, 0.3}) {
            const SharpGroove groove(half_deg * std::numbers::pi / 180);
            FieldContact contact(groove, spring_options(1));
            contact.update({0, 0, 1});
            for (int n = 0; n <= 20; ++n) contact.update({aside * n / 20, 0, 1 - 0.1 * n});
            ProbeContact c;
            for (int n = 0; n <= 100; ++n) c = contact.update({aside, 0.05 * n, -1});
            for (int n = 0; n < 20; ++n) c = contact.update({aside, 5, -1});
            EXPECT_NEAR(c.proxy_mm.y, 5, 0.01) << half_deg << " " << aside;
            EXPECT_NEAR(length(c.force_n), std::hypot(1, aside), 0.01) << half_deg << " " << aside;
        }
    }
}

TEST(FieldContact, in_a_groove_the_force_is_that_of_the_nearest_surface_point) {
    const Grooves grooves(1, 0.025);
    FieldContact contact(grooves, spring_options(1));
    contact.update({-0.2, 0, 0.5});
    for (int n = 0; n <= 400; ++n) {
        const Vec3 probe{-0.2 + 0.001 * n, 0.001 * n, -0.3};
        const ProbeContact c = contact.update(probe);
        const Vec3 axis{0, probe.y, grooves.radius_mm()};
        EXPECT_NEAR(length(c.force_n), distance(probe, axis) - grooves.radius_mm(), 1e-4) << n;
        EXPECT_NEAR(grooves.distance_mm(c.proxy_mm), 0, 1e-5);
    }
}

}  // namespace
}  // namespace tribo::haptics
