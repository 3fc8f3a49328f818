// SPDX-License-Identifier: MIT
// The places of a surface that are nearest to a point in their neighbourhoods, as a search finds them.
#pragma once

#include <array>
#include <span>

#include "contact/distance_field.hpp"

namespace tribo::field {

// Nearest places that are this far apart are two places, mm.
inline constexpr double kSameFoot = 0.01;
// Distances of the surface that differ by no more than this are the same, mm.
inline constexpr double kSameDistance = 2e-5;

// The nearest places of the surface found so far that are nearer than `within_mm`, and the distance of all
// the rest of them.
class NearestPlaces {
  public:
    explicit NearestPlaces(double within_mm)
        : within_mm_(within_mm),
          rest_mm_(within_mm),
          none_{{within_mm, {0, 0, 1}, 0}, {1e300, 0, 0}, {}, false} {}

    std::span<const contact::Foot> all() const { return {place_.data(), count_}; }
    const contact::Foot& best() const { return count_ > 0 ? place_[0] : none_; }
    bool none() const { return count_ == 0; }
    double distance_mm() const { return count_ > 0 ? place_[0].sample.distance_mm : within_mm_; }
    double rest_mm() const { return rest_mm_; }
    void put(const contact::Foot& foot) {
        if (foot.sample.distance_mm >= within_mm_) return;
        const auto is_same = [&](const contact::Foot& other) {
            return distance(foot.at_mm, other.at_mm) <= kSameFoot;
        };
        std::size_t n = 0;
        while (n < count_ && !is_same(place_[n])) ++n;
        if (n < count_) {
            if (!is_nearer(foot, place_[n])) return;
        } else if (count_ < place_.size()) {
            ++count_;
        } else {
            --n;
            rest_mm_ = std::min(rest_mm_, std::max(foot, place_[n], is_nearer).sample.distance_mm);
            if (!is_nearer(foot, place_[n])) return;
        }
        for (; n > 0 && is_nearer(foot, place_[n - 1]); --n) place_[n] = place_[n - 1];
        place_[n] = foot;
    }

  private:
    static bool is_nearer(const contact::Foot& a, const contact::Foot& b) {
        return a.sample.distance_mm < b.sample.distance_mm;
    }

    double within_mm_, rest_mm_;
    contact::Foot none_;
    std::array<contact::Foot, 1 + contact::NearHint::kMostOthers> place_;
    std::size_t count_ = 0;
};

}  // namespace tribo::field
