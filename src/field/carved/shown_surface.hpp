// SPDX-License-Identifier: MIT
// The surface around a point as the nodes of the grid show it: where searches for the nearest place start.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/fixed_list.hpp"
#include "field/carved/field_query.hpp"

namespace tribo::field {

// A place on the surface, as a node shows it, or where a search ended or passed.
struct SeenPlace {
    Vec3 at, normal;
    Vec3 along;           // of the edge to which a search led from there; zero if to none
    bool ended = false;   // a search ended or passed there
    ShapeId shape = 0;    // that gives the distance at the node
    bool corner = false;  // the node is near a corner: the place may be in the air before it
    // How far the point may move, as long as what is known holds: the search from there, or past there, leads
    // to the same end.
    double lasts_mm = kUnlimited;
    static constexpr double kUnlimited = 1e30;
};

// Surface so near to the end of a search belongs to it, in cells.
inline constexpr double kOwn = 1.5;

// A node near the surface, and the place that it shows.
struct ShownPlace {
    SeenPlace place;
    double way_mm;  // from the point
    BrickCoord brick;
    int node[3];  // node[0] < 0: the place is on the face of the blank, not shown by a node
};

// Looks at one brick after another. Allocates nothing: it is about 90 kB large.
class ShownSurface {
  public:
    // `memory` of other searches in the same field, or null.
    ShownSurface(const FieldQuery& field, Vec3 point_mm, contact::SearchMemory* memory)
        : field_(&field), memory_(memory), point_(point_mm) {}

    // Sees all places of a brick near which the surface may be less than `within_mm` away from the point, and
    // forgets those of the brick before that were not taken.
    void look_at(BrickCoord brick, double within_mm);
    // Takes the nearest place near which the surface may be less than `within_mm` away, that is not alike to
    // one of `but` and from which the surface does not come nearer towards another place; or one whose side
    // is nearer than `nearest`, the nearest place that was found. Returns false if there is none.
    bool take(double within_mm, const contact::Foot& nearest, std::span<const SeenPlace> but,
              SeenPlace& place);
    // How far the nearest other side is that was passed over, since a search has led from there to `nearest`.
    double other_side_mm() const { return other_side_mm_; }
    // Leaves out places between two sides with air all the way from one to the other (FieldQuery::wall_at),
    // from now on.
    void leave_out_gaps() { no_gaps_ = true; }
    // False if there were more places than could be kept. The nearest ones are.
    bool is_whole() const { return whole_; }
    // How far the point may move, up to `most_mm`, until a place that is not seen may become the nearest of
    // its neighbourhood, and nearer than the nearest place, which is `nearest_mm` away. `seen`: what take()
    // was given.
    double settled_mm(double most_mm, double nearest_mm, std::span<const SeenPlace> seen) const;

  private:
    void put(const ShownPlace& one);
    bool see(BrickCoord brick, int a, int b, int c, ShownPlace& shown) const;
    Vec3 normal_at(BrickCoord brick, int index, ShapeId shape, Vec3 node) const;
    Vec3 along_surface(const SeenPlace& place) const;
    bool none_nearer(const SeenPlace& place, double than_mm) const;
    template <class IsEnough>
    bool visit_nearer(const ShownPlace& from, IsEnough&& is_enough) const;
    bool leads_to(const SeenPlace& place, const SeenPlace& seen) const;
    bool is_left_out(const SeenPlace& place) const { return no_gaps_ && !field_->wall_at(place.at, memory_); }
    bool comes_nearer(const ShownPlace& from) const;
    double around_cells() const;
    std::optional<double> side_mm(const SeenPlace& place, double least_mm, double most_mm) const;
    double steepest_fall_mm(const ShownPlace& from, double enough_mm) const;

    const FieldQuery* field_;
    contact::SearchMemory* memory_;
    Vec3 point_;
    FixedList<ShownPlace, 192> here_;    // of the last brick, not taken yet
    FixedList<ShownPlace, 384> passed_;  // taken or passed over
    struct KnownNormal {
        BrickCoord brick;
        int index;
        Vec3 normal;
    };
    // Some of the normals that shapes have told, and the number of each by its place in the grid, from 1 on.
    mutable FixedList<KnownNormal, 255> known_;
    mutable std::array<std::uint8_t, 256> known_at_{};
    bool whole_ = true, no_gaps_ = false;
    double other_side_mm_ = SeenPlace::kUnlimited;
};

}  // namespace tribo::field
