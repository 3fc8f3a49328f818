// SPDX-License-Identifier: MIT
// The nearest surface to a point in air: followed from the last one, or searched in the bricks around.
#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "base/fixed_list.hpp"
#include "field/carved/field_query.hpp"
#include "field/carved/near_bricks.hpp"
#include "field/carved/nearest_places.hpp"
#include "field/carved/shown_surface.hpp"

namespace tribo::field {
namespace {

// A place counts as nearer only if it is nearer by more than this, mm.
constexpr double kOnSurface = 2e-5;
// Bricks leave out shapes whose surface others give within an error of searched sweeps: at the border of two
// bricks the surface has steps of this, mm. Where one shape gives the depth of a point, its surface is meant.
constexpr double kStep = 7e-5;
// A step that nothing notices, mm.
constexpr double kNoStep = 1e-6;
// A place that has moved by no more than this per way of its point is the same one.
constexpr double kKeeps = 2;
constexpr double kFar = 1e30;  // mm
// Searches for one point, and in one brick.
constexpr int kMostSearches = 24, kMostStarts = 10;
// Steps from a place that the grid shows down to the surface.
constexpr int kMostDown = 8;
// How much farther than the nearest place others are searched.
constexpr double kMarginCells = 0.1;
// A ball at a surface point is proven to be air by balls in the shapes that meet there, larger by the inverse
// of this share.
constexpr double kOfInnerBall = 0.9;
// Searches that pass the same place of an edge end at the same place, unless the edge comes nearer there by
// less than this share of its length: nearly round about the point, it has no clear end.
constexpr double kComesNearer = 5e-3;
// A search for a point this far away, in cells, ends at the same place if its way still comes nearer all
// along.
constexpr double kRemembered = 0.25;
// The longest way to an edge that is looked at, its parts, and how much less it may come nearer between two
// of them at least, in cells.
constexpr double kLongestWay = 8, kPart = 0.25, kLess = 0.05;
// So far beside an edge the surface belongs to the end of a search on it, in cells.
constexpr double kOwnBeside = 0.1;
// Longest step of a search along the surface, in cells. Grooves are two cells wide at least: a longer step
// may pass over the cusp beside the start.
constexpr double kLongestCells = 0.65;

// Whether the nearest place is another one than that of the hint, and not the same that has slid on.
bool has_leapt(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    // A place slides farther than its point on hollow surface only.
    constexpr double kTurned = 0.9, kSlides = 20;
    const Vec3 before = normalized(hint.from_mm - hint.at_mm, foot.sample.normal);
    return dot(before, foot.sample.normal) < kTurned ||
           distance(foot.at_mm, hint.at_mm) > kSameFoot + kSlides * distance(p, hint.from_mm);
}

// Forgets nothing of what was proven for the known places when another one than that of the hint is found:
// that becomes one of the others or, if there are too many, of all the rest.
void keep_margin(const contact::Foot& foot, Vec3 p, contact::NearHint& hint) {
    if (hint.sides.count == 0) hint.rest_mm = 0;  // of what, is not known
    if (hint.rest_mm <= 0) return;
    const double moved = distance(p, hint.proved_at_mm), last = distance(hint.from_mm, hint.at_mm);
    const std::span others(hint.other.data(), static_cast<std::size_t>(hint.others));
    const auto nearest_to = [&](Vec3 at) {
        return std::ranges::min_element(others, {},
                                        [at](const auto& one) { return distance(one.at_mm, at); });
    };
    const auto there = nearest_to(foot.at_mm);
    const double there_mm = there == others.end() ? kFar : distance(there->at_mm, foot.at_mm);
    if (there_mm >= distance(foot.at_mm, hint.at_mm) && !has_leapt(foot, p, hint)) return;
    const contact::KnownPlace left{hint.at_mm, hint.sides, last - distance(hint.from_mm, hint.proved_at_mm)};
    const auto same = nearest_to(left.at_mm);
    if (there_mm <= kSameFoot + kKeeps * moved) {
        *there = left;
    } else if (same != others.end() && distance(same->at_mm, left.at_mm) <= kSameFoot) {
        *same = left;
    } else if (others.size() < hint.other.size()) {
        hint.other[static_cast<std::size_t>(hint.others++)] = left;
    } else {
        hint.rest_mm = std::max(0.0, std::min(hint.rest_mm - moved, last - distance(p, hint.from_mm)));
        for (contact::KnownPlace& other : others) other.far_mm -= moved;
        hint.settled_mm -= moved;
        hint.proved_at_mm = p;
    }
}

// Whether a place is one of those of the hint and nearer than all that may be left. Material only ever
// disappears: surface that was farther away a short time ago still is.
bool is_nearer_than_rest(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    const double moved = distance(p, hint.proved_at_mm);
    return hint.rest_mm > 0 && moved < hint.settled_mm && foot.found &&
           foot.sample.distance_mm <= distance(p, hint.at_mm) + kOnSurface &&
           foot.sample.distance_mm - (hint.rest_mm - moved) <= kOnSurface;
}

// Whether none of the other places of the hint can be nearer.
bool is_nearer_than_others(const contact::Foot& foot, Vec3 p, const contact::NearHint& hint) {
    const double moved = distance(p, hint.proved_at_mm);
    const std::span others(hint.other.data(), static_cast<std::size_t>(hint.others));
    return std::ranges::all_of(others, [&](const contact::KnownPlace& other) {
        return foot.sample.distance_mm - (other.far_mm - moved) <= kOnSurface;
    });
}

// The material according to the brick around a point. If that brick is air or does not exist, one given brick
// is used instead, so that a point far from the surface still has a distance.
class NearBrick final : public contact::DistanceField {
  public:
    NearBrick(const FieldQuery& field, BrickRef ref) : field_(field), ref_(ref) {}
    double distance_mm(Vec3 p) const override { return field_.exact(around(p), p).distance_mm; }
    Vec3 normal(Vec3 p) const override { return sample(p).normal; }
    contact::SurfaceSample sample(Vec3 p) const override { return field_.sample_in(around(p), p); }
    contact::SurfaceSample sample_piece(std::uint32_t piece, Vec3 p) const override {
        return field_.sample_piece(piece, p);
    }

