// SPDX-License-Identifier: MIT
// A hand that goes anywhere on a surface, and what it feels there, checked without a model of what it should
// feel: the proxy stands in air, the spring pulls to it, and no free place near it is nearer to the probe.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/spiral.hpp"
#include "haptics/contact/field_contact.hpp"

namespace tribo::haptics::test {

struct Rides {
    long holds = 0, in_wall = 0, in_air = 0, weak = 0, not_least = 0;
    long stuck = 0;  // of not_least: for half of the hold the proxy has neither moved nor settled
};

// Of a ball to the surface, asked anew. In material: minus about its depth.
inline double room_of_ball(const contact::DistanceField& field, Vec3 centre, double radius) {
    const double air = field.distance_mm(centre);
    if (radius == 0 || air <= 0) return air - radius;
    contact::NearHint none;
    return field.nearest(centre, 2 * radius + 0.1, none).distance_mm - radius;
}

class Rider {
  public:
    Rider(const contact::DistanceField& field, double radius, double hz, Rides& rides)
        : field_(field), radius_(radius), hz_(hz), rides_(rides), contact_(field_, options()) {}

    void begin(Vec3 at) {
        at_ = at;
        (void)contact_.update(at);
    }
    void go(Vec3 to, double mm_per_s) {
        const int ticks = std::max(1, static_cast<int>(std::ceil(distance(at_, to) / mm_per_s * hz_)));
        for (int n = 1; n <= ticks; ++n) (void)contact_.update(lerp(at_, to, static_cast<double>(n) / ticks));
        at_ = to;
    }
    // Holds the probe still, and checks what it feels then. `free`: nothing is near.
    void hold(bool free) {
        ProbeContact felt;
        double still_s = 0;
        for (int n = 0; n < kHold * hz_; ++n) {
            const Vec3 before = felt.proxy_mm;
            felt = contact_.update(at_);
            still_s = felt.settled || felt.proxy_mm != before ? 0 : still_s + 1 / hz_;
        }
        const double force = length(felt.force_n);
        const Vec3 proxy = felt.in_contact ? felt.proxy_mm : at_;
        ++rides_.holds;
        if (free && force > 0) ++rides_.in_air;
        // A ball may be a lens deep, and a thin wall counts or not.
        constexpr double kDeep = 2e-3;
        if (room(proxy) < -kDeep) ++rides_.in_wall;
        if (force == 0) return;
        const double spring = kSpring * distance(proxy, at_);
        if (std::abs(force - spring) > 0.05 * spring + 1e-4) ++rides_.weak;
        if (!comes_nearer(proxy)) return;
        ++rides_.not_least;
        if (still_s > 0.5 * kHold) ++rides_.stuck;
    }

  private:
    static constexpr double kHold = 0.03, kSpring = 0.5;  // s, N/mm

    ContactOptions options() const {
        ContactOptions o;
        o.stiffness_n_per_mm = kSpring;
        o.probe_radius_mm = radius_;
        o.tick_s = 1 / hz_;
        return o;
    }
    double room(Vec3 centre) const { return room_of_ball(field_, centre, radius_); }
    // Whether a way of 3 or 20 um from a place leads through air by a fifth of its length nearer to the
    // probe.
    bool comes_nearer(Vec3 from) const {
        constexpr int kWays = 80, kParts = 8;
        constexpr double kRoom = 1e-4, kInWay = 5e-5, kNearer = 0.2;
        const double left = distance(from, at_);
        for (const double way : {0.003, 0.02}) {
            for (int n = 0; n < kWays; ++n) {
                const Vec3 step = way * tribo::test::spiral_direction(n, kWays);
                if (left - distance(from + step, at_) < kNearer * way || room(from + step) < kRoom) continue;
                bool is_free = true;
                for (int k = 1; k < kParts && is_free; ++k)
                    is_free = room(from + static_cast<double>(k) / kParts * step) >= -kInWay;
                if (is_free) return true;
            }
        }
        return false;
    }

    const contact::DistanceField& field_;
    double radius_, hz_;
    Rides& rides_;
    FieldContact contact_;
    Vec3 at_;
};

}  // namespace tribo::haptics::test
