// SPDX-License-Identifier: MIT
#include "session/random_cut.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "base/noise_hash.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/moves.hpp"

namespace tribo::session {
namespace {

using milling::Cutter;
using milling::CutterKind;
using std::numbers::pi;

class Draw {
  public:
    explicit Draw(std::uint64_t seed) : noise_(seed) {}
    double between(double low, double high) { return low + (high - low) * noise_.uniform(count_++); }
    int below(int count) {
        return static_cast<int>(noise_.bits(count_++) % static_cast<std::uint64_t>(count));
    }

  private:
    CounterNoise noise_;
    std::uint64_t count_ = 0;
};

Cutter random_cutter(Draw& draw) {
    Cutter c;
    c.kind = static_cast<CutterKind>(draw.below(3));
    c.diameter_mm = 0.1 * std::pow(500, draw.between(0, 1));
    if (c.kind == CutterKind::bull) c.corner_mm = draw.between(0.02, 0.48) * c.diameter_mm;
    c.flutes = 1 + draw.below(6);
    c.helix_deg = draw.below(4) == 0 ? 0 : draw.between(-45, 45);
    c.length_mm = 4 * c.diameter_mm;
    if (draw.below(3) == 0) {
        c.runout_mm = draw.between(0, 0.004) * c.diameter_mm;
        c.runout_deg = draw.between(0, 360);
    }
    if (c.flutes > 1 && draw.below(3) == 0) {
        const double even = 360.0 / c.flutes, shift = draw.between(0, 0.3) * even;
        c.pitch_deg.assign(static_cast<std::size_t>(c.flutes), even);
        c.pitch_deg.front() += shift;
        c.pitch_deg.back() -= shift;
    }
    return c;
}

// Leans up to 30 degrees each way.
Vec3 random_axis(Draw& draw) {
    const double lead = draw.between(-pi / 6, pi / 6), tilt = draw.between(-pi / 6, pi / 6);
    return {std::sin(lead) * std::cos(tilt), std::sin(tilt), std::cos(lead) * std::cos(tilt)};
}

std::ostream& operator<<(std::ostream& out, Vec3 v) {
    return out << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
}

}  // namespace

bool turns(CutMotion motion) {
    return motion == CutMotion::turning_slot || motion == CutMotion::pivot || motion == CutMotion::fan;
}

RandomCut random_cut(std::uint64_t seed) {
    Draw draw(seed);
    RandomCut cut;
    const Cutter cutter = random_cutter(draw);
    const double d = cutter.diameter_mm;
    cut.motion = static_cast<CutMotion>(draw.below(8));
    cut.stock = static_cast<CutStock>(draw.below(3));

    // The stock's top is z = 0; it reaches from -1.5 d to 1.5 d along x, from -d to d along y.
    const double thick = cut.stock == CutStock::plate ? draw.between(0.1, 0.5) * d : 1.5 * d;
    const Box3 block{{-1.5 * d, -d, -thick}, {1.5 * d, d, 0}};
    const double depth = draw.between(0.05, 0.9) * d, y = draw.between(-1.2, 1.2) * d;
    const double cell = d / draw.between(16, 24);
    const Vec3 axis = random_axis(draw), other = random_axis(draw);

    motion::Move m;
    m.feed_mm_per_min = draw.between(0.003, 0.02) * d * cutter.flutes * 6000;
    m.line = 1;
    std::vector<motion::Move> moves;
    const auto straight = [&](Vec3 from, Vec3 to, Vec3 axis_from, Vec3 axis_to, double seconds = 0) {
        motion::Move s = m;
        s.start = {from, axis_from};
        s.end = {to, axis_to};
        s.duration_s = seconds;
        moves.push_back(s);
    };
    const Vec3 before{-2.8 * d, y, -depth}, after{2.8 * d, y + draw.between(-0.5, 0.5) * d, -depth};
    const Vec3 inside{draw.between(-1, 1) * d, y, -depth};
    switch (cut.motion) {
        case CutMotion::slot:
            straight(before, after, axis, axis);
            break;
        case CutMotion::ramp:
            straight(before + Vec3{0, 0, draw.between(-0.5, 0.5) * d}, after, axis, axis);
            break;
        case CutMotion::plunge: {
            const Vec3 upright = draw.below(2) == 0 ? Vec3{0, 0, 1} : axis;
            straight(inside + 2 * d * upright, inside, upright, upright);
            break;
        }
        case CutMotion::turning_slot:
            straight(before, after, axis, other);
            break;
        case CutMotion::pivot:
            straight(before, inside, axis, axis);
            straight(inside, inside, axis, other, draw.between(1, 4));
            break;
        case CutMotion::fan:
            straight(before, inside, axis, axis);
            straight(
                inside,
                inside + d * Vec3{draw.between(-0.3, 0.3), draw.between(-0.3, 0.3), draw.between(-0.2, 0.2)},
                axis, other, draw.between(1, 4));
            break;
        case CutMotion::arc: {
            const double r = draw.between(0.3, 2) * d, turn = draw.between(1, 6);
            const Vec3 start{-1.5 * d - 0.7 * d, y, -depth}, centre = start + Vec3{r, 0, 0};
            motion::Move arc = m;
            arc.start = {start, {0, 0, 1}};
            arc.end = {centre + r * Vec3{-std::cos(turn), -std::sin(turn), 0}, {0, 0, 1}};
            arc.arc = motion::Arc{centre, {0, 0, 1}, turn};
            moves.push_back(arc);
            break;
        }
        case CutMotion::bore: {
            const double r = draw.between(0.1, 0.5) * d, turns = draw.between(1, 3);
            const Vec3 centre{0, 0.5 * y, 0.1 * d};
            motion::Move helix = m;
            helix.start = {centre + Vec3{r, 0, 0}, {0, 0, 1}};
            helix.end = {
                centre + Vec3{r * std::cos(2 * pi * turns), r * std::sin(2 * pi * turns), -0.1 * d - depth},
                {0, 0, 1}};
            helix.arc = motion::Arc{centre, {0, 0, 1}, 2 * pi * turns};
            moves.push_back(helix);
            break;
        }
    }

    MillSetup& s = cut.setup;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    s.blank = std::make_unique<field::BoxShape>(block);
    s.blank_volume_mm3 = block.volume();
    s.cell_mm = cell;
    s.timing.max_axis_rad_per_s = 1000;
    for (const motion::Move& move : moves) {
        for (const motion::Move& piece : motion::to_elementary(move)) {
            s.moves.push_back(piece);
            s.cutter_of_move.push_back(0);
            s.rpm_of_move.push_back(6000);
        }
    }
    if (cut.stock == CutStock::stepped) {
        // Grooves of another tool across the path and along it.
        EarlierCuts earlier;
        Cutter ball;
        ball.kind = draw.below(2) == 0 ? CutterKind::ball : CutterKind::flat;
        ball.diameter_mm = draw.between(0.3, 1.2) * d;
        ball.length_mm = 4 * d;
        earlier.cutters = {ball};
        for (int n = 0; n < 3; ++n) {
            const double at = draw.between(-1.2, 1.2) * d, low = -draw.between(0.05, 0.6) * d;
            motion::Move groove;
            groove.feed_mm_per_min = 600;
            groove.start.tip_mm = n == 0 ? Vec3{-3 * d, at, low} : Vec3{at, -3 * d, low};
            groove.end.tip_mm = n == 0 ? Vec3{3 * d, at, low} : Vec3{at + 0.2 * d, 3 * d, low};
            earlier.moves.push_back(groove);
            earlier.cutter_of_move.push_back(0);
        }
        s.earlier.push_back(std::move(earlier));
    }

    std::ostringstream words;
    const char* kinds[] = {"flat", "ball", "bull"};
    const char* motions[] = {"slot", "ramp", "plunge", "turning slot", "pivot", "fan", "arc", "bore"};
    const char* stocks[] = {"box", "plate", "stepped"};
    words << motions[static_cast<int>(cut.motion)] << " in " << stocks[static_cast<int>(cut.stock)] << " "
          << thick << " thick, " << kinds[static_cast<int>(cutter.kind)] << " D " << d << " corner "
          << cutter.corner_mm << " z" << cutter.flutes << " helix " << cutter.helix_deg << " run-out "
          << cutter.runout_mm << (cutter.pitch_deg.empty() ? "" : " uneven pitch") << ", cell " << cell;
    for (const motion::Move& move : moves) {
        words << "; " << move.start.tip_mm << move.start.axis << " to " << move.end.tip_mm << move.end.axis;
        if (move.arc) words << " about " << move.arc->centre_mm << " by " << move.arc->turn_rad;
    }
    cut.words = words.str();
    return cut;
}

}  // namespace tribo::session