  private:
    BrickRef around(Vec3 p) const {
        const BrickCoord b = field_.brick_at(p);
        const BrickRef ref = field_.bricks.contains(b) ? field_.bricks.get(b) : kAir;
        return ref == kAir ? ref_ : ref;
    }
    const FieldQuery& field_;
    BrickRef ref_;
};

}  // namespace

// Returns true if a single shape of the brick proves that there is no material of the brick within the
// radius.
bool FieldQuery::is_clear(BrickRef ref, Vec3 p, double radius_mm) const {
    if (ref == kUntouched) return blank().distance_mm(p) >= radius_mm;
    const Brick& brick = (*pool)[ref];
    const auto clears = [&](ShapeId id) {
        return id == 0 ? blank().distance_mm(p) >= radius_mm
                       : shape(id).distance_below(p, -radius_mm) < -radius_mm;
    };
    const std::uint16_t likely = likely_in(brick, p);
    if (likely != Brick::kUnlisted && clears(brick.shapes[likely])) return true;
    for (std::size_t n = 0; n < brick.shapes.size(); ++n) {
        if (n != likely && clears(brick.shapes[n])) return true;
    }
    return false;
}

// Returns true if the ball around a point whose surface touches the foot point holds no material, by the
// shapes that meet there and no others. Let the point be at r m from the foot point, m = sum of a_k n_k with
// a_k >= 0 and n_k the normals of the shapes there. A place y (seen from the foot point) in the ball has
// y^2 < 2 r m y. Each shape holds a ball of radius rho that touches it there: outside of all of them
// y^2 >= 2 rho n_k y. Both at once needs rho < r sum of a_k. No bricks have to be searched then.
bool FieldQuery::is_nearest(const contact::Foot& foot) const {
    const double r = foot.sample.distance_mm;
    const contact::HalfSpaces::Cone cone = foot.sides.cone_to(foot.sample.normal);
    double sum = 0;
    for (const double weight : cone.weight) sum += weight;
    const double rho = r * sum / kOfInnerBall;
    // How much nearer a surface may be, as the sum misses m, and as the balls do not quite touch.
    double nearer = 0.5 * r * cone.miss * cone.miss / (1 - kOfInnerBall);
    for (std::size_t n = 0; n < static_cast<std::size_t>(cone.count) && nearer <= kOnSurface; ++n) {
        const contact::HalfSpace& side = foot.sides.side[static_cast<std::size_t>(cone.index[n])];
        const Vec3 centre = foot.at_mm + rho * side.normal;
        const double least = rho - kOnSurface,
                     inside = side.piece == 0 ? blank().distance_mm(centre)
                                              : -shape(side.piece).distance_below(centre, -least);
        if (inside <= least) return false;
        nearer += cone.weight[n] * std::max(0.0, rho - inside);
    }
    return cone.count > 0 && nearer <= kOnSurface;
}

// Over a cusp the grid shows a place in the air between its sides. Returns the surface behind it, seen from
// the point.
Vec3 FieldQuery::surface_behind(Vec3 shown, Vec3 p) const {
    const Vec3 ray = normalized(shown - p, Vec3{});
    for (int n = 0; n < kMostDown; ++n) {
        const double air_mm = distance_mm(shown);
        if (std::abs(air_mm) <= kOnSurface) break;
        shown += air_mm * ray;
    }
    return shown;
}

// The place below a point that is so deep in the piece: found if it is on the surface. The ball of this depth
// is air. Far from its surface a searched sweep may miss the depth by some 1e-5 mm: then once more from
// there.
contact::Foot FieldQuery::below(contact::SurfaceSample depth, Vec3 p) const {
    contact::Foot foot{depth, p - depth.distance_mm * depth.normal, {}, false};
    double off_mm = std::abs(distance_mm(foot.at_mm));
    if (off_mm > kNoStep && off_mm <= kStep) {
        const contact::SurfaceSample left = sample_piece(depth.piece, foot.at_mm);
        foot.at_mm -= left.distance_mm * left.normal;
        foot.sample.distance_mm = distance(p, foot.at_mm);
        foot.sample.normal = normalized(p - foot.at_mm, depth.normal);
        off_mm = std::abs(distance_mm(foot.at_mm));
    }
    // A brick that knows the piece knows where another one is deeper.
    foot.found = depth.distance_mm > 0 &&
                 (off_mm <= kNoStep || (off_mm <= kStep && !is_listed(depth.piece, foot.at_mm)));
    if (foot.found) foot.sides.put({foot.sample.normal, dot(foot.sample.normal, foot.at_mm), depth.piece}, 0);
    return foot;
}

bool FieldQuery::is_listed(ShapeId id, Vec3 p) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b) || bricks.get(b) < kFirstBrick) return false;
    const std::vector<ShapeId>& listed = (*pool)[bricks.get(b)].shapes;
    return std::find(listed.begin(), listed.end(), id) != listed.end();
}

