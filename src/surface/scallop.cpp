// SPDX-License-Identifier: MIT
#include "surface/scallop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math.hpp"

namespace tribo::surface {
namespace {

constexpr int kSectors = 32;
constexpr double kCellsPerWidth = 16;
// Opposite means half a turn, plus or minus two sectors (22 degrees).
constexpr int kSlack = 2;
constexpr double kSameFace = 0.5;         // least cosine between normals
constexpr double kSteepest = 0.5;         // largest height over the tangent plane, per mm of distance
constexpr std::uint64_t kBlockBits = 21;  // blocks along an axis: two million pass widths

std::uint64_t packed(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return (x << (2 * kBlockBits)) | (y << kBlockBits) | z;
}

std::uint64_t along(double x, double edge, int shift) {
    constexpr double last = (1 << kBlockBits) - 2;
    return static_cast<std::uint64_t>(std::clamp(std::floor(x / edge) + 1 + shift, 0.0, last));
}

// The number of the sector of a direction, from -u on over -v; without an angle, as this is asked often.
std::size_t sector_of(double u, double v) {
    static_assert(kSectors == 32);
    // Of 11.25, 22.5 and 33.75 degrees.
    constexpr double tangents[] = {0.19891236737965800, 0.41421356237309503, 0.66817863791929890};
    const double less = std::min(std::abs(u), std::abs(v)), more = std::max(std::abs(u), std::abs(v));
    int n = 0;
    for (const double tangent : tangents) n += less >= tangent * more ? 1 : 0;
    if (std::abs(v) > std::abs(u)) n = 7 - n;  // of the quarter turn from u to v
    if (u < 0) n = 15 - n;                     // of the half turn
    return static_cast<std::size_t>(v < 0 ? 15 - n : 16 + n);
}

}  // namespace

TouchedSamples::TouchedSamples(std::span<const SurfaceSample> samples, std::span<const float> heights_mm,
                               double touch_mm, double pass_width_mm)
    : width_(pass_width_mm) {
    Box3 box;
    for (const SurfaceSample& s : samples) box.include(s.point_mm);
    if (!box.empty()) origin_ = box.min;
    struct Cell {
        std::uint64_t key;
        float height;
        std::size_t sample;
        bool operator<(const Cell& o) const {
            return key != o.key ? key < o.key : height != o.height ? height < o.height : sample < o.sample;
        }
    };
    std::vector<Cell> cells;
    const double edge = width_ / kCellsPerWidth;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (static_cast<double>(heights_mm[i]) > touch_mm) continue;
        const Vec3 p = samples[i].point_mm - origin_;
        cells.push_back(
            {packed(along(p.x, edge, 0), along(p.y, edge, 0), along(p.z, edge, 0)), heights_mm[i], i});
    }
    std::sort(cells.begin(), cells.end());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0 && cells[i].key == cells[i - 1].key) continue;
        const SurfaceSample& s = samples[cells[i].sample];
        touched_.push_back(
            {block_of(s.point_mm, 0, 0, 0), s.point_mm, s.normal, static_cast<double>(cells[i].height)});
    }
    std::sort(touched_.begin(), touched_.end(),
              [](const Touched& a, const Touched& b) { return a.block < b.block; });
}

std::uint64_t TouchedSamples::block_of(Vec3 point, int dx, int dy, int dz) const {
    const Vec3 p = point - origin_;
    return packed(along(p.x, width_, dx), along(p.y, width_, dy), along(p.z, width_, dz));
}

std::optional<Crossing> TouchedSamples::around(const SurfaceSample& sample, double height_mm) const {
    const Vec3 u = any_perpendicular(sample.normal), v = cross(sample.normal, u);
    std::array<double, kSectors> nearest;  // by direction, mm^2 at first
    nearest.fill(std::numeric_limits<double>::infinity());
    const auto look_at = [&](const Touched& t) {
        if (!(t.height < 0.5 * height_mm) || dot(t.normal, sample.normal) < kSameFace) return;
        const Vec3 to = t.point - sample.point_mm;
        const double far2 = squared_length(to), up = dot(to, sample.normal);
        if (far2 >= width_ * width_ || up * up > kSteepest * kSteepest * far2) return;
        double& least = nearest[sector_of(dot(to, u), dot(to, v))];
        least = std::min(least, far2);
    };
    for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dz = -1; dz <= 1; ++dz) {
                const std::uint64_t block = block_of(sample.point_mm, dx, dy, dz);
                auto at = std::lower_bound(touched_.begin(), touched_.end(), block,
                                           [](const Touched& t, std::uint64_t b) { return t.block < b; });
                for (; at != touched_.end() && at->block == block; ++at) look_at(*at);
            }
        }
    }
    for (double& far : nearest) far = std::sqrt(far);
    std::optional<Crossing> best;
    double least = width_;
    for (int i = 0; i < kSectors / 2 + kSlack; ++i) {
        for (int slack = -kSlack; slack <= kSlack; ++slack) {
            const int j = (i + kSectors / 2 + slack) % kSectors;
            const double first = nearest[static_cast<std::size_t>(i)],
                         second = nearest[static_cast<std::size_t>(j)];
            if (!(first + second < least)) continue;
            least = first + second;
            const double turn = ((i + 0.5 + 0.5 * slack) / kSectors - 0.5) * math::kTwoPi;
            best = Crossing{math::cos(turn) * u + math::sin(turn) * v, first, second};
        }
    }
    return best;
}

}  // namespace tribo::surface
