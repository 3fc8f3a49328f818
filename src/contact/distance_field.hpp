// SPDX-License-Identifier: MIT
// The queries of a probe to any surface: the stock while it is cut, a part read from a file, a flat pad.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "base/vec3.hpp"
#include "contact/half_spaces.hpp"

namespace tribo::contact {

class SearchMemory;  // search_memory.hpp

// Distance and direction in one answer.
struct SurfaceSample {
    double distance_mm = 0;   // negative in material
    Vec3 normal{0, 0, 1};     // unit, out of the material
    std::uint32_t piece = 0;  // the smooth part of the surface that gave the result, if the field knows it
    float way_per_mm = 1;     // along the normal per mm that the distance grows; at least 1

    // To the surface along the normal, as far as the surface is flat.
    double way_mm() const { return distance_mm * static_cast<double>(way_per_mm); }
};

// Places of edges that a search has passed on its way to the nearest one, in the order of the way: the first
// of them.
class Trail {
  public:
    struct Place {
        Vec3 at_mm, along;  // `along`: of the edge, unit
    };
    void put(const Place& one) {
        if (count_ < place_.size()) place_[count_++] = one;
    }
    std::span<const Place> all() const { return {place_.data(), count_}; }
    // Leaves out the places less than `near_mm` from the end of the search, and turns the edges along the
    // way. `along` is zero where an edge does not come nearer to the point that way.
    void lead_to(Vec3 end_mm, double near_mm, Vec3 point_mm);
    // After that: over this way of the point, mm, the edges still come nearer to it at all places.
    double lasts_mm(Vec3 point_mm) const;

  private:
    std::array<Place, 32> place_;
    std::size_t count_ = 0;
};

// A place of the surface that is nearest to a point in its own neighbourhood, as a query found it.
struct KnownPlace {
    Vec3 at_mm;
    HalfSpaces sides;   // tangent planes of the pieces that met there
    double far_mm = 0;  // its least distance from NearHint::proved_at_mm
};

// Knowledge of the surface near a point that moves a little from query to query.
struct NearHint {
    Vec3 at_mm;    // a guess at the nearest surface point
    Vec3 from_mm;  // the point that it was for
    // Tangent planes of the pieces that met there. is_shallow: there is one, and the distance to it is less
    // than the way.
    HalfSpaces sides;
    bool is_shallow = false;
    // The next nearest places.
    static constexpr int kMostOthers = 6;
    std::array<KnownPlace, kMostOthers> other;
    int others = 0;
    // Seen from proved_at_mm, all of the surface except these places was farther than rest_mm; 0: not known.
    Vec3 proved_at_mm;
    double rest_mm = 0;
    // Until it has moved so far from there, no other place can come to be nearest in its neighbourhood.
    double settled_mm = 0;
    // Searches along the surface that the queries with this hint have made, and bricks they have looked at
    // for where to start. Each takes some microseconds.
    long searches = 0;
    // Of these and other queries of the same field; null: none.
    SearchMemory* memory = nullptr;
};

// Distances in mm, negative inside material. Implementations answer in bounded time without allocation or
// locks, on any number of threads while the field does not change.
class DistanceField {
  public:
    virtual ~DistanceField() = default;
    // The zero set is the exact surface. Away from it the value is a lower bound of the distance with slope
    // at most 1.
    virtual double distance_mm(Vec3 point_mm) const = 0;
    // Unit direction of steepest increase (out of the material), at or near the surface.
    virtual Vec3 normal(Vec3 point_mm) const = 0;

    // Returns both of them.
    virtual SurfaceSample sample(Vec3 point_mm) const { return {distance_mm(point_mm), normal(point_mm), 0}; }

    // Returns the distance to one piece as if it continued beyond its edges, or the distance to another piece
    // if this is not known.
    virtual SurfaceSample sample_piece(std::uint32_t /*piece*/, Vec3 point_mm) const {
        return sample(point_mm);
    }

    // Returns the radius of a ball around the point without material, up to `enough_mm` (or more): a probe
    // may travel this far without another query. Also valid far from the surface; 0 or less in material.
    virtual double clearance_mm(Vec3 point_mm, double /*enough_mm*/) const { return distance_mm(point_mm); }

    // For a point in air: returns the true distance to the material, cusps included, if it is below
    // `within_mm` (else any value from there up), and the direction from the nearest surface point. May
    // improve the hint for the next query; the hint stays valid when material is removed. This default
    // searches from the hint (nearest_from). It is for fields whose distances are accurate as far as a
    // probe's radius.
    virtual SurfaceSample nearest(Vec3 point_mm, double within_mm, NearHint& hint) const;
};

// A thinner wall is none, mm. Where two cuts meet, or a cut and a face of the blank, its thickness is 0 but
// for rounding.
inline constexpr double kThinnestWall = 1e-3;

// True if there is material behind a place of the surface, or a little aside behind it, as on an edge. False
// on a wall that is none. One query, up to 19 on an edge.
bool has_material_behind(const DistanceField& field, Vec3 at_mm, Vec3 normal);
// Deeper in material than this is no rounding, mm.
inline constexpr double kInward = 0.02 * kThinnestWall;
// Of the distance kThinnestWall behind a place of the surface: whether that is in material.
inline bool falls_inward(double distance_mm) {
    return distance_mm < -kInward;
}

// A surface point that is nearest to a point in its neighbourhood.
struct Foot {
    SurfaceSample sample;  // of the point; not found: a lower bound of the distance
    Vec3 at_mm;
    HalfSpaces sides;  // tangent planes of the pieces that meet there, as far as they are known
    bool found = false;
};

// Finds the surface point nearest to `point_mm` (in air) in the neighbourhood of `start_mm`, by cutting
// planes. The material near it is the intersection of half-spaces, one for each piece found; each is renewed
// at the last result. Exact on edges and corners. At most 16 rounds of one sample and the pieces found; if
// these are not enough, it follows the surface down in at most 24 steps. Out of a hollow that is nearly round
// about the point it does the same to both sides. If nothing is found, returns a lower bound of the distance.
// Real-time safe. The steps of the rounds are at most `longest_mm` long, because curved pieces must be found
// where they meet each other. Adds the places of edges that it passes to `trail`.
Foot nearest_from(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, double longest_mm = 1e9,
                  Trail* trail = nullptr);

// The same for a place on pieces that are known, from a start near it: asks the field for others only where
// these do not lead to the surface, and gives up where nearest_from goes on to search.
Foot nearest_on(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, const HalfSpaces& pieces);

// From a place on an edge: where that bends about the point nearly as a circle does, it hardly comes nearer
// over a long way, and the searches end too early. Follows it to its nearest place, and learns the bends of
// its sides. Any other place stays as it is. nearest_from does so itself. Adds the places on the way to
// `trail`.
Foot along_edge(const DistanceField& field, Vec3 point_mm, Foot foot, Trail* trail = nullptr);

}  // namespace tribo::contact
