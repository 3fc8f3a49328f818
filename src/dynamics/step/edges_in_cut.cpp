// SPDX-License-Identifier: MIT
#include "dynamics/step/edges_in_cut.hpp"

#include <algorithm>
#include <limits>

#include "base/math.hpp"

namespace tribo::dynamics {

void EdgesInCut::engage(std::size_t slices, double step_rad, bool in_steps) {
    per_rad_ = 1 / step_rad;
    spread_rad_ = in_steps ? step_rad : 0;
    edges_.assign(phase_rad_.size() * slices, {});
    list_.clear();
    list_.reserve(edges_.size());
    next_ = 0;
}

bool EdgesInCut::find(std::span<const EdgeSlice> slices, std::size_t sample, double turn_rad) {
    bool changed = false;
    next_ = std::numeric_limits<std::size_t>::max();
    std::size_t n = 0;
    for (const double phase : phase_rad_) {
        for (const EdgeSlice& slice : slices) {
            Edge& edge = edges_[n++];
            if (edge.next <= sample) {
                const State before = edge.state;
                look(edge, slice, sample, turn_rad + phase);
                changed = changed || edge.state != before || (spread_rad_ > 0 && edge.state == State::part);
            }
            next_ = std::min(next_, edge.next);
        }
    }
    if (!changed) return false;
    list_.clear();
    for (n = 0; n < edges_.size(); ++n) {
        const State state = edges_[n].state;
        if (state == State::out) continue;
        list_.push_back({static_cast<std::uint32_t>(n / slices.size()),
                         static_cast<std::uint32_t>(n % slices.size()), state == State::whole,
                         edges_[n].share, edges_[n].now});
    }
    return true;
}

void EdgesInCut::look(Edge& edge, const EdgeSlice& slice, std::size_t sample, double tip_rad) const {
    double last = tip_rad - slice.low_rad - 0.5 * spread_rad_;  // of the last end from the entry
    if (last < 0) last += math::kTwoPi;
    if (last >= math::kTwoPi) last -= math::kTwoPi;
    const double width = slice.width_rad, first = last + slice.span_rad + spread_rad_;  // end
    double way;  // until the state changes
    if (last >= width && first < math::kTwoPi) {
        edge.state = State::out;
        way = math::kTwoPi - first;
    } else if (first <= width) {
        edge.state = State::whole;
        edge.share = 1;
        edge.now = true;
        way = width - first;
    } else {
        edge.state = State::part;
        if (spread_rad_ > 0) {
            const double again = std::max(first - math::kTwoPi, 0.0);  // beyond the next entry
            const double middle = last + 0.5 * spread_rad_;
            edge.share = (std::max(std::min(first, width) - last, 0.0) + again) * per_rad_;
            edge.now = middle < width || middle >= math::kTwoPi;
        }
        way = (last < width ? width : math::kTwoPi) - last;
    }
    // A step less than the way: the state surely stays until then.
    edge.next = sample + std::max<std::size_t>(1, static_cast<std::size_t>(way * per_rad_));
}

}  // namespace tribo::dynamics
