// SPDX-License-Identifier: MIT
#include "field/contour/contour_nodes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace tribo::field {
namespace {

// Value of air if no node gives its distance, in cells: more than half the diagonal of a cell.
constexpr float kAirCells = static_cast<float>(FieldQuery::kClearCells);
// A wall or slit thinner than this share of a cell is left out of the mesh: single precision would not keep
// its two sides apart.
constexpr double kThinnest = 1e-3;

constexpr int coordinate(int node, int axis) {
    return axis == 0   ? node % kLatticeEdge
           : axis == 1 ? node / kLatticeEdge % kLatticeEdge
                       : node / (kLatticeEdge * kLatticeEdge);
}

// A node on the border of a brick, and the same node in the bricks that share it. The bricks are numbered as
// in BrickNodes::around.
struct BorderNode {
    std::uint16_t node = 0;
    std::uint16_t count = 0;
    std::array<std::uint8_t, 8> brick{};
    std::array<std::uint16_t, 8> node_there{};
};
constexpr std::size_t kBorderNodes =
    kLatticeNodes - (kLatticeEdge - 2) * (kLatticeEdge - 2) * (kLatticeEdge - 2);

constexpr std::array<BorderNode, kBorderNodes> kBorder = [] {
    std::array<BorderNode, kBorderNodes> all{};
    std::size_t count = 0;
    for (int node = 0; node < kLatticeNodes; ++node) {
        const int at[3] = {coordinate(node, 0), coordinate(node, 1), coordinate(node, 2)};
        const auto low = [&](int axis) { return at[axis] == 0 ? -1 : 0; };
        const auto high = [&](int axis) { return at[axis] == kBrickCells ? 1 : 0; };
        BorderNode border;
        border.node = static_cast<std::uint16_t>(node);
        for (int k = low(2); k <= high(2); ++k) {
            for (int j = low(1); j <= high(1); ++j) {
                for (int i = low(0); i <= high(0); ++i) {
                    border.brick[border.count] =
                        static_cast<std::uint8_t>((i + 1) + 3 * ((j + 1) + 3 * (k + 1)));
                    border.node_there[border.count++] = static_cast<std::uint16_t>(node_index(
                        at[0] - kBrickCells * i, at[1] - kBrickCells * j, at[2] - kBrickCells * k));
                }
            }
        }
        if (border.count > 1) all[count++] = border;
    }
    return all;
}();

// One end of a line, on one side of the surface.
struct End {
    double at, distance_mm;  // along the line, mm; from the surface, > 0
    ShapeId shape;           // the shape that gives the distance
};

// Searches the line from p along `unit` for a point on the other side of the surface: `sign` times the
// distance is negative there. Returns nothing if the other side cannot lie between the ends, because the
// slope is at most one. Also returns nothing between two points in air of one carved shape, because carved
// shapes do not bend around walls.
std::optional<double> find_beyond(const CarvedField& field, BrickRef ref, Vec3 p, Vec3 unit, End low,
                                  End high, double sign) {
    constexpr int kMost = 10;
    for (int n = 0; n < kMost; ++n) {
        const double slack = high.at - low.at - low.distance_mm - high.distance_mm;
        if (slack <= 0 || (sign > 0 && low.shape == high.shape && low.shape != 0)) break;
        const double at = low.at + low.distance_mm + 0.5 * slack;
        const CarvedField::Exact e = field.exact(ref, p + at * unit);
        const double d = sign * e.distance_mm;
        if (d < 0) return at;
        // The side on which the search continues: the one whose end has another shape, otherwise the one with
        // more room.
        const bool to_high = low.shape != high.shape && (e.shape == low.shape || e.shape == high.shape)
                                 ? e.shape == low.shape
                                 : high.at - at - high.distance_mm >= at - low.at - low.distance_mm;
        (to_high ? low : high) = {at, d, e.shape};
    }
    return std::nullopt;
}

}  // namespace

