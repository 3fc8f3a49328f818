// SPDX-License-Identifier: MIT
#include "field/carved_field.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "field/brick_kernels.hpp"

namespace tribo::field {
namespace {

// The first node stands this many cells outside the blank: a fraction that keeps nodes off the round
// coordinates where programs put their planes, so that signs at nodes are seldom a matter of rounding.
constexpr double kMarginCells = 2.37;
// Work is handed to other threads from this many bricks on; below it the hand-over costs more than it saves.
constexpr std::size_t kParallelBricks = 64;
// A brick's list is pruned when it has grown by this many shapes.
constexpr std::size_t kPruneEvery = 8;
// A brick whose nodes are all further than this from material (in cells) holds none between them either:
// half the diagonal of a cell.
constexpr double kClearCells = 0.8661;

BrickCoord grid_size(const Box3& blank, double cell) {
    const double brick = kBrickCells * cell;
    const auto bricks = [&](double extent) {
        return static_cast<int>(std::ceil((extent + 2 * kMarginCells * cell) / brick));
    };
    const Vec3 s = blank.size();
    return {bricks(s.x), bricks(s.y), bricks(s.z)};
}

}  // namespace

CarvedField::CarvedField(std::unique_ptr<const Shape> blank, double cell_mm, ParallelFor parallel)
    : cell_(cell_mm),
      per_cell_(1 / cell_mm),
      near_(kNearCells * cell_mm),
      brick_radius_(0.5 * std::sqrt(3.0) * kBrickCells * cell_mm),
      parallel_(std::move(parallel)),
      index_(grid_size(blank->bounds_mm(), cell_mm)) {
    assert(cell_mm > 0);
    const Vec3 corner = blank->bounds_mm().min;
    const double margin = kMarginCells * cell_mm;
    origin_ = {corner.x - margin, corner.y - margin, corner.z - margin};
    shapes_.push_back(std::move(blank));
}

Vec3 CarvedField::centre(BrickCoord b) const {
    const double half = 0.5 * kBrickCells * cell_;
    return lattice(b).node(0, 0, 0) + Vec3{half, half, half};
}

BrickCoord CarvedField::brick_at(Vec3 p) const {
    const Vec3 q = (p - origin_) * (per_cell_ / kBrickCells);
    // Far points are clamped before the conversion, which would overflow.
    const auto whole = [](double v) { return static_cast<int>(std::floor(std::clamp(v, -1e9, 1e9))); };
    return {whole(q.x), whole(q.y), whole(q.z)};
}

double CarvedField::volume_mm3(const float* distance_mm) const {
    return brick_kernels().volume_cells(distance_mm, static_cast<float>(cell_)) * cell_ * cell_ * cell_;
}

double CarvedField::blank_brick_volume(BrickCoord b) const {
    const double d = blank().distance_mm(centre(b));
    if (d > brick_radius_ + cell_) return 0;
    const double edge = kBrickCells * cell_;
    if (d < -brick_radius_ - cell_) return edge * edge * edge;
    std::array<float, kLatticeNodes> nodes;
    blank().sample(lattice(b), nodes.data());
    return volume_mm3(nodes.data());
}

void CarvedField::fill_from_blank(Brick& brick) const {
    const auto floor = static_cast<float>(-near_);
    brick.shapes.clear();
    if (blank().distance_mm(centre(brick.coord)) < -brick_radius_ - near_) {
        brick.distance_mm.fill(floor);
        brick.winner.fill(Brick::kUnlisted);
        const double edge = kBrickCells * cell_;
        brick.volume_mm3 = edge * edge * edge;
        return;
    }
    blank().sample(lattice(brick.coord), brick.distance_mm.data());
    for (float& d : brick.distance_mm) d = std::max(d, floor);
    brick.shapes.push_back(0);
    brick.winner.fill(0);
    brick.volume_mm3 = volume_mm3(brick.distance_mm.data());
}

void CarvedField::clear(BrickCoord b, BrickRef ref) {
    cleared_ += ref >= kFirstBrick ? pool_[ref].volume_mm3 : blank_brick_volume(b);
    if (ref >= kFirstBrick) pool_.give_back(ref);
    index_.set(b, kAir);
}

void CarvedField::gather_brick(const Shape& shape, BrickCoord b) {
    const BrickRef ref = index_.get(b);
    if (ref == kAir) return;
    const Vec3 c = centre(b);
    const double d = shape.distance_mm(c);
    if (d >= brick_radius_ + near_) return;
    if (d <= -brick_radius_ - cell_) {
        clear(b, ref);
        return;
    }
    if (ref == kUntouched && blank().distance_mm(c) > brick_radius_) {
        index_.set(b, kAir);
        return;
    }
    updates_.push_back({b, ref, ref == kUntouched});
}

void CarvedField::gather(const Shape& shape) {
    const Box3 reach = shape.bounds_mm().inflated(near_);
    const BrickCoord n = index_.size();
    const BrickCoord lo = brick_at(reach.min), hi = brick_at(reach.max);
    const int i0 = std::max(lo.i, 0), j0 = std::max(lo.j, 0), k0 = std::max(lo.k, 0);
    const int i1 = std::min(hi.i, n.i - 1), j1 = std::min(hi.j, n.j - 1), k1 = std::min(hi.k, n.k - 1);
    // Blocks of bricks first: most of a long sweep's box is either far from it or deep inside it.
    constexpr int kBlock = 4;
    const double block_radius = kBlock * brick_radius_;
    const double half = 0.5 * kBlock * kBrickCells * cell_;
    for (int k = k0; k <= k1; k += kBlock) {
        for (int j = j0; j <= j1; j += kBlock) {
            for (int i = i0; i <= i1; i += kBlock) {
                const Vec3 c = lattice({i, j, k}).node(0, 0, 0) + Vec3{half, half, half};
                if (shape.distance_mm(c) >= block_radius + near_) continue;
                for (int kk = k; kk <= std::min(k + kBlock - 1, k1); ++kk) {
                    for (int jj = j; jj <= std::min(j + kBlock - 1, j1); ++jj) {
                        for (int ii = i; ii <= std::min(i + kBlock - 1, i1); ++ii) {
                            gather_brick(shape, {ii, jj, kk});
                        }
                    }
                }
            }
        }
    }
}

void CarvedField::update(Update& u, const Shape& shape, ShapeId id) {
    Brick& brick = pool_[u.ref];
    std::array<float, kLatticeNodes> carved;
    shape.sample(lattice(u.coord), carved.data());
    if (u.fresh) fill_from_blank(brick);
    const auto index = static_cast<std::uint16_t>(brick.shapes.size());
    const CarveResult result =
        brick_kernels().carve(brick.distance_mm.data(), brick.winner.data(), carved.data(), index,
                              static_cast<float>(near_), static_cast<float>(cell_));
    if (!result.changed) {
        u.drop = u.fresh;
        return;
    }
    if (result.least_mm > kClearCells * cell_) {
        u.air = true;
        u.removed_mm3 = brick.volume_mm3;
        return;
    }
    u.removed_mm3 = result.removed_cells * cell_ * cell_ * cell_;
    brick.volume_mm3 -= u.removed_mm3;
    if (!result.won) return;
    brick.shapes.push_back(id);
    if (brick.shapes.size() % kPruneEvery == 0) prune_shapes(brick, static_cast<float>(near_));
}

double CarvedField::carve(std::unique_ptr<const Shape> shape) {
    updates_.clear();
    cleared_ = 0;
    gather(*shape);
    for (Update& u : updates_) {
        if (u.fresh) u.ref = pool_.take(u.coord);
    }
    const auto id = static_cast<ShapeId>(shapes_.size());
    const auto body = [&](std::size_t n) { update(updates_[n], *shape, id); };
    if (updates_.size() >= kParallelBricks) {
        parallel_(updates_.size(), body);
    } else {
        for (std::size_t n = 0; n < updates_.size(); ++n) body(n);
    }
    double removed = cleared_;
    for (const Update& u : updates_) {
        removed += u.removed_mm3;
        if (u.drop) {
            pool_.give_back(u.ref);
        } else if (u.air) {
            pool_.give_back(u.ref);
            index_.set(u.coord, kAir);
        } else if (u.fresh) {
            index_.set(u.coord, u.ref);
        }
    }
    shapes_.push_back(std::move(shape));
    removed_ += removed;
    return removed;
}

CarvedField::NearNode CarvedField::nearest_node(BrickCoord b, Vec3 p) const {
    const Vec3 q = (p - lattice(b).node(0, 0, 0)) * per_cell_;
    const auto nearest = [](double v) {
        return static_cast<int>(std::clamp(v + 0.5, 0.0, static_cast<double>(kBrickCells)));
    };
    const int i = nearest(q.x), j = nearest(q.y), k = nearest(q.z);
    return {node_index(i, j, k), q - Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}};
}

