// SPDX-License-Identifier: MIT
#include "motion/curve/keyframe_motion.hpp"

#include <cmath>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "motion/made_motions.hpp"
#include "motion/path/path.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

// Spacing 0.01..30 mm, axes up to 60 degrees from neighbour to neighbour.
std::vector<Keyframe> random_keyframes(bool weighted) {
    std::vector<Keyframe> keys(1);
    keys[0].pose = pose(100);
    for (int i = *rc::gen::inRange(1, 12); i > 0; --i) {
        Keyframe k;
        const double step = std::pow(10.0, -0.25 + real(1.7));
        k.pose.tip_mm = keys.back().pose.tip_mm + step * direction();
        k.pose.axis = slerp(keys.back().pose.axis, direction(), 0.33);
        k.weight = weighted ? 1 + real(0.4) : 1;
        keys.push_back(k);
    }
    return keys;
}

double off_line(Vec3 p, Vec3 from, Vec3 direction) {
    return length(cross(p - from, direction));
}

void passes_keyframes(const KeyframeOptions& options, bool weighted) {
    const std::vector<Keyframe> keys = random_keyframes(weighted);
    const Result<KeyframeMotion> m = interpolate_keyframes(keys, options);
    if (!m) RC_DISCARD("a pole");
    RC_ASSERT(is_valid(m->motion.spline));
    RC_ASSERT(m->parameters.size() == keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const ToolPose p = m->motion.pose(m->parameters[i]);
        RC_ASSERT(distance(p.tip_mm, keys[i].pose.tip_mm) < 1e-9);
        RC_ASSERT(angle_rad(p.axis, keys[i].pose.axis) < 1e-9);
    }
}

std::vector<Keyframe> wave(int count) {
    std::vector<Keyframe> keys;
    for (int i = 0; i < count; ++i) {
        const double x = 80.0 * i / (count - 1);
        keys.push_back({{{x, 10 * std::sin(x / 15), 5 * std::cos(x / 20)},
                         normalized(Vec3{0.4 * std::sin(x / 25), 0.3 * std::cos(x / 17), 1})}});
        keys.back().line = i + 2;
    }
    return keys;
}

}  // namespace

RC_GTEST_PROP(KeyframeProperty, the_motion_passes_every_keyframe, ()) {
    passes_keyframes({}, false);
}
RC_GTEST_PROP(KeyframeProperty, weights_leave_the_keyframes_on_the_motion, ()) {
    passes_keyframes({}, true);
}
RC_GTEST_PROP(KeyframeProperty, centripetal_spacing_and_not_a_knot_ends_pass_every_keyframe, ()) {
    KeyframeOptions o;
    o.spacing = Spacing::centripetal;
    o.ends = EndCondition::not_a_knot;
    passes_keyframes(o, false);
}
RC_GTEST_PROP(KeyframeProperty, the_curve_in_dual_quaternion_space_passes_every_keyframe, ()) {
    KeyframeOptions o;
    o.curve = Curve::dual_quaternion;
    passes_keyframes(o, true);
}

TEST(Keyframes, the_knots_say_c2_and_the_pieces_obey) {
    for (const Curve curve : {Curve::tip, Curve::dual_quaternion}) {
        KeyframeOptions o;
        o.curve = curve;
        std::vector<Keyframe> keys = wave(9);
        for (std::size_t i = 0; i < keys.size(); ++i) keys[i].weight = i % 2 == 0 ? 1 : 1.3;
        const Result<KeyframeMotion> m = interpolate_keyframes(keys, o);
        ASSERT_TRUE(m);
        EXPECT_EQ(m->motion.degree(), curve == Curve::tip ? 6u : 3u);
        const auto pieces = bezier_pieces(m->motion);
        ASSERT_EQ(pieces.size(), 8u);
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            auto left = pieces[i - 1].motion.control, right = pieces[i].motion.control;
            const double l = pieces[i - 1].end - pieces[i - 1].start, r = pieces[i].end - pieces[i].start;
            for (int order = 0; order <= 2; ++order) {
                const DualQuaternion a = std::pow(1 / l, order) * left.back();
                const DualQuaternion b = std::pow(1 / r, order) * right.front();
                EXPECT_LT(gap(a, b), 1e-10) << order;
                left = derivative(left);
                right = derivative(right);
            }
        }
    }
}

