// SPDX-License-Identifier: MIT
#include "surface/nearest_height.hpp"

#include <algorithm>
#include <cmath>

#include "surface/height.hpp"

namespace tribo::surface {
namespace {

constexpr double kOutsideBlank = 1e-3;  // a point farther outside the blank than this is outside, mm
constexpr double kNoDoubt = 1e-4;       // lower heights are not refined, mm
constexpr int kMostBalls = 16;          // largest number of balls; three to five are usual
constexpr double kLeastShrink = 0.99;
// A ball belongs to the point if the design comes no nearer to its centre than this share of its radius. With
// it, facets of a curved design that meet at angles up to 25 degrees do not hide each other.
constexpr double kOwn = 0.9;

}  // namespace

std::optional<NearestHeight::Way> NearestHeight::way(Vec3 point, Vec3 normal) const {
    const auto found = height_over(machined_, point, normal, limit_);
    const bool in_material = found ? *found >= 0 : machined_.distance_mm(point) < 0;
    if (in_material) return Way{found.value_or(limit_), !found};
    const Way down{found.value_or(-limit_), !found};
    if (!blank_) return down;
    if (blank_->distance_mm(point) > kOutsideBlank) return std::nullopt;
    // Ends at the border of the blank if that comes first: material that never existed was not gouged.
    for (double t = 0; t > down.mm;) {
        const double depth = blank_->distance_mm(point + t * normal);
        if (depth > kOutsideBlank) return Way{t, false};
        t += std::min(depth, -kOutsideBlank);
    }
    return down;
}

std::optional<double> NearestHeight::at(Vec3 point, Vec3 normal, std::uint32_t triangle) const {
    const auto found = with_way(point, normal, triangle);
    return found ? std::optional(found->mm) : std::nullopt;
}

std::optional<NearestHeight::Height> NearestHeight::with_way(Vec3 point, Vec3 normal,
                                                             std::uint32_t triangle) const {
    const auto found = way(point, normal);
    if (!found) return std::nullopt;
    const auto mm = height(*found, point, normal, triangle);
    return mm ? std::optional(Height{*mm, found->mm}) : std::nullopt;
}

std::optional<double> NearestHeight::height(const Way& found, Vec3 point, Vec3 normal,
                                            std::uint32_t triangle) const {
    const double side = found.mm < 0 ? -1 : 1;
    double radius = std::abs(found.mm), farthest = 0;
    if (radius <= kNoDoubt) return found.mm;
    for (int n = 0; n < kMostBalls; ++n) {
        const Vec3 centre = point + side * radius * normal;
        const field::MeshPoint near = designed_.closest(centre, triangle);
        const double off = side * near.distance_mm;  // negative: beyond another face of the design
        if (off >= kOwn * radius) {
            if (n == 0 && found.is_open) return std::nullopt;
            return side * std::max(off, farthest);
        }
        if (!near.on_border) farthest = std::max(farthest, off);
        // The ball through the point that was found. It lies inside the present ball.
        const Vec3 chord = near.point_mm - point;
        const double along = 2 * side * dot(chord, normal);
        if (!(along > 0)) break;
        radius = std::min(kLeastShrink * radius, squared_length(chord) / along);
        triangle = near.triangle;
    }
    return side * farthest;
}

}  // namespace tribo::surface