// The nearest place on the pieces that met at the last one, and whether it is proven to be the nearest of
// all.
FieldQuery::Followed FieldQuery::follow(Vec3 p, Vec3 last_mm, const contact::HalfSpaces& sides,
                                        bool is_shallow) const {
    if (sides.count == 0) return {};
    for (int n = 0; n < sides.count; ++n) {
        if (!is_listed(sides.side[static_cast<std::size_t>(n)].piece, last_mm)) return {};
    }
    Vec3 start = sides.nearest(p);
    if (sides.count == 1) {
        if (!is_shallow) {
            const contact::Foot foot = below(sample_piece(sides.side[0].piece, p), p);
            if (foot.found) return {foot, true, false};
            start = foot.at_mm;
        }
    } else if (const auto edge = sides.edge_at(start); squared_length(edge.along) > 0) {
        start = sides.nearest_on_bend(p, edge, start, last_mm);
    }
    const NearBrick brick(*this, kAir);
    const contact::Foot foot = contact::along_edge(brick, p, contact::nearest_on(brick, p, start, sides));
    return {foot, foot.found && is_nearest(foot), sides.count == 1};
}

// The nearest place to one point, where following the last one does not prove it.
class FieldQuery::NearestSearch {
  public:
    NearestSearch(const FieldQuery& field, Vec3 p, double within_mm, contact::NearHint& hint)
        : field_(field), p_(p), within_mm_(within_mm), hint_(hint), found_(within_mm) {}

