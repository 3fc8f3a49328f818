// SPDX-License-Identifier: MIT
#include "milling/sweep/sweep.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/math.hpp"
#include "base/simd.hpp"
#include "milling/sweep/joined_sweep.hpp"
#include "milling/sweep/profile_sweep.hpp"
#include "milling/sweep/sweep_frames.hpp"
#include "milling/sweep/sweep_kernels.hpp"
#include "milling/sweep/sweep_lines.hpp"
#include "milling/sweep/upright_curve.hpp"
#include "motion/path/program.hpp"

namespace tribo::milling {
namespace {

using namespace simd;

using field::kLatticeEdge;

// Each of these files uses the one before it.
// clang-format off
#include "milling/sweep/sweep_search.inl"
#include "milling/sweep/sweep_distance.inl"
#include "milling/sweep/sweep_curved.inl"
#include "milling/sweep/sweep_top.inl"
// clang-format on

// Calls f with the kind as a constant, so that each formula is compiled for its profile.
template <class F>
auto by_kind(CutterKind kind, const F& f) {
    switch (kind) {
        case CutterKind::ball:
            return f.template operator()<CutterKind::ball>();
        case CutterKind::bull:
            return f.template operator()<CutterKind::bull>();
        default:
            break;
    }
    return f.template operator()<CutterKind::flat>();
}

// A point that is so much nearer to the side than to the top of the tool is beside it, mm.
constexpr double kTopEdge = 1e-5;

bool are_parallel(Vec3 a, Vec3 b) {
    constexpr double kSine = 1e-12;
    return squared_length(cross(a, b)) <= kSine * kSine * squared_length(a) * squared_length(b);
}

// The gradient of the distance of the profile by rho and by z: a unit vector.
struct ProfileNormal {
    double by_rho, by_z;
};
ProfileNormal profile_normal(const ToolProfile& tool, double rho, double z) {
    const double side = rho - (tool.radius_mm - tool.corner_mm), under = tool.corner_mm - z;
    const double out = length({std::max(side, 0.0), std::max(under, 0.0), 0});
    if (out > 0) return {std::max(side, 0.0) / out, -std::max(under, 0.0) / out};
    return side >= under ? ProfileNormal{1, 0} : ProfileNormal{0, -1};
}

// The tool at one instant as seen from a point: in stock coordinates, or in the frame of an upright travel.
struct ToolView {
    Vec3 axis, radial;  // unit; radial is zero on the axis
    double rho, z, drho, dz;
};
ToolView view(const CurvedLine& c, Vec3 point, double t) {
    const Vec3 d = point - tip_at(c, t), velocity = c.tip1 + 2 * t * c.tip2;
    const Vec3 raw = c.axis0 + t * (c.axis1 + t * c.axis2), turning = c.axis1 + 2 * t * c.axis2;
    const double size = length(raw);
    ToolView v;
    v.axis = raw / size;
    const Vec3 axis_rate = (turning - dot(turning, v.axis) * v.axis) / size;
    v.z = dot(d, v.axis);
    const Vec3 radial = d - v.z * v.axis;
    v.rho = length(radial);
    v.radial = normalized(radial, {0, 0, 0});
    v.dz = dot(d, axis_rate) - dot(velocity, v.axis);
    v.drho = -dot(v.radial, velocity) - v.z * dot(v.radial, axis_rate);
    return v;
}

// From the axis of the tool across to a point.
Vec3 from_axis(const UprightLine& line, Vec3 q, double t) {
    return {q.x - t * (line.across + t * line.bend_x), q.y - t * t * line.bend_y, 0};
}
ToolView view(const UprightLine& line, Vec3 q, double t) {
    const Vec3 off = from_axis(line, q, t);
    ToolView v;
    v.axis = {0, 0, 1};
    v.radial = normalized(off, {0, 0, 0});
    v.rho = length(off);
    v.z = q.z - t * line.rise;
    v.drho = -dot(v.radial, {line.across + 2 * t * line.bend_x, 2 * t * line.bend_y, 0});
    v.dz = -line.rise;
    return v;
}

// The outward normal of a swept volume, and the way along it per distance (field::Shape::Slope).
struct SweptNormal {
    Vec3 normal;
    float way_per_mm = 1;
};

// Returns the normal where the tool touches the volume at the instant t. Where side and bottom of a flat
// cutter meet, the edge makes the surface: its normal is perpendicular to the travel of the edge, between the
// two normals. In a plunge that is the side, in a level move the bottom. There the distance is the larger one
// of two that both grow by 1, of which the instant takes a share each.
SweptNormal swept_normal(const ToolProfile& tool, const ToolView& v, double t) {
    constexpr double kEdge = 1e-5;  // mm; many times the accuracy of the search
    if (tool.kind == CutterKind::flat && t > 0 && t < 1 && v.drho * v.dz >= 0 && (v.drho != 0 || v.dz != 0) &&
        std::abs(v.rho - tool.radius_mm + v.z) < kEdge) {
        const double side = std::abs(v.dz), bottom = std::abs(v.drho);
        const Vec3 gradient = (side * v.radial - bottom * v.axis) / (side + bottom);
        const double way_per_mm = 1 / length(gradient);
        return {way_per_mm * gradient, static_cast<float>(way_per_mm)};
    }
    const ProfileNormal n = profile_normal(tool, v.rho, v.z);
    return {normalized(n.by_rho * v.radial + n.by_z * v.axis, -v.axis)};
}

// The same for the tool with its top: its upper half is that of a flat cutter upside down.
SweptNormal closed_normal(ToolProfile tool, ToolView v, double t) {
    const double below_top = tool.length_mm - v.z;
    if (below_top < 0.5 * tool.length_mm && v.rho - tool.radius_mm <= kTopEdge - below_top) {
        tool.kind = CutterKind::flat;
        tool.corner_mm = 0;
        v.axis = -v.axis;
        v.z = below_top;
        v.dz = -v.dz;
    }
    return swept_normal(tool, v, t);
}

// The same of an upright travel, in its frame. Of a ball it points away from the centre, or from the place of
// the axis above it that is as high as the point.
SweptNormal swept_normal(const ToolProfile& tool, const UprightLine& line, Vec3 q, double t) {
    if (tool.kind != CutterKind::ball) return swept_normal(tool, view(line, q, t), t);
    const Vec3 off = from_axis(line, q, t);
    const double below = std::min(q.z - t * line.rise - tool.radius_mm, 0.0);
    return {normalized({off.x, off.y, below}, {0, 0, -1})};
}

// Returns distance and gradient of the sweep of the tool with its top. `d`: the point relative to the tip at
// the start.
field::Shape::Slope closed_slope(const ToolProfile& tool, const CurvedLine& line, Vec3 d) {
    const auto nearest = by_kind(tool.kind, [&]<CutterKind kind>() {
        const Profile<double> p(tool);
        const auto at = [&](double t) { return closed_instant<kind>(p, line, d, t); };
        const Least<double> found = closed_nearest<kind>(p, line, d, kNever);
        // Every tool has the edge of a flat cutter at its top.
        return Least<double>{found.distance, sharpened<CutterKind::flat>(p.R, at, found.t)};
    });
    const SweptNormal n = closed_normal(tool, view(line, d, nearest.t), nearest.t);
    return {nearest.distance, n.normal, n.way_per_mm};
}

// The travel in its own frame.
CurvedLine as_curve(const StraightLine& line) {
    return {{line.across, 0, line.rise}, {}, {0, 0, 1}, {}, {}};
}

// Distance and gradient of a straight sweep at a point (x, y, z) of its frame.
field::Shape::Slope straight_slope(const ToolProfile& tool, const StraightLine& line, const Frame& frame,
                                   Vec3 q) {
    const Profile<double> p(tool);
    const Line<double> l(line);
    const auto nearest = by_kind(tool.kind, [&]<CutterKind kind>() {
        if (line.rise != 0) return ramp_nearest<kind>(p, l, q.x, q.y, q.z, kNever);
        const double t = unit_clamp(q.x * l.per_across), dx = q.x - t * l.across;
        return Least<double>{profile_distance<kind>(p, dx * dx + q.y * q.y, q.z), t};
    });
    if (!is_below_top(tool, nearest, q.z - nearest.t * line.rise)) {
        field::Shape::Slope slope = closed_slope(tool, as_curve(line), q);
        slope.gradient = frame.out_of(slope.gradient);
        return slope;
    }
    const SweptNormal n = swept_normal(tool, UprightLine{line.across, 0, 0, line.rise}, q, nearest.t);
    return {nearest.distance, frame.out_of(n.normal), n.way_per_mm};
}

// Returns the distance at a point (x, y, z) of the frame if it is below `bound`, else `bound`.
double straight_distance(const ToolProfile& tool, const StraightLine& line, Vec3 q, double bound) {
    const Profile<double> p(tool);
    const Line<double> l(line);
    // Lower bounds of the distance: to the cylinder around the path, to the lowest plane of the tip, and for
    // a ball also to the nearest of its centres if the point is below all of them.
    const double off = q.x - unit_clamp(q.x * l.per_across) * l.across, reach = tool.radius_mm + bound;
    const double lowest = std::min(line.rise, 0.0);
    if (lowest - q.z >= bound) return bound;
    const double below = tool.kind == CutterKind::ball ? std::max(lowest + tool.radius_mm - q.z, 0.0) : 0;
    if (reach > 0 && off * off + q.y * q.y + below * below >= reach * reach) return bound;
    return by_kind(tool.kind, [&]<CutterKind kind>() {
        if (line.rise == 0) return level_distance<kind>(p, l, q.x, q.y, q.z);
        const Least<double> least = ramp_nearest<kind>(p, l, q.x, q.y, q.z, kNever);
        if (least.distance >= bound || is_below_top(tool, least, q.z - least.t * line.rise))
            return least.distance;
        const double above_all = q.z - std::max(line.rise, 0.0) - tool.length_mm;
        if (above_all >= bound) return bound;
        return closed_nearest<kind>(p, as_curve(line), q, bound).distance;
    });
}

class StraightSweep final : public field::Shape {
  public:
    StraightSweep(const ToolProfile& tool, Vec3 from, Vec3 travel, Vec3 axis)
        : tool_(tool), path_(from, travel, axis) {}

