// SPDX-License-Identifier: MIT
#include "motion/algebra/dual_quaternion.hpp"

#include <cassert>
#include <limits>

#include "base/math.hpp"

namespace tribo::motion {

namespace {

// Below this half angle (rad) sines are replaced by their series; its next term is below 1e-17.
constexpr double kSmallHalfAngle = 1e-4;

// sin(h) / h and its derivative divided by h: (h cos h - sin h) / h^3.
struct SineRatio {
    double value, slope_over_h;

    explicit SineRatio(double h) {
        if (h < kSmallHalfAngle) {
            value = 1 - h * h / 6;
            slope_over_h = -1.0 / 3 + h * h / 30;
        } else {
            double s = 0, c = 1;
            math::sincos(h, s, c);
            value = s / h;
            slope_over_h = (h * c - s) / (h * h * h);
        }
    }
};

}  // namespace

DualNumber norm(const DualQuaternion& a) {
    const double n = norm(a.real);
    assert(n > 0);
    return {n, dot(a.real, a.dual) / n};
}

DualQuaternion normalized(const DualQuaternion& a) {
    const double n = norm(a.real);
    assert(n > 0);
    const Quaternion q = (1 / n) * a.real, d = (1 / n) * a.dual;
    return {q, d - dot(q, d) * q};
}

ToolPose tool_pose(const DualQuaternion& a) {
    return {translation_mm(a), normalized(transform_direction(a, {0, 0, 1}))};
}

DualQuaternion displacement(const ToolPose& pose) {
    return displacement(minimal_rotation({0, 0, 1}, pose.axis), pose.tip_mm);
}

std::vector<DualQuaternion> minimal_twist_displacements(std::span<const ToolPose> poses) {
    std::vector<DualQuaternion> all;
    all.reserve(poses.size());
    Quaternion frame = kIdentityQuaternion;
    for (const ToolPose& pose : poses) {
        // Starts from the actual axis of the frame, so that rounding does not accumulate along the way.
        const Vec3 axis_before = normalized(rotate(frame, {0, 0, 1}));
        frame = normalized(minimal_rotation(axis_before, pose.axis) * frame);
        all.push_back(displacement(frame, pose.tip_mm));
    }
    return all;
}

double Screw::pitch_mm_per_rad() const {
    return angle_rad > 0 ? shift_mm / angle_rad : std::numeric_limits<double>::infinity();
}

Screw screw_of(const DualQuaternion& unit) {
    const DualQuaternion q = unit.real.w < 0 ? -unit : unit;
    const Vec3 v = q.real.vector();
    const double sine = length(v);
    const Vec3 t = translation_mm(q);
    if (sine == 0) return {{}, normalized(t), 0, length(t)};
    const Vec3 direction = v / sine;
    // The part of t across the line is (1 - cos a) c - sin a (l x c), where c is the foot point of the line.
    // Solved for c: c = (t + cot(a/2) l x t) / 2 for t across.
    const double shift = dot(t, direction);
    const Vec3 across = t - shift * direction;
    const Vec3 foot = 0.5 * (across + (q.real.w / sine) * cross(direction, across));
    return {foot, direction, 2 * math::atan2(sine, q.real.w), shift};
}

DualQuaternion displacement(const Screw& s) {
    double sine = 0, cosine = 1;
    math::sincos(0.5 * s.angle_rad, sine, cosine);
    const Quaternion rotation(cosine, sine * s.direction);
    return displacement(rotation, s.shift_mm * s.direction + s.point_mm - rotate(rotation, s.point_mm));
}

DualQuaternion log(const DualQuaternion& unit) {
    // q = (cos h, v) with v = (sin h / h) a, d = its derivative along (a, b): real a = h l, dual b.
    const Vec3 v = unit.real.vector();
    const double sine = length(v);
    const double h = math::atan2(sine, unit.real.w);
    if (sine == 0) {
        // Q = 1 + e b, or Q = -1 + e d, a turn of 2 pi about an axis that only d defines.
        if (unit.real.w > 0) return {{}, Quaternion(0, unit.dual.vector())};
        const Vec3 axis = normalized(unit.dual.vector());
        return {Quaternion(0, h * axis), Quaternion(0, -unit.dual.vector())};
    }
    const SineRatio ratio(h);
    const Vec3 a = h / sine * v;
    // d.w = -ratio a.b and d.v = ratio b + slope_over_h (a.b) a.
    const double ab = -unit.dual.w / ratio.value;
    const Vec3 b = (unit.dual.vector() - (ratio.slope_over_h * ab) * a) / ratio.value;
    return {Quaternion(0, a), Quaternion(0, b)};
}

DualQuaternion exp(const DualQuaternion& dual_vector) {
    const Vec3 a = dual_vector.real.vector(), b = dual_vector.dual.vector();
    const double h = length(a), ab = dot(a, b);
    const SineRatio ratio(h);
    return {Quaternion(math::cos(h), ratio.value * a),
            Quaternion(-ratio.value * ab, ratio.value * b + (ratio.slope_over_h * ab) * a)};
}

DualQuaternion screw_interpolate(const DualQuaternion& a, const DualQuaternion& b, double t) {
    const DualQuaternion near = dot(a.real, b.real) < 0 ? -b : b;
    return a * exp(t * log(quaternion_conjugate(a) * near));
}

}  // namespace tribo::motion
