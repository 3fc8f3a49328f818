// SPDX-License-Identifier: MIT
#include "session/flute_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tribo::session {
namespace {

using std::numbers::pi;

// So near to the edge material must begin, for the edge to cut at all.
constexpr double kSkin = 1e-6;  // mm

double wrapped(double angle) {
    return std::remainder(angle, 2 * pi);
}

// The rotation that takes the unit vector `from` to `to` the short way, by a share of its angle, on v.
Vec3 turned(Vec3 v, Vec3 from, Vec3 to, double share) {
    const Vec3 normal = cross(from, to);
    const double sine = length(normal);
    if (sine < 1e-12) return v;
    const Vec3 n = normal / sine;
    const double a = share * std::atan2(sine, dot(from, to));
    return std::cos(a) * v + std::sin(a) * cross(n, v) + (1 - std::cos(a)) * dot(n, v) * n;
}

}  // namespace

Vec3 FluteStepping::Pose::across(double angle) const {
    return std::cos(angle) * e1 - std::sin(angle) * e2;
}

FluteStepping::FluteStepping(const milling::Cutter& cutter, const milling::CuttingCoefficients& coefficients,
                             Box3 block, std::vector<motion::Move> moves, double rpm)
    : cutter_(cutter), k_(coefficients), block_(block), moves_(std::move(moves)), spin_(rpm / 60 * 2 * pi) {
    double now = 0;
    Vec3 e1 = any_perpendicular(moves_.front().start.axis);
    for (const motion::Move& m : moves_) {
        start_s_.push_back(now);
        e1_.push_back(e1);
        const double way = distance(m.start.tip_mm, m.end.tip_mm);
        now += m.duration_s > 0 ? m.duration_s : way / (m.feed_mm_per_min / 60);
        e1 = turned(e1, m.start.axis, m.end.axis, 1);
    }
    start_s_.push_back(now);
    double ahead = 0;
    for (int j = 0; j < cutter_.flutes; ++j) {
        ahead_.push_back(ahead);
        ahead += cutter_.pitch_deg.empty() ? 2 * pi / cutter_.flutes
                                           : cutter_.pitch_deg[static_cast<std::size_t>(j)] * pi / 180;
    }
}

FluteStepping::Pose FluteStepping::pose_at(double time_s) const {
    const auto next = std::upper_bound(start_s_.begin() + 1, start_s_.end() - 1, time_s);
    const auto n = static_cast<std::size_t>(next - start_s_.begin()) - 1;
    const motion::Move& m = moves_[n];
    const double share = (time_s - start_s_[n]) / (start_s_[n + 1] - start_s_[n]);
    Pose pose;
    pose.tip = lerp(m.start.tip_mm, m.end.tip_mm, share);
    pose.axis = turned(m.start.axis, m.start.axis, m.end.axis, share);
    pose.e1 = turned(e1_[n], m.start.axis, m.end.axis, share);
    pose.e2 = cross(pose.axis, pose.e1);
    return pose;
}

// About the tool's own axis, which run-out sets beside the spindle's; angles from flute 0.
FluteStepping::Place FluteStepping::place_at(double time_s, Vec3 q) const {
    const Pose pose = pose_at(time_s);
    Vec3 d = q - pose.tip;
    if (cutter_.runout_mm > 0)
        d = d - cutter_.runout_mm * pose.across(spin_ * time_s + cutter_.runout_deg * pi / 180);
    const double u = dot(d, pose.e1), v = -dot(d, pose.e2);
    return {std::sqrt(u * u + v * v), dot(d, pose.axis), std::atan2(v, u) - spin_ * time_s};
}

// Signed distance to the envelope across its profile; what stands over the tip within the cutting length is
// inside.
double FluteStepping::outside(double radius, double height) const {
    const double corner = cutter_.corner_radius_mm(), middle = cutter_.radius_mm() - corner;
    const double out = radius - middle, down = corner - height;
    const double skin =
        out > 0 && down > 0 ? std::sqrt(out * out + down * down) - corner : std::max(out, down) - corner;
    return std::max(skin, height - cutter_.length_mm);
}

// The same when the edge that stands at that angle of the tool (at the tip) comes past q, about that time.
double FluteStepping::outside_pass(double time_s, double edge_angle, Vec3 q) const {
    Place place = place_at(time_s, q);
    for (int n = 0; n < 2; ++n) {
        const double lag = std::tan(cutter_.helix_deg * pi / 180) / cutter_.radius_mm() * place.height;
        time_s += wrapped(place.angle - (edge_angle - lag)) / spin_;
        place = place_at(time_s, q);
    }
    return outside(place.radius, place.height);
}

