// SPDX-License-Identifier: MIT
#include "field/carved/shown_surface.hpp"

#include <algorithm>

namespace tribo::field {
namespace {

// Two starts of searches lead to the same place if they are this near to each other, in cells: in any
// direction, or, where one of them ended at an edge, so far beside it and so far along it.
constexpr double kOneStart = 1, kBesideStart = 0.5, kBesideEnd = 0.75, kAlongEdge = 6;
// kOneWay: two surface points are on different sides if the product of their normals is less. kOneSlope:
// distances come from one side if they rise by at least this share of the full slope; or by less, as those in
// the sweep of a tilted cutter do, but at least kLeastSlope, and evenly to this share of a cell.
constexpr double kOneWay = 0.5, kOneSlope = 0.97, kLeastSlope = 0.7, kEven = 0.1;
// The surface that a node represents: radius around it, and largest bulge, in cells. Where others may be left
// out it represents what is on the way to the next node, too.
constexpr double kAround = 0.87, kBulge = 0.1, kAroundGaps = kAround + 1, kBulgeAtGaps = 0.5;
// Surface between two nodes goes on around no corner if the product of their normals is at least kGoesOn, and
// has no edge if the normals part by no more than kNoEdge.
constexpr double kGoesOn = 0.95, kNoEdge = 2e-3;
// A point moves this far from query to query, in cells: less is not worth knowing.
constexpr double kTooLittle = 0.02;
// No point of the surface is farther than this from every node, in cells.
constexpr double kClose = FieldQuery::kClearCells + FieldQuery::kRounding;
// What is nearer by less than this is not looked for, in cells.
constexpr double kLeastNearer = 1e-3;
// A place of the blank is in its brick up to this, mm.
constexpr double kInside = 2e-5;

// How the distances of a brick differ around a node.
struct Differences {
    Vec3 slope;  // mm per cell
    bool even;   // alike on both sides
};

Differences differences_at(const FieldQuery& field, const Brick& brick, int a, int b, int c) {
    constexpr int kMostBend = static_cast<int>(kEven * kStepsPerCell);
    const double mm_per_step = field.cell_mm / kStepsPerCell;
    const auto at = [&](int node) { return int{brick.steps[static_cast<std::size_t>(node)]}; };
    const int node = node_index(a, b, c);
    Differences result{{}, true};
    const auto along = [&](int n, int stride) {
        const int first = node - n * stride, low = first + std::max(n - 1, 0) * stride,
                  high = first + std::min(n + 1, kBrickCells) * stride,
                  middle = first + std::clamp(n, 1, kBrickCells - 1) * stride;
        const int bend = at(middle - stride) - 2 * at(middle) + at(middle + stride);
        result.even = result.even && std::abs(bend) < kMostBend;
        return (high - low == stride ? mm_per_step : 0.5 * mm_per_step) * (at(high) - at(low));
    };
    result.slope = {along(a, 1), along(b, kLatticeEdge), along(c, kLatticeEdge * kLatticeEdge)};
    return result;
}

// Whether searches from both places lead to the same one. Surface that faces another way is the other side of
// a corner.
bool is_alike(const SeenPlace& a, const SeenPlace& b, double per_cell) {
    const Vec3 off = (b.at - a.at) * per_cell, aside = off - dot(off, a.along) * a.along;
    const double near = squared_length(a.along) > 0 ? (a.ended ? kBesideEnd : kBesideStart) : kOneStart;
    return squared_length(aside) < near * near && squared_length(off) < kAlongEdge * kAlongEdge &&
           dot(a.normal, b.normal) > kOneWay;
}

}  // namespace

void ShownSurface::look_at(BrickCoord where, double within_mm) {
    here_.clear();
    const FieldQuery& field = *field_;
    const BrickRef ref = field.bricks.get(where);
    if (ref == kUntouched) {
        // Where the blank begins at the face of the brick, its surface is in a nearer one.
        const Box3 here = field.box(where);
        const Vec3 face = clamped(here, point_);
        const double outside = field.blank().distance_mm(face);
        if (outside < 0) return;
        const Vec3 normal = field.blank().gradient(face), at = face - outside * normal;
        if (distance(clamped(here, at), at) <= kInside)
            put({{at, normal, {}}, distance(at, point_), where, {-1, 0, 0}});
        return;
    }
    const Brick& brick = (*field.pool)[ref];
    const double cell_mm = field.cell_mm;
    const Vec3 q = (point_ - field.lattice(where).node(0, 0, 0)) * field.per_cell;
    const double reach = within_mm * field.per_cell + FieldQuery::kClearCells + around_cells() - kAround;
    const double most = within_mm + around_cells() * cell_mm, most_row = most + kClose * cell_mm;
    const auto low = [&](double at) { return std::max(0, static_cast<int>(std::ceil(at - reach))); };
    const auto high = [&](double at) {
        return std::min(kBrickCells, static_cast<int>(std::floor(at + reach)));
    };
    constexpr int kCloseSteps = static_cast<int>(kClose * static_cast<double>(kStepsPerCell));
    for (int c = low(q.z); c <= high(q.z); ++c) {
        for (int b = low(q.y); b <= high(q.y); ++b) {
            const double yz = (b - q.y) * (b - q.y) + (c - q.z) * (c - q.z);
            if (yz * cell_mm * cell_mm >= most_row * most_row) continue;
            for (int a = low(q.x); a <= high(q.x); ++a) {
                const int node = node_index(a, b, c);
                if (std::abs(int{brick.steps[static_cast<std::size_t>(node)]}) > kCloseSteps) continue;
                const double far = most + std::abs(field.at_node_mm(brick, node));
                if ((yz + (a - q.x) * (a - q.x)) * cell_mm * cell_mm >= far * far) continue;
                ShownPlace one;
                if (see(where, a, b, c, one) && !none_nearer(one.place, within_mm)) put(one);
            }
        }
    }
}

void ShownSurface::put(const ShownPlace& one) {
    if (!here_.is_full()) {
        here_.put(one);
        return;
    }
    whole_ = false;
    ShownPlace& farthest = *std::ranges::max_element(here_, {}, &ShownPlace::way_mm);
    if (one.way_mm < farthest.way_mm) farthest = one;
}

// The surface near a node and its normal there: from the grid or, near corners, from the shape that gives the
// distance. The node may be that of a neighbour. False if there is no surface near it.
bool ShownSurface::see(BrickCoord where, int a, int b, int c, ShownPlace& shown) const {
    const auto wrap = [](int& brick, int& node) {
        if (node < 0 || node > kBrickCells) {
            brick += node < 0 ? -1 : 1;
            node += node < 0 ? kBrickCells : -kBrickCells;
        }
    };
    wrap(where.i, a);
    wrap(where.j, b);
    wrap(where.k, c);
    if (!field_->bricks.contains(where)) return false;
    const BrickRef ref = field_->bricks.get(where);
    if (ref < kFirstBrick) return false;
    const Brick& brick = (*field_->pool)[ref];
    const int index = node_index(a, b, c);
    const double d = field_->at_node_mm(brick, index);
    if (std::abs(d) > kClose * field_->cell_mm) return false;
    const Vec3 node = field_->lattice(where).node(a, b, c);
    const auto [slope, even] = differences_at(*field_, brick, a, b, c);
    const double steep = length(slope) * field_->per_cell;
    const bool corner = !(steep > kOneSlope || (even && steep > kLeastSlope));
    const std::uint16_t winner = brick.winner[static_cast<std::size_t>(index)];
    const ShapeId shape = winner == Brick::kUnlisted ? 0 : brick.shapes[winner];
    const Vec3 normal = corner ? normal_at(where, index, shape, node) : normalized(slope, Vec3{0, 0, 1}),
               at = node - (steep > kOneSlope || corner ? d : d / steep) * normal;
    shown = {{at, normal, {}, false, shape, corner}, distance(at, point_), where, {a, b, c}};
    return true;
}

// Nodes near corners are seen often, once from each node beside them.
Vec3 ShownSurface::normal_at(BrickCoord brick, int index, ShapeId shape, Vec3 node) const {
    constexpr unsigned kSpread = 37;
    const unsigned at =
        static_cast<unsigned>(index) + kSpread * static_cast<unsigned>(brick.i + 3 * brick.j + 9 * brick.k);
    std::uint8_t& number = known_at_[at % known_at_.size()];
    if (number != 0) {
        KnownNormal& known = known_[number - 1U];
        if (known.index != index || !(known.brick == brick))
            known = {brick, index, field_->outward(shape, node)};
        return known.normal;
    }
    const Vec3 normal = field_->outward(shape, node);
    if (known_.is_full()) return normal;
    known_.put({brick, index, normal});
    number = static_cast<std::uint8_t>(known_.size());
    return normal;
}

// The part of the way from a place to the point that is along the surface there. Over narrow grooves the grid
// shows means of the normals of both sides; the shape knows its own.
Vec3 ShownSurface::along_surface(const SeenPlace& place) const {
    const bool by_shape = !place.corner && !(place.shape != 0 && field_->shape(place.shape).is_searched());
    const Vec3 normal = by_shape ? field_->outward(place.shape, place.at) : place.normal,
               way = point_ - place.at;
    return way - dot(way, normal) * normal;
}

// Visits the places that nodes beside one show, in the direction in which the surface comes nearer to the
// point, if they are nearer and the surface goes on to come nearer from there: until one is enough. Gives how
// steeply it does so there: as the part of the way to the point that is along the step.
template <class IsEnough>
bool ShownSurface::visit_nearer(const ShownPlace& from, IsEnough&& is_enough) const {
    if (from.node[0] < 0) return false;
    const Vec3 way = along_surface(from.place);
    const auto visit = [&](int a, int b, int c) {
        if (a * way.x + b * way.y + c * way.z <= 0) return false;
        ShownPlace to;
        if (!see(from.brick, from.node[0] + a, from.node[1] + b, from.node[2] + c, to)) return false;
        if (to.way_mm >= from.way_mm || dot(to.place.normal, from.place.normal) < kGoesOn) return false;
        const Vec3 step = to.place.at - from.place.at;
        if (dot(step, way) <= 0) return false;
        // What a node shows in the air before a corner has no slope of its own.
        const Vec3 ahead = normalized(step, Vec3{});
        double fall_mm = dot(ahead, along_surface(to.place));
        if (to.place.corner) fall_mm = std::max(fall_mm, dot(ahead, way));
        return fall_mm > 0 && is_enough(to.place, step, fall_mm);
    };
    // Straight ahead first: that is enough most often.
    const double most = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    const auto along = [most](double part) { return part > 0.5 * most ? 1 : part < -0.5 * most ? -1 : 0; };
    const int first[] = {along(way.x), along(way.y), along(way.z)};
    if (visit(first[0], first[1], first[2])) return true;
    for (int c = -1; c <= 1; ++c) {
        for (int b = -1; b <= 1; ++b) {
            for (int a = -1; a <= 1; ++a) {
                const bool again = a == first[0] && b == first[1] && c == first[2];
                if (!again && visit(a, b, c)) return true;
            }
        }
    }
    return false;
}

// Whether the surface comes nearer to the point all the way to a place that a node beside this one shows.
// That place leads where this one does. Beside a gap a search goes on into that: it has an end of its own.
bool ShownSurface::comes_nearer(const ShownPlace& from) const {
    const SeenPlace& here = from.place;
    const auto goes_on = [&](const SeenPlace& there, Vec3 step, double) {
        if (there.shape == here.shape) return true;
        // Another shape goes on where this one ends, if there is no edge between them.
        const double most = kNoEdge * length(step);
        const auto parts = [&](Vec3 turn) { return dot(step, turn) > most; };
        return !here.corner && !parts(there.normal - here.normal) &&
               !parts(field_->outward(there.shape, there.at) - field_->outward(here.shape, here.at));
    };
    const auto is_gap = [&](const SeenPlace& there, Vec3, double) { return is_left_out(there); };
    return visit_nearer(from, goes_on) && !(no_gaps_ && visit_nearer(from, is_gap));
}

double ShownSurface::steepest_fall_mm(const ShownPlace& from, double enough_mm) const {
    double most = 0;
    visit_nearer(from, [&](const SeenPlace&, Vec3, double fall_mm) {
        most = std::max(most, fall_mm);
        return most >= enough_mm;
    });
    return most;
}

double ShownSurface::around_cells() const {
    return no_gaps_ ? kAroundGaps : kAround;
}

// Returns true if the surface that a place represents is nowhere nearer to the point than `than_mm`.
bool ShownSurface::none_nearer(const SeenPlace& place, double than_mm) const {
    const Vec3 way = point_ - place.at;
    const double over = dot(way, place.normal), aside = length(way - over * place.normal);
    const double side = std::max(0.0, aside - around_cells() * field_->cell_mm),
                 up = std::max(0.0, over - (no_gaps_ ? kBulgeAtGaps : kBulge) * field_->cell_mm);
    return side * side + up * up >= than_mm * than_mm;
}

// Whether a search from a place leads where one did that began, passed or ended at another. Of an edge: it
// comes nearer to the point in the same direction.
bool ShownSurface::leads_to(const SeenPlace& place, const SeenPlace& seen) const {
    if (!is_alike(seen, place, field_->per_cell)) return false;
    if (!seen.ended || squared_length(seen.along) == 0) return true;
    const double ahead_mm = dot(point_ - place.at, seen.along);
    if (seen.lasts_mm < SeenPlace::kUnlimited) return ahead_mm > 0;
    const double way_mm = dot(seen.at - place.at, seen.along);
    return std::abs(way_mm) < kOwn * field_->cell_mm || ahead_mm * way_mm > 0;
}

// How far the side of a place is from the point, if that is between the two bounds: of a place that is known,
// as it is alike to one of another side, or leads there. Within a cell there may be two sides.
std::optional<double> ShownSurface::side_mm(const SeenPlace& place, double least_mm, double most_mm) const {
    const double over_mm = std::max(dot(point_ - place.at, place.normal), least_mm);
    const double behind_mm = over_mm + kLeastNearer * field_->cell_mm;
    if (behind_mm >= most_mm || !field_->is_material(point_ - behind_mm * place.normal, 0))
        return std::nullopt;
    return over_mm;
}

bool ShownSurface::take(double within_mm, const contact::Foot& nearest, std::span<const SeenPlace> but,
                        SeenPlace& place) {
    const double nearest_mm = nearest.sample.distance_mm,
                 ball_mm = nearest_mm - 2 * kLeastNearer * field_->cell_mm;
    while (here_.size() > 0) {
        const ShownPlace one = here_.take(*std::ranges::min_element(here_, {}, &ShownPlace::way_mm));
        if (none_nearer(one.place, within_mm) || is_left_out(one.place)) continue;
        if (passed_.is_full())
            whole_ = false;
        else
            passed_.put(one);
        const auto leads_there = [&](const SeenPlace& other) { return leads_to(one.place, other); };
        const bool is_known = std::any_of(but.begin(), but.end(), leads_there) || comes_nearer(one);
        if (is_known && !side_mm(one.place, ball_mm, nearest_mm)) {
            if (dot(one.place.normal, nearest.sample.normal) < kGoesOn) {
                if (const auto side = side_mm(one.place, nearest_mm, within_mm))
                    other_side_mm_ = std::min(other_side_mm_, *side);
            }
            continue;
        }
        place = one.place;
        return true;
    }
    return false;
}

double ShownSurface::settled_mm(double most_mm, double nearest_mm, std::span<const SeenPlace> seen) const {
    double settled = most_mm;
    for (const ShownPlace& one : passed_) {
        const double nearer_mm = 0.5 * (one.way_mm - nearest_mm);
        if (nearer_mm >= settled) continue;
        double way_mm = nearer_mm;
        for (const SeenPlace& place : seen) {
            if (way_mm >= settled || !leads_to(one.place, place)) continue;
            const double along_mm = std::abs(dot(point_ - one.place.at, place.along));
            if (!place.ended)
                way_mm = std::max(way_mm, place.lasts_mm);
            else if (place.lasts_mm == SeenPlace::kUnlimited && along_mm < kOwn * field_->cell_mm)
                way_mm = settled;
            else
                way_mm = std::max(way_mm, std::min(place.lasts_mm, along_mm));
        }
        if (way_mm < settled) way_mm = std::max(way_mm, steepest_fall_mm(one, settled));
        settled = std::min(settled, way_mm);
        if (settled < kTooLittle * field_->cell_mm) return 0;
    }
    return settled;
}

}  // namespace tribo::field