    contact::Foot from(const contact::Foot& known);

  private:
    bool is_proven_beyond(double mm) const { return is_proven_ || found_.distance_mm() - mm <= kOnSurface; }
    std::optional<contact::Foot> search(BrickRef ref, Vec3 from);
    std::optional<contact::Foot> search_at(Vec3 from);
    bool is_among_known();
    std::optional<contact::Foot> remembered(SeenPlace& start);
    std::optional<contact::Foot> search_from(SeenPlace& start, BrickRef ref);
    double comes_nearer_mm(Vec3 from, Vec3 to, Vec3 edge) const;
    contact::Foot among_bricks(contact::SurfaceSample lower);

    const FieldQuery& field_;
    const Vec3 p_;
    const double within_mm_;
    contact::NearHint& hint_;
    NearestPlaces found_;
    bool is_proven_ = false;     // the best one is the nearest
    contact::Trail trail_;       // of the last search
    Vec3 refuted_{1e300, 0, 0};  // the last foot point that was not on the surface
};

contact::Foot FieldQuery::NearestSearch::from(const contact::Foot& known) {
    if (known.found) {
        found_.put(known);
        if (is_among_known()) return found_.best();
    }
    // There is no material inside a shape that was carved. The depth of the point in it is therefore a lower
    // bound of the distance, which a surface point can reach; on a smooth piece one does.
    const BrickCoord here = field_.brick_at(p_), there = field_.brick_at(hint_.at_mm);
    contact::SurfaceSample lower{0, {0, 0, 1}, 0};
    for (const BrickCoord b : {here, there}) {
        if (!field_.bricks.contains(b) || field_.bricks.get(b) == kAir) continue;
        const Exact e = field_.exact(field_.bricks.get(b), p_);
        const contact::SurfaceSample s{e.distance_mm, field_.outward(e.shape, p_), e.shape};
        if (s.distance_mm >= within_mm_) return {s, p_, {}};
        if (s.distance_mm <= 0) {
            if (b == here) return {s, p_, {}};
            continue;
        }
        if (const contact::Foot foot = field_.below(s, p_); foot.found) {
            keep_margin(foot, p_, hint_);
            return foot;
        }
        if (s.distance_mm > lower.distance_mm) lower = s;
        if (here == there) break;
    }
    if (!known.found) {
        (void)search_at(hint_.at_mm + (p_ - hint_.from_mm));
        if (is_among_known()) return found_.best();
    }
    // In a corner of the material both sides are near.
    if (!is_proven_beyond(lower.distance_mm) && lower.distance_mm > 0)
        (void)search_at(p_ - lower.distance_mm * lower.normal);
    if (is_proven_beyond(lower.distance_mm)) {
        keep_margin(found_.best(), p_, hint_);
        return found_.best();
    }
    return among_bricks(lower);
}

// From a place, in one brick.
std::optional<contact::Foot> FieldQuery::NearestSearch::search(BrickRef ref, Vec3 from) {
    std::optional<contact::Foot> last;
    for (int tries = 0; tries < 2; ++tries) {
        ++hint_.searches;
        const NearBrick brick(field_, ref);
        const contact::Foot foot =
            contact::nearest_from(brick, p_, from, kLongestCells * field_.cell_mm, &trail_);
        const contact::SurfaceSample at_foot = field_.sample(foot.at_mm);
        if (foot.found && std::abs(at_foot.distance_mm) <= kOnSurface) {
            found_.put(foot);
            is_proven_ = is_proven_ || field_.is_nearest(foot);
            last = foot;
            // What was reached by following the surface may be a little off: once more from there.
            if (foot.sides.count > 0) break;
            from = foot.at_mm;
            continue;
        }
        // The shapes of one brick may leave material where another brick has air. Continue from the true
        // surface.
        if (squared_length(foot.at_mm - refuted_) < kOnSurface * kOnSurface) break;
        refuted_ = foot.at_mm;
        from = foot.at_mm - at_foot.distance_mm * at_foot.normal;
        const BrickCoord b = field_.brick_at(from);
        if (!field_.bricks.contains(b) || field_.bricks.get(b) == kAir) break;
        ref = field_.bricks.get(b);
    }
    return last;
}