bool FluteStepping::in_block(Vec3 q) const {
    for (int i = 0; i < 3; ++i) {
        if (!(q[i] > block_.min[i] && q[i] < block_.max[i])) return false;
    }
    return true;
}

bool FluteStepping::cut_long_ago(Vec3 q, const std::vector<Instant>& history) const {
    return std::any_of(history.begin(), history.end(), [&](const Instant& at) {
        const Vec3 d = q - at.tip;
        const double height = dot(d, at.axis);
        return outside(std::sqrt(std::max(0.0, squared_length(d) - height * height)), height) < 0;
    });
}

// From q inward along the normal: how far there is material, at most `longest`. Teeth first, then the block's
// border and older cuts, which may end the chip sooner.
double FluteStepping::chip(double time_s, const EdgePoint& point, Vec3 q, Vec3 normal, double longest,
                           const std::vector<Instant>& history) const {
    if (!in_block(q - kSkin * normal)) return 0;
    // An edge that recedes only grazes the chip of its neighbour, which the tool's feed cuts round the
    // corner.
    const Pose then = pose_at(time_s - 2 * pi / spin_ / static_cast<double>(ahead_.size())),
               now = pose_at(time_s);
    const Vec3 arm = q - now.tip;
    const Vec3 came = arm - turned(arm, now.axis, then.axis, 1) + now.tip - then.tip;
    if (dot(came, normal) <= 0) return 0;
    const bool alike = cutter_.runout_mm == 0 && cutter_.pitch_deg.empty();
    const std::size_t teeth = ahead_.size(), passes = alike ? std::min<std::size_t>(teeth, 2) : 2 * teeth;
    // At a sharp corner the chip is shared between the two edges along the line half way between them.
    if (cutter_.kind == milling::CutterKind::flat)
        longest = std::min(longest, point.height == 0 ? cutter_.radius_mm() - point.radius : point.height);
    double thick = longest;
    for (std::size_t k = 1; k <= passes; ++k) {
        const std::size_t other = (point.flute + k) % teeth;
        const auto turns = static_cast<double>((point.flute + k) / teeth);
        const double before = time_s - (ahead_[other] + 2 * pi * turns - ahead_[point.flute]) / spin_;
        // The distance falls by 1 per mm where the normals are alike: a few steps find its zero.
        double s = kSkin;
        for (int n = 0; n < 6; ++n) {
            const double gap = outside_pass(before, ahead_[other], q - s * normal);
            if (gap < 0 && s == kSkin) return 0;
            s = std::max(s + gap, kSkin);
            if (std::abs(gap) < 1e-6 || s > 2 * longest) break;
        }
        thick = std::min(thick, s);
    }
    const auto solid = [&](double s) {
        const Vec3 p = q - s * normal;
        return in_block(p) && !cut_long_ago(p, history);
    };
    if (!solid(kSkin)) return 0;
    if (solid(thick - kSkin)) return thick;
    double near = kSkin, far = thick;
    for (int n = 0; n < 16; ++n) {
        const double middle = 0.5 * (near + far);
        (solid(middle) ? near : far) = middle;
    }
    return near;
}

std::vector<FluteStepping::EdgePoint> FluteStepping::edge_points(const SteppingOptions& options) const {
    const double corner = cutter_.corner_radius_mm(), radius = cutter_.radius_mm(), middle = radius - corner;
    const double lead = std::tan(cutter_.helix_deg * pi / 180) / radius;
    // Along the profile to the leading end: down for a right-hand helix, up for a left-hand one, outward on
    // the bottom.
    const double leads = cutter_.helix_deg < 0 ? 1 : -1;
    std::vector<EdgePoint> points;
    for (std::size_t j = 0; j < ahead_.size(); ++j) {
        const double core = 0.5 * cutter_.core_mm, ring = (middle - core) / options.bottom;
        for (int n = 0; n < options.bottom && ring > 0; ++n)
            points.push_back({j, core + (n + 0.5) * ring, 0, -ahead_[j], ring, 0, -1, 1, 0});
        const double arc = corner * pi / 2, whole = arc + std::max(0.0, options.height_mm - corner);
        const double step = whole / options.lateral;
        for (int n = 0; n < options.lateral; ++n) {
            const double s = (n + 0.5) * step, kappa = s < arc ? s / corner : pi / 2;
            const double r = middle + corner * std::sin(kappa);
            const double z = s < arc ? corner * (1 - std::cos(kappa)) : corner + s - arc;
            points.push_back({j, r, z, lead * z - ahead_[j], step, std::sin(kappa), -std::cos(kappa),
                              leads * std::cos(kappa), leads * std::sin(kappa)});
        }
    }
    return points;
}

