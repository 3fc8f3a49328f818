// SPDX-License-Identifier: MIT
#include "motion/path/timing.hpp"

#include <cmath>

#include "base/math.hpp"
#include "motion/algebra/direction.hpp"
#include "motion/path/path.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

Move line(Vec3 a, Vec3 b, double feed = 600, MoveKind kind = MoveKind::feed) {
    Move m;
    m.kind = kind;
    m.start.tip_mm = a;
    m.end.tip_mm = b;
    m.feed_mm_per_min = feed;
    return m;
}

std::vector<Move> polyline(const std::vector<Vec3>& points, double feed) {
    std::vector<Move> moves;
    for (std::size_t i = 1; i < points.size(); ++i) moves.push_back(line(points[i - 1], points[i], feed));
    return moves;
}

TimingOptions with_acceleration(double a) {
    TimingOptions o;
    o.acceleration_mm_per_s2 = a;
    return o;
}

double duration(const std::vector<Move>& moves, const TimingOptions& o = {}) {
    const Result<Schedule> s = schedule(moves, o);
    EXPECT_TRUE(s);
    return s ? s->duration_s : NAN;
}

// Random zig-zag of feeds, rapids, dwells, arcs and quadratics that join.
std::vector<Move> random_program() {
    std::vector<Move> moves;
    Vec3 at{};
    for (int i = *rc::gen::inRange(1, 25); i > 0; --i) {
        const Vec3 next = at + std::pow(10.0, real(1.5)) * normalized(Vec3{2, 0, 0} + vector(1));
        Move m =
            line(at, next, 1000 + real(900), *rc::gen::inRange(0, 5) == 0 ? MoveKind::rapid : MoveKind::feed);
        const int shape = *rc::gen::inRange(0, 6);
        if (shape == 0 && m.kind == MoveKind::feed) m.quadratic = Quadratic{at + vector(5), {0, 0, 1}};
        if (shape == 1) {
            m.kind = MoveKind::dwell;
            m.duration_s = 0.5;
            m.end = m.start;
        }
        if (shape == 2) m.end.axis = normalized(Vec3{0.3, 0, 1});
        moves.push_back(m);
        at = m.end.tip_mm;
    }
    return moves;
}

}  // namespace

TEST(Timing, feeds_rapids_dwells_and_inverse_time_last_what_they_say) {
    std::vector<Move> moves{line({0, 0, 0}, {30, 40, 0}, 600),
                            line({30, 40, 0}, {30, 40, 100}, 0, MoveKind::rapid)};
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.duration_s = 1.5;
    moves.push_back(dwell);
    Move inverse = line({30, 40, 100}, {0, 0, 0}, 0);
    inverse.duration_s = 12;
    moves.push_back(inverse);
    const Result<Schedule> s = schedule(moves);
    ASSERT_TRUE(s);
    EXPECT_DOUBLE_EQ(s->moves[0].end_s, 5);
    EXPECT_DOUBLE_EQ(s->moves[1].end_s - s->moves[1].start_s, 0.6);
    EXPECT_DOUBLE_EQ(s->moves[2].end_s - s->moves[2].start_s, 1.5);
    EXPECT_DOUBLE_EQ(s->moves[3].end_s - s->moves[3].start_s, 12);
    EXPECT_DOUBLE_EQ(s->duration_s, 19.1);
    EXPECT_DOUBLE_EQ(s->feed_s, 17);
    EXPECT_EQ(s->move_at(-1), 0u);
    EXPECT_EQ(s->move_at(5.3), 1u);
    EXPECT_EQ(s->move_at(100), 3u);
}

TEST(Timing, the_tip_runs_at_constant_speed_along_a_curve) {
    Move m = line({0, 0, 0}, {20, 0, 0}, 600);
    m.quadratic = Quadratic{{18, 9, 0}, {0, 0, 1}};
    const std::vector<Move> moves{m};
    const Result<Schedule> s = schedule(moves);
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->duration_s, path_length_mm(m) / 10, 1e-13);
    for (double t = 0.1; t < s->duration_s - 0.1; t += 0.1) {
        const double h = 1e-4;
        const double speed =
            distance(pose_at_time(moves, *s, t + h).tip_mm, pose_at_time(moves, *s, t - h).tip_mm) / (2 * h);
        EXPECT_NEAR(speed, 10, 1e-5);
    }
}

