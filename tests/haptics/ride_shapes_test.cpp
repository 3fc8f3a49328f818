// SPDX-License-Identifier: MIT
// A stylus and a finger that go anywhere in stock after any passes, and turn on the way. Held deep in
// material they are pushed back, above the stock nothing pushes.
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "haptics/contact/probe_shape.hpp"
#include "haptics/rider.hpp"
#include "milling/any_passes.hpp"

namespace tribo::haptics {
namespace {

using milling::test::AnyPasses;
using test::room_of_ball;
using tribo::test::Draw;

struct ShapeRides {
    long holds = 0, lost = 0, in_air = 0, deep = 0;
};

class ShapeRider {
  public:
    ShapeRider(const AnyPasses& stock, ProbeShape shape, double radius, double hz)
        : field_(*stock.field), shape_(std::move(shape)), radius_(radius), hz_(hz), balls_(shape_.size()) {
        ContactOptions o;
        o.probe_radius_mm = radius;
        o.tick_s = 1 / hz;
        contact_.set_options(o);
    }
    void begin(Vec3 at, Vec3 stylus) {
        at_ = at;
        stylus_ = stylus;
        update(at, stylus);
    }
    void go(Vec3 to, Vec3 stylus, double mm_per_s) {
        const int ticks = std::max(1, static_cast<int>(std::ceil(distance(at_, to) / mm_per_s * hz_)));
        for (int n = 1; n <= ticks; ++n) {
            const double share = static_cast<double>(n) / ticks;
            update(lerp(at_, to, share), normalized(lerp(stylus_, stylus, share)));
        }
        at_ = to;
        stylus_ = stylus;
    }
    void hold(bool free, ShapeRides& rides) {
        constexpr double kHold = 0.05, kDeep = 0.01;  // s, mm
        for (int n = 0; n < kHold * hz_; ++n) update(at_, stylus_);
        const double force = length(felt_.force_n);
        ++rides.holds;
        if (free && force > 0) ++rides.in_air;
        if (force == 0 && room(at_) < -kDeep) ++rides.lost;
        if (felt_.in_contact && room(felt_.proxy_mm) < -kDeep) ++rides.deep;
    }

  private:
    void update(Vec3 at, Vec3 stylus) {
        shape_.turned(stylus, balls_);
        felt_ = contact_.update(at, balls_);
    }
    // Of all balls to the surface, asked anew.
    double room(Vec3 at) const {
        double least = 1e30;
        for (const Vec3 ball : balls_) least = std::min(least, room_of_ball(field_, at + ball, radius_));
        return least;
    }

    const field::CarvedField& field_;
    ProbeShape shape_;
    double radius_, hz_;
    std::vector<Vec3> balls_;
    FieldContact contact_{field_};
    ProbeContact felt_;
    Vec3 at_, stylus_;
};

TEST(RideShapes, pushes_back_a_turning_stylus_and_a_finger_and_nothing_above_the_stock) {
    for (const bool finger : {false, true}) {
        ShapeRides rides;
        for (std::uint64_t n = 0; n < (finger ? 100U : 10U); ++n) {
            const bool upright = n % 2 == 0;
            Draw draw(finger ? 6 : 5, n);
            const AnyPasses stock(draw, 0.3, upright);
            for (int k = 0; k < 4; ++k) {
                constexpr double kRates[] = {1000, 4000};
                const double radius = finger ? 0 : draw.between(0, 1), length_mm = draw.between(5, 20),
                             finger_mm = draw.between(1, 6), hz = draw.one_of(kRates);
                ShapeRider hand(
                    stock, finger ? ProbeShape::cylinder(finger_mm, length_mm) : ProbeShape::ray(length_mm),
                    radius, hz);
                const Vec3 start = stock.on_way(draw);
                Vec3 at{start.x, start.y, 10}, stylus = normalized(Vec3{0, 0, 1} + draw.aside(0.5));
                hand.begin(at, stylus);
                for (int part = 0; part < 4; ++part) {
                    const bool out = upright && part == 3;
                    if (part == 0)
                        at = start + Vec3{0, 0, radius} + draw.aside(1, -0.6, 1.5);
                    else if (part == 3)
                        at.z = 30;
                    else
                        at += draw.aside(4, -1, 2);
                    stylus = normalized(stylus + draw.aside(0.4));
                    hand.go(at, stylus, draw.between(100, 1500));
                    hand.hold(out, rides);
                }
            }
        }
        EXPECT_EQ(rides.lost, 0) << finger << " " << rides.holds;
        EXPECT_EQ(rides.in_air, 0) << finger << " " << rides.holds;
        // Where a turn leaves no room near by, it is held in material.
        EXPECT_LE(rides.deep, rides.holds / 10) << finger << " " << rides.holds;
    }
}

}  // namespace
}  // namespace tribo::haptics
