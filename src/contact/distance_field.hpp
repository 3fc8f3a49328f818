// SPDX-License-Identifier: MIT
// What a probe may ask of a surface, whoever made it: the stock while it is cut, a part that was read, a flat
// pad.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/vec3.hpp"

namespace tribo::contact {

// Distance and direction in one answer.
struct SurfaceSample {
    double distance_mm = 0;   // negative in material
    Vec3 normal{0, 0, 1};     // unit, out of the material
    std::uint32_t piece = 0;  // which smooth part of the surface answered, where the field knows
};

// What is known of the surface near a point that moves a little from query to query.
struct NearHint {
    Vec3 at_mm;  // a guess at the nearest surface point
    // From here all of the surface but that place was farther than this; 0: not known.
    Vec3 proved_at_mm;
    double others_mm = 0;
};

// Distances in mm, negative inside material. Implementations answer in bounded time without allocation or
// locks, from any number of threads while nobody changes the field.
class DistanceField {
  public:
    virtual ~DistanceField() = default;
    // The zero set is the exact surface; off it the value is a lower bound of the distance with slope at
    // most 1.
    virtual double distance_mm(Vec3 point_mm) const = 0;
    // Unit direction of steepest increase (out of the material), at or near the surface.
    virtual Vec3 normal(Vec3 point_mm) const = 0;

    // Both of them.
    virtual SurfaceSample sample(Vec3 point_mm) const { return {distance_mm(point_mm), normal(point_mm), 0}; }

    // The distance to one piece, as if it went on beyond its edges; any other piece's where that is not
    // known.
    virtual SurfaceSample sample_piece(std::uint32_t /*piece*/, Vec3 point_mm) const {
        return sample(point_mm);
    }

    // Radius of a ball around the point that holds no material, up to `enough_mm` (more may be given): what a
    // probe may travel without looking. Far from the surface too; 0 or less in material.
    virtual double clearance_mm(Vec3 point_mm, double /*enough_mm*/) const { return distance_mm(point_mm); }

    // From a point in air the true distance to the material, cusps included, where that is below `within_mm`
    // (else anything from there up), and the direction from the nearest surface point. The hint may be made
    // better for the next query; what it says stays true where material is removed. Here by search from the
    // hint (nearest_from), for fields that measure well as far as a probe's radius.
    virtual SurfaceSample nearest(Vec3 point_mm, double within_mm, NearHint& hint) const;
};

// The surface point nearest to `point_mm` (in air) in the neighbourhood of `start_mm`, by cutting planes: the
// material near it is the intersection of half-spaces, one for each piece met, each renewed where the last
// answer lay. Exact on edges and corners. Real-time safe, at most 16 rounds of a sample and the pieces met;
// where that is not enough, a lower bound of the distance. It goes there in steps of at most `longest_mm`:
// pieces that bend must be met where they meet each other.
SurfaceSample nearest_from(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, double longest_mm = 1e9);

}  // namespace tribo::contact