BrickNodes::BrickNodes(const CarvedField& field, BrickCoord coord)
    : field_(field), coord_(coord), lattice_(field.lattice(coord)), ref_(field.ref(coord)) {
    find_around();
    if (ref_ < kFirstBrick &&
        field.blank().distance_mm(field.centre(coord)) < -field.brick_radius_mm() - field.cell_mm()) {
        value_.fill(static_cast<float>(-field.near_mm()));
    } else {
        field.sample_nodes(coord, value_.data());
    }
    agree_on_border();
    look_at_rows();
}

void BrickNodes::find_around() {
    std::size_t n = 0;
    for (int dk = -1; dk <= 1; ++dk) {
        for (int dj = -1; dj <= 1; ++dj) {
            for (int di = -1; di <= 1; ++di) {
                const BrickCoord b{coord_.i + di, coord_.j + dj, coord_.k + dk};
                around_[n] = field_.contains(b) ? field_.ref(b) : kAir;
                if (around_[n++] != kUntouched) untouched_around_ = false;
            }
        }
    }
}

// Makes the values on the border agree: air wins, then the first brick with its own nodes.
void BrickNodes::agree_on_border() {
    if (untouched_around_) return;
    const float clear = kAirCells * static_cast<float>(field_.cell_mm());
    for (const BorderNode& border : kBorder) {
        bool air = false;
        std::optional<double> first;
        for (std::size_t n = 0; n < border.count; ++n) {
            const BrickRef ref = around_[border.brick[n]];
            air |= ref == kAir;
            if (ref >= kFirstBrick && !first)
                first = field_.at_node_mm(field_.brick(ref), border.node_there[n]);
        }
        float& value = value_[border.node];
        if (first) value = static_cast<float>(*first);
        if (air && value < clear) value = clear;
    }
}

void BrickNodes::look_at_rows() {
    const auto cell = static_cast<float>(field_.cell_mm());
    const auto half = static_cast<float>(0.5 * field_.cell_mm());
    const float* value = value_.data();
    for (std::size_t row = 0; row < kRows; ++row) {
        unsigned inside = 0, near = 0, very_near = 0;
        for (unsigned a = 0; a < kLatticeEdge; ++a) {
            const float d = *value++, far = std::abs(d);
            inside |= static_cast<unsigned>(d < 0) << a;
            near |= static_cast<unsigned>(far < cell) << a;
            very_near |= static_cast<unsigned>(far <= half) << a;
        }
        inside_[row] = static_cast<std::uint8_t>(inside);
        near_[row] = static_cast<std::uint8_t>(near);
        very_near_[row] = static_cast<std::uint8_t>(very_near);
    }
}

bool BrickNodes::has_surface() const {
    // Between nodes that are at least half a cell from the surface no wall or slit can be hidden.
    unsigned in = 0xff, out = 0xff;
    for (std::size_t row = 0; row < kRows; ++row) {
        in &= inside_[row] & ~unsigned{very_near_[row]};
        out &= ~unsigned{inside_[row]} & ~unsigned{very_near_[row]};
    }
    return in != 0xff && out != 0xff;
}

// Returns the first brick with its own nodes among those that share all nodes of the box between two corners.
BrickRef BrickNodes::ref_between(int from, int to) const {
    if (untouched_around_) return kUntouched;
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int a = coordinate(from, axis), b = coordinate(to, axis);
        low[axis] = a == 0 && b == 0 ? -1 : 0;
        high[axis] = a == kBrickCells && b == kBrickCells ? 1 : 0;
    }
    for (int dk = low[2]; dk <= high[2]; ++dk) {
        for (int dj = low[1]; dj <= high[1]; ++dj) {
            for (int di = low[0]; di <= high[0]; ++di) {
                if (around(di, dj, dk) >= kFirstBrick) return around(di, dj, dk);
            }
        }
    }
    return kUntouched;
}