    Box3 bounds_mm() const override { return path_.box({tool_.radius_mm, tool_.length_mm}); }

    double distance_mm(Vec3 point) const override { return distance_below(point, kNever); }

    double distance_below(Vec3 point, double bound) const override {
        return straight_distance(tool_, path_.line, path_.frame.into(point - path_.start), bound);
    }

    // It is convex.
    bool is_whole_along(Vec3 /*direction*/) const override { return true; }

    Vec3 gradient(Vec3 point) const override { return slope(point).gradient; }

    Slope slope(Vec3 point) const override {
        return straight_slope(tool_, path_.line, path_.frame, path_.frame.into(point - path_.start));
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kNever, out);
    }

    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        sweep_kernels().straight(tool_, path_.line, path_.frame, path_.start, lattice, near_mm, out);
        if (path_.line.rise == 0) return;
        sample_tops(*this, lattice, near_mm, nullptr, out, [this](Vec3 point, double around) {
            return dot(point - path_.start, path_.frame.z) + around - std::min(path_.line.rise, 0.0) -
                   tool_.length_mm;
        });
    }

  private:
    ToolProfile tool_;
    StraightFrame path_;
};

class ArcSweep final : public field::Shape {
  public:
    ArcSweep(const ToolProfile& tool, const motion::Move& move) : tool_(tool), path_(move) {}

