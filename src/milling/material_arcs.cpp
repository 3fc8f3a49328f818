// SPDX-License-Identifier: MIT
#include "milling/material_arcs.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace tribo::milling {
namespace {

// Material thinner than this in front of the edge is what rounding leaves where the cutter runs along a
// surface that it has made before.
constexpr double kSkin = 2e-5;  // mm
// A step is as long as this share of the clear way, at least this share of a cell, and this many at most over
// half a turn.
constexpr double kWayShare = 0.8, kLeastCells = 0.25;
constexpr double kMostSteps = 48;
// A clear way is looked for up to here, in radii: further steps gain nothing.
constexpr double kEnoughRadii = 1;

class Scan {
  public:
    Scan(const field::CarvedView& stock, const AxisCircle& circle) : stock_(stock), circle_(circle) {}

    // Negative in material.
    double way(double rotation) const {
        return stock_.clear_way_mm(circle_.at(rotation), kEnoughRadii * circle_.radius_mm) + kSkin;
    }

    // The border between two rotations of which only `inside` stands in material: regula falsi in the
    // Illinois form. Far from the surface the clear way tells the side, where the exact distance of a brick
    // may not; near it both are the same.
    double border(double outside, double inside) const {
        constexpr int kSteps = 20;
        constexpr double kAngle = 1e-9, kDepth = 1e-11;  // rad, mm
        double out = way(outside), in = way(inside);
        double angle = inside;
        int last = 0;
        for (int n = 0; n < kSteps && std::abs(inside - outside) > kAngle; ++n) {
            angle = in < out ? outside + (inside - outside) * out / (out - in) : 0.5 * (inside + outside);
            const double d = way(angle);
            if (std::abs(d) < kDepth) break;
            const int side = d < 0 ? 1 : -1;
            if (side > 0) {
                inside = angle;
                in = d;
                if (last > 0) out *= 0.5;
            } else {
                outside = angle;
                out = d;
                if (last < 0) in *= 0.5;
            }
            last = side;
        }
        return angle;
    }

  private:
    const field::CarvedView& stock_;
    const AxisCircle& circle_;
};

}  // namespace

Vec3 AxisCircle::at(double rotation_rad) const {
    double sine, cosine;
    math::sincos(rotation_rad, sine, cosine);
    return centre_mm + sine * x + cosine * y;
}

void material_arcs(const field::CarvedView& stock, const AxisCircle& circle, double from, double to,
                   std::vector<MaterialArc>& arcs, std::vector<ClearPiece>& clear) {
    const Scan scan(stock, circle);
    clear.clear();
    const double radius = std::max(circle.radius_mm, 1e-9);
    const double least = std::max(kLeastCells * stock.field().cell_mm() / radius, (to - from) / kMostSteps);
    double at = from, way = scan.way(at), entry = from;
    while (at < to) {
        const double next = std::min(at + std::max(kWayShare * std::abs(way) / radius, least), to);
        const double next_way = scan.way(next);
        if (way < 0 && next_way >= 0) {
            arcs.push_back({entry, scan.border(next, at)});
        } else if (way >= 0 && next_way < 0) {
            entry = scan.border(at, next);
        } else if (way >= 0) {
            // No place between the two is less clear than this.
            clear.push_back(
                {0.5 * (at + next), next - at, std::max(0.0, 0.5 * (way + next_way - radius * (next - at)))});
        }
        at = next;
        way = next_way;
    }
    if (way < 0) arcs.push_back({entry, to});
}

}  // namespace tribo::milling