void BrickNodes::find_crossings(bool rough) {
    constexpr unsigned kLower = (1U << kBrickCells) - 1;
    for (int axis = 0; axis < 3; ++axis) {
        edges_[static_cast<std::size_t>(axis)].fill({});
        // The row with the upper ends of the edges of a row.
        const auto up = static_cast<std::size_t>(kStep[axis] / kLatticeEdge);
        for (std::size_t row = 0; row < kRows; ++row) {
            const int first = static_cast<int>(row) * kLatticeEdge;
            if (axis != 0 && coordinate(first, axis) == kBrickCells) continue;
            const auto upper = [&](const std::array<std::uint8_t, kRows>& rows) {
                return axis == 0 ? unsigned{rows[row]} >> 1 : unsigned{rows[row + up]};
            };
            unsigned left = (inside_[row] ^ upper(inside_)) | (near_[row] & upper(near_));
            if (axis == 0) left &= kLower;
            for (; left != 0; left &= left - 1) look_at_edge(axis, first + std::countr_zero(left), rough);
        }
    }
}

void BrickNodes::look_at_edge(int axis, int node, bool rough) {
    const float d0 = value_[static_cast<std::size_t>(node)];
    const float d1 = value_[static_cast<std::size_t>(node + kStep[axis])];
    if ((d0 < 0) == (d1 < 0)) {
        if (!rough && std::abs(d0) + std::abs(d1) < static_cast<float>(field_.cell_mm()))
            find_thin(axis, node);
        return;
    }
    edges_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(node)] = {
        static_cast<std::uint16_t>(list_.size()), 1};
    const auto from = static_cast<double>(d0), to = static_cast<double>(d1);
    list_.push_back(rough ? rough_crossing(axis, node, from, to)
                          : find_crossing(ref_between(node, node + kStep[axis]), axis, node, 0, 1, from, to));
}

Crossing BrickNodes::rough_crossing(int axis, int node, double d0, double d1) const {
    const int other = node + kStep[axis];
    const BrickRef ref = ref_between(node, other);
    const ShapeId here = shape_at(ref, node), there = shape_at(ref, other);
    // The faces of the blank stay flat up to their edges: machined ones are told from them by that. Beside
    // them differences mix the two.
    if (here == 0 || there == 0) {
        if (const auto x = crossing_of(d0 > 0 ? here : there, axis, node)) return *x;
    }
    Crossing x = crossing_at(axis, node, d0 / (d0 - d1));
    x.normal = rough_normal(x.along < 0.5 ? node : other);
    return x;
}

Crossing BrickNodes::crossing_at(int axis, int node, double along) const {
    Crossing x;
    x.along = along;
    x.point = node_mm(node);
    x.point[axis] += along * field_.cell_mm();
    x.edge = static_cast<std::uint16_t>(kLatticeNodes * axis + node);
    return x;
}

// Where the surface of one shape crosses the edge, by one step of Newton from the chord: at an edge of the
// shape its distance bends between the ends. Nothing if both ends are on one side of it.
std::optional<Crossing> BrickNodes::crossing_of(ShapeId shape, int axis, int node) const {
    const auto sample = [&](Vec3 p) { return field_.sample_piece(shape, p); };
    const double from = sample(node_mm(node)).distance_mm,
                 to = sample(node_mm(node + kStep[axis])).distance_mm;
    if ((from < 0) == (to < 0)) return std::nullopt;
    const Crossing chord = crossing_at(axis, node, from / (from - to));
    const contact::SurfaceSample s = sample(chord.point);
    const double rate = field_.cell_mm() * s.normal[axis], step = rate != 0 ? s.distance_mm / rate : 0;
    Crossing x = crossing_at(axis, node, std::clamp(chord.along - step, 0.0, 1.0));
    x.normal = sample(x.point).normal;
    return x;
}

// By differences to the neighbours nearer to the surface: values far from it are clamped.
Vec3 BrickNodes::rough_normal(int node) const {
    const auto value = [&](int n) { return static_cast<double>(value_[static_cast<std::size_t>(n)]); };
    Vec3 rise;
    for (int axis = 0; axis < 3; ++axis) {
        const int at = coordinate(node, axis);
        const bool has_low = at > 0, has_high = at < kBrickCells;
        const bool up = has_high && (!has_low || std::abs(value(node + kStep[axis])) <
                                                     std::abs(value(node - kStep[axis])));
        rise[axis] = up ? value(node + kStep[axis]) - value(node) : value(node) - value(node - kStep[axis]);
    }
    return normalized(rise, {0, 0, 1});
}