RC_GTEST_PROP(KeyframeProperty, collinear_keyframes_with_one_axis_stay_straight, ()) {
    const Vec3 from = vector(100), along = direction();
    std::vector<Keyframe> keys;
    double run = 0;
    for (int i = *rc::gen::inRange(2, 12); i > 0; --i) {
        keys.push_back({{from + run * along, {0.6, 0, 0.8}}, 1 + real(0.3)});
        run += std::pow(10.0, real(1.5));
    }
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    RC_ASSERT(m.has_value());
    for (int i = 0; i <= 200; ++i) {
        const ToolPose p = m->motion.pose(m->motion.end() * i / 200);
        RC_ASSERT(off_line(p.tip_mm, from, along) < 1e-9);
        RC_ASSERT(angle_rad(p.axis, {0.6, 0, 0.8}) < 1e-9);
    }
}

TEST(Keyframes, in_a_line_with_one_axis_become_one_straight_move_each) {
    std::vector<Keyframe> keys;
    for (const double x : {0.0, 1.0, 5.0, 5.5, 30.0}) keys.push_back({{{x, 2 * x, 3}, {0, 0, 1}}});
    const Result<std::vector<Move>> moves = keyframe_moves(keys, 600);
    ASSERT_TRUE(moves);
    ASSERT_EQ(moves->size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Move& m = (*moves)[i];
        EXPECT_FALSE(m.quadratic);
        EXPECT_EQ(m.feed_mm_per_min, 600);
        EXPECT_LT(distance(m.start.tip_mm, keys[i].pose.tip_mm), 1e-12);
        EXPECT_LT(distance(m.end.tip_mm, keys[i + 1].pose.tip_mm), 1e-12);
    }
}

TEST(Keyframes, a_straight_tip_path_stays_straight_while_the_axis_turns) {
    std::vector<Keyframe> keys;
    for (int i = 0; i < 5; ++i)
        keys.push_back({{{10.0 * i, 0, 0}, normalized(Vec3{0.3 * std::sin(i), 0.2 * i, 1})}});
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    ASSERT_TRUE(m);
    for (int i = 0; i <= 400; ++i)
        EXPECT_LT(off_line(m->motion.pose(m->motion.end() * i / 400).tip_mm, {}, {1, 0, 0}), 1e-11);
    // The curve through the dual quaternions swings as a screw would: L t / 8 to a factor.
    KeyframeOptions o;
    o.curve = Curve::dual_quaternion;
    const Result<KeyframeMotion> screw = interpolate_keyframes(std::span(keys).first(2), o);
    ASSERT_TRUE(screw);
    const double t = angle_rad(keys[0].pose.axis, keys[1].pose.axis);
    const double swing = off_line(screw->motion.pose(screw->motion.end() / 2).tip_mm, {}, {1, 0, 0});
    EXPECT_GT(swing, 0.5 * 10 * t / 8);
    EXPECT_LT(swing, 1.5 * 10 * t / 8);
}

RC_GTEST_PROP(KeyframeProperty, the_curve_in_dual_quaternion_space_does_not_depend_on_frames, ()) {
    // Every keyframe displaced by one rigid motion of the stock: the whole motion is displaced with them.
    const std::vector<Keyframe> keys = random_keyframes(false);
    const DualQuaternion g = displacement(rotation(), vector(50));
    std::vector<Keyframe> moved = keys;
    for (Keyframe& k : moved)
        k.pose = {transform_point(g, k.pose.tip_mm), transform_direction(g, k.pose.axis)};
    for (const Curve curve : {Curve::tip, Curve::dual_quaternion}) {
        KeyframeOptions o;
        o.curve = curve;
        const Result<KeyframeMotion> a = interpolate_keyframes(keys, o), b = interpolate_keyframes(moved, o);
        if (!a || !b) RC_DISCARD("a pole");
        for (int i = 0; i <= 30; ++i) {
            const ToolPose p = a->motion.pose(a->motion.end() * i / 30),
                           q = b->motion.pose(b->motion.end() * i / 30);
            RC_ASSERT(distance(transform_point(g, p.tip_mm), q.tip_mm) < 1e-7);
            RC_ASSERT(distance(transform_direction(g, p.axis), q.axis) < 1e-8);
        }
    }
}

