// SPDX-License-Identifier: MIT
// Gap between a probe and a surface: the smallest gap of its balls.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "contact/distance_field.hpp"
#include "contact/search_memory.hpp"

namespace tribo::haptics {

// A probe is a rigid set of balls with one radius: one ball (a stylus tip; radius 0 is a point), a row along
// a segment (a whole stylus), or a shell around a cylinder (a finger). Offsets from the probe position are in
// the stock frame and may change from tick to tick.
//
// Real-time safe. A ball that cannot be the nearest is not queried; its last gap and its motion since then
// bound its gap. So a shell costs little more than its one or two nearest balls.
class ProbeGap {
  public:
    static constexpr std::size_t kMostBalls = 64;

    explicit ProbeGap(double radius_mm = 0) : radius_(radius_mm) {}

    // 1 to kMostBalls offsets. Returns the largest motion of a ball relative to the probe (infinite if the
    // number of balls changes).
    double set_balls(std::span<const Vec3> offsets_mm);
    void set_radius(double radius_mm) { radius_ = radius_mm; }
    double radius_mm() const { return radius_; }
    std::size_t balls() const { return count_; }
    // Discards all stored gaps: for another surface. Not needed when material is removed.
    void forget();

    struct Gap {
        double gap_mm = 0;  // 0: touching; negative: about the depth in material
        Vec3 normal{0, 0, 1};
        std::uint32_t piece = 0;
        std::size_t ball = 0;  // index of the nearest ball
        // The ball touches an edge or a peak: its centre moves round that, until it lies on one of the sides
        // that meet there. Empty on a smooth side.
        struct Meeting {
            std::array<Vec3, contact::HalfSpaces::kMost> normal;
            std::size_t count = 0;
        };
        Meeting meeting;
    };
    Gap measure(const contact::DistanceField& field, Vec3 position_mm);
    // Distance that the probe can move in any direction without contact, up to about `enough_mm`. 0 or less:
    // none. `over_touch`: the position is over the one that was measured last, so that the same place is
    // near.
    double clearance_mm(const contact::DistanceField& field, Vec3 position_mm, double enough_mm,
                        bool over_touch = false);
    // The same for balls without a radius: for their centres alone. Without a search.
    double room_of_centres_mm(const contact::DistanceField& field, Vec3 position_mm, double enough_mm);
    Vec3 offset_mm(std::size_t ball) const { return ball_[ball].offset; }
    // Queries of the field so far, and searches along the surface that they needed (contact::NearHint).
    long queries() const { return queries_; }
    long searches() const { return searches_; }

  private:
    struct Ball {
        Vec3 offset;
        Vec3 seen_at;             // position of the last query
        double seen_gap = -1e30;  // a lower bound of its gap there
        // For contact queries and for clearance queries, which are at different places.
        contact::NearHint touch, room;
        double bound(Vec3 at) const { return seen_gap - distance(at, seen_at); }
    };
    Gap measure_ball(const contact::DistanceField& field, Ball& ball, contact::NearHint& near, Vec3 at);
    template <class Ask>
    void nearest_first(Vec3 position_mm, double most, const Ask& ask);

    double radius_;
    // Made at once: more than a small stack holds.
    std::vector<Ball> ball_ = std::vector<Ball>(kMostBalls);
    std::unique_ptr<contact::SearchMemory> memory_ = std::make_unique<contact::SearchMemory>();
    std::size_t count_ = 1, last_ = 0;
    long queries_ = 0, searches_ = 0;
};

}  // namespace tribo::haptics
