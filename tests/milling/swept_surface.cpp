// SPDX-License-Identifier: MIT
#include "milling/swept_surface.hpp"

#include <cmath>

namespace tribo::milling {

using motion::HomogeneousPoint;
using motion::testing::bezier_pieces;

namespace {

// Bezier points of a quarter of the unit circle, weights 1, sqrt(1/2), 1 (Farin 2002, 12.2), turned k times.
std::array<HomogeneousPoint, 3> quarter(int k, double radius, double height) {
    const double w = std::sqrt(0.5);
    const std::array<Vec3, 3> unit{Vec3{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::array<double, 3> weight{1, w, 1};
    std::array<HomogeneousPoint, 3> points;
    for (std::size_t j = 0; j < 3; ++j) {
        Vec3 p = unit[j];
        for (int turn = 0; turn < k; ++turn) p = {-p.y, p.x, 0};
        points[j] = weight[j] * HomogeneousPoint{{radius * p.x, radius * p.y, height}, 1};
    }
    return points;
}

// The three curves along u whose quadratic blend over v is the patch.
std::array<HomogeneousPoint, 3> along(const SweptPatch& patch, double u, bool rate) {
    std::array<HomogeneousPoint, 3> row;
    for (std::size_t j = 0; j < 3; ++j) {
        std::vector<HomogeneousPoint> column;
        for (std::size_t i = 0; i <= patch.degree_u; ++i) column.push_back(patch.net[i * 3 + j]);
        row[j] = motion::de_casteljau(rate ? motion::derivative(column) : column, u);
    }
    return row;
}

// Derivative of xyz / w from those of xyz and w.
Vec3 projected_rate(HomogeneousPoint at, HomogeneousPoint rate) {
    return (rate.xyz - rate.w * at.point()) / at.w;
}

}  // namespace

Vec3 SweptPatch::point(double u, double v) const {
    const std::array<HomogeneousPoint, 3> row = along(*this, u, false);
    return motion::de_casteljau(std::span<const HomogeneousPoint>(row), v).point();
}

Vec3 SweptPatch::normal(double u, double v) const {
    const std::array<HomogeneousPoint, 3> row = along(*this, u, false), rate = along(*this, u, true);
    const std::span<const HomogeneousPoint> row_v(row), rate_v(rate);
    const HomogeneousPoint at = motion::de_casteljau(row_v, v);
    const Vec3 by_u = projected_rate(at, motion::de_casteljau(rate_v, v));
    const Vec3 by_v = projected_rate(at, motion::de_casteljau(motion::derivative(row_v), v));
    return normalized(cross(by_u, by_v), {0, 0, 0});
}

std::array<SweptPatch, 4> swept_circle(const motion::BezierMotion& motion, double radius_mm,
                                       double height_mm) {
    std::array<SweptPatch, 4> patches;
    for (int k = 0; k < 4; ++k) {
        SweptPatch& patch = patches[static_cast<std::size_t>(k)];
        patch.degree_u = 2 * motion.degree();
        patch.net.resize((patch.degree_u + 1) * 3);
        const std::array<HomogeneousPoint, 3> circle = quarter(k, radius_mm, height_mm);
        for (std::size_t j = 0; j < 3; ++j) {
            const std::vector<HomogeneousPoint> path = point_path(motion, circle[j]);
            for (std::size_t i = 0; i < path.size(); ++i) patch.net[i * 3 + j] = path[i];
        }
    }
    return patches;
}

std::vector<std::array<SweptPatch, 4>> swept_circle(const motion::BSplineMotion& motion, double radius_mm,
                                                    double height_mm) {
    std::vector<std::array<SweptPatch, 4>> all;
    for (const motion::MotionPiece& piece : bezier_pieces(motion))
        all.push_back(swept_circle(piece.motion, radius_mm, height_mm));
    return all;
}

std::optional<std::array<Vec3, 2>> flank_grazing_points(const motion::testing::PoseRates& rates,
                                                        double radius_mm, double height_mm) {
    const Vec3 axis = rates.pose.axis, centre = rates.pose.tip_mm + height_mm * axis;
    const Vec3 speed = rates.tip_rate_mm + height_mm * rates.axis_rate;
    const Vec3 across = cross(axis, speed);
    if (!(length(across) > 1e-12 * length(speed))) return std::nullopt;
    const Vec3 out = radius_mm * normalized(across);
    return std::array<Vec3, 2>{centre + out, centre - out};
}

}  // namespace tribo::milling
