// SPDX-License-Identifier: MIT
// The search for the nearest surface to one point in air, in the bricks around it.
#pragma once

#include <optional>

#include "field/carved/field_query.hpp"
#include "field/carved/nearest_places.hpp"
#include "field/carved/shown_surface.hpp"

namespace tribo::field {

// The material according to the brick around a point. If that brick is air or does not exist, one given brick
// is used instead, so that a point far from the surface still has a distance. The material may be made
// thinner on all sides.
class NearBrick final : public contact::DistanceField {
  public:
    NearBrick(const FieldQuery& field, BrickRef ref, double thinner_mm = 0)
        : field_(field), ref_(ref), thinner_mm_(thinner_mm) {}
    double distance_mm(Vec3 p) const override { return field_.exact(around(p), p).distance_mm + thinner_mm_; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override { return thinner(field_.sample_in(around(p), p)); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return thinner(field_.sample_piece(piece, p));
    }

  private:
    contact::SurfaceSample thinner(contact::SurfaceSample s) const {
        s.distance_mm += thinner_mm_;
        return s;
    }
    BrickRef around(Vec3 p) const {
        const BrickCoord b = field_.brick_at(p);
        const BrickRef ref = field_.bricks.contains(b) ? field_.bricks.get(b) : kAir;
        return ref == kAir ? ref_ : ref;
    }
    const FieldQuery& field_;
    BrickRef ref_;
    double thinner_mm_;
};

// The nearest place to one point, where following the last one does not prove it. For one search each.
class FieldQuery::NearestSearch {
  public:
    NearestSearch(const FieldQuery& field, Vec3 p, double within_mm, contact::NearHint& hint)
        : field_(field), p_(p), within_mm_(within_mm), hint_(hint), found_(within_mm) {}

    // From the place that following led to, if that was found. Not found: a lower bound of the distance.
    contact::Foot from(const contact::Foot& known);

  private:
    bool is_proven_beyond(double mm) const {
        return is_proven_ || found_.distance_mm() - mm <= kSameDistance;
    }
    std::optional<contact::Foot> search(BrickRef ref, Vec3 from, double thinner_mm = 0);
    std::optional<contact::Foot> search_at(Vec3 from);
    bool is_among_known();
    std::optional<contact::Foot> remembered(SeenPlace& start);
    std::optional<contact::Foot> search_from(SeenPlace& start, BrickRef ref);
    std::optional<contact::Foot> search_between(Vec3 wall, Vec3 air, BrickRef ref);
    std::optional<contact::Foot> around(Vec3 wall, BrickRef ref);
    double comes_nearer_mm(Vec3 from, Vec3 to, Vec3 edge) const;
    double falls_to_mm(const contact::Foot& foot, Vec3 from) const;
    const contact::Foot* found_below(Vec3 from) const;
    contact::Foot among_bricks(contact::SurfaceSample lower);

    const FieldQuery& field_;
    const Vec3 p_;
    const double within_mm_;
    contact::NearHint& hint_;
    NearestPlaces found_;
    bool is_proven_ = false;     // the best one is the nearest
    contact::Trail trail_;       // of the last search
    Vec3 refuted_{1e300, 0, 0};  // the last foot point that was not on the surface
    // Where the last search ended, if not at a place with material behind the surface.
    std::optional<Vec3> lost_mm_;
    bool near_gaps_ = false;  // one of all searches did, or began between two sides with air between them
};

}  // namespace tribo::field
