// SPDX-License-Identifier: MIT
// Moves cut into pieces run the same path: the pose at a length along the pieces is the pose at that length
// along the whole.
#include "motion/path/path.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"

namespace tribo::motion {
namespace {

double number(int from, int to) {
    return 0.01 * *rc::gen::inRange(100 * from, 100 * to);
}

Move any_move() {
    Move m;
    m.start.tip_mm = {number(-9, 9), number(-9, 9), number(-9, 9)};
    m.start.axis = normalized(Vec3{number(-1, 1), number(-1, 1), 2});
    m.end.axis = m.start.axis;
    m.duration_s = number(1, 9);
    m.end.tip_mm = m.start.tip_mm + Vec3{number(1, 9), number(-9, 9), number(-9, 9)};
    const int kind = *rc::gen::inRange(0, 3);
    if (kind == 1) {
        const Vec3 centre = m.start.tip_mm + Vec3{number(1, 9), number(-9, 9), 0};
        const double turn = number(1, 9), rise = number(-3, 3), s = math::sin(turn), c = math::cos(turn);
        const Vec3 r = m.start.tip_mm - centre;
        m.arc = Arc{centre, {0, 0, 1}, turn};
        m.end.tip_mm = centre + Vec3{c * r.x - s * r.y, s * r.x + c * r.y, rise};
    } else if (kind == 2) {
        m.end.axis = normalized(Vec3{number(-1, 1), number(-1, 1), 2});
        m.quadratic = Quadratic{0.5 * (m.start.tip_mm + m.end.tip_mm) + Vec3{0, number(0, 4), number(0, 4)},
                                (m.start.axis + m.end.axis) / (1 + dot(m.start.axis, m.end.axis))};
    }
    return m;
}

RC_GTEST_PROP(Path, InPiecesIsTheSamePath, ()) {
    const Move move = any_move();
    const double longest = number(1, 5), whole = path_length_mm(move);
    const std::vector<Move> pieces = in_pieces(move, longest);
    double run = 0, seconds = 0;
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        const Move& piece = pieces[n];
        if (n > 0) RC_ASSERT(piece.start == pieces[n - 1].end);
        const double length = path_length_mm(piece);
        RC_ASSERT(length <= longest * (1 + 1e-6));
        for (const double t : {0.0, 0.3, 0.7, 1.0}) {
            const ToolPose is = pose_at(piece, t);
            const double at = run + path_length_mm(piece, t);
            const ToolPose should = pose_at(move, parameter_at_length(move, at));
            RC_ASSERT(distance(is.tip_mm, should.tip_mm) < 1e-7);
            // A part of the axis curve runs on the same cone, a hair sooner or later.
            RC_ASSERT(distance(is.axis, should.axis) < 2e-3);
        }
        run += length;
        seconds += piece.duration_s;
    }
    RC_ASSERT(std::abs(run - whole) < 1e-8 * (1 + whole));
    RC_ASSERT(std::abs(seconds - move.duration_s) < 1e-8);
    RC_ASSERT(pieces.back().end == move.end);
}

}  // namespace
}  // namespace tribo::motion