TEST(Keyframes, on_a_smooth_motion_are_followed_to_the_fourth_order) {
    // A circle of radius 40 with the axis leaning inward: 13 keyframes, then 25.
    const auto on_circle = [](double p) {
        return ToolPose{{40 * std::cos(p), 40 * std::sin(p), 0},
                        normalized(Vec3{-0.2 * std::cos(p), -0.2 * std::sin(p), 1})};
    };
    KeyframeOptions o;
    o.ends = EndCondition::not_a_knot;
    std::array<double, 2> worst_mm{}, worst_rad{};
    for (std::size_t r = 0; r < 2; ++r) {
        const int n = r == 0 ? 12 : 24;
        std::vector<Keyframe> keys;
        for (int i = 0; i <= n; ++i) keys.push_back({on_circle(3.0 * i / n)});
        const Result<KeyframeMotion> m = interpolate_keyframes(keys, o);
        ASSERT_TRUE(m);
        for (int i = 0; i <= 1000; ++i) {
            const double u = m->motion.end() * i / 1000;
            const ToolPose is = m->motion.pose(u), should = on_circle(3.0 * i / 1000);
            worst_mm[r] = std::max(worst_mm[r], distance(is.tip_mm, should.tip_mm));
            worst_rad[r] = std::max(worst_rad[r], angle_rad(is.axis, should.axis));
        }
    }
    EXPECT_LT(worst_mm[0], 5e-3);
    EXPECT_GT(worst_mm[0] / worst_mm[1], 12);
    EXPECT_GT(worst_rad[0] / worst_rad[1], 12);
}

TEST(Keyframes, a_larger_weight_pulls_the_motion_towards_its_keyframe) {
    std::vector<Keyframe> keys{{{{0, 0, 0}}}, {{{10, 10, 0}}}, {{{20, 0, 0}}}};
    const auto nearest = [&](double weight) {
        keys[1].weight = weight;
        const Result<KeyframeMotion> m = interpolate_keyframes(keys);
        return m->motion.pose(0.25 * m->motion.end()).tip_mm.x;
    };
    EXPECT_GT(nearest(2), nearest(1) + 0.5);
    EXPECT_LT(nearest(0.5), nearest(1) - 0.5);
}

TEST(Keyframes, weights_however_uneven_make_no_pole) {
    std::vector<Keyframe> keys = wave(7);
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i].weight = i % 2 == 0 ? 1e-3 : 1e3;
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    ASSERT_TRUE(m);
    for (std::size_t i = 0; i < keys.size(); ++i)
        EXPECT_LT(distance(m->motion.pose(m->parameters[i]).tip_mm, keys[i].pose.tip_mm), 1e-9);
}

TEST(Keyframes, turning_on_the_spot_keeps_the_tip_where_it_is) {
    const std::vector<Keyframe> keys{
        {{{1, 2, 3}, {0, 0, 1}}}, {{{1, 2, 3}, {0.6, 0, 0.8}}}, {{{1, 2, 3}, {1, 0, 0}}}};
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    ASSERT_TRUE(m);
    for (int i = 0; i <= 20; ++i)
        EXPECT_LT(distance(m->motion.pose(m->motion.end() * i / 20).tip_mm, {1, 2, 3}), 1e-13);
}

