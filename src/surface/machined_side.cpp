// SPDX-License-Identifier: MIT
#include "surface/machined_side.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/shape/surface_points.hpp"

namespace tribo::surface {
namespace {

constexpr std::size_t kClimbsAtOnce = 256;  // points that one task measures
constexpr std::size_t kClimbs = 16;         // number of points from which each extreme is climbed
constexpr double kOnBlank = 1e-3;           // a point less deep in the blank is on its surface, mm
constexpr int kMostRounds = 200;            // limit of the rounds of a climb; twenty are enough

class MachinedSide {
  public:
    MachinedSide(const contact::DistanceField& machined, const DesignedSurface& designed,
                 const field::Shape* blank)
        : machined_(machined), designed_(designed), blank_(blank) {}

    // Returns the signed distance to the design; 0 if it has no meaning there.
    double measure(Vec3 point, std::uint32_t& triangle, Vec3& foot) const {
        const field::MeshPoint near = designed_.closest(point, triangle);
        triangle = near.triangle;
        foot = near.point_mm;
        if (near.on_border) return 0;
        if (near.distance_mm < 0 && blank_ && blank_->distance_mm(point) > -kOnBlank) return 0;
        return near.distance_mm;
    }

    // Pattern search along the machined surface in eight directions. The step is halved if no direction leads
    // up.
    DeviationExtreme climb(Vec3 start, double side, double spacing) const {
        std::uint32_t triangle = 0;
        DeviationExtreme best;
        best.mm = std::max(0.0, side * measure(start, triangle, best.at_mm));
        best.machined_mm = start;
        Vec3 at = start;
        const double diagonal = std::sqrt(0.5);
        int moves = 0;
        for (double step = spacing; step > spacing / 65536 && moves < kMostRounds; ++moves) {
            const Vec3 n = machined_.normal(at), u = any_perpendicular(n), v = cross(n, u);
            const Vec3 ways[] = {u,
                                 -u,
                                 v,
                                 -v,
                                 diagonal * (u + v),
                                 diagonal * (u - v),
                                 -diagonal * (u + v),
                                 diagonal * (v - u)};
            Vec3 higher = at;
            for (const Vec3 way : ways) {
                const auto next = field::onto_surface(machined_, at + step * way);
                Vec3 foot;
                if (!next) continue;
                const double d = side * measure(*next, triangle, foot);
                if (d <= best.mm) continue;
                best = {d, foot, *next};
                higher = *next;
            }
            if (higher == at) step /= 2;
            at = higher;
        }
        return best;
    }

  private:
    const contact::DistanceField& machined_;
    const DesignedSurface& designed_;
    const field::Shape* blank_;
};

}  // namespace

MachinedExtremes farthest_machined(const contact::DistanceField& machined, const DesignedSurface& designed,
                                   const field::Shape* blank, std::span<const Vec3> points, double spacing_mm,
                                   const ParallelFor& parallel) {
    if (!designed.watertight() && designed.turned_edges() > 0) return {};
    const MachinedSide side(machined, designed, blank);
    std::vector<double> heights(points.size());
    parallel((points.size() + kClimbsAtOnce - 1) / kClimbsAtOnce, [&](std::size_t chunk) {
        const std::size_t end = std::min(points.size(), (chunk + 1) * kClimbsAtOnce);
        std::uint32_t triangle = 0;
        Vec3 foot;
        for (std::size_t i = chunk * kClimbsAtOnce; i < end; ++i) {
            heights[i] = side.measure(points[i], triangle, foot);
        }
    });
    const auto farthest = [&](double sign) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (sign * heights[i] > 0) order.push_back(i);
        }
        const std::size_t kept = std::min(order.size(), kClimbs);
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                          [&](std::size_t a, std::size_t b) {
                              return heights[a] != heights[b] ? sign * heights[a] > sign * heights[b] : a < b;
                          });
        order.resize(kept);
        DeviationExtreme best;
        for (const std::size_t i : order) {
            const DeviationExtreme top = side.climb(points[i], sign, spacing_mm);
            if (top.mm > best.mm) best = top;
        }
        return best;
    };
    const DeviationExtreme gouge = farthest(-1), rest = farthest(1);
    return {gouge, rest, std::move(heights)};
}

}  // namespace tribo::surface
