// SPDX-License-Identifier: MIT
#include "milling/sweep.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/math.hpp"
#include "base/simd.hpp"
#include "milling/sweep_kernels.hpp"
#include "milling/sweep_lines.hpp"
#include "motion/program.hpp"

namespace tribo::milling {
namespace {

using namespace simd;

#include "milling/sweep_distance.inl"

// The tool at one pose, cap included.
Box3 tool_box(const ToolProfile& tool, Vec3 tip, Vec3 axis) {
    const double r = tool.radius_mm;
    const auto reach = [r](double u) { return r * std::sqrt(std::max(0.0, 1 - u * u)); };
    const Vec3 disc{reach(axis.x), reach(axis.y), reach(axis.z)};
    Box3 box;
    for (const Vec3 centre : {tip, tip + tool.length_mm * axis}) {
        box.include(centre - disc);
        box.include(centre + disc);
    }
    return box;
}

// Calls f with the kind as a constant, so that each formula is compiled for its profile.
template <class F>
auto by_kind(CutterKind kind, const F& f) {
    switch (kind) {
        case CutterKind::ball:
            return f.template operator()<CutterKind::ball>();
        case CutterKind::bull:
            return f.template operator()<CutterKind::bull>();
        case CutterKind::flat:
            break;
    }
    return f.template operator()<CutterKind::flat>();
}

// Direction out of the tool, of which `radial` (unit, or zero on the axis) and `axis` are known.
Vec3 tool_normal(const ToolProfile& tool, double rho, double z, Vec3 radial, Vec3 axis) {
    const Profile<double> p(tool);
    double distance, by_rho, by_z;
    by_kind(tool.kind, [&]<CutterKind kind>() { profile_gradient<kind>(p, rho, z, distance, by_rho, by_z); });
    if (z - p.L > distance) return axis;
    return normalized(by_rho * radial + by_z * axis, -axis);
}

Vec3 to_vec3(const Vector<double>& v) {
    return {v.x, v.y, v.z};
}

double curved_distance(const ToolProfile& tool, const CurvedLine& line, Vec3 point) {
    const Profile<double> p(tool);
    const Curve<double> c(line);
    return by_kind(tool.kind, [&]<CutterKind kind>() {
        return curved_least<kind>(p, c, spread<double>(point)).distance;
    });
}

// The normal of the swept surface. Where side and bottom of a flat cutter meet, the edge makes the surface:
// its normal is the mix of both normals that the travel of the edge lies in.
Vec3 curved_gradient(const ToolProfile& tool, const CurvedLine& line, Vec3 point) {
    const Profile<double> p(tool);
    const Curve<double> c(line);
    const Vector<double> at = spread<double>(point);
    const double t = by_kind(tool.kind, [&]<CutterKind kind>() { return curved_least<kind>(p, c, at).t; });
    const Seen<double> s = seen_from(c, at, t);
    const Vec3 axis = to_vec3(s.axis), radial = normalized(to_vec3(s.radial), {0, 0, 0});
    constexpr double kEdge = 1e-4;  // mm, how well the search meets the edge
    const double side_rate = s.drho, bottom_rate = -s.dz;
    if (tool.kind == CutterKind::flat && t > 0 && t < 1 && side_rate * bottom_rate < 0 &&
        std::abs(s.rho - tool.radius_mm + s.z) < kEdge) {
        const double share = bottom_rate / (bottom_rate - side_rate);
        return normalized(share * radial - (1 - share) * axis);
    }
    return tool_normal(tool, s.rho, s.z, radial, axis);
}

class StraightSweep final : public field::Shape {
  public:
    StraightSweep(const ToolProfile& tool, Vec3 from, Vec3 to, Vec3 axis) : tool_(tool), start_(from) {
        const Vec3 travel = to - from;
        line_.rise = dot(travel, axis);
        const Vec3 across = travel - line_.rise * axis;
        line_.across = length(across);
        // Below this share the part along or across the axis is rounding of the axis itself.
        constexpr double kRounding = 1e-12;
        if (std::abs(line_.rise) < kRounding * line_.across) line_.rise = 0;
        if (line_.across < kRounding * std::abs(line_.rise)) line_.across = 0;
        frame_.z = axis;
        frame_.x = line_.across > 0 ? across / line_.across : any_perpendicular(axis);
        frame_.y = cross(frame_.z, frame_.x);
    }

    Box3 bounds_mm() const override {
        Box3 box = tool_box(tool_, start_, frame_.z);
        box.include(tool_box(tool_, start_ + travel(), frame_.z));
        return box;
    }

    double distance_mm(Vec3 point) const override {
        const Vec3 q = frame_.into(point - start_);
        const Profile<double> p(tool_);
        const Line<double> l(line_);
        if (line_.rise == 0) {
            return by_kind(tool_.kind,
                           [&]<CutterKind kind>() { return level_distance<kind>(p, l, q.x, q.y, q.z); });
        }
        if (tool_.kind == CutterKind::flat) return ramp_flat(p, l, q.x, q.y, q.z);
        if (tool_.kind == CutterKind::ball) return ramp_ball(p, l, q.x, q.y, q.z);
        return ramp_bull(p, l, q.x, q.y, q.z);
    }

    Vec3 gradient(Vec3 point) const override {
        if (line_.rise != 0) return curved_gradient(tool_, {travel(), {}, frame_.z, {}, {}}, point - start_);
        const Vec3 q = frame_.into(point - start_);
        const double t = line_.across > 0 ? std::clamp(q.x / line_.across, 0.0, 1.0) : 0;
        const Vec3 radial{q.x - t * line_.across, q.y, 0};
        return frame_.out_of(
            tool_normal(tool_, length(radial), q.z, normalized(radial, {0, 0, 0}), {0, 0, 1}));
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sweep_kernels().straight(tool_, line_, frame_, start_, lattice, out);
    }

