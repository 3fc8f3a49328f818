// SPDX-License-Identifier: MIT
#include "field/carved/carved_field.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "field/carved/brick_kernels.hpp"

namespace tribo::field {
namespace {

// Other threads are used from this many bricks or shapes on. Below it the hand-over costs more than it saves.
constexpr std::size_t kParallelBricks = 64;
constexpr std::size_t kParallelShapes = 8;
// Position of the brick's number in a cut; below it are the shape's number and a bit.
constexpr int kBrickShift = 11;
static_assert(CarvedField::kMostAtOnce == std::size_t{1} << (kBrickShift - 1));
// A brick's list is pruned when it has grown by this many shapes. Pruning takes about as long as carving a
// brick with a shape without search; it takes little beside a shape with search.
constexpr std::size_t kPruneEvery = 8, kPruneEverySearched = 1;
// Error of the distances of a shape with search at the nodes, mm.
constexpr double kSearchedError = 5e-5;

// Number of bricks along each axis. Whole numbers as doubles, because the requested cell may be finer than
// any possible grid.
Vec3 bricks_along(const Box3& blank, double cell) {
    const double brick = kBrickCells * cell;
    const auto bricks = [&](double extent) {
        return std::ceil((extent + 2 * CarvedField::kMarginCells * cell) / brick);
    };
    const Vec3 s = blank.size();
    return {bricks(s.x), bricks(s.y), bricks(s.z)};
}

BrickCoord grid_size(const Box3& blank, double cell) {
    const Vec3 n = bricks_along(blank, cell);
    return {static_cast<int>(n.x), static_cast<int>(n.y), static_cast<int>(n.z)};
}

}  // namespace

CarvedField::CarvedField(std::unique_ptr<const Shape> blank, double cell_mm, ParallelFor parallel)
    : cell_(cell_mm),
      near_(static_cast<double>(Brick::kNearCells) * cell_mm),
      brick_radius_(0.5 * std::sqrt(3.0) * kBrickCells * cell_mm),
      parallel_(std::move(parallel)),
      tables_(std::make_unique<FieldTables>(grid_size(blank->bounds_mm(), cell_mm))) {
    assert(cell_mm > 0);
    const Vec3 corner = blank->bounds_mm().min;
    const double margin = kMarginCells * cell_;
    tables_->shapes.push_back(std::move(blank));
    tables_->query.origin_mm = {corner.x - margin, corner.y - margin, corner.z - margin};
    tables_->query.cell_mm = cell_;
    tables_->query.per_cell = 1 / cell_;
    tables_->query.near_mm = near_;
    chunk_changes_.assign(tables_->index.chunks().size(), 0);
}

Vec3 CarvedField::centre(BrickCoord b) const {
    const double half = 0.5 * kBrickCells * cell_;
    return lattice(b).node(0, 0, 0) + Vec3{half, half, half};
}

double CarvedField::volume_mm3(const NodeSteps* steps) const {
    return brick_kernels().volume_cells(steps) * cell_ * cell_ * cell_;
}

void CarvedField::sample_blank(BrickCoord b, NodeSteps* steps) const {
    std::array<float, kLatticeNodes> nodes;
    blank().sample(lattice(b), nodes.data());
    brick_kernels().to_steps(nodes.data(), static_cast<float>(cell_), steps);
}

double CarvedField::blank_brick_volume(BrickCoord b) const {
    const double d = blank().distance_mm(centre(b));
    if (d > brick_radius_ + cell_) return 0;
    const double edge = kBrickCells * cell_;
    if (d < -brick_radius_ - cell_) return edge * edge * edge;
    std::array<NodeSteps, kLatticeNodes> nodes;
    sample_blank(b, nodes.data());
    return volume_mm3(nodes.data());
}

void CarvedField::sample_nodes(BrickCoord b, float* distance_mm) const {
    const BrickRef at = ref(b);
    if (at < kFirstBrick) return blank().sample(lattice(b), distance_mm);
    for (int node = 0; node < kLatticeNodes; ++node)
        distance_mm[node] = static_cast<float>(at_node_mm(brick(at), node));
}

void CarvedField::fill_from_blank(Brick& brick) const {
    constexpr auto kDeep = static_cast<NodeSteps>(kDeepest * kStepsPerCell - 1);
    brick.shapes.clear();
    brick.thin.clear();
    if (blank().distance_mm(centre(brick.coord)) < -brick_radius_ - near_) {
        brick.steps.fill(kDeep);
        brick.winner.fill(Brick::kUnlisted);
        const double edge = kBrickCells * cell_;
        brick.volume_mm3 = edge * edge * edge;
        return;
    }
    sample_blank(brick.coord, brick.steps.data());
    brick.shapes.push_back(0);
    brick.winner.fill(0);
    brick.volume_mm3 = volume_mm3(brick.steps.data());
}

void CarvedField::gather_brick(const Shape& shape, std::size_t number, BrickCoord b,
                               std::vector<Cut>& cuts) const {
    if (tables_->index.get(b) == kAir) return;
    const double d = shape.distance_mm(centre(b));
    if (d >= brick_radius_ + near_) return;
    const Cut holds_all = d <= -brick_radius_ - cell_ ? 1 : 0;
    cuts.push_back(tables_->index.number(b) << kBrickShift | static_cast<Cut>(number) << 1 | holds_all);
}

void CarvedField::gather(const Shape& shape, std::size_t number, std::vector<Cut>& cuts) const {
    cuts.clear();
    const Box3 reach = shape.bounds_mm().inflated(near_);
    const BrickCoord n = tables_->index.size();
    const BrickCoord lo = brick_at(reach.min), hi = brick_at(reach.max);
    const int i0 = std::max(lo.i, 0), j0 = std::max(lo.j, 0), k0 = std::max(lo.k, 0);
    const int i1 = std::min(hi.i, n.i - 1), j1 = std::min(hi.j, n.j - 1), k1 = std::min(hi.k, n.k - 1);
    // Blocks of bricks first: most of the box of a long sweep is far from the sweep or deep inside it.
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
                            gather_brick(shape, number, {ii, jj, kk}, cuts);
                        }
                    }
                }
            }
        }
    }
}

