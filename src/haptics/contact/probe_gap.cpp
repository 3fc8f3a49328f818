// SPDX-License-Identifier: MIT
#include "haptics/contact/probe_gap.hpp"

#include <algorithm>
#include <cassert>

namespace tribo::haptics {
namespace {

// A point so near to the surface stands on it, mm.
constexpr double kStands = 1e-6;

// Whether a point stands on a wall that is none: it may pass.
bool is_on_skin(const contact::DistanceField& field, Vec3 at, const contact::SurfaceSample& s) {
    return s.distance_mm < kStands && s.distance_mm > -contact::kThinnestWall &&
           !contact::has_material_behind(field, at - s.distance_mm * s.normal, s.normal);
}

}  // namespace

double ProbeGap::set_balls(std::span<const Vec3> offsets_mm) {
    assert(!offsets_mm.empty() && offsets_mm.size() <= kMostBalls);
    double most = 0;
    if (offsets_mm.size() != count_) {
        forget();
        most = 1e30;
    }
    count_ = offsets_mm.size();
    if (last_ >= count_) last_ = 0;
    for (std::size_t n = 0; n < count_; ++n) {
        most = std::max(most, distance(ball_[n].offset, offsets_mm[n]));
        ball_[n].offset = offsets_mm[n];
    }
    return most;
}

void ProbeGap::forget() {
    for (Ball& ball : ball_) {
        ball.seen_gap = -1e30;
        ball.touch = ball.room = {};
    }
    memory_->forget();
}

ProbeGap::Gap ProbeGap::measure_ball(const contact::DistanceField& field, Ball& ball, contact::NearHint& near,
                                     Vec3 at) {
    ++queries_;
    contact::SurfaceSample s;
    if (radius_ > 0) {
        // Beyond this nothing is asked exactly: a lower bound serves.
        const double within = 2 * radius_;
        if (near.sides.count == 0) near.at_mm = near.from_mm = at;
        const long before = near.searches;
        near.memory = memory_.get();
        s = field.nearest(at, within, near);
        searches_ += near.searches - before;
    } else {
        s = field.sample(at);
        if (is_on_skin(field, at, s)) s.distance_mm = contact::kThinnestWall;
    }
    ball.seen_at = at;
    ball.seen_gap = s.distance_mm - radius_;
    Gap gap{ball.seen_gap, s.normal, s.piece, 0, {}};
    if (radius_ > 0 && near.sides.count > 1) {
        for (int n = 0; n < near.sides.count; ++n)
            gap.meeting.normal[gap.meeting.count++] = near.sides.side[static_cast<std::size_t>(n)].normal;
    }
    return gap;
}

// The last nearest ball first, then all that might be nearer than what `most` has become.
template <class Ask>
void ProbeGap::nearest_first(Vec3 position_mm, double most, const Ask& ask) {
    const std::size_t first = last_;
    most = ask(first, most);
    for (std::size_t n = 0; n < count_; ++n) {
        if (n != first && ball_[n].bound(position_mm + ball_[n].offset) < most) most = ask(n, most);
    }
}

double ProbeGap::room_of_centres_mm(const contact::DistanceField& field, Vec3 position_mm, double enough_mm) {
    double least = 1e30;
    for (std::size_t n = 0; n < count_; ++n) {
        ++queries_;
        least = std::min(least, field.clearance_mm(position_mm + ball_[n].offset, enough_mm));
    }
    return least;
}

ProbeGap::Gap ProbeGap::measure(const contact::DistanceField& field, Vec3 position_mm) {
    Gap least;
    least.gap_mm = 1e30;
    nearest_first(position_mm, 1e30, [&](std::size_t n, double) {
        const Gap gap = measure_ball(field, ball_[n], ball_[n].touch, position_mm + ball_[n].offset);
        if (gap.gap_mm < least.gap_mm) {
            least = gap;
            least.ball = n;
        }
        return least.gap_mm;
    });
    last_ = least.ball;
    return least;
}

double ProbeGap::clearance_mm(const contact::DistanceField& field, Vec3 position_mm, double enough_mm,
                              bool over_touch) {
    double least = 1e30;
    nearest_first(position_mm, 1e30, [&](std::size_t n, double) {
        Ball& ball = ball_[n];
        const Vec3 at = position_mm + ball.offset;
        ++queries_;
        double clear = field.clearance_mm(at, enough_mm + radius_) - radius_;
        if (clear < enough_mm && radius_ > 0) {
            // Over a smooth side the last room leads there as fast, and what was proven of its surroundings
            // is kept.
            if (over_touch && ball.touch.sides.count > 1) ball.room = ball.touch;
            clear = std::max(clear, measure_ball(field, ball, ball.room, at).gap_mm);
        }
        if (radius_ == 0 && clear < kStands && is_on_skin(field, at, field.sample(at)))
            clear = contact::kThinnestWall;
        if (clear < least) {
            least = clear;
            last_ = n;
        }
        ball.seen_at = at;
        ball.seen_gap = clear;
        return least;
    });
    return least;
}

}  // namespace tribo::haptics