std::optional<contact::Foot> FieldQuery::NearestSearch::search_at(Vec3 from) {
    const BrickCoord b = field_.brick_at(from);
    if (!field_.bricks.contains(b) || field_.bricks.get(b) == kAir) return std::nullopt;
    return search(field_.bricks.get(b), from);
}

// Whether the nearest place is one of those of the hint: then it is found. Each must still be there: not
// beyond the point that was nearest before.
bool FieldQuery::NearestSearch::is_among_known() {
    if (found_.none()) return false;
    keep_margin(found_.best(), p_, hint_);
    if (!is_nearer_than_rest(found_.best(), p_, hint_)) return false;
    const double moved_mm = distance(p_, hint_.proved_at_mm);
    const contact::Foot first = found_.best();
    int nearest = -1;
    for (int n = 0; n < hint_.others; ++n) {
        contact::KnownPlace& other = hint_.other[static_cast<std::size_t>(n)];
        if (found_.distance_mm() - (other.far_mm - moved_mm) <= kOnSurface) continue;
        // A place on a smooth side may slide over its edge: only an edge is followed.
        contact::Foot foot;
        if (other.sides.count > 1) foot = field_.follow(p_, other.at_mm, other.sides, false).foot;
        if (foot.found && foot.sides.count > 1)
            found_.put(foot);
        else if (const auto searched = search_at(other.at_mm))
            foot = *searched;
        if (!foot.found || foot.sample.distance_mm > distance(p_, other.at_mm) + kOnSurface) return false;
        other.far_mm = foot.sample.distance_mm - moved_mm;
        const auto is_there = [&](Vec3 at_mm) { return distance(foot.at_mm, at_mm) <= kSameFoot; };
        const std::span before(hint_.other.data(), static_cast<std::size_t>(n));
        if (is_there(first.at_mm) ||
            std::ranges::any_of(before, [&](const auto& one) { return is_there(one.at_mm); })) {
            // What has led to a known place may come to be one of its own again.
            if (other.sides.count < 2 && !is_there(other.at_mm)) return false;
            continue;
        }
        other.at_mm = foot.at_mm;
        other.sides = foot.sides;
        if (found_.best().at_mm == foot.at_mm) nearest = n;
    }
    if (nearest >= 0)
        hint_.other[static_cast<std::size_t>(nearest)] = {first.at_mm, first.sides,
                                                          first.sample.distance_mm - moved_mm};
    return true;
}

// The end of an earlier search from a start, if it is the end for this point too.
std::optional<contact::Foot> FieldQuery::NearestSearch::remembered(SeenPlace& start) {
    if (!hint_.memory) return std::nullopt;
    contact::SearchMemory::Search& last = hint_.memory->from(start.at);
    const double moved_mm = distance(p_, last.point_mm);
    if (last.sides.count == 0 || last.start_mm != start.at || last.change != field_.change ||
        moved_mm > std::min(kRemembered * field_.cell_mm, last.lasts_mm) ||
        last.trail.lasts_mm(p_) <= kComesNearer * distance(p_, last.end_mm))
        return std::nullopt;
    contact::Foot foot = field_.follow(p_, last.end_mm, last.sides, false).foot;
    if (foot.found && foot.sides.count > 1) {
        found_.put(foot);
        is_proven_ = is_proven_ || field_.is_nearest(foot);
    } else if (const auto searched = search_at(last.end_mm)) {
        foot = *searched;
    } else {
        return std::nullopt;
    }
    if (distance(foot.at_mm, last.end_mm) > field_.cell_mm) return std::nullopt;
    trail_ = last.trail;
    start.lasts_mm = last.lasts_mm - moved_mm;
    last.end_mm = foot.at_mm;
    last.sides = foot.sides;
    return foot;
}

