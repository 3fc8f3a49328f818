// SPDX-License-Identifier: MIT
// The nearest surface to a point in air: followed from the last one, or searched anew.
#include <algorithm>

#include "contact/search_memory.hpp"
#include "field/carved/near_margin.hpp"
#include "field/carved/nearest_search.hpp"

namespace tribo::field {
namespace {

// Bricks leave out shapes whose surface others give within an error of searched sweeps: at the border of two
// bricks the surface has steps of this, mm. Where one shape gives the depth of a point, its surface is meant.
constexpr double kStep = 7e-5;
// A step that nothing notices, mm.
constexpr double kNoStep = 1e-6;
// Steps from a place that the grid shows down to the surface.
constexpr int kMostDown = 8;
// A ball at a surface point is proven to be air by balls in the shapes that meet there, larger by the inverse
// of this share.
constexpr double kOfInnerBall = 0.9;

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
    for (std::size_t n = 0; n < static_cast<std::size_t>(cone.count) && nearer <= kSameDistance; ++n) {
        const contact::HalfSpace& side = foot.sides.side[static_cast<std::size_t>(cone.index[n])];
        const Vec3 centre = foot.at_mm + rho * side.normal;
        const double least = rho - kSameDistance,
                     inside = side.piece == 0 ? blank().distance_mm(centre)
                                              : -shape(side.piece).distance_below(centre, -least);
        if (inside <= least) return false;
        nearer += cone.weight[n] * std::max(0.0, rho - inside);
    }
    return cone.count > 0 && nearer <= kSameDistance;
}

// Over a cusp the grid shows a place in the air between its sides. Returns the surface behind it, seen from
// the point.
Vec3 FieldQuery::surface_behind(Vec3 shown, Vec3 p) const {
    const Vec3 ray = normalized(shown - p, Vec3{});
    for (int n = 0; n < kMostDown; ++n) {
        const double air_mm = distance_mm(shown);
        if (std::abs(air_mm) <= kSameDistance) break;
        shown += air_mm * ray;
    }
    return shown;
}

// The place below a point that is so deep in the piece: found if it is on the surface. The ball of this depth
// is air. Far from its surface a searched sweep may miss the depth by some 1e-5 mm: then once more from
// there.
contact::Foot FieldQuery::below(contact::SurfaceSample depth, Vec3 p) const {
    contact::Foot foot{depth, p - depth.distance_mm * depth.normal, {}, false};
    const auto stand_on_side = [&] {
        foot.found = depth.distance_mm > 0;
        foot.sides.put({foot.sample.normal, dot(foot.sample.normal, foot.at_mm), depth.piece}, 0);
    };
    // Most often one query tells both, surface and material: a little deeper the distance is as much less.
    const Vec3 deeper = foot.at_mm - contact::kThinnestWall * depth.normal;
    if (depth.way_per_mm == 1 && std::abs(distance_mm(deeper) + contact::kThinnestWall) <= kNoStep) {
        stand_on_side();
        return foot;
    }
    double off_mm = std::abs(distance_mm(foot.at_mm));
    if (off_mm > kNoStep && off_mm <= kStep) {
        const contact::SurfaceSample left = sample_piece(depth.piece, foot.at_mm);
        foot.at_mm -= left.distance_mm * left.normal;
        foot.sample.distance_mm = distance(p, foot.at_mm);
        foot.sample.normal = normalized(p - foot.at_mm, depth.normal);
        off_mm = std::abs(distance_mm(foot.at_mm));
    }
    // A brick that knows the piece knows where another one is deeper.
    if (off_mm <= kNoStep || (off_mm <= kStep && !is_listed(depth.piece, foot.at_mm))) {
        stand_on_side();
        foot.found = foot.found && !is_skin(foot);
    }
    return foot;
}

// True if there is no material behind a place of the surface: against the normals of all its sides first.
bool FieldQuery::is_skin(const contact::Foot& foot) const {
    Vec3 out;
    for (int n = 0; n < foot.sides.count; ++n) out += foot.sides.side[static_cast<std::size_t>(n)].normal;
    out = normalized(out, foot.sample.normal);
    return !contact::has_material_behind(NearBrick(*this, kAir), foot.at_mm, out);
}

// Whether there is no material from a place of the air down to the surface of one side, and behind that.
bool FieldQuery::is_air_behind(Vec3 at) const {
    const contact::SurfaceSample one = sample(at);
    if (one.distance_mm < -contact::kThinnestWall) return false;
    return !contact::falls_inward(distance_mm(at - (one.distance_mm + contact::kThinnestWall) * one.normal));
}

std::optional<Vec3> FieldQuery::wall_at(Vec3 shown, contact::SearchMemory* memory) const {
    if (!memory) return find_wall(shown);
    contact::SearchMemory::Wall& known = memory->wall_at(shown);
    if (known.change != change || known.start_mm != shown) known = {shown, change, find_wall(shown)};
    return known.wall_mm;
}

// Where the sides come nearer to each other there may be a wall: it looks there.
std::optional<Vec3> FieldQuery::find_wall(Vec3 shown) const {
    constexpr int kMostMoves = 16;
    constexpr double kAroundCells = 1.5, kOpposite = 0.5, kThinnest = contact::kThinnestWall;
    const double around_mm = kAroundCells * cell_mm;
    Vec3 at = shown;
    for (int n = 0; n < kMostMoves && distance(at, shown) <= around_mm; ++n) {
        const contact::SurfaceSample one = sample(at);
        if (one.distance_mm < -kThinnest) return at;
        const double way_mm = one.distance_mm + kThinnest;
        const Vec3 beyond = at - way_mm * one.normal;
        const contact::SurfaceSample other = sample(beyond);
        if (other.distance_mm >= kClearCells * cell_mm) break;
        if (contact::falls_inward(other.distance_mm)) return beyond;
        const double opposite = -dot(one.normal, other.normal);
        if (opposite < kOpposite) {
            // Over an edge: what is behind the first side?
            at = beyond;
            continue;
        }
        // Half way the sides are as near, `half_mm`; along them it changes by `slope` per mm.
        const double half_way = (one.distance_mm - other.distance_mm + way_mm * opposite) / (1 + opposite);
        const double half_mm = one.distance_mm - half_way;
        const Vec3 middle = at - half_way * one.normal;
        if (half_mm < -kThinnest) return middle;
        const Vec3 apart = 0.5 * (one.normal + other.normal);
        const double slope = length(apart);
        if (half_mm + kThinnest > slope * around_mm) break;
        at = middle - std::min((half_mm + 2 * kThinnest) / slope, cell_mm) / slope * apart;
    }
    return std::nullopt;
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
    contact::Foot foot = contact::along_edge(brick, p, contact::nearest_on(brick, p, start, sides));
    foot.found = foot.found && !is_skin(foot);
    return {foot, foot.found && is_nearest(foot), sides.count == 1};
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
