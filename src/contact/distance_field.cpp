// SPDX-License-Identifier: MIT
#include "contact/distance_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tribo::contact {
namespace {

constexpr int kMostRounds = 16;
constexpr double kAnyStep = 1e30;  // mm
// A point this near to the surface counts as on it, mm.
constexpr double kOnSurface = 1e-6;
// What a searched sweep gives as one of many pieces may be off by this, mm.
constexpr double kUnsure = 2e-5;
// The search has ended at a point if the next step changes the distance by less than this, mm: half the
// square of the step over the distance.
constexpr double kStill = 1e-6;
// Normals of one smooth piece agree at least this well (product) from one step of the search to the next.
constexpr double kAlike = 0.5;
// Bends are measured over this share of the distance. A bend is too great from this share of the bend of a
// sphere on: nearly round about the point, a hollow tells no way to its nearest place.
constexpr double kBendStep = 1e-3, kTooBent = 0.9;
// An edge is round about the point if the way to its nearest place grows by no more than this share.
constexpr double kRound = 0.3;
// A side that is this share of a way behind does not come near over the way.
constexpr double kBehind = 0.1;
// Bends along an edge are measured over steps of this share along it, and at least this long beside the way
// to the point: over shorter ones the normals of searched sweeps tell of their errors.
constexpr double kAlong = 0.9, kLeastAlong = 0.0025;

// Goes down to the surface along the normals. Returns the sample there, if it comes so far.
std::optional<SurfaceSample> land(const DistanceField& field, Vec3& q) {
    constexpr int kMostLandings = 6;
    for (int n = 0; n < kMostLandings; ++n) {
        const SurfaceSample s = field.sample(q);
        if (std::abs(s.distance_mm) <= kOnSurface) return s;
        q -= s.way_mm() * s.normal;
    }
    return std::nullopt;
}

// For places where the planes do not agree (normals of swept edges jump): follows the surface as long as the
// distance falls.
Foot descend(const DistanceField& field, Vec3 point_mm, Vec3 start_mm) {
    constexpr int kMostSteps = 24;
    constexpr double kShortest = 1e-3, kLongest = 256;  // shares of the step on a plane: a hollow needs more
    Vec3 q = start_mm;
    const auto first = land(field, q);
    if (!first) return {field.sample(point_mm), start_mm, {}, false};
    SurfaceSample s = *first;
    double share = 1;
    for (int n = 0; n < kMostSteps && share > kShortest; ++n) {
        const Vec3 way = point_mm - q, along = way - dot(way, s.normal) * s.normal;
        if (std::max(1.0, share) * squared_length(along) <= 2 * kStill * length(way)) break;
        Vec3 next = q + share * along;
        const auto seen = land(field, next);
        if (seen && squared_length(point_mm - next) < squared_length(way) - kOnSurface * kOnSurface) {
            q = next;
            s = *seen;
            share = std::min(kLongest, 2 * share);
        } else {
            share *= 0.5;
        }
    }
    const double way = distance(point_mm, q);
    if (way > kOnSurface) return {{way, (point_mm - q) / way, s.piece}, q, {}, true};
    return {s, q, {}, true};
}

// The foot point where the sides that touch it, or `on_mm`, a point of the surface, hold the point. The last
// step, from `on_mm` to `foot_mm`, leaves the surface by its square over the radius of the bend only.
Foot foot_at(Vec3 foot_mm, Vec3 on_mm, Vec3 point_mm, const HalfSpaces& sides) {
    HalfSpaces touching;
    for (int i = 0; i < sides.count; ++i) {
        const HalfSpace& side = sides.side[static_cast<std::size_t>(i)];
        if (std::max(side.above(on_mm), side.above(foot_mm)) > -kOnSurface) touching.put(side, kAlike);
    }
    const double way = distance(point_mm, foot_mm);
    const std::uint32_t piece = touching.count > 0 ? touching.side[0].piece : 0;
    return {{way, (point_mm - foot_mm) / way, piece}, foot_mm, touching, true};
}

// Direction of the edge on which two sides meet.
Vec3 edge_of(const HalfSpace& a, const HalfSpace& b) {
    return normalized(cross(a.normal, b.normal), Vec3{});
}

bool lists(const HalfSpaces& sides, std::uint32_t piece) {
    const auto end = sides.side.begin() + sides.count;
    return std::any_of(sides.side.begin(), end, [&](const HalfSpace& side) { return side.piece == piece; });
}

// Until the pieces in `sides` have led to a place that is not on the surface, the field is not asked for
// others. Along an edge each step is Newton's, with the bend of the sides over the step before (a secant).
Foot foot_from(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, double longest_mm, HalfSpaces sides,
               Trail* trail = nullptr) {
    Vec3 q = start_mm;
    bool ask = sides.count == 0;
    bool there = !ask;      // q is the nearest point of all sides, not a point on the way to it
    HalfSpaces::Edge edge;  // the last step's, if that was along one
    double along_mm = 0;    // of it
    double moved_mm = 0;    // since the start
    Vec3 before = q;        // the last step
    for (int n = 0; n < kMostRounds; ++n) {
        double above_mm = -kAnyStep;  // of the intersection of all sides
        for (int i = 0; i < sides.count; ++i) {
            const auto index = static_cast<std::size_t>(i);
            HalfSpace& side = sides.side[index];
            // A side that was far behind the place still is.
            if (n == 0 || side.above(q) >= -kBehind * moved_mm) {
                const SurfaceSample t = field.sample_piece(side.piece, q);
                if (t.piece == side.piece && dot(t.normal, side.normal) > kAlike) {
                    if (along_mm != 0 && (index == edge.sides[0] || index == edge.sides[1])) {
                        side.bend = dot(t.normal - side.normal, edge.along) / along_mm;
                        side.beside = sides.side[edge.sides[index == edge.sides[0] ? 1 : 0]].piece;
                    }
                    side.normal = t.normal;
                    side.offset = dot(t.normal, q) - t.way_mm();
                }
            }
            above_mm = std::max(above_mm, side.above(q));
        }
        const auto is_still = [&](Vec3 next) {
            return there &&
                   squared_length(next - q) <= 2 * kStill * distance(point_mm, q) + kOnSurface * kOnSurface;
        };
        Vec3 next = sides.nearest(point_mm);
        const bool held = !ask && std::abs(above_mm) <= kOnSurface && is_still(next);
        // The known pieces do not hold the point: no further round would move it.
        if (!ask && !held && next == q) break;
        // A piece that is not known yet only takes material away. A place that is still on the surface stays
        // the nearest one.
        if (held && distance(point_mm, next) > kOnSurface && std::abs(field.distance_mm(q)) <= kOnSurface)
            return foot_at(next, q, point_mm, sides);
        if (ask || held) {
            const SurfaceSample s = field.sample(q);
            // The own answers of the pieces are the better ones.
            const bool is_known = std::abs(s.distance_mm) <= kUnsure && std::abs(above_mm) <= kOnSurface &&
                                  lists(sides, s.piece);
            if (trail && n > 0 && std::abs(s.distance_mm) <= kUnsure && squared_length(edge.along) > 0)
                trail->put({q, edge_of(sides.side[edge.sides[0]], sides.side[edge.sides[1]])});
            if (!is_known) {
                if (!lists(sides, s.piece)) sides.make_room(q);
                const int known = sides.count;
                sides.put({s.normal, dot(s.normal, q) - s.way_mm(), s.piece}, kAlike);
                // A step into the air beyond an edge has passed it: first back to the edge.
                const bool passed = n > 0 && sides.count > known && s.distance_mm > kUnsure;
                next = sides.nearest(passed ? before : point_mm);
            }
            // On the surface, and no nearer point exists with the present sides.
            if ((is_known || std::abs(s.distance_mm) <= kOnSurface) && is_still(next)) {
                if (distance(point_mm, next) <= kOnSurface) return {s, q, {}, true};
                return foot_at(next, q, point_mm, sides);
            }
            ask = true;
        }
        before = q;
        edge = sides.edge_at(next);
        const bool on_edge = squared_length(edge.along) > 0;
        const Vec3 step = (on_edge ? sides.nearest_on_bend(point_mm, edge, next, q) : next) - q;
        const double size = length(step), share = size > longest_mm ? longest_mm / size : 1;
        there = share == 1;
        const double step_mm = share * size;
        moved_mm += step_mm;
        q += share * step;
        // A step to the edge tells nothing of the bend along it.
        along_mm = on_edge ? share * dot(step, edge.along) : 0;
        if (std::abs(along_mm) < std::max(kAlong * step_mm, kLeastAlong * distance(point_mm, q)))
            along_mm = 0;
    }
    return {{0, {0, 0, 1}, 0}, q, sides};
}

// If the surface at a foot point bends towards the point more than a sphere about the point does: returns the
// direction of the greatest bend, with the bend's radius as its length. Otherwise returns zero.
Vec3 steepest_bend(const DistanceField& field, const Foot& foot) {
    const Vec3 n = foot.sample.normal;
    const double way = foot.sample.distance_mm, h = kBendStep * way;
    const Vec3 u = normalized(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), v = cross(n, u);
    const SurfaceSample here = field.sample_piece(foot.sample.piece, foot.at_mm),
                        at_u = field.sample_piece(foot.sample.piece, foot.at_mm + h * u),
                        at_v = field.sample_piece(foot.sample.piece, foot.at_mm + h * v);
    const Vec3 du = (at_u.normal - here.normal) / h, dv = (at_v.normal - here.normal) / h;
    // The least eigenvalue of the symmetric 2 x 2 matrix of bends.
    const double a = dot(du, u), b = 0.5 * (dot(du, v) + dot(dv, u)), c = dot(dv, v);
    const double least = 0.5 * (a + c) - std::sqrt(0.25 * (a - c) * (a - c) + b * b);
    if (!(-least * way > kTooBent)) return {};
    const Vec3 e =
        std::abs(least - a) > std::abs(least - c) ? b * u + (least - a) * v : (least - c) * u + b * v;
    return (-1 / least) * normalized(e, u);
}

// An edge on which two pieces meet.
struct Edge {
    const DistanceField& field;
    std::array<std::uint32_t, 2> pieces;

