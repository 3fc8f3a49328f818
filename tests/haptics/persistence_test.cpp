// SPDX-License-Identifier: MIT
// The proxy never falls through and the force never pulls in: feature size x probe x speed x rate.
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "groove_field.hpp"
#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics {
namespace {

using namespace test;

constexpr double kFeatures[] = {0.01, 0.05, 0.2, 0.55, 2};
constexpr double kProbes[] = {0, 0.05, 0.5, 2};
constexpr double kSpeeds[] = {1, 30, 300, 1000};  // mm/s
constexpr double kRates[] = {1000, 3000, 10000};

// Down at a slant from 0.3 mm above to 0.7 mm below, then along: what a probe meets there at each tick.
template <class Check>
void press(const contact::DistanceField& field, double radius, double speed, double rate, double top,
           const Check& check) {
    ContactOptions options;
    options.probe_radius_mm = radius;
    options.tick_s = 1 / rate;
    FieldContact contact(field, options);
    const double step = speed / rate;
    // No more ticks than it takes to see it: slow and fast begin close to the surface.
    const double above = std::min(0.3, 40 * step), below = std::min(0.7, 200 * step);
    double x = 0.0137, z = top + radius + above;
    contact.update({x, 0, z});
    for (int n = 0; n < 300; ++n) {
        if (z > top + radius - below) {
            z -= 0.8 * step;
            x += 0.6 * step;
        } else {
            x += step;
        }
        check(contact.update({x, 0.3 * x, z}), Vec3{x, 0.3 * x, z});
    }
}

TEST(Persistence, no_wall_is_too_thin) {
    int through = 0, inward = 0, lost = 0;
    for (const double thickness : kFeatures) {
        const Wall wall(thickness);
        for (const double radius : kProbes) {
            for (const double speed : kSpeeds) {
                for (const double rate : kRates) {
                    press(wall, radius, speed, rate, 0, [&](const ProbeContact& c, Vec3 probe) {
                        if (c.proxy_mm.z < radius - 1e-4) ++through;
                        if (c.force_n.z < 0) ++inward;
                        if (probe.z < radius - 1e-3 && !c.in_contact) ++lost;
                    });
                }
            }
        }
    }
    EXPECT_EQ(through, 0);
    EXPECT_EQ(inward, 0);
    EXPECT_EQ(lost, 0);
}

TEST(Persistence, no_groove_is_too_fine) {
    int through = 0, inward = 0, lost = 0;
    for (const double pitch : kFeatures) {
        for (const double slender : {0.025, 0.25}) {
            const Grooves grooves(pitch, slender * pitch);
            const double cusp = slender * pitch;
            for (const double radius : kProbes) {
                for (const double speed : kSpeeds) {
                    for (const double rate : kRates) {
                        press(grooves, radius, speed, rate, cusp, [&](const ProbeContact& c, Vec3 probe) {
                            contact::NearHint hint;
                            const double gap = radius > 0 ? grooves.nearest(c.proxy_mm, 1e9, hint).distance_mm
                                                          : grooves.distance_mm(c.proxy_mm);
                            if (gap < radius - 1e-4) ++through;
                            if (c.force_n.z < 0 || dot(c.force_n, c.normal) < 0) ++inward;
                            // Below all of the surface, give or take what is yet to be gone this tick.
                            if (probe.z < radius - 0.05 && !c.in_contact && c.settled) ++lost;
                        });
                    }
                }
            }
        }
    }
    EXPECT_EQ(through, 0);
    EXPECT_EQ(inward, 0);
    EXPECT_EQ(lost, 0);
}

// A point exactly on the surface is held: steps that end within rounding of z = 0.
TEST(Persistence, a_probe_that_lands_within_rounding_of_the_surface_is_held) {
    const Floor floor;
    for (const double rounding : {0.0, 1e-16, -1e-16, 1e-12, -1e-12}) {
        FieldContact contact(floor);
        for (int n = 3; n >= 0; --n) contact.update({0, 0, 0.1 * n + rounding});
        for (int n = 1; n < 10; ++n) EXPECT_GT(contact.update({0, 0, -0.1 * n}).force_n.z, 0) << rounding;
    }
}

TEST(Persistence, leaps_and_what_is_no_number_do_not_break_it) {
    const Wall wall(0.01);
    FieldContact contact(wall);
    contact.update({0, 0, 1});
    const CounterNoise noise(7);
    for (int n = 0; n < 2000; ++n) {
        const auto number = [&](std::uint64_t k) {
            return 2 * noise.uniform(3 * static_cast<std::uint64_t>(n) + k) - 1;
        };
        const Vec3 probe{10 * number(0), 10 * number(1), 5 * number(2)};
        const ProbeContact c = contact.update(n % 17 == 0 ? Vec3{NAN, 0, 0} : probe);
        EXPECT_TRUE(is_finite(c.force_n));
        EXPECT_GE(c.proxy_mm.z, -1e-5);
        EXPECT_GE(c.force_n.z, 0);
    }
}

}  // namespace
}  // namespace tribo::haptics