    Box3 bounds_mm() const override { return path_.box({tool_.radius_mm, tool_.length_mm}); }

    double distance_mm(Vec3 point) const override {
        const Vec3 q = path_.frame.into(point - path_.centre);
        const Profile<double> p(tool_);
        const Round<double> a(path_.line);
        return by_kind(tool_.kind,
                       [&]<CutterKind kind>() { return arc_distance<kind>(p, a, q.x, q.y, q.z); });
    }

    // Each instant of the tool holds a line along its axis from its bottom up to the common cap.
    bool is_whole_along(Vec3 direction) const override { return are_parallel(direction, path_.frame.z); }

    Vec3 gradient(Vec3 point) const override {
        const Vec3 q = path_.frame.into(point - path_.centre);
        const Vec3 radial = Vec3{q.x, q.y, 0} - path_.nearest(q);
        const double rho = length(radial);
        const Profile<double> p(tool_);
        const double cap = q.z - tool_.length_mm;
        if (cap > by_kind(tool_.kind,
                          [&]<CutterKind kind>() { return profile_distance<kind>(p, rho * rho, q.z); })) {
            return path_.frame.z;
        }
        const ProfileNormal n = profile_normal(tool_, rho, q.z);
        return path_.frame.out_of(
            normalized(n.by_rho * normalized(radial, {0, 0, 0}) + Vec3{0, 0, n.by_z}, {0, 0, -1}));
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sweep_kernels().arc(tool_, path_.line, path_.frame, path_.centre, lattice, out);
    }

  private:
    ToolProfile tool_;
    ArcFrame path_;
};

