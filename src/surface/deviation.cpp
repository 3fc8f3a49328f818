// SPDX-License-Identifier: MIT
#include "surface/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "surface/height.hpp"
#include "surface/nearest_height.hpp"
#include "surface/scallop.hpp"

namespace tribo::surface {
namespace {

constexpr std::size_t kChunk = 256;     // samples that one task measures
constexpr std::size_t kSharpened = 16;  // number of samples from which each extreme is refined
constexpr double kOffBlank = 1e-3;      // a point less deep in the blank is on its surface, mm
// Less is noise of the field, mm.
constexpr double kFlatScallop = 1e-4, kFlatGouge = 1e-4;
constexpr double kCrestCube = 3;     // edge of a cube with one crest, in spacings
constexpr double kCrestFall = 0.75;  // largest height half way to a pass, as a share of the crest's height
constexpr int kMostMoves = 200;      // limit of the rounds of a climb; twenty are enough
constexpr int kHistogramBins = 48;

class Comparison {
  public:
    Comparison(const contact::DistanceField& machined, const DesignedSurface& designed,
               const DeviationOptions& options)
        : machined_(machined),
          designed_(designed),
          options_(options),
          height_(machined, designed, options.limit_mm, options.blank) {
        const double finest = std::sqrt(2.7 * designed.area_mm2() / static_cast<double>(kMaxSamples));
        report_.spacing_mm = std::max(options.spacing_mm, finest);
    }

    DeviationReport run(const ParallelFor& parallel) {
        measure_all(parallel);
        if (!report_.samples.empty()) summarise();
        report_.rest = sharpest(by_height(1), 1);
        report_.gouge = sharpest(by_height(-1), -1);
        report_.scallop = sharpest(scallops(parallel), 1);
        const MachinedExtremes other = farthest_machined(machined_, designed_, options_.blank,
                                                         options_.machined_mm, report_.spacing_mm, parallel);
        if (other.rest.mm > report_.rest.mm) report_.rest = other.rest;
        if (other.gouge.mm > report_.gouge.mm) report_.gouge = other.gouge;
        if (options_.all_places) keep_places(other);
        return std::move(report_);
    }

  private:
    void measure_all(const ParallelFor& parallel) {
        const std::vector<SurfaceSample> samples = designed_.sample(report_.spacing_mm);
        std::vector<std::optional<NearestHeight::Height>> heights(samples.size());
        parallel((samples.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
            const std::size_t end = std::min(samples.size(), (chunk + 1) * kChunk);
            for (std::size_t i = chunk * kChunk; i < end; ++i)
                heights[i] = height_.with_way(samples[i].point_mm, samples[i].normal, samples[i].triangle);
        });
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (!heights[i]) {
                report_.unmeasured_mm2 += samples[i].area_mm2;
                continue;
            }
            report_.measured_mm2 += samples[i].area_mm2;
            report_.samples.push_back(samples[i]);
            report_.heights_mm.push_back(static_cast<float>(heights[i]->mm));
            ways_mm_.push_back(static_cast<float>(heights[i]->way_mm));
        }
    }

    // The extremes themselves, and the gouged points of the machined side.
    void keep_places(const MachinedExtremes& other) {
        const Vec3 top = report_.scallop.machined_mm;
        if (report_.scallop.mm > 0) report_.crests.push_back({report_.scallop.mm, {top, top, top}});
        for (std::size_t i = 0; i < other.deviations_mm.size(); ++i) {
            if (other.deviations_mm[i] < -kFlatGouge)
                report_.gouges.push_back({-other.deviations_mm[i], options_.machined_mm[i]});
        }
        if (report_.gouge.mm > kFlatGouge)
            report_.gouges.push_back({report_.gouge.mm, report_.gouge.machined_mm});
    }

    double height_of(std::size_t i) const { return static_cast<double>(report_.heights_mm[i]); }

    void summarise() {
        double sum = 0, squares = 0, touched = 0;
        std::vector<std::size_t> order(report_.samples.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (const std::size_t i : order) {
            const double h = height_of(i), area = report_.samples[i].area_mm2;
            sum += h * area;
            squares += h * h * area;
            (h > 0 ? report_.rest_mm3 : report_.gouge_mm3) += std::abs(h) * area;
            if (static_cast<double>(ways_mm_[i]) <= options_.touch_mm) touched += area;
        }
        report_.mean_mm = sum / report_.measured_mm2;
        report_.rms_mm = std::sqrt(squares / report_.measured_mm2);
        report_.touched_share = touched / report_.measured_mm2;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return height_of(a) != height_of(b) ? height_of(a) < height_of(b) : a < b;
        });
        report_.p1_mm = percentile(order, 0.01);
        report_.p50_mm = percentile(order, 0.5);
        report_.p99_mm = percentile(order, 0.99);
        fill_histogram(height_of(order.front()), height_of(order.back()));
    }

