// SPDX-License-Identifier: MIT
#include "surface/part_difference.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::surface {
namespace {

constexpr int kBlockNodes = 8;
// More blocks take a coarser grid: 160 MB and some minutes of one core at most.
constexpr double kMostBlocks = 4e6;
constexpr std::size_t kPointsAtOnce = 4096;

// The filled share of the cell around a node. Exact for a plane along the grid; else right in the mean over
// the cells that the surface passes. A field knows distances up to a cell of its own, so a share on a coarser
// grid rises within that.
double filled_share(const field::CarvedField& field, Vec3 node_mm, double cell_mm) {
    return std::clamp(0.5 - field.distance_mm(node_mm) / std::min(cell_mm, field.cell_mm()), 0.0, 1.0);
}

struct Grid {
    Vec3 first_mm;
    double cell_mm = 1;
    std::array<std::size_t, 3> blocks{};

    std::size_t count() const { return blocks[0] * blocks[1] * blocks[2]; }
    Vec3 node(std::size_t block, double i, double j, double k) const {
        const std::size_t x = block % blocks[0], y = block / blocks[0] % blocks[1],
                          z = block / (blocks[0] * blocks[1]);
        return first_mm + cell_mm * Vec3{kBlockNodes * static_cast<double>(x) + i,
                                         kBlockNodes * static_cast<double>(y) + j,
                                         kBlockNodes * static_cast<double>(z) + k};
    }
};

Grid grid_over(const field::CarvedField& a, const field::CarvedField& b) {
    const Box3 one = a.blank().bounds_mm(), other = b.blank().bounds_mm();
    Grid grid;
    Box3 both = one;
    both.include(other.min);
    both.include(other.max);
    constexpr double kBlockCells = kBlockNodes * kBlockNodes * kBlockNodes;
    grid.cell_mm =
        std::max(std::min(a.cell_mm(), b.cell_mm()), math::cbrt(both.volume() / (kBlockCells * kMostBlocks)));
    // As far outside as the nodes of a field, and for the same reason.
    const double margin = field::CarvedField::kMarginCells * grid.cell_mm;
    for (int axis = 0; axis < 3; ++axis) {
        grid.first_mm[axis] = both.min[axis] - margin;
        const double reach = both.max[axis] + margin - grid.first_mm[axis];
        grid.blocks[static_cast<std::size_t>(axis)] =
            static_cast<std::size_t>(reach / (kBlockNodes * grid.cell_mm)) + 1;
    }
    return grid;
}

void add(VolumeDifference& sum, double share_a, double share_b, double mm3) {
    sum.a_mm3 += mm3 * share_a;
    sum.b_mm3 += mm3 * share_b;
    sum.only_a_mm3 += mm3 * std::max(share_a - share_b, 0.0);
    sum.only_b_mm3 += mm3 * std::max(share_b - share_a, 0.0);
}

VolumeDifference in_block(const field::CarvedField& a, const field::CarvedField& b, const Grid& grid,
                          std::size_t block) {
    const double h = grid.cell_mm, cell_mm3 = h * h * h;
    // From the centre of the block beyond its cells: there each cell is all material or all air.
    constexpr double kMiddle = 0.5 * (kBlockNodes - 1);
    const double reach = 0.5 * std::sqrt(3.0) * kBlockNodes * h;
    const Vec3 centre = grid.node(block, kMiddle, kMiddle, kMiddle);
    const double way_a = a.clear_way_mm(centre, reach), way_b = b.clear_way_mm(centre, reach);
    VolumeDifference sum;
    if (std::abs(way_a) >= reach && std::abs(way_b) >= reach) {
        add(sum, way_a < 0 ? 1 : 0, way_b < 0 ? 1 : 0, kBlockNodes * kBlockNodes * kBlockNodes * cell_mm3);
        return sum;
    }
    for (int k = 0; k < kBlockNodes; ++k)
        for (int j = 0; j < kBlockNodes; ++j)
            for (int i = 0; i < kBlockNodes; ++i) {
                const Vec3 at = grid.node(block, i, j, k);
                add(sum, filled_share(a, at, h), filled_share(b, at, h), cell_mm3);
            }
    return sum;
}

// Calls `each(n)` for all numbers below `count`, many at a time.
template <class Each>
void for_points(std::size_t count, const ParallelFor& parallel, Each each) {
    parallel((count + kPointsAtOnce - 1) / kPointsAtOnce, [&](std::size_t piece) {
        const std::size_t end = std::min(count, (piece + 1) * kPointsAtOnce);
        for (std::size_t n = piece * kPointsAtOnce; n < end; ++n) each(n);
    });
}

// Of a point on A the first distance is 0 and the second negative where B leaves more; of a point on B it is
// the other way round. A vertex at a thin cusp is not quite on its surface; the difference does not see that.
double difference_at(Vec3 point_mm, const ComparedPart& a, const ComparedPart& b) {
    const double mm = a.distance_mm(point_mm) - b.distance_mm(point_mm);
    return std::abs(mm) < kSameMm ? 0 : mm;
}

void keep_extremes(const TriangleMesh& mesh, const std::vector<float>& differences, bool on_a,
                   const ComparedPart& a, const ComparedPart& b, SurfaceDifference& found) {
    if (differences.empty()) return;
    const auto keep = [&](std::size_t n, std::optional<DifferencePlace>& place) {
        const Vec3 at = mesh.position(static_cast<std::uint32_t>(n));
        place = {difference_at(at, a, b), on_a ? at : a.nearest_mm(at), on_a ? b.nearest_mm(at) : at};
    };
    const auto [low, high] = std::ranges::minmax_element(differences);
    if (*high > 0 && *high > (found.more ? found.more->mm : 0))
        keep(static_cast<std::size_t>(high - differences.begin()), found.more);
    if (*low < 0 && *low < (found.less ? found.less->mm : 0))
        keep(static_cast<std::size_t>(low - differences.begin()), found.less);
}

}  // namespace

