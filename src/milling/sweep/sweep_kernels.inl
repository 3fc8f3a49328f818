// SPDX-License-Identifier: MIT
// The kernels of sweep_kernels.hpp; included by sweep_kernels_sse2.cpp and sweep_kernels_v3.cpp.
#include <algorithm>
#include <array>
#include <optional>

#include "base/simd.hpp"
#include "milling/sweep/sweep_kernels.hpp"

namespace tribo::milling {
namespace {

using namespace simd;
using field::kLatticeEdge;

// Each of these files uses the one before it.
// clang-format off
#include "milling/sweep/sweep_search.inl"
#include "milling/sweep/sweep_distance.inl"
#include "milling/sweep/sweep_curved.inl"
#include "milling/sweep/sweep_upright.inl"
// clang-format on

// Node coordinates relative to the reference; node n along each axis. They become floats only after the
// subtraction.
struct Offsets {
    F8 x;
    float y[kLatticeEdge], z[kLatticeEdge];
    float centre[3], radius;  // of a ball around all nodes

    Offsets(const field::Lattice& lattice, Vec3 reference) {
        float along_x[kLatticeEdge];
        for (int n = 0; n < kLatticeEdge; ++n) {
            const Vec3 d = lattice.node(n, n, n) - reference;
            along_x[n] = static_cast<float>(d.x);
            y[n] = static_cast<float>(d.y);
            z[n] = static_cast<float>(d.z);
        }
        x = load(along_x);
        const double half = 0.5 * (kLatticeEdge - 1) * lattice.cell_mm;
        const Vec3 middle = lattice.node(0, 0, 0) - reference + Vec3{half, half, half};
        for (int k = 0; k < 3; ++k) centre[k] = static_cast<float>(middle[k]);
        radius = static_cast<float>(1.7321 * half);
    }
};

// Rows with all nodes farther than `near` from the surface. This follows from a neighbouring row, because the
// slope is at most 1. Values above near bound the distance from below, values under -near from above.
struct FarRows {
    F8 near, step;

    FarRows(double near_mm, double cell_mm)
        : near(broadcast<F8>(near_mm)), step(broadcast<F8>(cell_mm + 2 * kProven<F8>)) {}

    // Returns true if row b of layer c is far, and fills it. `out` has all rows before it.
    TRIBO_LANES bool fills(int b, int c, float* out) const { return fills(b, c, out, near); }
    // The same for distances that are needed below `limit` only.
    TRIBO_LANES bool fills(int b, int c, float* out, F8 limit) const {
        return (b > 0 && fills(load(out - kLatticeEdge), out, limit)) ||
               (c > 0 && fills(load(out - kLatticeEdge * kLatticeEdge), out, limit));
    }

  private:
    TRIBO_LANES bool fills(F8 beside, float* out, F8 limit) const {
        const F8 above = beside - step, below = beside + step;
        if (any(both(above<limit, below> - near))) return false;
        store(out, select(above >= limit, above, below));
        return true;
    }
};

// Skips no row, where a distance is cheaper than the test.
struct NoFarRows {
    TRIBO_LANES bool fills(int /*b*/, int /*c*/, float* /*out*/) const { return false; }
};

// The coordinates of the rows in a frame.
class RowsInFrame {
  public:
    struct Row {
        F8 x, y, z;
    };

    RowsInFrame(const Offsets& at, const Frame& frame) : at_(at) {
        const Vec3 axes[3] = {frame.x, frame.y, frame.z};
        for (int k = 0; k < 3; ++k) {
            for (int n = 0; n < 3; ++n) axes_[k][n] = static_cast<float>(axes[k][n]);
            along_[k] = at.x * splat(axes_[k][0]);
        }
    }
    TRIBO_LANES Row row(int b, int c) const { return {seen(0, b, c), seen(1, b, c), seen(2, b, c)}; }

