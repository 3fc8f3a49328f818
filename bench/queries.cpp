// SPDX-License-Identifier: MIT
// What an exact distance costs near the surface, at random places (nothing is in the cache).
#include <cmath>
#include <numbers>
#include <random>

#include "cuts.hpp"
#include "harness.hpp"
#include "milling/sweep/sweep.hpp"

namespace tribo::bench {
namespace {

constexpr Box3 kBlock{{0, 0, -10}, {60, 60, 0}};
constexpr double kSidestep = 2, kCell = 0.25;

std::vector<motion::Move> straight_passes() {
    std::vector<motion::Move> moves;
    for (double y = 0.3; y < 60; y += kSidestep) {
        for (const motion::Move& m : pass({-5, y, -1.013}, {65, y, -1.013}, 10)) moves.push_back(m);
    }
    return moves;
}

// About a centre beside the block, in pieces of 15 degrees.
std::vector<motion::Move> arc_passes() {
    const Vec3 centre{30, -40, -1.013};
    const double turn = std::numbers::pi / 12;
    std::vector<motion::Move> moves;
    for (double radius = 38; radius < 106; radius += kSidestep) {
        for (int n = 2; n < 10; ++n) {
            const auto at = [&](int k) {
                return centre + radius * Vec3{std::cos(k * turn), std::sin(k * turn), 0};
            };
            motion::Move move = straight(at(n), at(n + 1));
            move.arc = motion::Arc{centre, {0, 0, 1}, turn};
            moves.push_back(move);
        }
    }
    return moves;
}

// A wavy floor with a swaying axis, in quadratic pieces of 5 mm that turn the axis by up to 5 degrees.
std::vector<motion::Move> five_axis_passes() {
    const auto pose = [](double x, double y) {
        const double lead = 0.2 + 0.15 * std::sin(0.1 * x), side = 0.1 * std::cos(0.08 * x + 0.1 * y);
        return motion::ToolPose{{x, y, -1.5 + 0.4 * std::sin(0.12 * x)}, normalized(Vec3{lead, side, 1})};
    };
    std::vector<motion::Move> moves;
    for (double y = 0.3; y < 60; y += kSidestep) {
        for (double x = -5; x < 65; x += 5) {
            const motion::ToolPose a = pose(x, y), m = pose(x + 2.5, y), b = pose(x + 5, y);
            motion::Move move = straight(a.tip_mm, b.tip_mm);
            move.start = a;
            move.end = b;
            move.quadratic = motion::Quadratic{2 * m.tip_mm - 0.5 * (a.tip_mm + b.tip_mm),
                                               2 * m.axis - 0.5 * (a.axis + b.axis)};
            moves.push_back(move);
        }
    }
    return moves;
}

// Points within 0.1 mm of the surface as seen from above.
std::vector<Vec3> points_near_surface(const field::CarvedField& stock, std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> inside(6, 54), off(-0.1, 0.1);
    std::vector<Vec3> points;
    while (points.size() < count) {
        const double x = inside(random), y = inside(random);
        double low = -6, high = 1;
        for (int n = 0; n < 30; ++n) {
            const double middle = 0.5 * (low + high);
            (stock.distance_mm({x, y, middle}) > 0 ? high : low) = middle;
        }
        points.push_back({x, y, 0.5 * (low + high) + off(random)});
    }
    return points;
}

// The median over groups: a group is timed as one, so that the clock's own cost is spread out.
double query_ns(const milling::Cutter& cutter, const std::vector<motion::Move>& moves) {
    auto stock = block(kBlock, kCell);
    for (const motion::Move& move : moves) stock->carve(milling::make_sweep(cutter, move));
    constexpr std::size_t kGroup = 16;
    const std::vector<Vec3> points = points_near_surface(*stock, 2000 * kGroup);
    std::vector<double> ns;
    for (std::size_t n = 0; n < points.size(); n += kGroup) {
        double sum = 0;
        const double start = wall_s();
        for (std::size_t k = 0; k < kGroup; ++k) sum += stock->distance_mm(points[n + k]);
        ns.push_back(1e9 * (wall_s() - start) / kGroup);
        keep(sum);
    }
    return median(ns);
}

}  // namespace

void measure_queries(Report& report) {
    report.section("Exact distance near the surface, D8, sidestep 2 mm, 0.25 mm grid");
    const auto ball = end_mill(milling::CutterKind::ball, 8, 2, 30);
    const auto flat = end_mill(milling::CutterKind::flat, 8, 2, 30);
    report.add({"exact query, straight sweeps, ball", query_ns(ball, straight_passes()), "ns", 150});
    report.add({"exact query, straight sweeps, flat", query_ns(flat, straight_passes()), "ns", 150});
    report.add({"exact query, arc sweeps, ball", query_ns(ball, arc_passes()), "ns", 150});
    report.add({"exact query, arc sweeps, flat", query_ns(flat, arc_passes()), "ns", 150});
    report.add({"exact query, five-axis sweeps, ball", query_ns(ball, five_axis_passes()), "ns", 800});
    report.add({"exact query, five-axis sweeps, flat", query_ns(flat, five_axis_passes()), "ns", 800});
}

}  // namespace tribo::bench