    struct Place {
        Vec3 at, along;  // `along`: of the edge, unit
        std::array<Vec3, 2> normals;
    };
    // The place of the edge beside a point, if the two pieces meet there. `along`: near its direction.
    std::optional<Place> beside(Vec3 q, Vec3 along) const {
        constexpr int kMostRounds = 6;
        constexpr double kOnBoth = 1e-9, kLeastSine2 = 1e-6;
        for (int n = 0; n < kMostRounds; ++n) {
            const SurfaceSample a = field.sample_piece(pieces[0], q), b = field.sample_piece(pieces[1], q);
            const double c = dot(a.normal, b.normal), sine2 = 1 - c * c;
            if (a.piece != pieces[0] || b.piece != pieces[1] || sine2 < kLeastSine2) return std::nullopt;
            const Vec3 way = normalized(cross(a.normal, b.normal));
            if (std::abs(a.distance_mm) <= kOnBoth && std::abs(b.distance_mm) <= kOnBoth)
                return Place{q, dot(way, along) < 0 ? -1 * way : way, {a.normal, b.normal}};
            q -=
                ((a.way_mm() - c * b.way_mm()) * a.normal + (b.way_mm() - c * a.way_mm()) * b.normal) / sine2;
        }
        return std::nullopt;
    }
    std::optional<Place> next_to(const Place& place, double step_mm) const {
        return beside(place.at + step_mm * place.along, place.along);
    }
    // The tangent planes of the two pieces at a place.
    HalfSpaces sides_at(const Place& place) const {
        HalfSpaces both;
        for (std::size_t n = 0; n < 2; ++n)
            both.put({place.normals[n], dot(place.normals[n], place.at), pieces[n]}, kAlike);
        return both;
    }
    // Where another piece takes the place of one of the two, this far ahead: goes over to its edge, this far
    // from there at most.
    std::optional<Place> go_over(const Place& place, double step_mm, double most_mm) {
        constexpr double kAhead = 0.9;
        const Vec3 ahead = place.at + step_mm * place.along;
        const std::uint32_t piece = field.sample(ahead).piece;
        for (const std::uint32_t other : pieces) {
            if (piece == pieces[0] || piece == pieces[1]) break;
            const Edge next{field, {other, piece}};
            const auto on = next.beside(ahead, place.along);
            if (!on || dot(on->along, place.along) < kAhead || distance(on->at, ahead) > most_mm ||
                std::abs(field.distance_mm(on->at)) > kUnsure)
                continue;
            pieces = next.pieces;
            return on;
        }
        return std::nullopt;
    }
};

// From a place where the edge comes nearer to the point, in growing steps to one where it no longer does, and
// from there by false position to where the way to the point is square to the edge. The edge may go over to
// others.
Edge::Place nearest_along(Edge& edge, Vec3 point_mm, Edge::Place from, double first_mm, double least_mm,
                          Trail* trail) {
    constexpr int kMostSteps = 32, kMostRefinements = 12;
    constexpr double kGrows = 2, kLongest = 0.5;
    const auto ahead_mm = [&](const Edge::Place& place) { return dot(point_mm - place.at, place.along); };
    std::optional<Edge::Place> beyond;
    double step_mm = first_mm;
    for (int n = 0; n < kMostSteps && !beyond && step_mm >= least_mm; ++n) {
        const auto next = edge.next_to(from, step_mm);
        if (!next || std::abs(edge.field.distance_mm(next->at)) > kUnsure) {
            step_mm /= kGrows * kGrows;
            if (step_mm >= least_mm) continue;
            const auto over = edge.go_over(from, kGrows * least_mm, 2 * kGrows * least_mm);
            if (!over || ahead_mm(*over) <= 0) break;
            from = *over;
            if (trail) trail->put({from.at, from.along});
            step_mm = first_mm;
        } else if (ahead_mm(*next) <= 0) {
            beyond = next;
        } else {
            from = *next;
            if (trail) trail->put({from.at, from.along});
            step_mm = std::min(kGrows * step_mm, kLongest * distance(point_mm, from.at));
        }
    }
    // The Illinois way: what stays twice counts half.
    double low = ahead_mm(from), high = beyond ? -ahead_mm(*beyond) : 0;
    for (int n = 0, side = 0; n < kMostRefinements && low > 0 && high > 0; ++n) {
        const auto middle = edge.next_to(from, low / (low + high) * distance(from.at, beyond->at));
        if (!middle) break;
        const double ahead = ahead_mm(*middle);
        if (ahead > 0) {
            from = *middle;
            low = ahead;
            high *= side > 0 ? 0.5 : 1;
            side = 1;
        } else {
            beyond = middle;
            high = -ahead;
            low *= side < 0 ? 0.5 : 1;
            side = -1;
        }
    }
    return beyond && distance(point_mm, beyond->at) < distance(point_mm, from.at) ? *beyond : from;
}

// The edge that a search was on as its rounds ran out, at the place beside it.
Foot back_to_edge(const DistanceField& field, Vec3 point_mm, const Foot& lost) {
    HalfSpaces sides = lost.sides;
    if (sides.count < 2) return lost;
    std::sort(sides.side.begin(), sides.side.begin() + sides.count, [&](const auto& a, const auto& b) {
        return std::abs(a.above(lost.at_mm)) < std::abs(b.above(lost.at_mm));
    });
    // Two of the nearest three, as a sweep and the next one are near each other; or one of them and what has
    // taken the place of the other one there.
    constexpr std::size_t kPairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (const auto& pair : kPairs) {
        if (pair[1] >= static_cast<std::size_t>(sides.count)) break;
        Edge edge{field, {sides.side[pair[0]].piece, sides.side[pair[1]].piece}};
        auto place = edge.beside(lost.at_mm, Vec3{});
        if (place && std::abs(field.distance_mm(place->at)) > kUnsure)
            place = edge.go_over(*place, 0, kAnyStep);
        if (!place) continue;
        const double way = distance(point_mm, place->at);
        return {{way, (point_mm - place->at) / way, edge.pieces[0]}, place->at, edge.sides_at(*place), true};
    }
    return lost;
}

// Goes from a place along the surface of a hollow, in steps, as long as it comes nearer to the point.
Vec3 out_of_hollow(const DistanceField& field, Vec3 point_mm, Vec3 q, Vec3 step_mm) {
    constexpr int kMostSteps = 24;
    for (int n = 0; n < kMostSteps; ++n) {
        Vec3 next = q + step_mm;
        const auto seen = land(field, next);
        if (!seen || squared_length(point_mm - next) >= squared_length(point_mm - q)) break;
        q = next;
        const Vec3 on = step_mm - dot(step_mm, seen->normal) * seen->normal;
        step_mm = length(step_mm) * normalized(on, Vec3{});
    }
    return q;
}

}  // namespace

