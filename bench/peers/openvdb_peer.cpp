// SPDX-License-Identifier: MIT
#include "peers/openvdb_peer.hpp"

#ifdef TRIBO_OPENVDB
#include <cmath>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/global_control.h>

#include "harness.hpp"
#include "motion/path/path.hpp"
#endif

namespace tribo::bench {

#ifndef TRIBO_OPENVDB

bool has_openvdb() {
    return false;
}

std::optional<double> openvdb_us_per_mm(const Cuts&, double) {
    return {};
}

#else

namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

double box_distance(const Box3& box, Vec3 p) {
    return std::max({box.min.x - p.x, p.x - box.max.x, box.min.y - p.y, p.y - box.max.y, box.min.z - p.z,
                     p.z - box.max.z});
}

// A flat cutter swept along a straight move across its axis: a slot with round ends.
struct Slot {
    Vec3 from, along;
    double radius, top;

    double operator()(Vec3 p) const {
        const double dx = p.x - from.x, dy = p.y - from.y;
        const double t = std::clamp((dx * along.x + dy * along.y) / dot(along, along), 0.0, 1.0);
        const double ex = dx - t * along.x, ey = dy - t * along.y;
        return std::max({std::sqrt(ex * ex + ey * ey) - radius, from.z - p.z, p.z - top});
    }
};

// The level set of a distance function: the leaves near its surface are filled, the sign flooded inward.
template <class Distance>
openvdb::FloatGrid::Ptr level_set(const Distance& distance, const Box3& box, double cell) {
    const double band = 3 * cell, reach = band + 0.5 * Leaf::DIM * cell * std::sqrt(3.0);
    auto grid = openvdb::FloatGrid::create(static_cast<float>(band));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    openvdb::FloatTree& tree = grid->tree();
    const auto leaf_index = [&](double mm) { return static_cast<int>(std::floor(mm / (cell * Leaf::DIM))); };
    const int dim = Leaf::DIM;
    for (int k = leaf_index(box.min.z - band); k <= leaf_index(box.max.z + band); ++k) {
        for (int j = leaf_index(box.min.y - band); j <= leaf_index(box.max.y + band); ++j) {
            for (int i = leaf_index(box.min.x - band); i <= leaf_index(box.max.x + band); ++i) {
                const Vec3 origin{i * dim * cell, j * dim * cell, k * dim * cell};
                const double half = 0.5 * (dim - 1) * cell;
                if (std::abs(distance(origin + Vec3{half, half, half})) > reach) continue;
                Leaf* leaf = tree.touchLeaf({i * dim, j * dim, k * dim});
                for (int a = 0; a < dim; ++a) {
                    for (int b = 0; b < dim; ++b) {
                        for (int c = 0; c < dim; ++c) {
                            const double d = distance(origin + Vec3{a * cell, b * cell, c * cell});
                            const auto n = static_cast<openvdb::Index>((a * dim + b) * dim + c);
                            if (std::abs(d) < band) {
                                leaf->setValueOn(n, static_cast<float>(d));
                            } else {
                                leaf->setValueOff(n, static_cast<float>(d < 0 ? -band : band));
                            }
                        }
                    }
                }
            }
        }
    }
    openvdb::tools::signedFloodFill(tree, false);
    openvdb::tools::pruneLevelSet(tree, false);  // leaves near the surface that hold none of it
    return grid;
}

}  // namespace

bool has_openvdb() {
    return true;
}

std::optional<double> openvdb_us_per_mm(const Cuts& cuts, double cell_mm) {
    openvdb::initialize();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    auto stock = level_set([&](Vec3 p) { return box_distance(cuts.block_mm, p); }, cuts.block_mm, cell_mm);
    std::vector<double> us;
    const double radius = cuts.cutter.radius_mm();
    for (const auto& moves : cuts.passes) {
        double mm = 0;
        const double start = thread_s();
        for (const motion::Move& move : moves) {
            const Vec3 a = move.start.tip_mm, b = move.end.tip_mm;
            // Only up to just above the block: higher up there is nothing to cut.
            const Slot slot{a, b - a, radius, cuts.block_mm.max.z + 1};
            Box3 box;
            box.include(a - Vec3{radius, radius, 0});
            box.include(a + Vec3{radius, radius, 0});
            box.include(b - Vec3{radius, radius, 0});
            box.include(b + Vec3{radius, radius, 0});
            box.max.z = slot.top;
            auto sweep = level_set(slot, box, cell_mm);
            openvdb::tools::csgDifference(*stock, *sweep);
            mm += motion::path_length_mm(move);
        }
        us.push_back(1e6 * (thread_s() - start) / mm);
    }
    if (us.size() > 1) us.erase(us.begin());
    return median(us);
}

#endif

}  // namespace tribo::bench