// Merges the cuts of one brick into one update. Bricks that need nodes get a slot.
void CarvedField::plan_updates(std::size_t shapes) {
    cuts_.clear();
    for (std::size_t n = 0; n < shapes; ++n)
        cuts_.insert(cuts_.end(), cuts_of_[n].begin(), cuts_of_[n].end());
    if (shapes > 1) std::sort(cuts_.begin(), cuts_.end());
    removed_by_cut_.assign(cuts_.size(), 0);
    updates_.clear();
    for (std::size_t n = 0; n < cuts_.size();) {
        Update u;
        u.first = n;
        while (n < cuts_.size() && cuts_[n] >> kBrickShift == cuts_[u.first] >> kBrickShift) ++n;
        u.last = n;
        u.coord = tables_->index.coord(cuts_[u.first] >> kBrickShift);
        u.ref = tables_->index.get(u.coord);
        if (u.ref == kUntouched) {
            u.air = blank().distance_mm(centre(u.coord)) > brick_radius_;
            if (!u.air && (cuts_[u.first] & 1) == 0) {
                u.ref = take_brick(u.coord);
                u.drop = true;  // unless the brick is really cut
            }
        } else if (is_shown(u.ref) && (cuts_[u.first] & 1) == 0) {
            u.shown = u.ref;
            u.ref = take_brick(u.coord);
            u.drop = true;
        }
        updates_.push_back(u);
    }
}

void CarvedField::update(Update& u) {
    if (u.air) return;
    if (u.shown != kUntouched) {
        const Version version = tables_->pool[u.ref].version;
        tables_->pool[u.ref] = tables_->pool[u.shown];
        tables_->pool[u.ref].version = version;
    } else if (u.drop) {
        fill_from_blank(tables_->pool[u.ref]);
    }
    std::array<float, kLatticeNodes> carved;
    ThinWalls walls;
    for (std::size_t n = u.first; n < u.last; ++n) {
        if ((cuts_[n] & 1) != 0) {
            removed_by_cut_[n] =
                u.ref == kUntouched ? blank_brick_volume(u.coord) : tables_->pool[u.ref].volume_mm3;
            u.air = true;
            return;
        }
        Brick& brick = tables_->pool[u.ref];
        const auto id = static_cast<ShapeId>(carved_ + 1 + (cuts_[n] >> 1 & (kMostAtOnce - 1)));
        shape(id).sample_near(lattice(u.coord), near_, carved.data());
        const bool searched = shape(id).is_searched();
        const auto tie_mm =
            static_cast<float>(static_cast<double>(kTieCells) * cell_ + (searched ? kSearchedError : 0));
        const auto index = static_cast<std::uint16_t>(brick.shapes.size());
        const auto cell_mm = static_cast<float>(cell_);
        walls.find(brick, carved.data(), cell_mm);
        brick.winner.make_room(brick.shapes.size() + 1);
        const CarveResult result =
            brick_kernels().carve(brick.steps.data(), brick.winner.low(), brick.winner.high(), carved.data(),
                                  index, cell_mm, tie_mm);
        if (!result.changed) continue;
        u.drop = false;
        brick.change = change_;
        if (static_cast<double>(result.least_cells) > FieldQuery::kClearCells) {
            removed_by_cut_[n] = brick.volume_mm3;
            u.air = true;
            return;
        }
        const double removed = result.removed_cells + walls.update(brick);
        removed_by_cut_[n] = removed * cell_ * cell_ * cell_;
        brick.volume_mm3 -= removed_by_cut_[n];
        if (!result.won) continue;
        brick.shapes.push_back(id);
        const std::size_t every = searched ? kPruneEverySearched : kPruneEvery;
        if (result.tied || brick.shapes.size() % every == 0)
            prune_shapes(brick, carved.data(), cell_mm, tie_mm);
    }
}