bool has_material_behind(const DistanceField& field, Vec3 at, Vec3 normal) {
    const auto falls = [&](Vec3 way) {
        return falls_inward(field.distance_mm(at + kThinnestWall * normalized(way)));
    };
    if (falls(-normal)) return true;
    const Vec3 u = any_perpendicular(normal), v = cross(normal, u);
    for (const double down : {1.0, 0.2}) {
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                if (falls(i * u + j * v - down * normal)) return true;
            }
        }
    }
    return false;
}

void Trail::lead_to(Vec3 end_mm, double near_mm, Vec3 point_mm) {
    std::size_t kept = 0;
    for (const Place& one : all()) {
        if (distance(one.at_mm, end_mm) >= near_mm) place_[kept++] = one;
    }
    count_ = kept;
    for (std::size_t n = 0; n < count_; ++n) {
        Place& one = place_[n];
        const Vec3 next_mm = n + 1 < count_ ? place_[n + 1].at_mm : end_mm;
        const double sense = dot(next_mm - one.at_mm, one.along) < 0 ? -1 : 1;
        one.along = dot(point_mm - one.at_mm, one.along) * sense > 0 ? sense * one.along : Vec3{};
    }
}

double Trail::lasts_mm(Vec3 point_mm) const {
    double least = kAnyStep;
    for (const Place& one : all()) least = std::min(least, dot(point_mm - one.at_mm, one.along));
    return least;
}

