// SPDX-License-Identifier: MIT
#include "dynamics/step/tool_past.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math.hpp"
#include "dynamics/step/cubic_weights.hpp"

namespace tribo::dynamics {
namespace {

// Samples that are kept at most, unless one passage needs more.
constexpr double kMostKept = 262'144;

template <class T>
void lengthen(std::vector<T>& ring, std::size_t samples, std::size_t known) {
    std::vector<T> longer(samples);
    for (std::size_t back = 1; back <= std::min(known, ring.size()); ++back)
        longer[(known - back) & (samples - 1)] = ring[(known - back) & (ring.size() - 1)];
    ring = std::move(longer);
}

}  // namespace

ToolPast::ToolPast(const milling::Cutter& cutter, double first_rad)
    : teeth_(static_cast<std::size_t>(cutter.flutes)),
      deep_(cutter.corner_radius_mm() > 0),
      alike_(cutter.pitch_deg.empty()),
      first_rad_(first_rad) {
    for (std::size_t tooth = 0; tooth < (alike_ ? 1 : teeth_); ++tooth) {
        double back = 0;
        for (std::size_t k = 0; k < kMostPassages; ++k) {
            back += alike_ ? math::kTwoPi / static_cast<double>(teeth_)
                           : cutter.pitch_deg[(tooth + k) % teeth_] * math::kRadPerDeg;
            before_.push_back({.back_rad = back, .ahead = (k + 1) % teeth_});
        }
    }
}

void ToolPast::set_speed(double step_rad) {
    if (step_rad == step_rad_) return;
    step_rad_ = step_rad;
    even_from_ = samples_;
    double longest_pitch = 0;
    for (std::size_t first = 0; first < before_.size(); first += kMostPassages)
        longest_pitch = std::max(longest_pitch, before_[first].back_rad);
    passages_ = static_cast<std::size_t>(
        std::clamp(kMostKept * step_rad / longest_pitch, 1.0, static_cast<double>(kMostPassages)));
    double longest = 0;
    for (std::size_t n = 0; n < before_.size(); ++n) {
        Passage& p = before_[n];
        p.back_samples = p.back_rad / step_rad;
        p.back = static_cast<std::size_t>(std::ceil(p.back_samples));
        p.even_from = even_from_;
        p.weights = cubic_weights(static_cast<double>(p.back) - p.back_samples);
        if (n % kMostPassages < passages_) longest = std::max(longest, p.back_samples);
    }
    keep(std::bit_ceil(static_cast<std::size_t>(std::ceil(longest)) + 8));
}

void ToolPast::set_feed(const ToolPlace& per_rad, bool turns) {
    per_rad_ = per_rad;
    if (!turns || turns_) return;
    turns_ = true;
    turn_.assign(marks_.size(), D2{});
}

void ToolPast::keep(std::size_t samples) {
    if (samples <= marks_.size()) return;
    lengthen(xy_, samples, samples_);
    lengthen(marks_, samples, samples_);
    if (deep_) lengthen(z_, samples, samples_);
    if (turns_) lengthen(turn_, samples, samples_);
    mask_ = samples - 1;
}

void ToolPast::look_back_anywhere(Passage& p) const {
    const double at_rad = rotation_rad_ - p.back_rad;
    if (samples_ < 4 || !(at_rad > first_rad_)) {
        p.known_at = samples_ + 1;
        p.cut = ~TeethThatCut{0};
        p.place = fed_;
        move(p.place, -p.back_rad);
        return;
    }
    std::size_t n = p.back < samples_ ? samples_ - p.back : 0;
    std::array<double, 4> weights = p.weights;
    if (n < even_from_ + 1) {
        n = std::min(n, samples_ - 3);
        while (n > 0 && rotation_of(n) > at_rad) --n;
        while (n + 3 < samples_ && rotation_of(n + 1) <= at_rad) ++n;
        const double from = rotation_of(n), to = rotation_of(n + 1);
        weights = cubic_weights((at_rad - from) / (to - from));
    }
    if (n > 0) return see(p, n, weights);
    // The sample before the first one stood a step of the feed before it.
    const double lost = weights[0] * step_rad_;
    weights[1] += weights[0];
    weights[0] = 0;
    see(p, n, weights);
    move(p.place, -lost);
}

void ToolPast::move(ToolPlace& place, double rad) const {
    place.tip_mm.xy += both(rad) * per_rad_.tip_mm.xy;
    place.tip_mm.z += rad * per_rad_.tip_mm.z;
    place.turn_rad += both(rad) * per_rad_.turn_rad;
}

}  // namespace tribo::dynamics
