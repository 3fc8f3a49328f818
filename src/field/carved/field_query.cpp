// SPDX-License-Identifier: MIT
#include "field/carved/field_query.hpp"

#include <algorithm>

namespace tribo::field {
namespace {

// Largest number of bricks on each side in a search for clear air.
constexpr int kMostRings = 3;

}  // namespace

FieldQuery::Exact FieldQuery::exact(BrickRef ref, Vec3 p, bool any_air) const {
    if (ref == kUntouched) return {blank().distance_mm(p), 0};
    if (ref == kAir) return {kClearCells * cell_mm, 0};
    const Brick& brick = (*pool)[ref];
    // The shape that gives the distance at the nearest node most likely gives it here. The others only need
    // to be shown not to give it.
    const std::uint16_t likely = likely_in(brick, p);
    Exact best{-near_mm, 0};
    if (likely != Brick::kUnlisted) {
        deepen(best, brick.shapes[likely], p);
    } else if (!any_air) {
        // Deep in a shape that is near the surface nowhere in the brick: that is not listed.
        best.distance_mm = std::max(best.distance_mm, clear_of_nodes(brick, p));
    }
    for (std::size_t n = 0; n < brick.shapes.size() && !(any_air && best.distance_mm > 0); ++n) {
        if (n != likely) deepen(best, brick.shapes[n], p);
    }
    return best;
}

void FieldQuery::deepen(Exact& best, ShapeId id, Vec3 p) const {
    const double d = id == 0 ? blank().distance_mm(p) : -shape(id).distance_below(p, -best.distance_mm);
    if (d > best.distance_mm) best = {d, id};
}

contact::SurfaceSample FieldQuery::sample_in(BrickRef ref, Vec3 p) const {
    const bool air_or_blank = ref < kFirstBrick;
    const std::uint16_t likely = air_or_blank ? Brick::kUnlisted : likely_in((*pool)[ref], p);
    if (likely == Brick::kUnlisted) {
        const Exact e = exact(ref, p);
        return {e.distance_mm, outward(e.shape, p), e.shape};
    }
    const Brick& brick = (*pool)[ref];
    const contact::SurfaceSample first = sample_piece(brick.shapes[likely], p);
    Exact best{std::max(first.distance_mm, -near_mm), first.piece};
    for (std::size_t n = 0; n < brick.shapes.size(); ++n) {
        if (n != likely) deepen(best, brick.shapes[n], p);
    }
    const contact::SurfaceSample deepest = best.shape == first.piece ? first : sample_piece(best.shape, p);
    return {best.distance_mm, deepest.normal, best.shape, deepest.way_per_mm};
}

double FieldQuery::distance_mm(Vec3 p) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b)) return std::max(blank().distance_mm(p), kClearCells * cell_mm);
    return exact(bricks.get(b), p).distance_mm;
}

contact::SurfaceSample FieldQuery::sample(Vec3 p) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b))
        return {std::max(blank().distance_mm(p), kClearCells * cell_mm), blank().gradient(p), 0};
    const Exact e = exact(bricks.get(b), p);
    return {e.distance_mm, outward(e.shape, p), e.shape};
}

double FieldQuery::clear_of_nodes(const Brick& brick, Vec3 p) const {
    const NearNode near = nearest_node(brick.coord, p);
    return at_node_mm(brick, near.index) - cell_mm * (length(near.off_cells) + kRounding);
}

// In a brick that is completely `alike` (air or untouched): returns how far all bricks around are alike too,
// at least `clear_mm`. Bricks outside the grid count as alike.
double FieldQuery::clear_among(BrickRef alike, BrickCoord b, Vec3 p, double clear_mm,
                               double enough_mm) const {
    const Vec3 q = (p - lattice(b).node(0, 0, 0)) * per_cell;
    const auto to_face = [](double v) { return std::min(v, kBrickCells - v); };
    const double face_mm = cell_mm * std::min({to_face(q.x), to_face(q.y), to_face(q.z)});
    const double brick_mm = kBrickCells * cell_mm;
    double clear = std::max(clear_mm, face_mm);
    for (int ring = 1; ring <= kMostRings && clear < enough_mm; ++ring) {
        for (int k = b.k - ring; k <= b.k + ring; ++k) {
            for (int j = b.j - ring; j <= b.j + ring; ++j) {
                const bool edge = k == b.k - ring || k == b.k + ring || j == b.j - ring || j == b.j + ring;
                for (int i = b.i - ring; i <= b.i + ring; i += edge ? 1 : 2 * ring) {
                    if (bricks.contains({i, j, k}) && bricks.get({i, j, k}) != alike) return clear;
                }
            }
        }
        clear = std::max(clear, face_mm + ring * brick_mm);
    }
    return clear;
}