TEST(Keyframes, opposite_axes_and_repeated_poses_still_make_a_motion) {
    const std::vector<Keyframe> keys{{{{0, 0, 0}, {0, 0, 1}}},
                                     {{{0, 0, 0}, {0, 0, 1}}},
                                     {{{10, 0, 0}, {0, 0, -1}}},
                                     {{{10, 0, 0}, {0, 0, -1}}}};
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    ASSERT_TRUE(m);
    EXPECT_EQ(m->parameters[0], m->parameters[1]);
    EXPECT_EQ(m->parameters[2], m->parameters[3]);
    EXPECT_LT(angle_rad(m->motion.pose(m->motion.end()).axis, {0, 0, -1}), 1e-9);
}

TEST(Keyframes, linear_interpolation_keeps_the_corners) {
    std::vector<Keyframe> keys{{{{0, 0, 0}}}, {{{10, 0, 0}}}, {{{10, 0, 0}}}, {{{10, 10, 0}, {0, 3, 4}}}};
    keys[3].feed_mm_per_min = 250;
    keys[3].line = 7;
    KeyframeOptions o;
    o.interpolation = Interpolation::linear;
    const Result<std::vector<Move>> moves = keyframe_moves(keys, 900, o);
    ASSERT_TRUE(moves);
    ASSERT_EQ(moves->size(), 2u);
    EXPECT_EQ((*moves)[0].feed_mm_per_min, 900);
    EXPECT_EQ((*moves)[1].feed_mm_per_min, 250);
    EXPECT_EQ((*moves)[1].line, 7);
    EXPECT_EQ((*moves)[1].end.axis, (Vec3{0, 0.6, 0.8}));
    EXPECT_FALSE((*moves)[1].quadratic);
}

// A quarter circle of many keyframes between two straight lines, the second at a right angle.
TEST(Keyframes, fitted_ones_are_smooth_between_corners_and_keep_the_corners) {
    std::vector<Keyframe> keys;
    const auto add = [&](double x, double y) {
        keys.push_back({{{x, y, 0}}});
        keys.back().line = static_cast<int>(keys.size());
    };
    for (int i = 0; i < 10; ++i) add(i, 0);
    for (int i = 0; i <= 90; ++i) {
        const double a = i * std::numbers::pi / 180;
        add(10 + 20 * std::sin(a), 20 - 20 * std::cos(a));
    }
    for (int i = 1; i <= 10; ++i) add(30 - i, 20);
    KeyframeOptions o;
    o.interpolation = Interpolation::fit;
    const Result<std::vector<Move>> moves = keyframe_moves(keys, 900, o);
    ASSERT_TRUE(moves);
    double length = 0;
    int corners = 0;
    for (std::size_t n = 0; n < moves->size(); ++n) {
        const Move& m = (*moves)[n];
        length += path_length_mm(m);
        if (n == 0) continue;
        const Move& last = (*moves)[n - 1];
        EXPECT_LT(distance(m.start.tip_mm, last.end.tip_mm), 1e-9) << n;
        const double turn = angle_rad(tip_derivative_mm(last, 1), tip_derivative_mm(m, 0));
        if (turn > 1) {
            ++corners;
            EXPECT_LT(distance(m.start.tip_mm, {30, 20, 0}), 1e-9);
        } else {
            EXPECT_LT(turn, 0.05) << n;
        }
        if (m.line == last.line) continue;
        EXPECT_LT(distance(m.start.tip_mm, keys[static_cast<std::size_t>(m.line) - 2].pose.tip_mm), 0.0101);
    }
    EXPECT_EQ(corners, 1);
    EXPECT_NEAR(length, 20 + 10 * std::numbers::pi, 0.02);
    EXPECT_FALSE(keyframe_moves(std::span(keys).first(1), 900, o));
    keys[4].weight = 0;
    EXPECT_FALSE(keyframe_moves(keys, 900, o));
}

