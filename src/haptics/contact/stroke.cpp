// SPDX-License-Identifier: MIT
#include "haptics/contact/stroke.hpp"

#include <algorithm>
#include <cassert>

namespace tribo::haptics {

Stroke::Stroke(std::vector<StrokePoint> points) : points_(std::move(points)) {
    assert(!points_.empty());
}

Stroke::At Stroke::at(double t_s) {
    if (t_s < start_s()) return {points_.front().position_mm, {}};
    if (t_s >= end_s()) return {points_.back().position_mm, {}};
    const bool behind = t_s < points_[next_ - 1].t_s;
    if (behind || t_s >= points_[next_].t_s) {
        // The piece after the last one nearly always holds it.
        if (!behind && t_s < points_[next_ + 1].t_s) {
            ++next_;
        } else {
            const auto after = std::ranges::upper_bound(points_, t_s, {}, &StrokePoint::t_s);
            next_ = static_cast<std::size_t>(after - points_.begin());
        }
    }
    const StrokePoint &a = points_[next_ - 1], &b = points_[next_];
    const double seconds = b.t_s - a.t_s;
    return {lerp(a.position_mm, b.position_mm, (t_s - a.t_s) / seconds),
            (b.position_mm - a.position_mm) / seconds};
}

}  // namespace tribo::haptics