class CurvedSweep final : public field::Shape {
  public:
    CurvedSweep(const ToolProfile& tool, const motion::Move& move)
        : tool_(tool),
          start_(move.start.tip_mm),
          line_(curved_line(move)),
          instants_(line_),
          upright_(UprightCurve::of(tool_, line_)),
          box_(curved_box({tool_.radius_mm, tool_.length_mm}, line_, start_)) {}

    Box3 bounds_mm() const override { return box_; }

    double distance_mm(Vec3 point) const override { return distance_below(point, kNever); }

    double distance_below(Vec3 point, double bound) const override {
        const Vec3 d = point - start_;
        if (bound < kNever) {
            // On a grid that is coarse beside the moves a brick has hundreds of shapes, most of them far. At
            // an edge the mitred distance is at most the square root of 2 shorter than the distance.
            if (beyond(box_, point) > 1.4143 * std::max(bound, 0.0)) return bound;
            if (upright_) {
                if (upright_->is_beyond(d, bound)) return bound;
            } else {
                const Profile<double> p(tool_);
                const double least =
                    by_kind(tool_.kind, [&]<CutterKind kind>() { return curved_bound<kind>(p, line_, d); });
                if (least >= bound) return bound;
            }
        }
        return searched_below(point, bound);
    }

    // The same without a look at cheap bounds first, where none is expected to hold.
    double searched_below(Vec3 point, double bound) const {
        const Vec3 d = point - start_;
        double above_all = 0;
        Least<double> least{};
        if (const auto near = upright_nearest(d)) {
            least = {near->distance_mm, near->t};
            above_all = upright_->lowest_mm(d) - tool_.length_mm;
        } else {
            Floors floors;
            sweep_kernels().floors(tool_, instants_, line_.bounds, d, floors);
            least = nearest(floors, d, bound);
            above_all = static_cast<double>(floors.lowest) - sag_mm(d) - tool_.length_mm;
        }
        if (least.distance >= bound || above_all >= bound) return bound;
        if (is_below_top(tool_, least, height_at(d, least.t))) return least.distance;
        return by_kind(tool_.kind, [&]<CutterKind kind>() {
            return closed_nearest<kind>(Profile<double>(tool_), line_, d, bound).distance;
        });
    }

    bool is_searched() const override { return true; }

    bool is_whole_along(Vec3 direction) const override {
        constexpr double kStill = 1e-12;  // rad
        // At each instant the tool holds a piece of a line along its axis. If the path does not rise by more
        // than the cylinder is long, all these pieces have a point in common.
        const double half = dot(0.5 * line_.tip1, line_.axis0),
                     end = dot(line_.tip1 + line_.tip2, line_.axis0);
        const double rise = std::max({half, end, 0.0}) - std::min({half, end, 0.0});
        return line_.bounds.turn <= kStill && are_parallel(direction, line_.axis0) &&
               rise <= tool_.length_mm - tool_.corner_mm;
    }

    Vec3 gradient(Vec3 point) const override { return slope(point).gradient; }

    Slope slope(Vec3 point) const override {
        const Vec3 d = point - start_;
        if (const auto near = upright_nearest(d)) {
            if (!is_below_top(tool_, {near->distance_mm, near->t}, height_at(d, near->t)))
                return closed_slope(tool_, line_, d);
            const Frame& frame = upright_->frame();
            const SweptNormal n = swept_normal(tool_, upright_->line(), frame.into(d), near->t);
            return {near->distance_mm, frame.out_of(n.normal), n.way_per_mm};
        }
        Floors floors;
        sweep_kernels().floors(tool_, instants_, line_.bounds, d, floors);
        const Least<double> least = nearest(floors, d, kNever);
        if (!is_below_top(tool_, least, height_at(d, least.t))) return closed_slope(tool_, line_, d);
        return by_kind(tool_.kind, [&]<CutterKind kind>() -> Slope {
            const Profile<double> p(tool_);
            const auto at = [&](double t) { return curved_instant<kind>(p, line_, d, t); };
            const double t = sharpened<kind>(p.R, at, least.t);
            const ToolView v = view(line_, d, t);
            const SweptNormal n = swept_normal(tool_, v, t);
            const double distance = profile_distance<kind>(p, v.rho * v.rho, v.z);
            return {std::min(distance, least.distance), n.normal, n.way_per_mm};
        });
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sample_near(lattice, kNever, out);
    }

    void sample_near(const field::Lattice& lattice, double near_mm, float* out) const override {
        sample_below(lattice, near_mm, nullptr, out);
    }