SurfaceSample DistanceField::nearest(Vec3 point_mm, double within_mm, NearHint& hint) const {
    const SurfaceSample here = sample(point_mm);
    if (here.distance_mm <= 0 || here.distance_mm >= within_mm) return here;
    Foot foot = nearest_from(*this, point_mm, point_mm - here.distance_mm * here.normal);
    if (foot.sample.distance_mm > here.distance_mm + kOnSurface) {
        const Foot hinted = nearest_from(*this, point_mm, hint.at_mm);
        if (hinted.sample.distance_mm < foot.sample.distance_mm) foot = hinted;
    }
    if (foot.found) hint.at_mm = foot.at_mm;
    hint.sides = foot.sides;
    return foot.sample;
}

Foot along_edge(const DistanceField& field, Vec3 point_mm, Foot foot, Trail* trail) {
    constexpr double kFirst = 5, kLeastAhead = 1e-5;
    if (!foot.found || foot.sides.count < 2) return foot;
    const HalfSpaces::Edge line = foot.sides.edge_at(foot.at_mm);
    if (squared_length(line.along) == 0) return foot;
    HalfSpace &a = foot.sides.side[line.sides[0]], &b = foot.sides.side[line.sides[1]];
    Edge edge{field, {a.piece, b.piece}};
    auto here = edge.beside(foot.at_mm, line.along);
    if (!here) return foot;
    const double ahead_mm = dot(point_mm - here->at, here->along);
    // On all but a circle about the point it is at the nearest place now.
    if (std::abs(ahead_mm) <= kLeastAhead * foot.sample.distance_mm) return foot;
    if (ahead_mm < 0) here->along = -1 * here->along;
    const double least_mm = kBendStep * foot.sample.distance_mm;
    const auto next = edge.next_to(*here, least_mm);
    if (!next) return foot;
    const double moved_mm = dot(next->at - here->at, here->along);
    a.bend = dot(next->normals[0] - here->normals[0], here->along) / moved_mm;
    b.bend = dot(next->normals[1] - here->normals[1], here->along) / moved_mm;
    a.beside = b.piece;
    b.beside = a.piece;
    if (foot.sides.rest_on_bend(point_mm, line, foot.at_mm, foot.at_mm) > kRound) return foot;
    const double first_mm = std::max(kFirst * std::abs(ahead_mm), least_mm);
    const Edge::Place place = nearest_along(edge, point_mm, *here, first_mm, least_mm, trail);
    const double far_mm = distance(point_mm, place.at);
    if (far_mm >= foot.sample.distance_mm) return foot;
    foot.at_mm = place.at;
    foot.sample.distance_mm = far_mm;
    foot.sample.normal = (point_mm - place.at) / far_mm;
    if (a.piece != edge.pieces[0] || b.piece != edge.pieces[1]) {
        foot.sides = edge.sides_at(place);
        return foot;
    }
    a.normal = place.normals[0];
    b.normal = place.normals[1];
    for (HalfSpace* side : {&a, &b}) side->offset = dot(side->normal, place.at);
    return foot;
}