TEST(Keyframes, bad_ones_are_refused_with_their_line_and_a_remedy) {
    std::vector<Keyframe> keys = wave(4);
    const auto refused = [](const std::vector<Keyframe>& k, int line, const char* word) {
        const Result<KeyframeMotion> m = interpolate_keyframes(k);
        ASSERT_FALSE(m);
        EXPECT_EQ(m.error().line, line);
        EXPECT_NE(m.error().cause.find(word), std::string::npos) << m.error().cause;
        EXPECT_FALSE(m.error().remedy.empty());
    };
    auto bad = keys;
    bad[2].pose.tip_mm.y = NAN;
    refused(bad, 4, "finite");
    bad = keys;
    bad[1].pose.axis = {};
    refused(bad, 3, "axis");
    bad = keys;
    bad[3].weight = 0;
    refused(bad, 5, "weight");
    bad = keys;
    bad[3].feed_mm_per_min = -1;
    refused(bad, 5, "feed");
    refused({keys[0], keys[0]}, 0, "two different");
    refused({}, 0, "two different");
}

// The spline takes seven hundred bytes a keyframe, and its time grows with their number, not with its square.
TEST(Keyframes, one_spline_takes_a_stated_number_of_keyframes) {
    std::vector<Keyframe> keys(kMostSplineKeyframes + 1);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const double x = static_cast<double>(i);
        keys[i].pose.tip_mm = {x, std::sin(0.01 * x), 0};
        keys[i].line = static_cast<int>(i) + 2;
    }
    const Result<std::vector<Move>> refused = keyframe_moves(keys, 900);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().line, keys.back().line);
    EXPECT_NE(refused.error().cause.find("more than 100000"), std::string::npos) << refused.error().cause;
    keys.pop_back();
    const Result<std::vector<Move>> moves = keyframe_moves(keys, 900);
    ASSERT_TRUE(moves);
    EXPECT_GE(moves->size(), keys.size() - 1);
    EXPECT_LT(distance(moves->back().end.tip_mm, keys.back().pose.tip_mm), 1e-9);
    keys.resize(keys.size() + 2);
    KeyframeOptions linear;
    linear.interpolation = Interpolation::linear;
    EXPECT_TRUE(keyframe_moves(keys, 900, linear));
}

// A kilometre of path on which the axis turns is cut into pieces of 10 mm.
TEST(Keyframes, refuses_a_motion_of_too_many_moves_at_its_keyframe) {
    std::vector<Keyframe> keys(3);
    keys[1].pose = {{1e6, 0, 0}, normalized(Vec3{0.1, 0, 1})};
    keys[2].pose = {{1e6, 1e6, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i) keys[static_cast<std::size_t>(i)].line = i + 2;
    for (const Interpolation interpolation : {Interpolation::spline, Interpolation::fit}) {
        KeyframeOptions options;
        options.interpolation = interpolation;
        options.max_moves = 1000;
        const Result<std::vector<Move>> refused = keyframe_moves(keys, 900, options);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().line, 3);
        EXPECT_NE(refused.error().cause.find("more than 1000 moves"), std::string::npos);
        options.max_moves = 10'000'000;
        EXPECT_TRUE(keyframe_moves(keys, 900, options));
    }
    KeyframeOptions options;
    options.interpolation = Interpolation::linear;
    options.max_moves = 1;
    const Result<std::vector<Move>> refused = keyframe_moves(keys, 900, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().line, 4);
}

TEST(Keyframes, moves_of_the_spline_join_and_carry_the_words_of_the_keyframe_they_run_to) {
    std::vector<Keyframe> keys = wave(9);
    keys[4].feed_mm_per_min = 123;
    const Result<std::vector<Move>> moves = keyframe_moves(keys, 900);
    ASSERT_TRUE(moves);
    EXPECT_EQ(moves->front().line, keys[1].line);
    EXPECT_EQ(moves->back().line, keys.back().line);
    for (std::size_t i = 0; i < moves->size(); ++i) {
        const Move& m = (*moves)[i];
        EXPECT_EQ(m.feed_mm_per_min, m.line == keys[4].line ? 123 : 900);
        if (i > 0) {
            EXPECT_EQ(m.start, (*moves)[i - 1].end);
        }
    }
}