std::vector<FluteStepping::Instant> FluteStepping::history(double until_s,
                                                           const SteppingOptions& options) const {
    std::vector<Instant> instants;
    for (std::size_t n = 0; n < moves_.size() && start_s_[n] < until_s; ++n) {
        const motion::Move& m = moves_[n];
        const double end = std::min(start_s_[n + 1], until_s);
        const double way = std::max(distance(m.start.tip_mm, m.end.tip_mm),
                                    distance(m.start.tip_mm + options.height_mm * m.start.axis,
                                             m.end.tip_mm + options.height_mm * m.end.axis));
        const double part = (end - start_s_[n]) / (start_s_[n + 1] - start_s_[n]);
        const int steps = 1 + static_cast<int>(way * part / options.history_mm);
        for (int i = 0; i <= steps; ++i) {
            const Pose pose = pose_at(start_s_[n] + (end - start_s_[n]) * i / steps * (1 - 1e-12));
            instants.push_back({pose.tip, pose.axis});
        }
    }
    std::reverse(instants.begin(), instants.end());  // the latest are the likeliest
    return instants;
}

TurnOfForce FluteStepping::turn_at(double time_s, const SteppingOptions& options) const {
    const double turn_s = 2 * pi / spin_;
    const std::vector<EdgePoint> points = edge_points(options);
    const std::vector<Instant> older = history(time_s - 2.5 * turn_s, options);

    // Tool's frame in the middle of the turn: x as the tip travels across the axis; in a plunge or a turn on
    // the spot as it did last, stock +x before it ever did.
    const Pose middle = pose_at(time_s), before = pose_at(time_s - turn_s / 2),
               after = pose_at(time_s + turn_s / 2);
    Vec3 travel{1, 0, 0};
    for (std::size_t n = 0; n < moves_.size() && start_s_[n] <= time_s; ++n) {
        const Vec3 way = moves_[n].end.tip_mm - moves_[n].start.tip_mm;
        const Vec3 axis = start_s_[n + 1] <= time_s ? moves_[n].end.axis : middle.axis;
        const Vec3 level = way - dot(way, axis) * axis;
        if (length(level) > 1e-9) travel = level;
    }
    const Vec3 z = middle.axis, x = normalized(travel - dot(travel, z) * z), y = cross(z, x);
    const double height = options.height_mm;
    // No chip is thicker than what the fastest point goes in one turn, twice over, and what run-out adds.
    const double longest = 2 * (distance(before.tip, after.tip) +
                                (height + cutter_.radius_mm()) * distance(before.axis, after.axis)) +
                           2 * cutter_.runout_mm;

    TurnOfForce result;
    double largest_xy = 0;
    for (int n = 0; n < options.angles; ++n) {
        const double now = time_s + ((n + 0.5) / options.angles - 0.5) * turn_s;
        const Pose pose = pose_at(now);
        const Vec3 offset = cutter_.runout_mm * pose.across(spin_ * now + cutter_.runout_deg * pi / 180);
        Vec3 force;
        double torque = 0;
        for (const EdgePoint& point : points) {
            const double angle = spin_ * now - point.angle;
            const Vec3 out = pose.across(angle), motion = pose.across(angle + pi / 2);
            const Vec3 arm = offset + point.radius * out;
            const Vec3 normal = point.normal_out * out + point.normal_up * pose.axis;
            const double h =
                chip(now, point, pose.tip + arm + point.height * pose.axis, normal, longest, older);
            if (h <= 0) continue;
            const Vec3 along = point.edge_out * out + point.edge_up * pose.axis;
            const Vec3 f = point.width * (-(k_.ktc * h + k_.kte) * motion - (k_.krc * h + k_.kre) * normal +
                                          (k_.kac * h + k_.kae) * along);
            force += f;
            torque += dot(cross(arm, f), pose.axis);
        }
        const Vec3 in_frame{dot(force, x), dot(force, y), dot(force, z)};
        result.mean_n += in_frame / options.angles;
        result.mean_torque_nmm += torque / options.angles;
        for (int i = 0; i < 3; ++i) {
            if (std::abs(in_frame[i]) > std::abs(result.peak_n[i])) result.peak_n[i] = in_frame[i];
        }
        if (std::abs(torque) > std::abs(result.peak_torque_nmm)) result.peak_torque_nmm = torque;
        largest_xy = std::max(largest_xy, std::hypot(in_frame.x, in_frame.y));
    }
    result.peak_xy_n = largest_xy;
    return result;
}

}  // namespace tribo::session
