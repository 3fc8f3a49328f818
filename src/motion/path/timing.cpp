// SPDX-License-Identifier: MIT
#include "motion/path/timing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"

namespace tribo::motion {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// A tip path shorter than this counts as a turn on the spot, mm.
constexpr double kNoPath = 1e-9;

Result<void> check(const Move& m) {
    if (!is_finite(m.start.tip_mm) || !is_finite(m.end.tip_mm) || !std::isfinite(m.duration_s) ||
        !std::isfinite(m.feed_mm_per_min))
        return fail_at({}, m.line, 0, "a move holds a number that is not finite", "give finite numbers");
    if (m.kind == MoveKind::feed && !(m.feed_mm_per_min > 0) && !(m.duration_s > 0))
        return fail_at({}, m.line, 0, "a feed move has no feed",
                       "program a feed before it, or give feed_mm_per_min in [process]");
    if (m.duration_s < 0)
        return fail_at({}, m.line, 0, "a move lasts less than no time", "give a duration of at least 0 s");
    return {};
}

// Returns the time of the move at constant speed.
double even_duration(const Move& m, double length, const TimingOptions& o) {
    if (m.kind == MoveKind::dwell || m.duration_s > 0) return m.duration_s;
    const double mm_per_s = (m.kind == MoveKind::rapid ? o.rapid_mm_per_min : m.feed_mm_per_min) / 60;
    return std::max(length / mm_per_s, axis_turn_rad(m) / o.max_axis_rad_per_s);
}

Vec3 tangent(const Move& m, double t) {
    const Vec3 d = tip_derivative_mm(m, t);
    // A quadratic whose control point is an end point has no speed at that end.
    return squared_length(d) > 0 ? d : tip_derivative_mm(m, t + (t < 0.5 ? 1e-6 : -1e-6));
}

// Returns the highest speed at the joint of two moves that their shape allows.
double corner_speed(const Move& a, const Move& b, const TimingOptions& o) {
    if (a.kind != b.kind) return 0;
    const double corner = angle_rad(tangent(a, 1), tangent(b, 0));
    if (corner > o.stop_rad) return 0;
    const double cosine = math::cos(0.5 * corner);
    if (cosine >= 1) return kUnlimited;
    return std::sqrt(o.acceleration_mm_per_s2 * o.corner_deviation_mm * cosine / (1 - cosine));
}

double curve_speed(const Move& m, const TimingOptions& o) {
    const double curvature = std::min(max_curvature_per_mm(m), 1 / o.corner_deviation_mm);
    return curvature > 0 ? std::sqrt(o.acceleration_mm_per_s2 / curvature) : kUnlimited;
}

// Computes the trapezoid over `length` between two possible speeds, not above `limit`.
void shape(MoveTiming& m, double limit, double acceleration) {
    const double v0 = m.entry_mm_per_s, v1 = m.exit_mm_per_s, a = acceleration;
    const double reachable = std::sqrt(0.5 * (v0 * v0 + v1 * v1) + a * m.length_mm);
    const double v = std::max({std::min(limit, reachable), v0, v1});
    m.peak_mm_per_s = v;
    m.rise_s = (v - v0) / a;
    m.fall_s = (v - v1) / a;
    const double slopes = (v * v - v0 * v0 + v * v - v1 * v1) / (2 * a);
    m.end_s = m.start_s + m.rise_s + m.fall_s + std::max(0.0, m.length_mm - slopes) / v;
}

void accelerate(std::span<const Move> moves, std::vector<MoveTiming>& timing, const TimingOptions& o) {
    const std::size_t n = moves.size();
    const double twice_a = 2 * o.acceleration_mm_per_s2;
    std::vector<double> limit(n, 0.0), joint(n + 1, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        if (timing[i].length_mm > 0) limit[i] = std::min(timing[i].peak_mm_per_s, curve_speed(moves[i], o));
    for (std::size_t i = 1; i < n; ++i)
        if (limit[i - 1] > 0 && limit[i] > 0)
            joint[i] = std::min({limit[i - 1], limit[i], corner_speed(moves[i - 1], moves[i], o)});
    for (std::size_t i = n; i-- > 0;)
        joint[i] = std::min(joint[i], std::sqrt(joint[i + 1] * joint[i + 1] + twice_a * timing[i].length_mm));
    for (std::size_t i = 0; i < n; ++i)
        joint[i + 1] = std::min(joint[i + 1], std::sqrt(joint[i] * joint[i] + twice_a * timing[i].length_mm));
    double now = 0;
    for (std::size_t i = 0; i < n; ++i) {
        MoveTiming& m = timing[i];
        const double even = m.end_s - m.start_s;
        m.start_s = now;
        m.end_s = now + even;
        if (limit[i] > 0) {
            m.entry_mm_per_s = joint[i];
            m.exit_mm_per_s = joint[i + 1];
            shape(m, limit[i], o.acceleration_mm_per_s2);
        }
        now = m.end_s;
    }
}

}  // namespace

double MoveTiming::path_fraction(double time_s) const {
    if (!(time_s > start_s)) return 0;
    if (time_s >= end_s) return 1;
    const double t = time_s - start_s, whole = end_s - start_s;
    if (!(length_mm > 0)) return t / whole;
    double run = 0;
    if (t < rise_s)
        run = t * (entry_mm_per_s + 0.5 * (peak_mm_per_s - entry_mm_per_s) * t / rise_s);
    else if (const double left = whole - t; left < fall_s)
        run = length_mm - left * (exit_mm_per_s + 0.5 * (peak_mm_per_s - exit_mm_per_s) * left / fall_s);
    else
        run = 0.5 * rise_s * (entry_mm_per_s + peak_mm_per_s) + (t - rise_s) * peak_mm_per_s;
    return std::clamp(run / length_mm, 0.0, 1.0);
}

double MoveTiming::time_at_s(double fraction) const {
    const double f = std::clamp(fraction, 0.0, 1.0), whole = end_s - start_s;
    if (!(length_mm > 0)) return start_s + f * whole;
    // Returns the time since the start of a stretch that starts at `speed` and changes by `change` in
    // `seconds`: the root of change / (2 seconds) t^2 + speed t = run that stays finite if change or speed
    // vanish.
    const auto ramp = [](double run, double speed, double change, double seconds) {
        if (!(run > 0) || !(seconds > 0)) return 0.0;
        const double root = std::sqrt(std::max(0.0, speed * speed + 2 * change / seconds * run));
        return 2 * run / (speed + root);
    };
    const double run = f * length_mm, left = length_mm - run;
    const double rise_mm = 0.5 * rise_s * (entry_mm_per_s + peak_mm_per_s);
    const double fall_mm = 0.5 * fall_s * (exit_mm_per_s + peak_mm_per_s);
    double t = 0;
    if (run < rise_mm)
        t = ramp(run, entry_mm_per_s, peak_mm_per_s - entry_mm_per_s, rise_s);
    else if (left < fall_mm)
        t = whole - ramp(left, exit_mm_per_s, peak_mm_per_s - exit_mm_per_s, fall_s);
    else
        t = rise_s + (run - rise_mm) / peak_mm_per_s;
    return start_s + std::clamp(t, 0.0, whole);
}

double MoveTiming::speed_mm_per_s(double time_s) const {
    const double t = std::clamp(time_s, start_s, end_s) - start_s, left = end_s - start_s - t;
    if (t < rise_s) return entry_mm_per_s + (peak_mm_per_s - entry_mm_per_s) * t / rise_s;
    if (left < fall_s) return exit_mm_per_s + (peak_mm_per_s - exit_mm_per_s) * left / fall_s;
    return peak_mm_per_s;
}

std::size_t Schedule::move_at(double time_s) const {
    const auto after = std::upper_bound(moves.begin(), moves.end(), time_s,
                                        [](double t, const MoveTiming& m) { return t < m.start_s; });
    return after == moves.begin() ? 0 : static_cast<std::size_t>(after - moves.begin()) - 1;
}

Result<Schedule> schedule(std::span<const Move> moves, const TimingOptions& options) {
    if (!(options.rapid_mm_per_min > 0) || !(options.acceleration_mm_per_s2 >= 0) ||
        !(options.max_axis_rad_per_s > 0) || !(options.corner_deviation_mm > 0))
        return fail("a limit of the machine is not greater than zero",
                    "give rapid_mm_per_min and the axis rate in [machine] as positive numbers");
    Schedule s;
    s.moves.reserve(moves.size());
    double now = 0;
    for (const Move& move : moves) {
        if (const Result<void> good = check(move); !good) return std::unexpected(good.error());
        MoveTiming m;
        const double length = path_length_mm(move);
        const double duration = even_duration(move, length, options);
        m.length_mm = length > kNoPath && duration > 0 ? length : 0;
        m.start_s = now;
        m.end_s = now + duration;
        if (m.length_mm > 0) m.entry_mm_per_s = m.peak_mm_per_s = m.exit_mm_per_s = m.length_mm / duration;
        s.moves.push_back(m);
        now = m.end_s;
    }
    if (options.acceleration_mm_per_s2 > 0) accelerate(moves, s.moves, options);
    for (std::size_t i = 0; i < moves.size(); ++i)
        if (moves[i].kind == MoveKind::feed) s.feed_s += s.moves[i].end_s - s.moves[i].start_s;
    if (!s.moves.empty()) s.duration_s = s.moves.back().end_s;
    return s;
}

ToolPose pose_at_time(std::span<const Move> moves, const Schedule& schedule, double time_s) {
    const std::size_t i = schedule.move_at(time_s);
    const double fraction = schedule.moves[i].path_fraction(time_s);
    if (!moves[i].quadratic) return pose_at(moves[i], fraction);
    if (!(schedule.moves[i].length_mm > 0)) return pose_at(moves[i], fraction);
    return pose_at(moves[i], parameter_at_length(moves[i], fraction * schedule.moves[i].length_mm));
}

}  // namespace tribo::motion