// Regula falsi (Illinois) along an edge whose ends lie on different sides. It starts from the values there,
// which are distances, so that one or two evaluations of the exact level are usual. At a kink beside a face
// that runs along the edge it converges slowly: halvings find it.
Crossing BrickNodes::find_crossing(BrickRef ref, int axis, int node, double t0, double t1, double d0,
                                   double d1) const {
    constexpr double kDone = 1e-7;  // mm
    constexpr int kMost = 40, kFalsi = 8;
    const Vec3 from = node_mm(node);
    Crossing x;
    x.point = from;
    x.edge = static_cast<std::uint16_t>(kLatticeNodes * axis + node);
    CarvedField::Exact e{0, 0};
    int side = 0;
    for (int n = 0; n < kMost; ++n) {
        x.along = n < kFalsi ? t0 + (t1 - t0) * d0 / (d0 - d1) : 0.5 * (t0 + t1);
        x.point[axis] = from[axis] + x.along * field_.cell_mm();
        e = field_.exact(ref, x.point);
        if (std::abs(e.distance_mm) < kDone) break;
        if ((e.distance_mm < 0) == (d0 < 0)) {
            t0 = x.along;
            d0 = e.distance_mm;
            if (side == 1) d1 *= 0.5;
            side = 1;
        } else {
            t1 = x.along;
            d1 = e.distance_mm;
            if (side == -1) d0 *= 0.5;
            side = -1;
        }
    }
    x.normal = normal_of_face(field_, e.shape, x.point);
    x.shape = e.shape;
    return x;
}

// Returns the shape that gives the distance at a node of this brick, according to the brick `ref`.
ShapeId BrickNodes::shape_at(BrickRef ref, int node) const {
    if (ref < kFirstBrick) return 0;
    const Brick& brick = field_.brick(ref);
    const int there = node_index(coordinate(node, 0) + kBrickCells * (coord_.i - brick.coord.i),
                                 coordinate(node, 1) + kBrickCells * (coord_.j - brick.coord.j),
                                 coordinate(node, 2) + kBrickCells * (coord_.k - brick.coord.k));
    const std::uint16_t winner = brick.winner[static_cast<std::size_t>(there)];
    return winner == Brick::kUnlisted ? 0 : brick.shapes[winner];
}

void BrickNodes::find_thin(int axis, int node) {
    const BrickRef ref = ref_between(node, node + kStep[axis]);
    const double d0 = static_cast<double>(value_[static_cast<std::size_t>(node)]);
    const double d1 = static_cast<double>(value_[static_cast<std::size_t>(node + kStep[axis])]);
    Vec3 unit;
    unit[axis] = 1;
    const double cell = field_.cell_mm();
    const std::optional<double> beyond =
        find_beyond(field_, ref, node_mm(node), unit, {0, std::abs(d0), shape_at(ref, node)},
                    {cell, std::abs(d1), shape_at(ref, node + kStep[axis])}, d0 < 0 ? -1 : 1);
    if (!beyond) return;
    const double t = *beyond / cell;
    const double d = field_.exact(ref, node_mm(node) + *beyond * unit).distance_mm;
    const Crossing first = find_crossing(ref, axis, node, 0, t, d0, d);
    const Crossing second = find_crossing(ref, axis, node, t, 1, d, d1);
    if (second.along - first.along < kThinnest) return;
    has_thin_ = true;
    edges_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(node)] = {
        static_cast<std::uint16_t>(list_.size()), 2};
    list_.push_back(first);
    list_.push_back(second);
}