// From a place that the grid shows, in a brick.
std::optional<contact::Foot> FieldQuery::NearestSearch::search_from(SeenPlace& start, BrickRef ref) {
    if (const auto known = remembered(start)) return known;
    trail_ = {};
    const Vec3 from = field_.surface_behind(start.at, p_);
    const std::optional<contact::Foot> foot = search(ref, from);
    if (!foot) return foot;
    trail_.lead_to(foot->at_mm, field_.cell_mm, p_);
    const std::span passed = trail_.all();
    start.lasts_mm = passed.empty()
                         ? comes_nearer_mm(from, foot->at_mm, foot->sides.edge_at(foot->at_mm).along)
                         : comes_nearer_mm(from, passed.front().at_mm, Vec3{});
    if (hint_.memory && foot->sides.count > 1)
        hint_.memory->from(start.at) = {start.at,    p_,          start.lasts_mm, trail_,
                                        foot->at_mm, foot->sides, field_.change};
    return foot;
}

// Over this way of the point, mm, the surface comes nearer to it all along from one place to another, except
// beside the edge on which that is an end (`edge`, or zero).
double FieldQuery::NearestSearch::comes_nearer_mm(Vec3 from, Vec3 to, Vec3 edge) const {
    const Vec3 way = to - from;
    const double cells = length(way) * field_.per_cell;
    if (cells > kLongestWay) return 0;
    const int parts = static_cast<int>(std::ceil(cells / kPart));
    double lasts = SeenPlace::kUnlimited, before_mm = 0;
    for (int n = 0; n < parts && lasts > 0; ++n) {
        Vec3 at = from + ((n + 0.5) / parts) * way;
        const contact::SurfaceSample s = field_.sample(at);
        at -= s.distance_mm * s.normal;
        const Vec3 left = (to - at) * field_.per_cell;
        const double along = dot(left, edge);
        if (std::abs(along) < kOwn && length(left - along * edge) < kOwnBeside) break;
        const double nearer_mm = dot(p_ - at, normalized(way - dot(way, s.normal) * s.normal, Vec3{}));
        // Between two of these it may be less.
        const double less_mm = n == 0 ? kPart * field_.cell_mm
                                      : std::max(kLess * field_.cell_mm, std::abs(nearer_mm - before_mm));
        lasts = std::min(lasts, std::max(0.0, nearer_mm - less_mm));
        before_mm = nearer_mm;
    }
    return lasts;
}