// In a brick of air: returns the distance to the nearest brick that may contain material, or to the surface
// of the empty ball around the nearest node.
double FieldQuery::clear_in_air(BrickCoord b, Vec3 p, double enough_mm) const {
    const double node = cell_mm * (kClearCells - length(nearest_node(b, p).off_cells));
    return clear_among(kAir, b, p, node, enough_mm);
}

double FieldQuery::clear_way_mm(Vec3 p, double enough_mm) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b)) return std::max(blank().distance_mm(p), kRounding * cell_mm);
    const BrickRef ref = bricks.get(b);
    if (ref == kAir) return clear_in_air(b, p, enough_mm);
    if (ref == kUntouched) {
        const double of_blank = blank().distance_mm(p);
        if (of_blank >= 0) return of_blank;
        const double enough = std::min(enough_mm, -of_blank);
        return -std::min(-of_blank, clear_among(kUntouched, b, p, 0, enough));
    }
    const Brick& brick = (*pool)[ref];
    const NearNode near = nearest_node(brick.coord, p);
    const double at_node = at_node_mm(brick, near.index);
    const double off = cell_mm * (length(near.off_cells) + kRounding);
    // Nearer to the surface than this, the exact distance is worth its cost.
    constexpr double kSureCells = 0.3;
    if (at_node - off > kSureCells * cell_mm) return at_node - off;
    if (at_node + off < -kSureCells * cell_mm) return at_node + off;
    return exact(ref, p, true).distance_mm;
}

ShapeId FieldQuery::emptied_by(Vec3 p, double skin_mm) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b)) return 0;
    const BrickRef ref = bricks.get(b);
    if (ref == kAir || ref == kUntouched) return 0;
    const Exact e = exact(ref, p, true);
    if (e.distance_mm < -skin_mm) return 0;
    if (e.shape != 0 || e.distance_mm > skin_mm) return e.shape;
    // On a face of the blank: a cut may end here.
    for (const ShapeId id : (*pool)[ref].shapes) {
        if (id != 0 && shape(id).distance_below(p, skin_mm) < skin_mm) return id;
    }
    return 0;
}

double FieldQuery::clearance_mm(Vec3 p, double enough_mm) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b)) return blank().distance_mm(p);
    const BrickRef ref = bricks.get(b);
    if (ref == kAir) return clear_in_air(b, p, enough_mm);
    if (ref == kUntouched) return blank().distance_mm(p);
    const double nodes = clear_of_nodes((*pool)[ref], p);
    if (nodes >= enough_mm) return nodes;
    return std::max(nodes, exact(ref, p).distance_mm);
}

bool FieldQuery::is_material(Vec3 p, double skin_mm) const {
    const BrickCoord b = brick_at(p);
    if (!bricks.contains(b)) return false;
    const BrickRef ref = bricks.get(b);
    if (ref == kAir) return false;
    if (ref == kUntouched) return blank().distance_mm(p) < -skin_mm;
    const Brick& brick = (*pool)[ref];
    const NearNode near = nearest_node(b, p);
    const double way = cell_mm * length(near.off_cells);
    // The sign at the node holds around it as far as its distance, less rounding.
    const double d = at_node_mm(brick, near.index);
    if (d > way + kRounding * cell_mm) return false;
    if (d < -way - kRounding * cell_mm - skin_mm) return true;
    const auto in_material = [&](ShapeId id) {
        return id == 0 ? blank().distance_mm(p) < -skin_mm : shape(id).distance_below(p, skin_mm) >= skin_mm;
    };
    const std::uint16_t likely = brick.winner[static_cast<std::size_t>(near.index)];
    if (likely != Brick::kUnlisted && !in_material(brick.shapes[likely])) return false;
    for (std::size_t n = brick.shapes.size(); n-- > 0;) {
        if (n != likely && !in_material(brick.shapes[n])) return false;
    }
    return true;
}

}  // namespace tribo::field