VolumeDifference volume_difference(const field::CarvedField& a, const field::CarvedField& b,
                                   const ParallelFor& parallel) {
    const Grid grid = grid_over(a, b);
    std::vector<VolumeDifference> of_block(grid.count());
    parallel(grid.count(), [&](std::size_t n) { of_block[n] = in_block(a, b, grid, n); });
    VolumeDifference sum;
    for (const VolumeDifference& v : of_block) {
        sum.only_a_mm3 += v.only_a_mm3;
        sum.only_b_mm3 += v.only_b_mm3;
        sum.a_mm3 += v.a_mm3;
        sum.b_mm3 += v.b_mm3;
    }
    sum.cell_mm = grid.cell_mm;
    return sum;
}

double ComparedPart::distance_mm(Vec3 point_mm) const {
    const double near = field_->distance_mm(point_mm);
    return std::abs(near) < 0.5 * field_->cell_mm() ? near : distance_.closest(point_mm).distance_mm;
}

std::vector<float> differences_at(const TriangleMesh& mesh, const ComparedPart& a, const ComparedPart& b,
                                  const ParallelFor& parallel) {
    std::vector<float> differences(mesh.positions.size());
    for_points(differences.size(), parallel, [&](std::size_t n) {
        differences[n] =
            static_cast<float>(difference_at(mesh.position(static_cast<std::uint32_t>(n)), a, b));
    });
    return differences;
}

SurfaceDifference surface_difference(const ComparedPart& a, const ComparedPart& b,
                                     const ParallelFor& parallel) {
    SurfaceDifference found;
    keep_extremes(a.mesh(), differences_at(a.mesh(), a, b, parallel), true, a, b, found);
    keep_extremes(b.mesh(), differences_at(b.mesh(), a, b, parallel), false, a, b, found);
    return found;
}

}  // namespace tribo::surface