TEST(Timing, a_turn_faster_than_the_axes_allow_takes_the_time_of_the_turn) {
    Move spot = line({1, 1, 1}, {1, 1, 1});
    spot.end.axis = {1, 0, 0};
    EXPECT_NEAR(duration({spot}), 1, 1e-15);
    Move fast = line({0, 0, 0}, {0.001, 0, 0});
    fast.end.axis = {1, 0, 0};
    EXPECT_NEAR(duration({fast}), 1, 1e-15);
    Move slow = line({0, 0, 0}, {100, 0, 0});
    slow.end.axis = {1, 0, 0};
    EXPECT_NEAR(duration({slow}), 10, 1e-15);
    const std::vector<Move> moves{spot};
    const Result<Schedule> s = schedule(moves);
    ASSERT_TRUE(s);
    EXPECT_NEAR(angle_rad(pose_at_time(moves, *s, 0.25).axis, {0, 0, 1}), math::kPi / 8, 1e-14);
}

TEST(Timing, one_move_from_rest_to_rest_is_a_trapezoid_or_a_triangle) {
    // v = 10 mm/s, a = 20 mm/s2: L >= v^2/a = 5: L/v + v/a; below: 2 sqrt(L/a)
    EXPECT_NEAR(duration({line({}, {30, 0, 0})}, with_acceleration(20)), 3 + 0.5, 1e-14);
    EXPECT_NEAR(duration({line({}, {5, 0, 0})}, with_acceleration(20)), 1, 1e-14);
    EXPECT_NEAR(duration({line({}, {1, 0, 0})}, with_acceleration(20)), 2 * std::sqrt(1 / 20.0), 1e-14);
}

TEST(Timing, the_trapezoid_has_its_closed_form_inside) {
    const std::vector<Move> moves{line({}, {30, 0, 0})};
    const Result<Schedule> s = schedule(moves, with_acceleration(20));
    ASSERT_TRUE(s);
    const MoveTiming& m = s->moves[0];
    EXPECT_NEAR(30 * m.path_fraction(0.3), 10 * 0.09, 1e-13);
    EXPECT_NEAR(30 * m.path_fraction(0.5), 2.5, 1e-13);
    EXPECT_NEAR(30 * m.path_fraction(1.7), 2.5 + 12, 1e-13);
    EXPECT_NEAR(30 * m.path_fraction(3.2), 30 - 10 * 0.09, 1e-13);
    EXPECT_NEAR(m.speed_mm_per_s(0.3), 6, 1e-13);
    EXPECT_NEAR(m.speed_mm_per_s(2), 10, 1e-13);
    EXPECT_NEAR(m.speed_mm_per_s(3.4), 2, 1e-13);
    EXPECT_EQ(m.path_fraction(-1), 0);
    EXPECT_EQ(m.path_fraction(9), 1);
}

TEST(Timing, moves_in_one_line_are_run_as_one) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 300; ++i) points.push_back({0.1 * i, 0, 0});
    EXPECT_NEAR(duration(polyline(points, 600), with_acceleration(20)), 3.5, 1e-9);
}

TEST(Timing, a_right_angle_is_an_exact_stop) {
    const std::vector<Move> moves = polyline({{0, 0, 0}, {30, 0, 0}, {30, 30, 0}}, 600);
    EXPECT_NEAR(duration(moves, with_acceleration(20)), 7, 1e-13);
}

TEST(Timing, a_mild_corner_is_passed_at_the_speed_of_its_rounding_circle) {
    const double c = 0.4, a = 100;
    const std::vector<Move> moves =
        polyline({{0, 0, 0}, {30, 0, 0}, {30 + 30 * std::cos(c), 30 * std::sin(c), 0}}, 6000);
    const Result<Schedule> s = schedule(moves, with_acceleration(a));
    ASSERT_TRUE(s);
    const double half = std::cos(c / 2), v = std::sqrt(a * 0.01 * half / (1 - half));
    EXPECT_NEAR(s->moves[0].exit_mm_per_s, v, 1e-9);
    EXPECT_NEAR(s->moves[1].entry_mm_per_s, v, 1e-9);
    // Triangle from rest to v: peak^2 = a L + v^2 / 2.
    const double peak = std::sqrt(a * 30 + v * v / 2);
    EXPECT_NEAR(s->moves[0].end_s, peak / a + (peak - v) / a, 1e-9);
    EXPECT_NEAR(s->duration_s, 2 * s->moves[0].end_s, 1e-9);
}