FaceSegments BrickNodes::segments(int node, int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int edge_axis[4] = {u, v, u, v};
    const int edge_node[4] = {node, node + kStep[u], node + kStep[v], node};
    std::array<FaceSegment::End, 8> ends{};
    int count = 0;
    FaceSegments found;
    for (std::uint8_t e = 0; e < 4; ++e) {
        const int n = crossings(edge_axis[e], edge_node[e]).count;
        found.has_thin |= n > 1;
        for (int k = 0; k < n; ++k)
            ends[static_cast<std::size_t>(count++)] = {e, static_cast<std::uint8_t>(e < 2 ? k : n - 1 - k)};
    }
    // Between two consecutive crossings the border of the face is completely inside or completely outside.
    // Only with four or more crossings there is a choice of which one the segments run around: usually the
    // inside, so that material that meets only in a corner is not connected.
    bool around_inside = true;
    if (count > 2 && found.has_thin) around_inside = !is_joined(node, axis, ends, count);
    const int first = inside(node) != around_inside ? 0 : 1;
    for (int n = first; n < first + count; n += 2) {
        found.all[static_cast<std::size_t>(found.count++)] = {
            ends[static_cast<std::size_t>(n % count)], ends[static_cast<std::size_t>((n + 1) % count)]};
    }
    return found;
}

const Crossing& BrickNodes::at(int node, int axis, FaceSegment::End end) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int from = end.edge == 1 ? node + kStep[u] : end.edge == 2 ? node + kStep[v] : node;
    return list_[static_cast<std::size_t>(crossings(end.edge % 2 == 0 ? u : v, from).first + end.ordinal)];
}

// Returns true if there is material between two points in air, or air between two points in material.
bool BrickNodes::is_parted(BrickRef ref, Vec3 p, Vec3 q, bool by_material) const {
    const double sign = by_material ? 1 : -1;
    const CarvedField::Exact from = field_.exact(ref, p), to = field_.exact(ref, q);
    const double way = distance(p, q);
    if (sign * from.distance_mm <= 0 || sign * to.distance_mm <= 0 || way <= 0) return false;
    return find_beyond(field_, ref, p, (q - p) / way, {0, sign * from.distance_mm, from.shape},
                       {way, sign * to.distance_mm, to.shape}, sign)
        .has_value();
}

// Returns true if the material along the border of a face is connected across it.
bool BrickNodes::is_joined(int node, int axis, const std::array<FaceSegment::End, 8>& ends, int count) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vec3 corner = node_mm(node);
    const BrickRef ref = ref_between(node, node + kStep[u] + kStep[v]);
    // Position along the border, in cells.
    const auto way = [&](int n) {
        const FaceSegment::End end = ends[static_cast<std::size_t>(n % count)];
        const double along = at(node, axis, end).along;
        return end.edge + (end.edge < 2 ? along : 1 - along) + (n >= count ? 4 : 0);
    };
    const auto middle = [&](int n) {  // between crossing n and the next
        const double once = 0.5 * (way(n) + way(n + 1)), s = once < 4 ? once : once - 4;
        const double a = s < 1 ? s : s < 2 ? 1 : s < 3 ? 3 - s : 0;
        const double b = s < 1 ? 0 : s < 2 ? s - 1 : s < 3 ? 1 : 4 - s;
        Vec3 p = corner;
        p[u] += a * field_.cell_mm();
        p[v] += b * field_.cell_mm();
        return p;
    };
    // Pieces of the border in air that a wall separates; for a slit, pieces in material.
    bool wall = false;
    const int edge_axis[4] = {u, v, u, v};
    const int edge_node[4] = {node, node + kStep[u], node + kStep[v], node};
    for (int e = 0; e < 4; ++e)
        wall |= crossings(edge_axis[e], edge_node[e]).count > 1 && !inside(edge_node[e]);
    const int first = inside(node) == wall ? 0 : 1;
    bool parted = true;
    const int pieces = count / 2;
    for (int n = 0; n < (pieces == 2 ? 1 : pieces); ++n)
        parted &= is_parted(ref, middle(first + 2 * n), middle((first + 2 * n + 2) % count), wall);
    return parted == wall;
}

}  // namespace tribo::field
