// SPDX-License-Identifier: MIT
// Gouge and scallop of lines: against grooves in closed form, and against the sweeps of the moves themselves.
#include "session/audit/part_errors.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/noise_hash.hpp"
#include "field/shape/surface_points.hpp"
#include "milling/sweep/sweep.hpp"
#include "session/block_setup.hpp"
#include "session/random_cut.hpp"

namespace tribo::session {
namespace {

constexpr double kRadius = 3, kFloor = -2, kCell = 0.25;

// Grooves of a ball along x over a flat design, 1 line each, in the order of their sides.
struct Grooves {
    std::vector<double> y_mm, depth_mm;  // below the design

    double centre_mm(std::size_t n) const { return kFloor - depth_mm[n] + kRadius; }
    // Height of the crest between two neighbours over the design.
    double crest_mm(std::size_t n) const {
        const double dy = y_mm[n + 1] - y_mm[n], dz = centre_mm(n + 1) - centre_mm(n);
        const double chord = std::hypot(dy, dz), up = std::sqrt(kRadius * kRadius - chord * chord / 4);
        // From the middle of the centres, across their line and down.
        return (centre_mm(n) + centre_mm(n + 1)) / 2 - up * dy / chord - kFloor;
    }
    PartErrors::Largest expected(std::size_t n) const {
        double scallop = 0;
        if (n > 0) scallop = crest_mm(n - 1);
        if (n + 1 < y_mm.size()) scallop = std::max(scallop, crest_mm(n));
        return {std::max(depth_mm[n], 0.0), scallop};
    }
    MillSetup setup() const {
        MillSetup s = block_setup(
            {{0, -5, -8}, {30, 25, 0}},
            {.kind = milling::CutterKind::ball, .diameter_mm = 2 * kRadius, .length_mm = 20}, kCell);
        for (std::size_t n = 0; n < y_mm.size(); ++n) {
            const double z = kFloor - depth_mm[n];
            motion::Move cut = straight_cut({-5, y_mm[n], z}, {35, y_mm[n], z}, 1200);
            cut.line = static_cast<int>(10 + n);
            add_cut(s, cut);
        }
        return s;
    }
};

// Flat, between two sides.
surface::DesignedSurface floor_between(double from_y, double to_y) {
    TriangleMesh mesh;
    for (const Vec3 corner :
         {Vec3{5, from_y, kFloor}, Vec3{25, from_y, kFloor}, Vec3{25, to_y, kFloor}, Vec3{5, to_y, kFloor}})
        mesh.positions.push_back(
            {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(corner.z)});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return *surface::DesignedSurface::make(std::move(mesh));
}

surface::DeviationReport compared(const MillSession& session, const surface::DesignedSurface& designed) {
    surface::DeviationOptions options;
    options.pass_width_mm = 2 * kRadius;
    options.blank = &session.stock().blank();
    options.spacing_mm = kCell;
    const std::vector<Vec3> points = field::surface_points(session.stock(), surface::kMaxSamples);
    options.machined_mm = points;
    options.all_places = true;
    return surface::compare(session.stock(), designed, options);
}

void expect_grooves(const Grooves& grooves) {
    MillSession session(grooves.setup(), serial_for);
    session.run({});
    const surface::DeviationReport report =
        compared(session, floor_between(grooves.y_mm.front() - 0.5, grooves.y_mm.back() + 0.5));
    const PartErrors errors(session, report);
    double deepest = 0;
    int line = 0;
    for (std::size_t n = 0; n < grooves.y_mm.size(); ++n) {
        const motion::MoveTiming& time = session.schedule().moves[n];
        const PartErrors::Largest found = errors.between(time.start_s, time.end_s),
                                  expected = grooves.expected(n);
        // Points of the machined surface are a cell apart, and crests may be sampled half of one beside their
        // top.
        EXPECT_NEAR(found.gouge_mm, expected.gouge_mm, kCell * kCell / (8 * kRadius) + 1e-3) << n;
        EXPECT_LE(found.scallop_mm, expected.scallop_mm + 1e-6) << n;
        EXPECT_GT(found.scallop_mm, 0.8 * expected.scallop_mm) << n;
        if (expected.gouge_mm <= deepest) continue;
        deepest = expected.gouge_mm;
        line = session.setup().moves[n].line;
    }
    EXPECT_EQ(errors.gouge_line(), line);
    // The largest of all lines are those of the part.
    const PartErrors::Largest all = errors.between(0, session.duration_s());
    EXPECT_EQ(all.gouge_mm, report.gouge.mm > 1e-4 ? report.gouge.mm : 0);
    EXPECT_EQ(all.scallop_mm, report.scallop.mm);
}

TEST(PartErrors, of_even_grooves_are_their_scallops) {
    expect_grooves({{0, 3, 6, 9}, {0, 0, 0, 0}});
}

TEST(PartErrors, find_the_groove_that_is_too_deep) {
    expect_grooves({{0, 3, 6, 9, 12}, {0, 0, 0.05, 0, 0.02}});
}

TEST(PartErrors, of_random_grooves_are_those_of_their_circles) {
    const CounterNoise noise(5);
    std::uint64_t draw = 0;
    for (int n = 0; n < 10; ++n) {
        Grooves grooves;
        double y = 0;
        for (int groove = 0; groove < 5; ++groove) {
            grooves.y_mm.push_back(y);
            grooves.depth_mm.push_back(0.1 * noise.uniform(draw++));
            y += 2.2 + 1.5 * noise.uniform(draw++);
        }
        SCOPED_TRACE(n);
        expect_grooves(grooves);
    }
}

// What tool and worst lines are told is what their moves have.
TEST(PartErrors, are_told_by_tool_and_line) {
    const Grooves grooves{{0, 3, 6}, {0, 0.07, 0}};
    MillSession session(grooves.setup(), serial_for);
    session.run({});
    const PartErrors errors(session, compared(session, floor_between(0, 6)));
    Audit audit;
    audit.tools.resize(1);
    for (const motion::MoveTiming& time : session.schedule().moves) {
        LoadTally& line = audit.worst.emplace_back();
        line.start_s = time.start_s;
        line.end_s = time.end_s;
    }
    errors.describe(audit);
    EXPECT_NEAR(*audit.tools.front().gouge_mm, 0.07, 1e-3);
    EXPECT_EQ(audit.worst[0].gouge_mm, 0);
    EXPECT_EQ(audit.worst[1].gouge_mm, audit.tools.front().gouge_mm);
    EXPECT_EQ(audit.worst[2].gouge_mm, 0);
    ASSERT_EQ(errors.gouges().size(), 1u);
    EXPECT_EQ(errors.gouges().front().line, 11);
}

// The move of each piece of the surface has its sweep there, whatever cutter, motion and stock.
TEST(MillSession, knows_the_move_that_made_a_place) {
    std::size_t places = 0, blank = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        RandomCut cut = random_cut(seed);
        if (!cut.setup.moves.empty()) {
            motion::Move dwell = cut.setup.moves.front();
            dwell.kind = motion::MoveKind::dwell;
            dwell.end = dwell.start;
            dwell.duration_s = 0.1;
            cut.setup.moves.insert(cut.setup.moves.begin() + 1, dwell);
            cut.setup.cutter_of_move.insert(cut.setup.cutter_of_move.begin(),
                                            cut.setup.cutter_of_move.front());
            cut.setup.rpm_of_move.insert(cut.setup.rpm_of_move.begin(), cut.setup.rpm_of_move.front());
            cut.setup.schedule = nullptr;
        }
        MillSession session(std::move(cut.setup), serial_for);
        session.run({});
        const MillSetup& setup = session.setup();
        const std::vector<Vec3> points = field::surface_points(session.stock(), 200);
        for (const Vec3 point : points) {
            const auto move = session.move_at(point);
            if (!move) {
                ++blank;
                continue;
            }
            ++places;
            ASSERT_NE(setup.moves[*move].kind, motion::MoveKind::dwell) << cut.words;
            const auto sweep =
                milling::make_sweep(setup.cutters[setup.cutter_of_move[*move]], setup.moves[*move]);
            EXPECT_NEAR(sweep->distance_mm(point), 0, 1e-3) << cut.words;
        }
    }
    EXPECT_GT(places, 1000u);
    EXPECT_GT(blank, 500u);
}

}  // namespace
}  // namespace tribo::session
