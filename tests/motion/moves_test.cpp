// SPDX-License-Identifier: MIT
#include "motion/path/moves.hpp"

#include <cmath>
#include <numbers>

#include "motion/algebra/direction.hpp"
#include "motion/curve/keyframe_motion.hpp"
#include "motion/made_motions.hpp"
#include "motion/path/path.hpp"
#include "random_poses.hpp"

using namespace tribo;
using namespace tribo::motion;
using namespace tribo::motion::testing;

namespace {

constexpr double kPi = std::numbers::pi;

// Largest gap between a tool of 40 mm on the move and on the motion, as long as both are at the nearest pose
// of the other: pieces of `moves` run over equal parameters, so the nearest is sought around the proportional
// one.
struct Gap {
    double tip_mm = 0, axis_rad = 0;
};

Gap gap_of_piece(const Move& piece, const BSplineMotion& motion, double a, double b) {
    Gap g;
    for (int i = 0; i <= 40; ++i) {
        const ToolPose is = pose_at(piece, i / 40.0), should = motion.pose(a + (b - a) * i / 40.0);
        g.tip_mm = std::max(g.tip_mm, distance(is.tip_mm, should.tip_mm));
        g.axis_rad = std::max(g.axis_rad, angle_rad(is.axis, should.axis));
    }
    return g;
}

// The parameters at which the pieces begin: found from where their starts lie on the motion.
std::vector<double> parameters_of(const std::vector<Move>& moves, const BSplineMotion& motion) {
    std::vector<double> u{motion.start()};
    // Pieces come from halving the spans between knots: walk the same dyadic grid.
    for (const MotionPiece& span : bezier_pieces(motion)) {
        double at = span.start;
        while (at < span.end - 1e-9) {
            const Vec3 end = moves[u.size() - 1].end.tip_mm;
            double step = span.end - span.start;
            while (distance(motion.pose(std::min(at + step, span.end)).tip_mm, end) > 1e-9 && step > 1e-9)
                step /= 2;
            at = std::min(at + step, span.end);
            u.push_back(at);
        }
    }
    return u;
}

Move arc_move(Vec3 start, Vec3 centre, Vec3 normal, double turn, double rise, Vec3 axis) {
    Move m;
    m.start = {start, axis};
    m.end = {centre + turned(start - centre, normal, turn) + rise * normal, axis};
    m.arc = Arc{centre, normal, turn};
    m.feed_mm_per_min = 300;
    m.line = 12;
    return m;
}

void expect_joined(const std::vector<Move>& pieces, const Move& whole) {
    ASSERT_FALSE(pieces.empty());
    EXPECT_EQ(pieces.front().start, whole.start);
    EXPECT_EQ(pieces.back().end, whole.end);
    double duration = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_EQ(pieces[i].line, whole.line);
        EXPECT_EQ(pieces[i].feed_mm_per_min, whole.feed_mm_per_min);
        duration += pieces[i].duration_s;
        if (i > 0) {
            EXPECT_EQ(pieces[i].start, pieces[i - 1].end);
        }
    }
    EXPECT_NEAR(duration, whole.duration_s, 1e-12);
}

}  // namespace

TEST(ToMoves, pieces_stay_within_the_tolerance_of_a_winding_five_axis_motion) {
    std::vector<Keyframe> keys;
    for (int i = 0; i <= 12; ++i) {
        const double x = 6.0 * i;
        keys.push_back({{{x, 10 * std::sin(x / 9), 5 * std::cos(x / 13)},
                         normalized(Vec3{0.5 * std::sin(x / 12), 0.4 * std::cos(x / 10), 1})}});
    }
    const Result<KeyframeMotion> m = interpolate_keyframes(keys);
    ASSERT_TRUE(m);
    for (const PieceTolerance tolerance :
         {PieceTolerance{}, PieceTolerance{1e-3, 2.5e-5}, PieceTolerance{1e-2, 1e-3}}) {
        const std::vector<Move> moves = to_moves(m->motion, {}, tolerance);
        const std::vector<double> u = parameters_of(moves, m->motion);
        ASSERT_EQ(u.size(), moves.size() + 1);
        for (std::size_t i = 0; i < moves.size(); ++i) {
            const Gap g = gap_of_piece(moves[i], m->motion, u[i], u[i + 1]);
            EXPECT_LE(g.tip_mm, tolerance.tip_mm);
            EXPECT_LE(g.axis_rad, tolerance.axis_rad);
            if (i > 0) {
                EXPECT_EQ(moves[i].start, moves[i - 1].end);
            }
        }
    }
}

