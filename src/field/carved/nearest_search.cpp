// SPDX-License-Identifier: MIT
#include "field/carved/nearest_search.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "base/fixed_list.hpp"
#include "contact/search_memory.hpp"
#include "field/carved/near_bricks.hpp"
#include "field/carved/near_margin.hpp"

namespace tribo::field {
namespace {

// Searches for one point, and in one brick.
constexpr int kMostSearches = 24, kMostStarts = 10;
// How much farther than the nearest place others are searched.
constexpr double kMarginCells = 0.1;
// Searches that pass the same place of an edge end at the same place, unless the edge comes nearer there by
// less than this share of its length: nearly round about the point, it has no clear end.
constexpr double kComesNearer = 5e-3;
// A search for a point this far away, in cells, ends at the same place, on an edge or on one side, if its way
// still comes nearer all along.
constexpr double kOnEdge = 0.25, kOnSide = 1;
// The longest way to an edge that is looked at, its parts, and how much less it may come nearer between two
// of them at least, in cells.
constexpr double kLongestWay = 8, kPart = 0.25, kLess = 0.05;
// So far beside an edge the surface belongs to the end of a search on it, in cells.
constexpr double kOwnBeside = 0.1;
// A wall that is none vanishes when the material is made thinner by this on all sides, mm.
constexpr double kThinner = 0.5 * contact::kThinnestWall;
// Longest step of a search along the surface, in cells. Grooves are two cells wide at least: a longer step
// may pass over the cusp beside the start.
constexpr double kLongestCells = 0.65;

}  // namespace

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
    if (!is_proven_beyond(lower.distance_mm) && lower.distance_mm > 0) {
        const Vec3 below = p_ - lower.distance_mm * lower.normal;
        if (!found_below(below)) (void)search_at(below);
    }
    if (is_proven_beyond(lower.distance_mm)) {
        keep_margin(found_.best(), p_, hint_);
        return found_.best();
    }
    const bool knew_gaps = near_gaps_;
    contact::Foot foot = among_bricks(lower);
    if (near_gaps_ && !knew_gaps && !is_proven_) foot = among_bricks(lower);
    return foot;
}