Foot nearest_from(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, double longest_mm, Trail* trail) {
    // Along the rim of a groove that many sweeps left the way is long.
    constexpr int kMostTries = 3;
    Foot foot = foot_from(field, point_mm, start_mm, longest_mm, {}, trail);
    for (int tries = 0; tries < kMostTries && !foot.found; ++tries) {
        const Foot on = back_to_edge(field, point_mm, foot);
        if (!on.found) break;
        foot =
            foot_from(field, point_mm, along_edge(field, point_mm, on, trail).at_mm, longest_mm, {}, trail);
    }
    if (!foot.found) foot = descend(field, point_mm, foot.at_mm);
    foot = along_edge(field, point_mm, foot, trail);
    if (!foot.found || foot.sides.count > 1) return foot;
    // If a hollow is narrower than the distance of the point over it, the foot point at its bottom is the
    // farthest place there. The nearest places are up its sides.
    const Vec3 aside = steepest_bend(field, foot);
    if (squared_length(aside) == 0) return foot;
    const Vec3 step = std::min(1.0, longest_mm / length(aside)) * aside;
    Foot best = foot;
    for (const double side : {-1.0, 1.0}) {
        const Vec3 start = out_of_hollow(field, point_mm, foot.at_mm, side * step);
        Foot other = foot_from(field, point_mm, start, longest_mm, {});
        if (!other.found || other.sides.count <= 1) {
            const Foot on = descend(field, point_mm, other.at_mm);
            if (!other.found || (on.found && on.sample.distance_mm < other.sample.distance_mm)) other = on;
        }
        if (other.found && other.sample.distance_mm < best.sample.distance_mm) best = other;
    }
    return best;
}

Foot nearest_on(const DistanceField& field, Vec3 point_mm, Vec3 start_mm, const HalfSpaces& pieces) {
    return foot_from(field, point_mm, start_mm, kAnyStep, pieces);
}

}  // namespace tribo::contact