TEST(ToMoves, a_polynomial_motion_of_degree_two_is_one_piece) {
    // Pure shifts along a parabola are what one quadratic holds exactly.
    BSplineMotion m{{2, {0, 0, 0, 1, 1, 1}, {}}};
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{5, 8, 0}, Vec3{10, 0, 1}})
        m.spline.control.push_back(displacement(kIdentityQuaternion, p));
    const std::vector<Move> moves = to_moves(m, {});
    ASSERT_EQ(moves.size(), 1u);
    ASSERT_TRUE(moves[0].quadratic);
    EXPECT_LT(distance(moves[0].quadratic->tip_control_mm, {5, 8, 0}), 1e-12);
}

TEST(ToMoves, straight_stretches_are_merged_and_curved_ones_are_not) {
    // Collinear for three spans, then off.
    BSplineMotion m{{1, {0, 0, 1, 2, 3, 4, 4}, {}}};
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{4, 0, 0}, Vec3{9, 0, 0}, Vec3{9, 5, 0}})
        m.spline.control.push_back(displacement(kIdentityQuaternion, p));
    const std::vector<Move> moves = to_moves(m, {});
    ASSERT_EQ(moves.size(), 2u);
    EXPECT_FALSE(moves[0].quadratic || moves[1].quadratic);
    EXPECT_LT(distance(moves[0].end.tip_mm, {9, 0, 0}), 1e-12);
}

TEST(ToMoves, a_straight_path_that_turns_back_keeps_its_full_reach) {
    BSplineMotion m{{2, {0, 0, 0, 1, 1, 1}, {}}};
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{10, 0, 0}, Vec3{0, 0, 0}})
        m.spline.control.push_back(displacement(kIdentityQuaternion, p));
    double length = 0;
    Box3 box;
    for (const Move& move : to_moves(m, {})) {
        length += path_length_mm(move);
        box.include(tip_bounds(move));
    }
    EXPECT_NEAR(length, 10, 1e-9);
    EXPECT_NEAR(box.max.x, 5, 1e-9);
}

TEST(Elementary, what_is_elementary_stays_as_it_is) {
    Move straight;
    straight.end.tip_mm = {10, 2, 3};
    EXPECT_EQ(to_elementary(straight).size(), 1u);
    straight.kind = MoveKind::rapid;
    EXPECT_EQ(to_elementary(straight).size(), 1u);
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.duration_s = 2;
    ASSERT_EQ(to_elementary(dwell).size(), 1u);
    EXPECT_EQ(to_elementary(dwell)[0].duration_s, 2);
}

TEST(Elementary, a_planar_arc_is_cut_into_quarter_turns_at_most) {
    for (const auto& [turn, count] :
         {std::pair{kPi / 2, 1}, {kPi / 2 + 0.01, 2}, {-2 * kPi, 4}, {3 * kPi, 6}}) {
        Move arc = arc_move({7, 1, 5}, {2, 1, 5}, {0, 0, 1}, turn, 0, {0, 0, 1});
        arc.duration_s = 3;
        const std::vector<Move> pieces = to_elementary(arc);
        ASSERT_EQ(pieces.size(), static_cast<std::size_t>(count));
        expect_joined(pieces, arc);
        for (const Move& p : pieces) {
            ASSERT_TRUE(p.arc);
            EXPECT_LE(std::abs(p.arc->turn_rad), kPi / 2 + 1e-8);
            for (int i = 0; i <= 10; ++i)
                EXPECT_NEAR(distance(pose_at(p, i / 10.0).tip_mm, {2, 1, 5}), 5, 1e-12);
        }
    }
}

TEST(Elementary, a_helix_becomes_quadratics_that_keep_to_it_and_join_without_corners) {
    for (const double rise : {2.0, 40.0}) {
        const Move helix = arc_move({12, 0, 1}, {2, 0, 0}, {0, 0, 1}, 5 * kPi, rise, {0, 0, 1});
        const PieceTolerance tolerance;
        const std::vector<Move> pieces = to_elementary(helix, tolerance);
        expect_joined(pieces, helix);
        Vec3 before{};
        for (const Move& p : pieces) {
            ASSERT_TRUE(p.quadratic);
            for (int i = 0; i <= 16; ++i) {
                const Vec3 q = pose_at(p, i / 16.0).tip_mm;
                // The helix's own height at the nearest turn of this angle.
                const double angle = std::atan2(q.y, q.x - 2);
                const double turns = std::round(((q.z - 1) / rise * 5 * kPi - angle) / (2 * kPi));
                const double z = 1 + rise * (angle + 2 * kPi * turns) / (5 * kPi);
                EXPECT_LE(std::hypot(std::hypot(q.x - 2, q.y) - 10, q.z - z), tolerance.tip_mm);
                EXPECT_EQ(pose_at(p, i / 16.0).axis, (Vec3{0, 0, 1}));
            }
            const Vec3 leaving = normalized(tip_derivative_mm(p, 0));
            if (&p != &pieces.front()) {
                EXPECT_LT(angle_rad(before, leaving), 1e-3);
            }
            before = normalized(tip_derivative_mm(p, 1));
        }
    }
}

