// SPDX-License-Identifier: MIT
#include "surface/form_error.hpp"

#include <algorithm>
#include <cmath>

namespace tribo::surface {
namespace {

// A trace is a chord of its path: a point this near belongs to its surface.
constexpr double kOnSurfaceMm = 0.02;
// A trace that stands so far out of the material was cut away. Of those that stay most are off by less than a
// hundredth of that; only between short moves of very unequal lengths one side may cut into the other.
constexpr double kCutAwayMm = 1e-3;
// Of its length, by which the end of a trace goes on where no other one continues it.
constexpr double kBeyond = 0.25, kBeyondWeight = 1e-6;
constexpr int kMostLooked = 32;  // traces of a cell
// Cosine between normals of one face.
constexpr double kSameFace = 0.9;
// Less is rounding.
constexpr double kLeastErrorMm = 1e-6;
constexpr std::size_t kSamplesAtOnce = 1024;

double length_of(const ToothTrace& t) {
    return distance(t.from_mm, t.to_mm);
}

}  // namespace

FormError::FormError(ToothTraces traces, const contact::DistanceField& machined,
                     const ParallelFor& parallel) {
    keep(std::move(traces), machined, parallel);
    const std::size_t count = kept_.traces.size();
    parallel((count + kSamplesAtOnce - 1) / kSamplesAtOnce, [&](std::size_t chunk) {
        for (std::size_t n = chunk * kSamplesAtOnce; n < std::min(count, (chunk + 1) * kSamplesAtOnce); ++n)
            cut_beside(n);
    });
    extremes_ = extremes_of(kept_.traces);
    std::vector<Vec3> places;
    double reach = 0;
    places.reserve(count);
    for (const ToothTrace& t : kept_.traces) {
        places.push_back(0.5 * (t.from_mm + t.to_mm));
        reach = std::max(reach, (0.5 + kBeyond) * length_of(t) + t.width_mm + kOnSurfaceMm);
    }
    if (count > 0) cells_ = CellIndex(places, reach);
}

void FormError::keep(ToothTraces all, const contact::DistanceField& machined, const ParallelFor& parallel) {
    const std::size_t count = all.traces.size();
    std::vector<char> stays(count);
    parallel((count + kSamplesAtOnce - 1) / kSamplesAtOnce, [&](std::size_t chunk) {
        for (std::size_t n = chunk * kSamplesAtOnce; n < std::min(count, (chunk + 1) * kSamplesAtOnce); ++n) {
            const ToothTrace& t = all.traces[n];
            const double off = machined.distance_mm(t.inner_mm);
            // In material where the grid missed the cut of this row.
            stays[n] = t.count > 0 && off <= kCutAwayMm && off >= -kOnSurfaceMm;
        }
    });
    std::vector<std::uint32_t> place(count);
    for (std::size_t n = 0; n < count; ++n) {
        if (stays[n] == 0) continue;
        ToothTrace t = all.traces[n];
        place[n] = static_cast<std::uint32_t>(kept_.traces.size());
        if (t.before) t.before = stays[*t.before] != 0 ? std::optional(place[*t.before]) : std::nullopt;
        const auto first = all.marks.begin() + static_cast<std::ptrdiff_t>(t.first);
        t.first = kept_.marks.size();
        kept_.marks.insert(kept_.marks.end(), first, first + static_cast<std::ptrdiff_t>(t.count));
        kept_.traces.push_back(t);
    }
    next_.resize(kept_.traces.size());
    for (std::size_t n = 0; n < kept_.traces.size(); ++n)
        if (const auto before = kept_.traces[n].before) next_[*before] = static_cast<std::uint32_t>(n);
}

// A tooth cuts an arc along the trace; what the deepest arcs leave stands.
void FormError::cut_beside(std::size_t n) {
    const ToothTrace& own = kept_.traces[n];
    const double size = length_of(own);
    const auto cut_by = [&](const ToothTrace& other, double shift_mm) {
        const double other_size = length_of(other);
        for (std::size_t k = own.first; k < own.first + own.count; ++k) {
            ToothMark& mark = kept_.marks[k];
            for (std::size_t m = other.first; m < other.first + other.count; ++m) {
                const ToothMark& cut = kept_.marks[m];
                const double apart = double{cut.at} * other_size + shift_mm - double{mark.at} * size;
                const double left = double{cut.displaced_mm} + apart * apart / (2 * own.arc_mm);
                mark.left_mm = std::min(mark.left_mm, static_cast<float>(left));
            }
        }
    };
    for (std::size_t k = own.first; k < own.first + own.count; ++k)
        kept_.marks[k].left_mm = kept_.marks[k].displaced_mm;
    cut_by(own, 0);
    if (own.before) cut_by(kept_.traces[*own.before], -length_of(kept_.traces[*own.before]));
    if (next_[n]) cut_by(kept_.traces[*next_[n]], size);
}

FormError::Extremes FormError::extremes_of(std::span<const ToothTrace> traces) const {
    Extremes e{kLeastErrorMm, kLeastErrorMm, kLeastErrorMm};
    for (const ToothTrace& t : traces) {
        double least = 0, most = 0;
        for (std::size_t k = t.first; k < t.first + t.count; ++k) {
            const double left = double{kept_.marks[k].left_mm};
            least = k == t.first ? left : std::min(least, left);
            most = k == t.first ? left : std::max(most, left);
        }
        e.wave_mm = std::max(e.wave_mm, most - least);
        if (most > e.left_mm) {
            e.left_mm = most;
            e.left_line = t.line;
        }
        if (-least > e.overcut_mm) {
            e.overcut_mm = -least;
            e.overcut_line = t.line;
        }
    }
    for (double* mm : {&e.left_mm, &e.overcut_mm, &e.wave_mm})
        if (*mm <= kLeastErrorMm) *mm = 0;
    return e;
}

FormError::Extremes FormError::extremes_between(double from_s, double to_s) const {
    const auto first_from = [&](double t_s) {
        return std::ranges::lower_bound(kept_.traces, t_s, {}, &ToothTrace::start_s);
    };
    return extremes_of({first_from(from_s), first_from(to_s)});
}

// Linear between the marks, also from those of one trace to those of the next.
double FormError::left_at(std::uint32_t trace, double at) const {
    const ToothTrace& t = kept_.traces[trace];
    const auto begin = kept_.marks.begin() + static_cast<std::ptrdiff_t>(t.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(t.count);
    const auto next =
        std::lower_bound(begin, end, at, [](const ToothMark& m, double a) { return double{m.at} < a; });
    ToothMark low = next == begin ? *begin : *(next - 1), high = next == end ? *(end - 1) : *next;
    if (next == begin && t.before) {
        const ToothTrace& other = kept_.traces[*t.before];
        low = kept_.marks[other.first + other.count - 1];
        low.at = static_cast<float>((double{low.at} - 1) * length_of(other) / length_of(t));
    } else if (next == end && next_[trace]) {
        const ToothTrace& other = kept_.traces[*next_[trace]];
        high = kept_.marks[other.first];
        high.at = static_cast<float>(1 + double{high.at} * length_of(other) / length_of(t));
    }
    if (!(high.at > low.at)) return double{high.left_mm};
    const double share = (at - double{low.at}) / (double{high.at} - double{low.at});
    return std::lerp(double{low.left_mm}, double{high.left_mm}, share);
}

std::optional<double> FormError::at(Vec3 point_mm) const {
    const auto wave = wave_at(point_mm);
    return wave ? std::optional(wave->left_mm) : std::nullopt;
}

std::optional<FormError::Wave> FormError::wave_at(Vec3 point_mm) const {
    if (kept_.traces.empty() || !is_finite(point_mm)) return std::nullopt;
    double newest = -1, weights = 0, sum = 0;
    const ToothTrace* nearest = nullptr;
    double most = 0;
    const auto look = [&](std::uint32_t n, bool find_newest) {
        const ToothTrace& t = kept_.traces[n];
        const Vec3 way = t.to_mm - t.from_mm, off = point_mm - t.from_mm;
        const double size = length(way), beyond = kBeyond * size;
        if (!(size > 0)) return;
        const double out = dot(off, t.normal);
        if (std::abs(out) > kOnSurfaceMm) return;
        const double along = dot(off, way) / size;
        const double over = std::max({0.0, -along, along - size});
        const double beside = length(off - out * t.normal - (along / size) * way);
        if (over >= beyond || beside >= t.width_mm) return;
        if (find_newest) {
            newest = std::max(newest, t.start_s);
            return;
        }
        // Beside it lie the other heights of the same row, behind it the row before.
        if (t.start_s < newest - 2 * (t.end_s - t.start_s)) return;
        // Where a trace ends and none goes on, it does.
        const double weight =
            (over > 0 ? kBeyondWeight * (1 - over / beyond) : 1) * (1 - beside / t.width_mm);
        weights += weight;
        sum += weight * left_at(n, along / size);
        if (weight > most) {
            most = weight;
            nearest = &t;
        }
    };
    for (const bool find_newest : {true, false})
        cells_.for_each_near(point_mm, kMostLooked, [&](std::uint32_t n) { look(n, find_newest); });
    if (nearest == nullptr) return std::nullopt;
    const double size = length_of(*nearest);
    return Wave{sum / weights, (nearest->to_mm - nearest->from_mm) / size,
                2 * size / static_cast<double>(nearest->count)};
}

double SurfaceWithFormError::distance_mm(Vec3 point_mm) const {
    const double off = machined_.distance_mm(point_mm);
    const FormError::Extremes& e = error_.extremes();
    const double most = std::max(e.left_mm, e.overcut_mm);
    if (std::abs(off) > 2 * most) return off > 0 ? off - most : off + most;
    const Vec3 normal = machined_.normal(point_mm), foot = point_mm - off * normal;
    const auto wave = error_.wave_at(foot);
    if (!wave) return off;
    // Beside an edge the other face stays where it is, and no distance along one normal tells of both.
    const Vec3 aside = (2 * most + kOnSurfaceMm) * cross(wave->along, normal);
    for (const Vec3 beside : {foot + aside, foot - aside})
        if (dot(machined_.normal(beside), normal) < kSameFace) return off;
    return off - wave->left_mm;
}

}  // namespace tribo::surface