  private:
    TRIBO_LANES F8 seen(int k, int b, int c) const {
        return along_[k] + splat(at_.y[b] * axes_[k][1] + at_.z[c] * axes_[k][2]);
    }
    const Offsets& at_;
    F8 along_[3];
    float axes_[3][3];
};

// Calls distance(x, y, z) with the coordinates in the frame, for each row of nodes that is not far.
template <class Far, class F>
TRIBO_LANES void over_rows(const Offsets& at, const Frame& frame, const Far& far, float* out,
                           const F& distance) {
    const RowsInFrame rows(at, frame);
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b, out += kLatticeEdge) {
            if (far.fills(b, c, out)) continue;
            const auto [x, y, z] = rows.row(b, c);
            store(out, distance(x, y, z));
        }
    }
}

template <CutterKind kind>
void straight_of(const ToolProfile& tool, const StraightLine& line, const Frame& frame, const Offsets& at,
                 const FarRows& far, float* out) {
    const Profile<F8> p(tool);
    const Line<F8> l(line);
    if (line.rise == 0) {
        over_rows(at, frame, NoFarRows(), out,
                  [&](F8 x, F8 y, F8 z) { return level_distance<kind>(p, l, x, y, z); });
    } else if constexpr (kind == CutterKind::bull) {
        over_rows(at, frame, far, out,
                  [&](F8 x, F8 y, F8 z) { return ramp_distance<kind>(p, l, x, y, z, far.near); });
    } else {
        over_rows(at, frame, NoFarRows(), out,
                  [&](F8 x, F8 y, F8 z) { return ramp_distance<kind>(p, l, x, y, z, far.near); });
    }
}

void straight(const ToolProfile& tool, const StraightLine& line, const Frame& frame, Vec3 reference,
              const field::Lattice& lattice, double near_mm, float* out) {
    const Offsets at(lattice, reference);
    const FarRows far(near_mm, lattice.cell_mm);
    switch (tool.kind) {
        case CutterKind::ball:
            return straight_of<CutterKind::ball>(tool, line, frame, at, far, out);
        case CutterKind::bull:
            return straight_of<CutterKind::bull>(tool, line, frame, at, far, out);
        default:
            return straight_of<CutterKind::flat>(tool, line, frame, at, far, out);
    }
}

template <CutterKind kind>
void joined_straight_of(const ToolProfile& tool, std::span<const StraightPart> parts, const Frame& frame,
                        const Offsets& at, const FarRows& far, float* out) {
    const Profile<F8> p(tool);
    double lowest_top = kNever;  // of the caps
    std::array<PartOf<F8>, kMostParts> part_of;
    std::size_t count = 0;
    for (const StraightPart& part : parts) {
        lowest_top = std::min(lowest_top, part.start.z + std::max(part.line.rise, 0.0) + tool.length_mm);
        part_of[count++] = PartOf<F8>(part);
    }
    const F8 under_caps = broadcast<F8>(lowest_top - tool.radius_mm);
    over_rows(at, frame, far, out, [&](F8 x, F8 y, F8 z) {
        F8 least = broadcast<F8>(kNever);
        // No distance is below -R: up to here no cap counts.
        if (kind == CutterKind::ball && every(z <= under_caps)) {
            for (std::size_t n = 0; n < count; ++n) {
                const auto v = part_of[n].view(x, y, z);
                least = min(least, ramp_ball_squared(p, part_of[n].line, v.x, v.y, v.z).distance);
            }
            return sqrt(least) - p.R;
        }
        for (std::size_t n = 0; n < count; ++n) {
            const auto v = part_of[n].view(x, y, z);
            least = min(least, ramp_distance<kind>(p, part_of[n].line, v.x, v.y, v.z, far.near));
        }
        return least;
    });
}

void joined_straight(const ToolProfile& tool, std::span<const StraightPart> parts, const Frame& frame,
                     Vec3 reference, const field::Lattice& lattice, double near_mm, float* out) {
    const Offsets at(lattice, reference);
    const FarRows far(near_mm, lattice.cell_mm);
    switch (tool.kind) {
        case CutterKind::ball:
            return joined_straight_of<CutterKind::ball>(tool, parts, frame, at, far, out);
        case CutterKind::bull:
            return joined_straight_of<CutterKind::bull>(tool, parts, frame, at, far, out);
        default:
            return joined_straight_of<CutterKind::flat>(tool, parts, frame, at, far, out);
    }
}