TEST(Elementary, are_counted_without_being_made) {
    Move straight, tilting;
    straight.end.tip_mm = {10, 2, 3};
    tilting.end = {{3000, 0, 0}, {0.6, 0, 0.8}};
    Move both = arc_move({10, 0, 0}, {}, {0, 0, 1}, 2, 3, {0, 0, 1});
    both.end.axis = normalized(Vec3{1, 1, 2});
    for (const Move& move : {straight, tilting, both, arc_move({5, 0, 0}, {}, {0, 0, 1}, 9, 0, {0, 0, 1}),
                             arc_move({5, 0, 0}, {}, {0, 1, 0}, 9, 0, {0, 0, 1}),
                             arc_move({12, 0, 1}, {2, 0, 0}, {0, 0, 1}, 5 * kPi, 40, {0, 0, 1})}) {
        EXPECT_EQ(count_elementary(move), to_elementary(move).size());
    }
    // A kilometre wide, ten thousand turns.
    const Move wide = arc_move({1e6, 0, 0}, {}, {0, 0, 1}, 2e4 * kPi, 40, {0, 0, 1});
    EXPECT_GT(count_elementary(wide), 1'000'000u);
}

TEST(Elementary, an_arc_across_the_axis_becomes_quadratics) {
    const Move arc = arc_move({5, 0, 0}, {}, {0, 1, 0}, -kPi / 2, 0, {0, 0, 1});
    const std::vector<Move> pieces = to_elementary(arc);
    expect_joined(pieces, arc);
    for (const Move& p : pieces) {
        ASSERT_TRUE(p.quadratic);
        for (int i = 0; i <= 16; ++i) EXPECT_NEAR(length(pose_at(p, i / 16.0).tip_mm), 5, 1e-4);
    }
}

TEST(Elementary, a_turning_axis_becomes_quadratics_that_match_the_move_at_every_fraction) {
    Move m;
    m.start = {{0, 0, 0}, {0, 0, 1}};
    m.duration_s = 7;
    m.line = 3;
    for (const Vec3 end_axis :
         {Vec3{std::sin(1e-6), 0, std::cos(1e-6)}, Vec3{0.6, 0, 0.8}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
        m.end = {{30, 5, 2}, end_axis};
        const std::vector<Move> pieces = to_elementary(m);
        expect_joined(pieces, m);
        const double n = static_cast<double>(pieces.size());
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            ASSERT_TRUE(pieces[k].quadratic);
            for (int i = 0; i <= 20; ++i) {
                const ToolPose is = pose_at(pieces[k], i / 20.0);
                const ToolPose should = pose_at(m, (static_cast<double>(k) + i / 20.0) / n);
                EXPECT_LE(distance(is.tip_mm, should.tip_mm), 1e-12);
                EXPECT_LE(angle_rad(is.axis, should.axis), 2.5e-6);
            }
        }
        EXPECT_LE(pieces.size(), 8u);
    }
}

TEST(Elementary, an_arc_with_a_turning_axis_matches_the_move_at_every_fraction) {
    Move m = arc_move({10, 0, 0}, {}, {0, 0, 1}, 2, 3, {0, 0, 1});
    m.end.axis = normalized(Vec3{1, 1, 2});
    const std::vector<Move> pieces = to_elementary(m);
    const double n = static_cast<double>(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k)
        for (int i = 0; i <= 20; ++i) {
            const ToolPose is = pose_at(pieces[k], i / 20.0);
            const ToolPose should = pose_at(m, (static_cast<double>(k) + i / 20.0) / n);
            EXPECT_LE(distance(is.tip_mm, should.tip_mm), 1e-4);
            EXPECT_LE(angle_rad(is.axis, should.axis), 2.5e-6);
        }
}