    double percentile(const std::vector<std::size_t>& order, double share) const {
        double area = 0;
        for (const std::size_t i : order) {
            area += report_.samples[i].area_mm2;
            if (area >= share * report_.measured_mm2) return height_of(i);
        }
        return height_of(order.back());
    }

    void fill_histogram(double lowest, double highest) {
        DeviationHistogram& h = report_.histogram;
        h.first_mm = lowest;
        h.bin_mm = std::max(highest - lowest, 1e-9) / kHistogramBins;
        h.shares.assign(kHistogramBins, 0);
        for (std::size_t i = 0; i < report_.samples.size(); ++i) {
            const int bin =
                std::min(kHistogramBins - 1, static_cast<int>((height_of(i) - lowest) / h.bin_mm));
            h.shares[static_cast<std::size_t>(bin)] += report_.samples[i].area_mm2 / report_.measured_mm2;
        }
    }

    // Returns the samples from which an extreme is refined: the highest (side 1) or the deepest (-1).
    std::vector<std::size_t> by_height(double side) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < report_.samples.size(); ++i) {
            if (side * height_of(i) > 0) found.push_back(i);
        }
        const std::size_t kept = std::min(found.size(), kSharpened);
        std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end(),
                          [&](std::size_t a, std::size_t b) {
                              return height_of(a) != height_of(b) ? side * height_of(a) > side * height_of(b)
                                                                  : a < b;
                          });
        found.resize(kept);
        return found;
    }

    // Returns the highest samples on crests between passes.
    std::vector<std::size_t> scallops(const ParallelFor& parallel) {
        const TouchedSamples touched(report_.samples, ways_mm_, options_.touch_mm, options_.pass_width_mm);
        std::vector<std::size_t> order, found;
        for (std::size_t i = 0; i < report_.samples.size(); ++i) {
            if (height_of(i) > kFlatScallop) order.push_back(i);
        }
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return height_of(a) != height_of(b) ? height_of(a) > height_of(b) : a < b;
        });
        for (const std::size_t i : order) {
            if (found.size() == kSharpened) break;
            if (crest_at(i, touched)) found.push_back(i);
        }
        if (options_.all_places) keep_crests(std::move(order), touched, parallel);
        return found;
    }

    void keep_crests(std::vector<std::size_t> highest_first, const TouchedSamples& touched,
                     const ParallelFor& parallel) {
        thin_out(highest_first);
        std::vector<std::optional<Crest>> crests(highest_first.size());
        parallel((crests.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
            const std::size_t end = std::min(crests.size(), (chunk + 1) * kChunk);
            for (std::size_t n = chunk * kChunk; n < end; ++n)
                crests[n] = crest_at(highest_first[n], touched);
        });
        for (const std::optional<Crest>& crest : crests) {
            if (crest) report_.crests.push_back(*crest);
        }
    }

    // Keeps the first of the samples in each cube of kCrestCube spacings.
    void thin_out(std::vector<std::size_t>& order) const {
        const double edge = kCrestCube * report_.spacing_mm;
        std::vector<std::pair<std::array<double, 3>, std::size_t>> cubes;  // with the place in the order
        cubes.reserve(order.size());
        for (std::size_t n = 0; n < order.size(); ++n) {
            const Vec3 at = report_.samples[order[n]].point_mm / edge;
            cubes.push_back({{std::floor(at.x), std::floor(at.y), std::floor(at.z)}, n});
        }
        std::ranges::sort(cubes);
        const auto rest = std::ranges::unique(cubes, {}, [](const auto& cube) { return cube.first; });
        cubes.erase(rest.begin(), rest.end());
        std::ranges::sort(cubes, {}, [](const auto& cube) { return cube.second; });
        std::vector<std::size_t> kept;
        kept.reserve(cubes.size());
        for (const auto& [cube, n] : cubes) kept.push_back(order[n]);
        order = std::move(kept);
    }

    // The crest between two passes on which the sample is. On both sides of it the surface falls: on a flank
    // with a wall above it, one side rises.
    std::optional<Crest> crest_at(std::size_t i, const TouchedSamples& touched) const {
        const SurfaceSample& s = report_.samples[i];
        const auto crossing = touched.around(s, height_of(i));
        if (!crossing) return std::nullopt;
        Crest crest{height_of(i), {s.point_mm + height_of(i) * s.normal}};
        const double half_way = 0.5 * std::min(crossing->first_mm, crossing->second_mm);
        for (const std::size_t side : {1U, 2U}) {
            const Vec3 way = (side == 1 ? half_way : -half_way) * crossing->way;
            const field::MeshPoint at = designed_.closest(s.point_mm + way, s.triangle);
            const auto h = height_.at(at.point_mm, at.normal, at.triangle);
            if (!h || *h > kCrestFall * height_of(i)) return std::nullopt;
            crest.machined_mm[side] = at.point_mm + *h * at.normal;
        }
        if (is_blank(i)) return std::nullopt;
        return crest;
    }

    // True if the machined surface is still the surface of the blank: no cutter was there.
    bool is_blank(std::size_t i) const {
        if (!options_.blank) return false;
        const SurfaceSample& s = report_.samples[i];
        const auto top = height_over(machined_, s.point_mm, s.normal, options_.limit_mm);
        return !top || options_.blank->distance_mm(s.point_mm + *top * s.normal) > -kOffBlank;
    }

    // Climbs from each sample, within the spacing around it, and returns the best top.
    DeviationExtreme sharpest(const std::vector<std::size_t>& from, double side) const {
        DeviationExtreme best;
        for (const std::size_t i : from) {
            const DeviationExtreme top = climb(report_.samples[i], side);
            if (top.mm > best.mm) best = top;
        }
        return best;
    }

    // Pattern search along the designed surface in eight directions. The step is halved if no direction leads
    // up.
    DeviationExtreme climb(const SurfaceSample& start, double side) const {
        const Vec3 u = any_perpendicular(start.normal), v = cross(start.normal, u);
        const double diagonal = std::sqrt(0.5);
        const Vec3 ways[] = {
            u, -u, v, -v, diagonal * (u + v), diagonal * (u - v), -diagonal * (u + v), diagonal * (v - u)};
        const auto extreme = [&](double h, Vec3 point, Vec3 normal) {
            return DeviationExtreme{side * h, point, point + h * normal};
        };
        DeviationExtreme best = extreme(height_.at(start.point_mm, start.normal, start.triangle).value_or(0),
                                        start.point_mm, start.normal);
        std::uint32_t triangle = start.triangle;
        int moves = 0;
        for (double step = report_.spacing_mm / 2; step > report_.spacing_mm / 65536 && moves < kMostMoves;) {
            bool climbed = false;
            ++moves;
            for (const Vec3 way : ways) {
                const field::MeshPoint at = designed_.closest(best.at_mm + step * way, triangle);
                if (distance(at.point_mm, start.point_mm) > report_.spacing_mm) continue;
                const auto h = height_.at(at.point_mm, at.normal, at.triangle);
                if (!h || side * *h <= best.mm) continue;
                best = extreme(*h, at.point_mm, at.normal);
                triangle = at.triangle;
                climbed = true;
            }
            if (!climbed) step /= 2;
        }
        return best;
    }

    const contact::DistanceField& machined_;
    const DesignedSurface& designed_;
    const DeviationOptions& options_;
    NearestHeight height_;
    DeviationReport report_;
    // One per sample of the report, along its normal. In a corner of the design the nearest point is soon on
    // the other face, and heights go to 0 where no pass was.
    std::vector<float> ways_mm_;
};

}  // namespace

DeviationReport compare(const contact::DistanceField& machined, const DesignedSurface& designed,
                        const DeviationOptions& options, const ParallelFor& parallel) {
    return Comparison(machined, designed, options).run(parallel);
}

std::vector<float> deviations_of(const TriangleMesh& machined, const DesignedSurface& designed,
                                 const ParallelFor& parallel, double reach_mm) {
    std::vector<float> result(machined.positions.size(), std::numeric_limits<float>::quiet_NaN());
    parallel((result.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min(result.size(), (chunk + 1) * kChunk);
        std::uint32_t guess = 0;
        for (std::size_t i = chunk * kChunk; i < end; ++i) {
            const Vec3 point = machined.position(static_cast<std::uint32_t>(i));
            const auto found = designed.closest_within(point, reach_mm, guess);
            if (!found) continue;
            result[i] = static_cast<float>(found->distance_mm);
            guess = found->triangle;
        }
    });
    return result;
}

}  // namespace tribo::surface