template <CutterKind kind>
void arc_of(const ToolProfile& tool, const ArcLine& line, const Frame& frame, const Offsets& at, float* out) {
    const Profile<F8> p(tool);
    const Round<F8> a(line);
    over_rows(at, frame, NoFarRows(), out,
              [&](F8 x, F8 y, F8 z) { return arc_distance<kind>(p, a, x, y, z); });
}

void arc(const ToolProfile& tool, const ArcLine& line, const Frame& frame, Vec3 reference,
         const field::Lattice& lattice, float* out) {
    const Offsets at(lattice, reference);
    switch (tool.kind) {
        case CutterKind::ball:
            return arc_of<CutterKind::ball>(tool, line, frame, at, out);
        case CutterKind::bull:
            return arc_of<CutterKind::bull>(tool, line, frame, at, out);
        default:
            return arc_of<CutterKind::flat>(tool, line, frame, at, out);
    }
}

// The tool at one instant; the same bits as the nodes of SeenFrame.
template <CutterKind kind>
TRIBO_LANES void standing(const Profile<F8>& p, const CurvedLine& line, double t, const Offsets& at,
                          float* out) {
    const SeenAxes axes(line, t);
    F8 along_x[3];
    float constant[3], by_y[3], by_z[3];
    for (int k = 0; k < 3; ++k) {
        constant[k] = static_cast<float>(axes.rows[k].constant);
        along_x[k] = at.x * splat(static_cast<float>(axes.rows[k].axis.x));
        by_y[k] = static_cast<float>(axes.rows[k].axis.y);
        by_z[k] = static_cast<float>(axes.rows[k].axis.z);
    }
    const F8 zero = splat(0.0f);
    for (int c = 0; c < kLatticeEdge; ++c) {
        float layer[3];
        for (int k = 0; k < 3; ++k) layer[k] = constant[k] + at.z[c] * by_z[k];
        for (int b = 0; b < kLatticeEdge; ++b, out += kLatticeEdge) {
            F8 seen[3];
            for (int k = 0; k < 3; ++k) seen[k] = splat(layer[k] + at.y[b] * by_y[k]) + along_x[k];
            store(
                out,
                instant<kind>(p, seen[0] * seen[0] + seen[1] * seen[1], zero, seen[2], zero, zero).distance);
        }
    }
}

// The distances of row b of layer c, by the search.
template <CutterKind kind>
TRIBO_LANES F8 searched_row(const Profile<F8>& p, const SeenFrame& frame, const Offsets& at, int b, int c,
                            PointBounds<F8> bounds, const Needed<F8>& needed) {
    bounds.way_error = splat(frame.spin) * bounds.speed * bounds.reach;
    SeenRow seen(frame, at.x, at.y[b], at.z[c]);
    return curved_row<kind>(p, seen, bounds, needed);
}

// The distance below which those of row b of layer c are needed.
TRIBO_LANES F8 limit_of(const FarRows& far, const float* known, int b, int c) {
    return known ? min(far.near, load(known + kLatticeEdge * (b + kLatticeEdge * c))) : far.near;
}

template <CutterKind kind>
void curved_of(const ToolProfile& tool, const CurvedLine& line, const CurvedInstants& instants,
               const Offsets& at, const FarRows& far, const float* known, float* out) {
    const Profile<F8> p(tool);
    const Part part = nearest_part<kind>(p, instants, line.bounds, at.centre, at.radius);
    if (part.from == part.to) return standing<kind>(p, line, part.to, at, out);
    const SeenFrame frame(line, part);
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b, out += kLatticeEdge) {
            const F8 limit = limit_of(far, known, b, c);
            if (far.fills(b, c, out, limit)) continue;
            const PointBounds<F8> bounds = bounds_of(p, line.bounds, at.x, splat(at.y[b]), splat(at.z[c]));
            if (known && frame.stretches == 1) {
                const F8 least = row_bound<kind>(p, frame, at.x, at.y[b], at.z[c], bounds);
                if (every(least >= limit)) {
                    store(out, max(least, -far.near));  // a bound from below is no proof of depth
                    continue;
                }
            }
            store(out, searched_row<kind>(p, frame, at, b, c, bounds, Needed<F8>(far.near, limit)));
        }
    }
}