    void sample_below(const field::Lattice& lattice, double near_mm, const float* known,
                      float* out) const override {
        if (upright_) {
            sweep_kernels().upright(tool_, upright_->line(), upright_->frame(), line_, start_, lattice,
                                    near_mm, known, out);
        } else {
            sweep_kernels().curved(tool_, line_, instants_, start_, lattice, near_mm, known, out);
        }
        sample_tops(*this, lattice, near_mm, known, out, [this](Vec3 point, double around) {
            const Vec3 d = point - start_;
            const double reach = reach_of(d) + around;
            const double moved = 0.5 * (line_.bounds.speed + line_.bounds.turn * reach);
            return height_at(d, 0.5) + moved + around - tool_.length_mm;
        });
    }

  private:
    double height_at(Vec3 d, double t) const { return dot(d - tip_at(line_, t), axis_at(line_, t)); }
    // No less than how far the height of a point falls below its least at the instants of Floors between two
    // of them, with rounding.
    double sag_mm(Vec3 d) const {
        constexpr double kSteps = CurvedInstants::kCount - 1, kHeightRounding = 1e-3;
        const PointBounds<double> bounds =
            bounds_of<double>(Profile<double>(tool_), line_.bounds, d.x, d.y, d.z);
        return bounds.bend / (8 * kSteps * kSteps) + kHeightRounding;
    }
    // No less than the distance from the tip at any instant.
    double reach_of(Vec3 d) const { return length(d - line_.bounds.middle) + line_.bounds.spread; }

    // Returns how far the point is outside the box, along the axis along which it is farthest.
    static double beyond(const Box3& box, Vec3 p) {
        const auto along = [](double low, double at, double high) { return std::max(low - at, at - high); };
        return std::max({along(box.min.x, p.x, box.max.x), along(box.min.y, p.y, box.max.y),
                         along(box.min.z, p.z, box.max.z)});
    }
    Least<double> nearest(const Floors& floors, Vec3 d, double bound) const {
        const Profile<double> p(tool_);
        return by_kind(tool_.kind,
                       [&]<CutterKind kind>() { return curved_nearest<kind>(p, line_, floors, d, bound); });
    }
    std::optional<UprightCurve::Nearest> upright_nearest(Vec3 d) const {
        return upright_ ? upright_->nearest(d) : std::nullopt;
    }

    ToolProfile tool_;
    Vec3 start_;
    CurvedLine line_;
    CurvedInstants instants_;
    std::optional<UprightCurve> upright_;
    Box3 box_;
};

#include "milling/sweep/sweep_joined.inl"

// True for a straight move with one axis.
bool is_straight(const motion::Move& move) {
    return !move.arc && !move.quadratic && move.start.axis == move.end.axis;
}

// Returns the number of stretches. A stretch must be short enough that each part of the tool comes nearest at
// most once over it. More stretches are cheap: a brick searches only the few that may hold its nearest
// instants, and short ones need fewer evaluations.
int stretches_needed(const CurvedLine& c) {
    const Vec3 leaving = c.tip1 + 2 * c.tip2;
    const double speed = std::max(length(c.tip1), length(leaving));
    const double turn = std::max(length(c.axis1), length(c.axis1 + 2 * c.axis2));
    const double bend = speed > 0 ? 2 * length(c.tip2) / speed : 0;
    constexpr double kFirst = 0.04;  // rad
    const double bow = std::max(turn, 0.5 * bend);
    return bow < kFirst ? 1 : bow < 2 * kFirst ? 4 : SeenFrame::kMostStretches;
}

// The control points of the Bezier form bound a polynomial.
TravelBounds bounds_of(const CurvedLine& c) {
    TravelBounds b;
    b.middle = tip_at(c, 0.5);
    const Vec3 tips[3] = {{}, 0.5 * c.tip1, c.tip1 + c.tip2};
    const Vec3 axes[3] = {c.axis0, c.axis0 + 0.5 * c.axis1, c.axis0 + c.axis1 + c.axis2};
    const Vec3 rates[2] = {c.axis1, c.axis1 + 2 * c.axis2};
    const Vec3 along = normalized(axes[0] + axes[2]);
    double least_size = 1, turned = 0;
    for (int k = 0; k < 3; ++k) {
        b.spread = std::max(b.spread, length(tips[k] - b.middle));
        least_size = std::min(least_size, dot(axes[k], along));
        turned = std::max(turned, length(cross(2 * c.axis2, axes[k])));
    }
    least_size = std::max(least_size, 0.1);
    b.speed = std::max(length(c.tip1), length(c.tip1 + 2 * c.tip2));
    b.tip_bend = 2 * length(c.tip2);
    b.turn = std::max(length(rates[0]), length(rates[1])) / least_size;
    // Bounds axis . axis', half the rate of change of its square.
    const double growth =
        std::max(std::max(std::abs(dot(axes[0], rates[0])), std::abs(dot(axes[2], rates[1]))),
                 std::max(std::abs(dot(axes[0], rates[1]) + 2 * dot(axes[1], rates[0])),
                          std::abs(2 * dot(axes[1], rates[1]) + dot(axes[2], rates[0]))) /
                     3);
    b.turn_rate = (turned + 2 * b.turn * growth) / (least_size * least_size);
    return b;
}

}  // namespace