CarvedField::Exact CarvedField::exact(BrickRef ref, Vec3 p) const {
    if (ref == kUntouched) return {blank().distance_mm(p), 0};
    if (ref == kAir) return {kClearCells * cell_, 0};
    const Brick& brick = pool_[ref];
    Exact best{-near_, 0};
    const auto measure = [&](ShapeId id) {
        const double d =
            id == 0 ? shapes_[0]->distance_mm(p) : -shapes_[id]->distance_below(p, -best.distance_mm);
        if (d > best.distance_mm) best = {d, id};
    };
    // The shape that gives the distance at the nearest node most likely gives it here; the others need only
    // show that they do not.
    const std::uint16_t likely = brick.winner[static_cast<std::size_t>(nearest_node(brick.coord, p).index)];
    if (likely != Brick::kUnlisted) measure(brick.shapes[likely]);
    for (std::size_t n = 0; n < brick.shapes.size(); ++n) {
        if (n != likely) measure(brick.shapes[n]);
    }
    return best;
}

double CarvedField::distance_mm(Vec3 p) const {
    const BrickCoord b = brick_at(p);
    if (!index_.contains(b)) return std::max(blank().distance_mm(p), kClearCells * cell_);
    return exact(index_.get(b), p).distance_mm;
}

Vec3 CarvedField::normal(Vec3 p) const {
    const BrickCoord b = brick_at(p);
    if (!index_.contains(b)) return blank().gradient(p);
    const Exact e = exact(index_.get(b), p);
    return e.shape == 0 ? blank().gradient(p) : -shapes_[e.shape]->gradient(p);
}