TEST(Timing, look_ahead_brakes_over_several_short_moves) {
    // 1 mm pieces at 100 mm/s, a = 1000: braking takes 5 mm.
    std::vector<Vec3> points;
    for (int i = 0; i <= 40; ++i) points.push_back({1.0 * i, 0, 0});
    const std::vector<Move> moves = polyline(points, 6000);
    const Result<Schedule> s = schedule(moves, with_acceleration(1000));
    ASSERT_TRUE(s);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const double left = 39.0 - static_cast<double>(i);
        EXPECT_NEAR(s->moves[i].exit_mm_per_s,
                    std::min({100.0, std::sqrt(2000 * left), std::sqrt(2000.0 * (40 - left))}), 1e-9);
    }
}

TEST(Timing, a_curve_is_run_no_faster_than_its_curvature_allows) {
    Move arc = line({2, 0, 0}, {-2, 0, 0}, 6000);
    arc.arc = Arc{{0, 0, 0}, {0, 0, 1}, math::kPi};
    const Result<Schedule> s = schedule(std::vector<Move>{arc}, with_acceleration(50));
    ASSERT_TRUE(s);
    EXPECT_NEAR(s->moves[0].peak_mm_per_s, 10, 1e-12);
}

RC_GTEST_PROP(TimingProperty, a_schedule_is_continuous_and_keeps_every_limit, ()) {
    const std::vector<Move> moves = random_program();
    const double a = std::pow(10.0, 2 + real(1.5));
    const Result<Schedule> s = schedule(moves, with_acceleration(a));
    RC_ASSERT(s.has_value());
    RC_ASSERT(s->duration_s >= duration(moves) - 1e-9);
    double now = 0, speed = 0;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const MoveTiming& m = s->moves[i];
        RC_ASSERT(m.start_s == now);
        RC_ASSERT(m.end_s >= m.start_s);
        now = m.end_s;
        if (!(m.length_mm > 0)) {
            RC_ASSERT(speed == 0.0);
            continue;
        }
        RC_ASSERT(m.entry_mm_per_s == speed);
        speed = m.exit_mm_per_s;
        const double programmed = moves[i].kind == MoveKind::rapid ? 10000 : moves[i].feed_mm_per_min;
        RC_ASSERT(m.peak_mm_per_s <= programmed / 60 + 1e-9);
        const double even = m.end_s - m.start_s - m.rise_s - m.fall_s;
        const double run = 0.5 * m.rise_s * (m.entry_mm_per_s + m.peak_mm_per_s) + even * m.peak_mm_per_s +
                           0.5 * m.fall_s * (m.peak_mm_per_s + m.exit_mm_per_s);
        RC_ASSERT(even > -1e-12);
        RC_ASSERT(std::abs(run - m.length_mm) < 1e-9 * (1 + m.length_mm));
        // The path is the integral of the speed, and the speed never changes faster than a.
        const int n = 100;
        const double h = (m.end_s - m.start_s) / n;
        for (int k = 0; k < n; ++k) {
            const double t = m.start_s + k * h;
            const double v0 = m.speed_mm_per_s(t), v1 = m.speed_mm_per_s(t + h);
            const double step = m.length_mm * (m.path_fraction(t + h) - m.path_fraction(t));
            RC_ASSERT(std::abs(v1 - v0) <= a * h + 1e-9);
            RC_ASSERT(std::abs(step - 0.5 * h * (v0 + v1)) <= 0.25 * a * h * h + 1e-9);
        }
    }
    RC_ASSERT(speed == 0.0);
}

TEST(Timing, what_cannot_be_timed_is_refused_with_its_line) {
    Move m = line({}, {1, 0, 0}, 0);
    m.line = 17;
    Result<Schedule> s = schedule(std::vector<Move>{m});
    ASSERT_FALSE(s);
    EXPECT_EQ(s.error().line, 17);
    EXPECT_NE(s.error().cause.find("no feed"), std::string::npos);
    m.feed_mm_per_min = NAN;
    EXPECT_FALSE(schedule(std::vector<Move>{m}));
    m.feed_mm_per_min = 100;
    m.duration_s = -1;
    EXPECT_FALSE(schedule(std::vector<Move>{m}));
    TimingOptions o;
    o.rapid_mm_per_min = 0;
    EXPECT_FALSE(schedule({}, o));
    s = schedule({});
    ASSERT_TRUE(s);
    EXPECT_EQ(s->duration_s, 0);
}
