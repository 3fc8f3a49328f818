// SPDX-License-Identifier: MIT
#include "contact/distance_field.hpp"

#include "contact/half_spaces.hpp"

namespace tribo::contact {
namespace {

constexpr int kMostRounds = 16;
// A point this close to the surface is on it, mm.
constexpr double kOnSurface = 1e-6;
// Normals of one smooth piece, from one step of the search to the next, agree at least this well.
constexpr double kAlike = 0.5;

}  // namespace

SurfaceSample DistanceField::nearest(Vec3 point_mm, double within_mm, Vec3 hint_mm) const {
    const SurfaceSample here = sample(point_mm);
    if (here.distance_mm <= 0 || here.distance_mm >= within_mm) return here;
    const SurfaceSample below = nearest_from(*this, point_mm, point_mm - here.distance_mm * here.normal);
    if (below.distance_mm <= here.distance_mm + kOnSurface) return below;
    const SurfaceSample hinted = nearest_from(*this, point_mm, hint_mm);
    return hinted.distance_mm < below.distance_mm ? hinted : below;
}

SurfaceSample nearest_from(const DistanceField& field, Vec3 point_mm, Vec3 start_mm) {
    HalfSpaces sides;
    Vec3 q = start_mm;
    SurfaceSample best = field.sample(point_mm);  // a lower bound
    for (int n = 0; n < kMostRounds; ++n) {
        const SurfaceSample s = field.sample(q);
        if (s.distance_mm <= kOnSurface && n > 0 && s.distance_mm >= -kOnSurface) {
            const double way = length(point_mm - q);
            if (way > kOnSurface) return {way, (point_mm - q) / way, s.piece};
            return {s.distance_mm, s.normal, s.piece};
        }
        for (int i = 0; i < sides.count; ++i) {
            HalfSpace& side = sides.side[static_cast<std::size_t>(i)];
            const SurfaceSample t = field.sample_piece(side.piece, q);
            if (t.piece == side.piece && dot(t.normal, side.normal) > kAlike)
                side = {t.normal, dot(t.normal, q) - t.distance_mm, t.piece};
        }
        sides.put({s.normal, dot(s.normal, q) - s.distance_mm, s.piece}, kAlike);
        q = sides.nearest(point_mm);
    }
    return best;
}

}  // namespace tribo::contact