void CarvedField::carve(std::span<std::unique_ptr<const Shape>> shapes, std::span<double> removed_mm3) {
    assert(shapes_to_carve_again() == 0);
    for (std::unique_ptr<const Shape>& shape : shapes) tables_->shapes.push_back(std::move(shape));
    carve_stored(shapes.size(), removed_mm3);
}

void CarvedField::carve_again(std::size_t count) {
    assert(count <= shapes_to_carve_again());
    std::vector<double> removed_mm3(count);
    carve_stored(count, removed_mm3);
}

void CarvedField::carve_stored(std::size_t count, std::span<double> removed_mm3) {
    assert(count <= kMostAtOnce && removed_mm3.size() == count);
    tables_->query.change = ++change_;
    if (cuts_of_.size() < count) cuts_of_.resize(count);
    const auto over = [&](std::size_t number, std::size_t least, const auto& body) {
        if (number >= least) return parallel_(number, body);
        for (std::size_t n = 0; n < number; ++n) body(n);
    };
    over(count, kParallelShapes,
         [&](std::size_t n) { gather(shape(static_cast<ShapeId>(carved_ + 1 + n)), n, cuts_of_[n]); });
    plan_updates(count);
    over(updates_.size(), kParallelBricks, [&](std::size_t n) { update(updates_[n]); });
    for (const Update& u : updates_) {
        if (u.air || u.drop) release(u.ref);
        if (u.air || !u.drop) {
            release(u.shown);
            const BrickRef now = u.air ? kAir : u.ref;
            if (now != tables_->index.get(u.coord)) point_to(u.coord, now);
            chunk_changes_[tables_->index.table().chunk_number(u.coord)] = change_;
        }
    }
    brick_updates_ += updates_.size();
    std::fill(removed_mm3.begin(), removed_mm3.end(), 0.0);
    for (std::size_t n = 0; n < cuts_.size(); ++n) {
        removed_mm3[cuts_[n] >> 1 & (kMostAtOnce - 1)] += removed_by_cut_[n];
    }
    for (const double mm3 : removed_mm3) removed_ += mm3;
    carved_ += count;
    if (showing_) show_->show(tables_->query, tables_->index.chunks(), tables_->pool);
}

double CarvedField::carve(std::unique_ptr<const Shape> shape) {
    double removed = 0;
    carve({&shape, 1}, {&removed, 1});
    return removed;
}

FieldShow& CarvedField::begin_show() {
    assert(!showing_);
    if (!show_) show_ = std::make_unique<FieldShow>();
    showing_ = true;
    show_->show(tables_->query, tables_->index.chunks(), tables_->pool);
    return *show_;
}

void CarvedField::end_show() {
    show_->close(tables_->pool);
    showing_ = false;
}

BrickRef CarvedField::take_brick(BrickCoord coord) {
    const BrickRef ref = tables_->pool.take(coord);
    tables_->pool[ref].version = version();
    return ref;
}

void CarvedField::release(BrickRef ref) {
    if (ref < kFirstBrick) return;
    if (is_shown(ref)) {
        show_->retire(ref);
    } else {
        tables_->pool.give_back(ref);
    }
}

void CarvedField::point_to(BrickCoord coord, BrickRef ref) {
    std::unique_ptr<BrickChunk> old = tables_->index.set(coord, ref, version());
    if (old) show_->retire(std::move(old));
}

double CarvedField::estimated_bytes(const Box3& blank_mm, double cell_mm, double cut_bricks,
                                    double touched_bricks) {
    const Vec3 n = bricks_along(blank_mm, cell_mm);
    constexpr double kLists = 96;  // list of shapes in a brick, with the overhead of the heap
    constexpr double kChunk = kChunkEdge * kChunkEdge * kChunkEdge;
    // About half of a chunk is touched.
    return cut_bricks * (sizeof(Brick) + kLists) + 2 * touched_bricks * sizeof(BrickRef) +
           n.x * n.y * n.z * (sizeof(void*) / kChunk);
}

}  // namespace tribo::field