CurvedLine::CurvedLine(Vec3 tip_1, Vec3 tip_2, Vec3 axis_0, Vec3 axis_1, Vec3 axis_2)
    : tip1(tip_1), tip2(tip_2), axis0(axis_0), axis1(axis_1), axis2(axis_2) {
    stretches = stretches_needed(*this);
    bounds = bounds_of(*this);
}

CurvedInstants::CurvedInstants(const CurvedLine& line) {
    for (int k = 0; k < kCount; ++k) put(k, line, static_cast<double>(k) / (kCount - 1), {});
}

void CurvedInstants::put(int k, const CurvedLine& line, double t, Vec3 start) {
    const Vec3 at = start + tip_at(line, t), velocity = line.tip1 + 2 * t * line.tip2;
    const Vec3 raw = line.axis0 + t * (line.axis1 + t * line.axis2),
               turning = line.axis1 + 2 * t * line.axis2;
    const double per = 1 / length(raw);
    const Vec3 unit = per * raw, rate = per * (turning - dot(turning, unit) * unit);
    for (int n = 0; n < 3; ++n) {
        tip[n][k] = static_cast<float>(at[n]);
        axis[n][k] = static_cast<float>(unit[n]);
        tip_rate[n][k] = static_cast<float>(velocity[n]);
        axis_rate[n][k] = static_cast<float>(rate[n]);
    }
}

void TravelMiddles::put(int k, const CurvedLine& line, Vec3 start) {
    const TravelBounds& b = line.bounds;
    const Vec3 tip = start + b.middle;
    at.put(k, line, 0.5, start);
    for (int axis = 0; axis < 3; ++axis) middle[axis][k] = static_cast<float>(tip[axis]);
    spread[k] = static_cast<float>(b.spread);
    speed[k] = static_cast<float>(b.speed);
    turn[k] = static_cast<float>(b.turn);
    bend[k] = static_cast<float>(b.tip_bend + 2 * b.turn * b.speed);
    bend_per_mm[k] = static_cast<float>(b.turn_rate + b.turn * b.turn);
}

std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, const motion::Move& move) {
    if (cutter.has_profile())
        return make_profile_sweep(cutter.zones ? cutter.zones : std::make_shared<const ConvexZones>(cutter),
                                  move);
    const ToolProfile tool(cutter);
    if (move.arc) return std::make_unique<ArcSweep>(tool, move);
    if (!is_straight(move)) return std::make_unique<CurvedSweep>(tool, move);
    return std::make_unique<StraightSweep>(tool, move.start.tip_mm, move.end.tip_mm - move.start.tip_mm,
                                           move.start.axis);
}

std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, std::span<const motion::Move* const> moves) {
    if (moves.size() == 1) return make_sweep(cutter, *moves.front());
    const bool has_own_form = !cutter.has_profile() && moves.size() <= kMostParts;
    const auto every = [&](const auto& holds) {
        return has_own_form && std::ranges::all_of(moves, [&](const motion::Move* m) { return holds(*m); });
    };
    const Vec3 axis = moves.front()->start.axis;
    if (every([&](const motion::Move& m) { return is_straight(m) && m.start.axis == axis; }))
        return std::make_unique<JoinedStraightSweep>(ToolProfile(cutter), moves);
    std::vector<std::unique_ptr<const field::Shape>> sweeps;
    for (const motion::Move* move : moves) sweeps.push_back(make_sweep(cutter, *move));
    if (every([](const motion::Move& m) { return !m.arc && !is_straight(m); }))
        return std::make_unique<JoinedCurvedSweep>(ToolProfile(cutter), moves, std::move(sweeps));
    return std::make_unique<JoinedSweep>(std::move(sweeps));
}

}  // namespace tribo::milling
