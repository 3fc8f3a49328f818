// SPDX-License-Identifier: MIT
#include "motion/curve/bezier_motion.hpp"

#include <algorithm>

namespace tribo::motion {

namespace {

// Largest number of halvings. After it, a piece whose norm is still too near to zero is assumed to have a
// pole.
constexpr int kPoleDepth = 24;
constexpr double kPoleMargin = 1e-9;

bool has_pole(const BezierMotion& motion, int depth) {
    if (norm_margin(motion) > kPoleMargin) return false;
    if (depth == kPoleDepth) return true;
    const auto [left, right] = subdivide(motion, 0.5);
    return has_pole(left, depth + 1) || has_pole(right, depth + 1);
}

}  // namespace

std::pair<BezierMotion, BezierMotion> subdivide(const BezierMotion& motion, double t) {
    auto [left, right] = subdivide(motion.control, t);
    return {{std::move(left)}, {std::move(right)}};
}

HomogeneousPoint image(const DualQuaternion& a, const DualQuaternion& b, HomogeneousPoint p) {
    const Quaternion turned = a.real * Quaternion(0, p.xyz) * conjugate(b.real);
    const Quaternion shifted = (2 * p.w) * (a.dual * conjugate(b.real));
    return {turned.vector() + shifted.vector(), p.w * dot(a.real, b.real)};
}

std::vector<HomogeneousPoint> point_path(const BezierMotion& motion, HomogeneousPoint p) {
    const std::span<const DualQuaternion> q(motion.control);
    return bezier_product(q, q,
                          [&](const DualQuaternion& a, const DualQuaternion& b) { return image(a, b, p); });
}

std::vector<HomogeneousPoint> point_path(const BezierMotion& motion, Vec3 point_in_tool_mm) {
    return point_path(motion, HomogeneousPoint{point_in_tool_mm, 1});
}

std::vector<HomogeneousPoint> direction_path(const BezierMotion& motion, Vec3 direction_in_tool) {
    const std::span<const DualQuaternion> q(motion.control);
    return bezier_product(q, q, [&](const DualQuaternion& a, const DualQuaternion& b) {
        return HomogeneousPoint{image(a, b, {direction_in_tool, 0}).xyz, dot(a.real, b.real)};
    });
}

double norm_margin(const BezierMotion& motion) {
    const std::span<const DualQuaternion> q(motion.control);
    const std::vector<double> squares = bezier_product(
        q, q, [](const DualQuaternion& a, const DualQuaternion& b) { return dot(a.real, b.real); });
    const auto [low, high] = std::minmax_element(squares.begin(), squares.end());
    return *high > 0 ? *low / *high : 0;
}

bool has_pole(const BezierMotion& motion) {
    return has_pole(motion, 0);
}

}  // namespace tribo::motion
