// SPDX-License-Identifier: MIT
// How far a probe is from touching: the smallest distance over its parts.
#pragma once

#include <array>
#include <span>

#include "contact/distance_field.hpp"

namespace tribo::haptics {

// A probe is a set of balls of one radius that move together: one ball (a stylus tip; radius 0 is a point), a
// row along a segment (a stylus, whose direction matters), or a shell around a cylinder (a finger). Offsets
// from the probe's position stand in the stock's frame and may change from tick to tick.
//
// Real-time safe. Cost: a ball that cannot be the nearest, by what was last known of it and how far it has
// moved since, is not asked: a shell costs little more than its one or two nearest balls.
class ProbeGap {
  public:
    static constexpr std::size_t kMostBalls = 64;

    explicit ProbeGap(double radius_mm = 0) : radius_(radius_mm) {}

    // At most kMostBalls, at least one. Gives how far the ball that moved most has moved against the probe
    // (without end where their number is another).
    double set_balls(std::span<const Vec3> offsets_mm);
    void set_radius(double radius_mm) { radius_ = radius_mm; }
    double radius_mm() const { return radius_; }
    std::size_t balls() const { return count_; }
    // What was known does not hold any more: another surface, not one from which material was taken.
    void forget();

    struct Gap {
        double gap_mm = 0;  // 0: touching; negative: in material by about that much
        Vec3 normal{0, 0, 1};
        std::uint32_t piece = 0;
        std::size_t ball = 0;  // the one that is nearest
    };
    Gap measure(const contact::DistanceField& field, Vec3 position_mm);
    // A way that the probe may go without touching, up to about `enough_mm`; 0 or less: none.
    double clearance_mm(const contact::DistanceField& field, Vec3 position_mm, double enough_mm);
    Vec3 offset_mm(std::size_t ball) const { return ball_[ball].offset; }
    // Queries of the field so far.
    long queries() const { return queries_; }

  private:
    struct Ball {
        Vec3 offset;
        Vec3 seen_at;             // where it was last asked
        double seen_gap = -1e30;  // a lower bound of its gap there
        // Of the surface next to it, while it is looked for contact and for room: these places are apart.
        struct Near {
            Vec3 foot;  // the surface point last nearest, from the ball's centre
            contact::NearHint hint;
        } touch, room;
        double bound(Vec3 at) const { return seen_gap - distance(at, seen_at); }
    };
    Gap measure_ball(const contact::DistanceField& field, Ball& ball, Ball::Near& near, Vec3 at);
    template <class Ask>
    void nearest_first(Vec3 position_mm, double most, const Ask& ask);

    double radius_;
    std::array<Ball, kMostBalls> ball_;
    std::size_t count_ = 1, last_ = 0;
    long queries_ = 0;
};

}  // namespace tribo::haptics