// From a place, in one brick. Of material that is thinner by so much on all sides, if that is asked for.
std::optional<contact::Foot> FieldQuery::NearestSearch::search(BrickRef ref, Vec3 from, double thinner_mm) {
    std::optional<contact::Foot> last;
    lost_mm_.reset();
    for (int tries = 0; tries < 2; ++tries) {
        ++hint_.searches;
        const NearBrick brick(field_, ref, thinner_mm);
        const contact::Foot foot =
            contact::nearest_from(brick, p_, from, kLongestCells * field_.cell_mm, &trail_);
        contact::SurfaceSample at_foot = field_.sample(foot.at_mm);
        at_foot.distance_mm += thinner_mm;
        if (foot.found && std::abs(at_foot.distance_mm) <= kSameDistance) {
            if (field_.is_skin(foot)) {
                lost_mm_ = foot.at_mm;
                near_gaps_ = true;
                break;
            }
            found_.put(foot);
            is_proven_ = is_proven_ || field_.is_nearest(foot);
            last = foot;
            // What was reached by following the surface may be a little off: once more from there.
            if (foot.sides.count > 0) break;
            from = foot.at_mm;
            continue;
        }
        lost_mm_ = foot.at_mm;
        // The shapes of one brick may leave material where another brick has air. Continue from the true
        // surface.
        if (squared_length(foot.at_mm - refuted_) < kSameDistance * kSameDistance) break;
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
        if (found_.distance_mm() - (other.far_mm - moved_mm) <= kSameDistance) continue;
        // A place on a smooth side may slide over its edge: only an edge is followed.
        contact::Foot foot;
        if (other.sides.count > 1) foot = field_.follow(p_, other.at_mm, other.sides, false).foot;
        if (foot.found && foot.sides.count > 1)
            found_.put(foot);
        else if (const auto searched = search_at(other.at_mm))
            foot = *searched;
        if (!foot.found || foot.sample.distance_mm > distance(p_, other.at_mm) + kSameDistance) return false;
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
    const double most_mm = (last.sides.count > 1 ? kOnEdge : kOnSide) * field_.cell_mm;
    if (last.sides.count == 0 || last.start_mm != start.at || last.change != field_.change ||
        moved_mm > std::min(most_mm, last.lasts_mm) ||
        last.trail.lasts_mm(p_) <= kComesNearer * distance(p_, last.end_mm))
        return std::nullopt;
    contact::Foot foot = field_.follow(p_, last.end_mm, last.sides, false).foot;
    const bool on_same_side = foot.sides.count == 1 && last.sides.count == 1 &&
                              foot.sides.side[0].piece == last.sides.side[0].piece;
    if (foot.found && (foot.sides.count > 1 || on_same_side)) {
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
    if (const contact::Foot* known = found_below(from)) return *known;
    std::optional<contact::Foot> foot = search(ref, from);
    if (!foot && lost_mm_) {
        const Vec3 lost = *lost_mm_;
        const std::optional<Vec3> wall = field_.wall_at(start.at, hint_.memory);
        if (wall) foot = search_between(*wall, lost, ref);
        if (wall && !foot) foot = around(*wall, ref);
        near_gaps_ = near_gaps_ || !wall;
    }
    if (!foot) return foot;
    trail_.lead_to(foot->at_mm, field_.cell_mm, p_);
    const std::span passed = trail_.all();
    start.lasts_mm = falls_to_mm(*foot, from);
    const bool falls = start.lasts_mm > 0;
    if (!falls)
        start.lasts_mm = passed.empty()
                             ? comes_nearer_mm(from, foot->at_mm, foot->sides.edge_at(foot->at_mm).along)
                             : comes_nearer_mm(from, passed.front().at_mm, Vec3{});
    if (hint_.memory && (falls || foot->sides.count > 1))
        hint_.memory->from(start.at) = {start.at,    p_,          start.lasts_mm, trail_,
                                        foot->at_mm, foot->sides, field_.change};
    return foot;
}

// Towards its tip a cusp may be no thicker than a wall that is none. From a wall, where a search from there
// has gone on to a place over the tip: the nearest place with material behind the surface.
std::optional<contact::Foot> FieldQuery::NearestSearch::search_between(Vec3 wall, Vec3 air, BrickRef ref) {
    constexpr int kHalvings = 24;
    constexpr double kAtTip = 2e-5;  // mm
    if (!field_.is_air_behind(air)) return std::nullopt;
    for (int n = 0; n < kHalvings; ++n) {
        const Vec3 middle = 0.5 * (wall + air);
        (field_.is_air_behind(middle) ? air : wall) = middle;
    }
    // Above that place the sides do not meet: from there both are known.
    contact::HalfSpaces both;
    Vec3 at = wall;
    for (int n = 0; n < 2; ++n) {
        const contact::SurfaceSample one = field_.sample(at);
        both.put({one.normal, dot(one.normal, at) - one.way_mm(), one.piece}, 0);
        at -= (one.distance_mm + 2 * contact::kThinnestWall) * one.normal;
    }
    const NearBrick brick(field_, ref, kThinner);
    contact::Foot foot = contact::along_edge(brick, p_, contact::nearest_on(brick, p_, wall, both), &trail_);
    ++hint_.searches;
    // The search ends a little off: sides that are nearly parallel meet at no sharp line.
    if (std::abs(brick.distance_mm(foot.at_mm)) > kAtTip || field_.is_skin(foot))
        return search(ref, wall, kThinner);
    if (!foot.found) {
        const double far_mm = distance(p_, foot.at_mm);
        foot.sample = {far_mm, (p_ - foot.at_mm) / far_mm, both.side[0].piece};
        foot.found = true;
    }
    found_.put(foot);
    return foot;
}

// From a place in material, where searches along the surface have failed or gone elsewhere: nearer to the
// point, in ever shorter steps, as long as that is in material too. Then once more along the surface. The
// wall is not lost then.
std::optional<contact::Foot> FieldQuery::NearestSearch::around(Vec3 wall, BrickRef ref) {
    constexpr double kShortest = 1e-4;  // mm
    constexpr int kMostTries = 400;
    const auto is_wall = [&](Vec3 at) { return field_.is_material(at, contact::kInward); };
    if (!is_wall(wall)) return std::nullopt;
    double step_mm = field_.cell_mm;
    for (int tries = 0; step_mm >= kShortest && tries < kMostTries;) {
        const Vec3 ahead = normalized(p_ - wall), u = any_perpendicular(ahead), v = cross(ahead, u);
        bool has_moved = false;
        for (int n = 0; n < 27 && !has_moved; ++n) {
            // Straight ahead first.
            const int i = 1 - n / 9, j = n / 3 % 3 == 2 ? -1 : n / 3 % 3, k = n % 3 == 2 ? -1 : n % 3;
            const Vec3 next = wall + step_mm * (i * ahead + j * u + k * v);
            if (distance(p_, next) >= distance(p_, wall)) continue;
            ++tries;
            if (!is_wall(next)) continue;
            wall = next;
            has_moved = true;
        }
        if (!has_moved) step_mm *= 0.5;
    }
    const double far_mm = distance(p_, wall);
    const contact::Foot foot{{far_mm, (p_ - wall) / far_mm, field_.sample(wall).piece}, wall, {}, true};
    found_.put(foot);
    (void)search(ref, wall);
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

// Over this way of the point, mm, the surface falls towards it all along from a place down to one place, less
// and less steeply, and without an edge where it ends; for this point that is a foot on one side. 0: it does
// not.
double FieldQuery::NearestSearch::falls_to_mm(const contact::Foot& foot, Vec3 from) const {
    // The longest way, in cells, and how much less steeply it has to fall at least, per way: a hollow nearly
    // round about the point has no clear end.
    constexpr double kLongest = 4, kLeastLess = 0.01;
    // Normals from one look to the next (product): of one piece on one side, and of two without an edge.
    constexpr double kOneSide = 0.98, kNoEdge = 0.9995;
    if (foot.sides.count != 1) return 0;
    const Vec3 way = foot.at_mm - from;
    const double cells = length(way) * field_.per_cell;
    if (cells > kLongest) return 0;
    const int parts = std::max(2, static_cast<int>(std::ceil(cells / kPart)));
    const double least_less_mm = kLeastLess * length(way) / parts;
    contact::SurfaceSample last;
    double last_mm = 0, lasts_mm = SeenPlace::kUnlimited;
    for (int n = 0; n <= parts; ++n) {
        const Vec3 at = from + (static_cast<double>(n) / parts) * way;
        const contact::SurfaceSample s = field_.sample(at);
        const Vec3 on = at - s.way_mm() * s.normal,
                   along = normalized(way - dot(way, s.normal) * s.normal, Vec3{});
        const double nearer_mm = dot(p_ - on, along);
        if (n > 0) {
            if (last_mm - nearer_mm < least_less_mm) return 0;
            if (dot(s.normal, last.normal) < (s.piece == last.piece ? kOneSide : kNoEdge)) {
                // Over a ridge, not through a corner.
                if (dot(s.normal - last.normal, way) < 0 || nearer_mm < 0) return 0;
                lasts_mm = std::min(lasts_mm, nearer_mm);
            }
        }
        last = s;
        last_mm = nearer_mm;
    }
    return lasts_mm;
}

// The foot that was found to which smooth surface falls from a place, or null. Beside a way over an edge that
// may itself be nearer.
const contact::Foot* FieldQuery::NearestSearch::found_below(Vec3 from) const {
    const auto falls = [&](const contact::Foot& foot) {
        return falls_to_mm(foot, from) == SeenPlace::kUnlimited;
    };
    const auto found = std::ranges::find_if(found_.all(), falls);
    return found == found_.all().end() ? nullptr : &*found;
}

// At a cusp: the nearest surface point of each brick that may contain one, from the nearest brick on, which
// is the most likely. Where it meets the first gap it is to be called again: it has not left out gaps till
// then.
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
    ShownSurface shown(field_, p_, hint_.memory);
    const bool knew_gaps = near_gaps_;
    if (knew_gaps) shown.leave_out_gaps();
    const auto place_of = [](const contact::Foot& foot) -> SeenPlace {
        return {foot.at_mm, foot.sample.normal, foot.sides.edge_at(foot.at_mm).along, true};
    };
    for (const contact::Foot& foot : found_.all()) seen.put(place_of(foot));
    contact::SurfaceSample nearest_box{within_mm_, {0, 0, 1}, 0};
    while (bricks_near.take(reach(), b, way)) {
        const BrickRef ref = field_.bricks.get(b);
        if (field_.is_clear(ref, p_, reach())) continue;
        if (way < nearest_box.distance_mm)
            nearest_box = {way, (p_ - clamped(field_.box(b), p_)) / std::max(way, kSameDistance), 0};
        // Start where the grid shows the surface, once for each cusp: two cusps in one brick are two places.
        ++hint_.searches;
        shown.look_at(b, reach());
        SeenPlace start;
        for (int n = 0; shown.take(reach(), found_.best(), seen, start); ++n) {
            if (n == kMostStarts) {
                all_looked = false;
                break;
            }
            if (++searches > kMostSearches) break;
            const std::optional<contact::Foot> foot = search_from(start, ref);
            // Over the edge of a rib, or out of a gap, it goes on to a place beyond: another start leads to
            // what is nearest here.
            const double on_mm = foot ? foot->sample.distance_mm - distance(p_, start.at) : 0;
            near_gaps_ = near_gaps_ || (on_mm > 0 && !field_.wall_at(start.at, hint_.memory));
            if (is_proven_ || near_gaps_ != knew_gaps) return found_.best();
            if (!foot && distance(p_, start.at) >= reach() + field_.cell_mm) continue;
            if (!foot) {
                doubt = true;
                break;  // the other cusps of this brick would fail too
            }
            if (on_mm > 0 && distance(foot->at_mm, start.at) > field_.cell_mm) {
                // It has passed what it began at.
                if (const auto wall = field_.wall_at(start.at, hint_.memory)) (void)around(*wall, ref);
            }
            if (on_mm > field_.cell_mm) continue;
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
    if (!(doubt && found_.none()) && found_.distance_mm() <= proven + kSameDistance) {
        if (all_looked && shown.is_whole() && !doubt && !found_.none()) {
            hint_.proved_at_mm = p_;
            hint_.rest_mm = std::min({found_.rest_mm(), reach(), proven, shown.other_side_mm()});
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

}  // namespace tribo::field