bool CarvedField::is_material(Vec3 p, double skin_mm) const {
    const BrickCoord b = brick_at(p);
    if (!index_.contains(b)) return false;
    const BrickRef ref = index_.get(b);
    if (ref == kAir) return false;
    if (ref == kUntouched) return blank().distance_mm(p) < -skin_mm;
    const Brick& brick = pool_[ref];
    const NearNode near = nearest_node(b, p);
    const auto node = static_cast<std::size_t>(near.index);
    const double way = cell_ * length(near.off_cells);
    // What the node says holds as far around it as its distance, less rounding.
    const double d = static_cast<double>(brick.distance_mm[node]);
    constexpr double kRounding = 1e-3;
    if (d > way + kRounding * cell_) return false;
    if (d < -way - kRounding * cell_ - skin_mm) return true;
    const auto in_material = [&](ShapeId id) {
        return id == 0 ? shapes_[0]->distance_mm(p) < -skin_mm
                       : shapes_[id]->distance_below(p, skin_mm) >= skin_mm;
    };
    const std::uint16_t likely = brick.winner[node];
    if (likely != Brick::kUnlisted && !in_material(brick.shapes[likely])) return false;
    for (std::size_t n = brick.shapes.size(); n-- > 0;) {
        if (n != likely && !in_material(brick.shapes[n])) return false;
    }
    return true;
}

std::optional<Vec3> CarvedField::overlap(const Shape& shape, double depth_mm) const {
    const Box3 reach = shape.bounds_mm();
    const BrickCoord n = index_.size(), lo = brick_at(reach.min), hi = brick_at(reach.max);
    std::optional<Vec3> place;
    float deepest = static_cast<float>(-depth_mm);
    std::array<float, kLatticeNodes> other, own;
    for (int k = std::max(lo.k, 0); k <= std::min(hi.k, n.k - 1); ++k) {
        for (int j = std::max(lo.j, 0); j <= std::min(hi.j, n.j - 1); ++j) {
            for (int i = std::max(lo.i, 0); i <= std::min(hi.i, n.i - 1); ++i) {
                const BrickRef ref = index_.get({i, j, k});
                const Vec3 c = centre({i, j, k});
                if (ref == kAir || shape.distance_mm(c) > brick_radius_) continue;
                if (ref == kUntouched && blank().distance_mm(c) > brick_radius_) continue;
                const Lattice nodes = lattice({i, j, k});
                shape.sample(nodes, other.data());
                const float* material = own.data();
                if (ref == kUntouched) {
                    blank().sample(nodes, own.data());
                } else {
                    material = pool_[ref].distance_mm.data();
                }
                for (int at = 0; at < kLatticeNodes; ++at) {
                    const float d = std::max(other[static_cast<std::size_t>(at)], material[at]);
                    if (d >= deepest) continue;
                    deepest = d;
                    place = nodes.node(at % kLatticeEdge, at / kLatticeEdge % kLatticeEdge,
                                       at / (kLatticeEdge * kLatticeEdge));
                }
            }
        }
    }
    return place;
}

double CarvedField::estimated_bytes(const Box3& blank_mm, double cell_mm, double surface_mm2) {
    const BrickCoord n = grid_size(blank_mm, cell_mm);
    const double bricks = static_cast<double>(n.i) * n.j * n.k;
    const double brick_edge = kBrickCells * cell_mm;
    // A surface passes through about two bricks per brick face of its area: it is seldom centred in a layer.
    const double touched = std::min(bricks, 2 * surface_mm2 / (brick_edge * brick_edge));
    const double chunk = kChunkEdge * kChunkEdge * kChunkEdge;
    return touched * (sizeof(Brick) + 64) + bricks * (sizeof(BrickRef) + sizeof(void*) / chunk);
}

}  // namespace tribo::field
