// SPDX-License-Identifier: MIT
#include "devices/arm/falcon/falcon_kinematics.hpp"

#include <cmath>

#include "base/math.hpp"

namespace tribo::devices::falcon {
namespace {

// After Stamper's figure, mm. The frame of a leg: u away from the middle of the base, w to the user, v along
// the axis of the arm.
constexpr double kArm = 60, kShin = 102.5;                 // a, b
constexpr double kOffsets = 11.25 + 11.25;                 // d + e: joints at both ends of the shin
constexpr double kGripU = 14, kGripV = -25;                // c, f: from the shin to the middle of the grip
constexpr double kBaseU = 37.233758, kBaseV = -27.330909;  // r, s: from the middle of the base to the arm
// Directions of the legs about z.
constexpr double kTurn = math::kPi / 12;
constexpr std::array kDirections{math::kHalfPi + kTurn, -math::kPi / 6 + kTurn, -5 * math::kPi / 6 + kTurn};
constexpr int kMostSteps = 30;
constexpr double kConverged = 1e-6;  // mm
constexpr double kLongestStep = 20;  // of Newton's method, mm

struct Frame {
    Vec3 u, v;
};
Frame frame_of(std::size_t leg) {
    const double c = math::cos(kDirections[leg]), s = math::sin(kDirections[leg]);
    return {{c, s, 0}, {-s, c, 0}};
}

// The end of a leg at the shin, in its frame, from the axis of the arm. `reach`: from the end of the arm to
// it in the plane of the arm; the shin leans by v out of this plane.
struct Leg {
    double u = 0, v = 0, w = 0, reach = 0;
};
std::optional<Leg> leg_to(std::size_t n, Vec3 grip) {
    const Frame f = frame_of(n);
    const Leg leg{dot(grip, f.u) - kBaseU + kGripU, dot(grip, f.v) - kBaseV + kGripV, grip.z, 0};
    const double flat = kShin * kShin - leg.v * leg.v;
    if (!(flat > 0)) return std::nullopt;
    return Leg{leg.u, leg.v, leg.w, kOffsets + std::sqrt(flat)};
}

// Of two circles' intersections the one with the arm outside.
std::optional<double> angle_of(const Leg& leg) {
    const double way = math::hypot(leg.u, leg.w);
    const double cosine = (way * way + kArm * kArm - leg.reach * leg.reach) / (2 * kArm * way);
    if (!(std::abs(cosine) <= 1)) return std::nullopt;
    return math::atan2(leg.w, leg.u) - math::acos(cosine);
}

// The x that has the product `values` with each of the rows; the rows are not in one plane.
Vec3 solve(const std::array<Vec3, 3>& rows, const std::array<double, 3>& values) {
    const Vec3 a = cross(rows[1], rows[2]), b = cross(rows[2], rows[0]), c = cross(rows[0], rows[1]);
    return (values[0] * a + values[1] * b + values[2] * c) / dot(rows[0], a);
}

}  // namespace

std::optional<Angles> angles_at(Vec3 grip) {
    Angles angles{};
    for (std::size_t n = 0; n < 3; ++n) {
        const std::optional<Leg> leg = leg_to(n, grip);
        const std::optional<double> angle = leg ? angle_of(*leg) : std::nullopt;
        if (!angle) return std::nullopt;
        angles[n] = *angle;
    }
    return angles;
}

// The leg closes where g = (|m| - offsets)^2 + v^2 - shin^2 = 0, m from the end of the arm to the end of the
// leg; so the angle's gradient is -(dg/dposition) / (dg/dangle).
std::optional<std::array<Vec3, 3>> gradients_at(Vec3 grip) {
    std::array<Vec3, 3> rows;
    for (std::size_t n = 0; n < 3; ++n) {
        const std::optional<Leg> leg = leg_to(n, grip);
        const std::optional<double> angle = leg ? angle_of(*leg) : std::nullopt;
        if (!angle) return std::nullopt;
        const Frame f = frame_of(n);
        const double c = math::cos(*angle), s = math::sin(*angle);
        const double u = leg->u - kArm * c, w = leg->w - kArm * s, share = 1 - kOffsets / leg->reach;
        const double by_angle = share * kArm * (u * s - w * c);
        if (std::abs(by_angle) < 1e-3 * kArm * kShin) return std::nullopt;
        rows[n] = -1 / by_angle * (share * u * f.u + leg->v * f.v + Vec3{0, 0, share * w});
    }
    const double volume = std::abs(dot(rows[0], cross(rows[1], rows[2])));
    if (!(volume > 1e-3 * length(rows[0]) * length(rows[1]) * length(rows[2]))) return std::nullopt;
    return rows;
}

// A step that would leave the reach of the legs is halved.
std::optional<Vec3> grip_at(const Angles& angles, Vec3 near) {
    Vec3 at = near;
    std::optional<Angles> now = angles_at(at);
    for (int step = 0; now && step < kMostSteps; ++step) {
        const auto rows = gradients_at(at);
        if (!rows) return std::nullopt;
        Vec3 way = solve(*rows, {angles[0] - (*now)[0], angles[1] - (*now)[1], angles[2] - (*now)[2]});
        if (length(way) < kConverged) return at;
        if (const double size = length(way); size > kLongestStep) way *= kLongestStep / size;
        for (now = angles_at(at + way); !now && length(way) > kConverged; now = angles_at(at + way))
            way *= 0.5;
        at += way;
    }
    return std::nullopt;
}

// force = sum of torque x gradient: the power of both is the same for every motion.
std::array<double, 3> torques_for(Vec3 force, Vec3 grip) {
    const auto rows = gradients_at(grip);
    if (!rows) return {};
    const Vec3 a = cross((*rows)[1], (*rows)[2]), b = cross((*rows)[2], (*rows)[0]),
               c = cross((*rows)[0], (*rows)[1]);
    const double volume = dot((*rows)[0], a);
    return {dot(force, a) / volume, dot(force, b) / volume, dot(force, c) / volume};
}

}  // namespace tribo::devices::falcon