void curved(const ToolProfile& tool, const CurvedLine& line, const CurvedInstants& instants, Vec3 reference,
            const field::Lattice& lattice, double near_mm, const float* known, float* out) {
    const Offsets at(lattice, reference);
    const FarRows far(near_mm, lattice.cell_mm);
    switch (tool.kind) {
        case CutterKind::ball:
            return curved_of<CutterKind::ball>(tool, line, instants, at, far, known, out);
        case CutterKind::bull:
            return curved_of<CutterKind::bull>(tool, line, instants, at, far, known, out);
        default:
            return curved_of<CutterKind::flat>(tool, line, instants, at, far, known, out);
    }
}

template <CutterKind kind>
void upright_of(const ToolProfile& tool, const UprightLine& upright, const Frame& own, const CurvedLine& line,
                const Offsets& at, const FarRows& far, const float* known, float* out) {
    const Profile<F8> p(tool);
    const RowsInFrame rows(at, own);
    std::optional<SeenFrame> searched;  // few bricks have points that must be searched
    for (int c = 0; c < kLatticeEdge; ++c) {
        for (int b = 0; b < kLatticeEdge; ++b, out += kLatticeEdge) {
            const F8 limit = limit_of(far, known, b, c);
            if (far.fills(b, c, out, limit)) continue;
            const auto [x, y, z] = rows.row(b, c);
            I8 sure;
            F8 distance = upright_distance<kind>(p, upright, x, y, z, sure);
            if (!every(sure)) {
                if (!searched) searched.emplace(line, Part{});
                const PointBounds<F8> bounds =
                    bounds_of(p, line.bounds, at.x, splat(at.y[b]), splat(at.z[c]));
                const Needed<F8> needed(far.near, limit);
                distance = select(sure, distance, searched_row<kind>(p, *searched, at, b, c, bounds, needed));
            }
            store(out, distance);
        }
    }
}

void upright(const ToolProfile& tool, const UprightLine& own, const Frame& frame, const CurvedLine& line,
             Vec3 reference, const field::Lattice& lattice, double near_mm, const float* known, float* out) {
    const Offsets at(lattice, reference);
    const FarRows far(near_mm, lattice.cell_mm);
    if (tool.kind == CutterKind::ball) {
        upright_of<CutterKind::ball>(tool, own, frame, line, at, far, known, out);
    } else {
        upright_of<CutterKind::flat>(tool, own, frame, line, at, far, known, out);
    }
}

void floors(const ToolProfile& tool, const CurvedInstants& at, const TravelBounds& travel, Vec3 point,
            Floors& out) {
    const Profile<F8> p(tool);
    const float seen[3] = {static_cast<float>(point.x), static_cast<float>(point.y),
                           static_cast<float>(point.z)};
    switch (tool.kind) {
        case CutterKind::ball:
            return curved_floors<CutterKind::ball>(p, at, travel, seen, out);
        case CutterKind::bull:
            return curved_floors<CutterKind::bull>(p, at, travel, seen, out);
        default:
            return curved_floors<CutterKind::flat>(p, at, travel, seen, out);
    }
}

void lower_bounds(const ToolProfile& tool, const TravelMiddles& travels, Vec3 point, float* out) {
    const Profile<F8> p(tool);
    const float seen[3] = {static_cast<float>(point.x), static_cast<float>(point.y),
                           static_cast<float>(point.z)};
    switch (tool.kind) {
        case CutterKind::ball:
            return store(out, bounds_from_middles<CutterKind::ball>(p, travels, seen));
        case CutterKind::bull:
            return store(out, bounds_from_middles<CutterKind::bull>(p, travels, seen));
        default:
            return store(out, bounds_from_middles<CutterKind::flat>(p, travels, seen));
    }
}

constexpr SweepKernels kKernels{straight, joined_straight, arc, curved, upright, floors, lower_bounds};

}  // namespace
}  // namespace tribo::milling