  private:
    Vec3 travel() const { return line_.across * frame_.x + line_.rise * frame_.z; }

    ToolProfile tool_;
    Vec3 start_;
    Frame frame_;
    StraightLine line_;
};

class ArcSweep final : public field::Shape {
  public:
    ArcSweep(const ToolProfile& tool, const motion::Move& move) : tool_(tool) {
        const motion::Arc& arc = *move.arc;
        const Vec3 axis = move.start.axis;
        const Vec3 from_centre = move.start.tip_mm - arc.centre_mm;
        const Vec3 radial = from_centre - dot(from_centre, axis) * axis;
        centre_ = move.start.tip_mm - radial;
        line_.radius = length(radial);
        frame_.z = axis;
        frame_.x = normalized(radial, any_perpendicular(axis));
        frame_.y = cross(frame_.z, frame_.x);
        // Turning to the right is turning to the left with y mirrored; the distance formula never sees the
        // difference.
        const double turn = arc.turn_rad * (dot(arc.normal, axis) < 0 ? -1 : 1);
        if (turn < 0) frame_.y = -frame_.y;
        math::sincos(std::abs(turn), line_.end_y, line_.end_x);
        assert(std::abs(turn) <= math::kPi + 1e-9);
        line_.end_y = std::max(line_.end_y, 0.0);
        path_ = motion::tip_bounds(move);
    }

    Box3 bounds_mm() const override {
        Box3 box = tool_box(tool_, {}, frame_.z);
        return {path_.min + box.min, path_.max + box.max};
    }

    double distance_mm(Vec3 point) const override {
        const Vec3 q = frame_.into(point - centre_);
        const Profile<double> p(tool_);
        const Round<double> a(line_);
        return by_kind(tool_.kind,
                       [&]<CutterKind kind>() { return arc_distance<kind>(p, a, q.x, q.y, q.z); });
    }

    Vec3 gradient(Vec3 point) const override {
        const Vec3 q = frame_.into(point - centre_);
        const Vec3 start{line_.radius, 0, 0}, end{line_.radius * line_.end_x, line_.radius * line_.end_y, 0};
        const Vec3 flat{q.x, q.y, 0};
        Vec3 nearest = squared_length(flat - start) < squared_length(flat - end) ? start : end;
        if (std::min(q.y, q.x * line_.end_y - q.y * line_.end_x) >= 0) {
            nearest = line_.radius * normalized(flat, {1, 0, 0});
        }
        const Vec3 radial = flat - nearest;
        return frame_.out_of(
            tool_normal(tool_, length(radial), q.z, normalized(radial, {0, 0, 0}), {0, 0, 1}));
    }

    void sample(const field::Lattice& lattice, float* out) const override {
        sweep_kernels().arc(tool_, line_, frame_, centre_, lattice, out);
    }

  private:
    ToolProfile tool_;
    Vec3 centre_;  // at the height of the tip
    Frame frame_;
    ArcLine line_;
    Box3 path_;
};

class CurvedSweep final : public field::Shape {
  public:
    CurvedSweep(const ToolProfile& tool, const motion::Move& move) : tool_(tool), start_(move.start.tip_mm) {
        Vec3 tip = 0.5 * (move.start.tip_mm + move.end.tip_mm),
             axis = 0.5 * (move.start.axis + move.end.axis);
        if (move.quadratic) {
            tip = move.quadratic->tip_control_mm;
            axis = move.quadratic->axis_control;
        }
        line_.tip1 = 2 * (tip - move.start.tip_mm);
        line_.tip2 = move.start.tip_mm - 2 * tip + move.end.tip_mm;
        line_.axis0 = move.start.axis;
        line_.axis1 = 2 * (axis - move.start.axis);
        line_.axis2 = move.start.axis - 2 * axis + move.end.axis;
    }

    Box3 bounds_mm() const override {
        // The tip stays in the hull of its control points. The unit axis stays within its turn of either end.
        const Vec3 end = line_.axis0 + line_.axis1 + line_.axis2;
        const double bulge = tool_.length_mm * (length(line_.axis1) + length(line_.axis2));
        Box3 path, tool = tool_box(tool_, {}, line_.axis0);
        for (const Vec3 p : {Vec3{}, 0.5 * line_.tip1, line_.tip1 + line_.tip2}) path.include(start_ + p);
        tool.include(tool_box(tool_, {}, normalized(end)));
        tool = tool.inflated(0.125 * bulge * (length(line_.axis1) + length(line_.axis2)));
        return {path.min + tool.min, path.max + tool.max};
    }

    double distance_mm(Vec3 point) const override { return curved_distance(tool_, line_, point - start_); }
    Vec3 gradient(Vec3 point) const override { return curved_gradient(tool_, line_, point - start_); }
    void sample(const field::Lattice& lattice, float* out) const override {
        sweep_kernels().curved(tool_, line_, start_, lattice, out);
    }

  private:
    ToolProfile tool_;
    Vec3 start_;
    CurvedLine line_;
};

}  // namespace

std::unique_ptr<field::Shape> make_sweep(const Cutter& cutter, const motion::Move& move) {
    const ToolProfile tool(cutter);
    if (move.arc) return std::make_unique<ArcSweep>(tool, move);
    if (move.quadratic || move.start.axis != move.end.axis) return std::make_unique<CurvedSweep>(tool, move);
    return std::make_unique<StraightSweep>(tool, move.start.tip_mm, move.end.tip_mm, move.start.axis);
}

}  // namespace tribo::milling