// At a cusp: the nearest surface point of each brick that may contain one, from the nearest brick on, which
// is the most likely.
contact::Foot FieldQuery::NearestSearch::among_bricks(contact::SurfaceSample lower) {
    hint_.rest_mm = 0;
    hint_.others = 0;
    bool doubt = false;
    // Up to `proven` no brick that is not listed can be nearer.
    const auto reach = [&] {
        return std::min(found_.distance_mm() + kMarginCells * field_.cell_mm, within_mm_);
    };
    NearBricks bricks_near(field_, field_.brick_at(p_), p_, reach());
    const double proven = bricks_near.seen_mm();
    BrickCoord b;
    double way = 0;
    int searches = 0;
    bool all_looked = true;
    // Start and end points of the searches, and places of the edges that they passed.
    constexpr std::size_t kMostPassed = 200;
    FixedList<SeenPlace, kMostPassed + 2 * kMostSearches + 2 + contact::NearHint::kMostOthers> seen;
    ShownSurface shown(field_, p_);
    const auto place_of = [](const contact::Foot& foot) -> SeenPlace {
        return {foot.at_mm, foot.sample.normal, foot.sides.edge_at(foot.at_mm).along, true};
    };
    for (const contact::Foot& foot : found_.all()) seen.put(place_of(foot));
    contact::SurfaceSample nearest_box{within_mm_, {0, 0, 1}, 0};
    while (bricks_near.take(reach(), b, way)) {
        const BrickRef ref = field_.bricks.get(b);
        if (field_.is_clear(ref, p_, reach())) continue;
        if (way < nearest_box.distance_mm)
            nearest_box = {way, (p_ - clamped(field_.box(b), p_)) / std::max(way, kOnSurface), 0};
        // Start where the grid shows the surface, once for each cusp: two cusps in one brick are two places.
        ++hint_.searches;
        shown.look_at(b, reach());
        SeenPlace start;
        for (int n = 0; shown.take(reach(), seen, start); ++n) {
            if (n == kMostStarts) {
                all_looked = false;
                break;
            }
            if (++searches > kMostSearches) break;
            const std::optional<contact::Foot> foot = search_from(start, ref);
            if (is_proven_) return found_.best();
            if (!foot) {
                doubt = true;
                break;  // the other cusps of this brick would fail too
            }
            // It went on over the edge of a rib: another start leads to what is nearest here.
            if (foot->sample.distance_mm > distance(p_, start.at) + field_.cell_mm) continue;
            const SeenPlace end = place_of(*foot);
            start.along = end.along;
            start.lasts_mm = std::min(start.lasts_mm, trail_.lasts_mm(p_));
            seen.put(start);
            seen.put(end);
            for (const contact::Trail::Place& passed : trail_.all()) {
                if (seen.size() >= kMostPassed) break;
                SeenPlace on_way = end;
                on_way.at = passed.at_mm;
                on_way.along = passed.along;
                on_way.normal = normalized(p_ - passed.at_mm, end.normal);
                on_way.lasts_mm = dot(p_ - passed.at_mm, passed.along);
                if (on_way.lasts_mm >= kComesNearer * distance(p_, passed.at_mm)) seen.put(on_way);
            }
        }
        if (searches > kMostSearches) {
            all_looked = false;
            break;
        }
    }
    // A search may have failed on surface that the shapes of other bricks removed. This is accepted if
    // another search succeeded.
    if (!(doubt && found_.none()) && found_.distance_mm() <= proven + kOnSurface) {
        if (all_looked && shown.is_whole() && !doubt && !found_.none()) {
            hint_.proved_at_mm = p_;
            hint_.rest_mm = std::min({found_.rest_mm(), reach(), proven});
            for (const contact::Foot& foot : found_.all().subspan(1))
                hint_.other[static_cast<std::size_t>(hint_.others++)] = {foot.at_mm, foot.sides,
                                                                         foot.sample.distance_mm};
            hint_.settled_mm = shown.settled_mm(reach() - found_.distance_mm(), found_.distance_mm(), seen);
        }
        return found_.best();
    }
    // Not proven to be the nearest: return what is known of the distance.
    if (nearest_box.distance_mm > lower.distance_mm && nearest_box.distance_mm < proven) lower = nearest_box;
    if (nearest_box.distance_mm >= proven && proven > lower.distance_mm)
        lower = {proven, lower.normal, lower.piece};
    const double outside = field_.blank().distance_mm(p_);
    if (outside > lower.distance_mm) lower = {outside, field_.blank().gradient(p_), 0};
    return {lower, p_, {}};
}

contact::SurfaceSample FieldQuery::nearest(Vec3 p, double within_mm, contact::NearHint& hint) const {
    const Followed known = follow(p, hint.at_mm, hint.sides, hint.is_shallow);
    if (known.is_proven) keep_margin(known.foot, p, hint);
    const bool is_known = known.is_proven || (is_nearer_than_rest(known.foot, p, hint) &&
                                              is_nearer_than_others(known.foot, p, hint));
    const contact::Foot foot =
        is_known ? known.foot : NearestSearch(*this, p, within_mm, hint).from(known.foot);
    if (foot.found) {
        hint.at_mm = foot.at_mm;
        hint.from_mm = p;
    }
    const bool is_of_same = hint.sides.count == 1 && foot.sides.count == 1 &&
                            hint.sides.side[0].piece == foot.sides.side[0].piece;
    hint.is_shallow = known.is_shallow && is_of_same;
    hint.sides = foot.sides;
    return foot.sample;
}

}  // namespace tribo::field
