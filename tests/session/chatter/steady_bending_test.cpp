// SPDX-License-Identifier: MIT
// The form error of a tool that bends and does not vibrate: against slices of the edge with a beam that is
// integrated in steps, and against the vibration of a tool whose modes are far too fast to ring.
#include "session/chatter/steady_bending.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "session/chatter/row_simulation.hpp"
#include "wall_cut.hpp"

namespace tribo::session {
namespace {

// Rows of three turns.
double row_s(const Wall& w) {
    return 3 * 60 / w.rpm;
}

surface::ToothTraces left_by_bending(const Wall& w) {
    const MillSetup setup = setup_of(w);
    SteadyBending bending(setup);
    for (int n = 0; n < 4; ++n) bending.add(row_of(w, setup, n * row_s(w), (n + 1) * row_s(w)));
    return bending.take();
}

// Force across the axis by 3,000 slices of all teeth, as the edge of one stands at `angle_rad` at a height.
Vec3 force_by_slices(const Wall& w, double angle_rad, double height_mm) {
    constexpr int kSlices = 3000;
    const double lag = w.cutter.lag_rad(1), dz = w.depth_mm / kSlices;
    const milling::CuttingCoefficients& k = w.coefficients;
    Vec3 sum{};
    for (int tooth = 0; tooth < w.cutter.flutes; ++tooth) {
        for (int n = 0; n < kSlices; ++n) {
            const double z = (n + 0.5) * dz;
            double phi = angle_rad + lag * (height_mm - z) + 2 * math::kPi * tooth / w.cutter.flutes;
            phi -= 2 * math::kPi * std::floor(phi / (2 * math::kPi));
            if (phi < w.entry_rad || phi > w.exit_rad) continue;
            const double chip = w.feed_mm * std::sin(phi);
            const double tangential = (k.ktc * chip + k.kte) * dz, radial = (k.krc * chip + k.kre) * dz;
            sum.x += -tangential * std::cos(phi) - radial * std::sin(phi);
            sum.y += tangential * std::sin(phi) - radial * std::cos(phi);
        }
    }
    return sum;
}

// How far a bar that is clamped at its top moves at a height under 1 N at another one: moment over stiffness,
// summed twice from the top down.
double yield_by_steps(double diameter_mm, double length_mm, double force_mm, double at_mm) {
    constexpr int kSteps = 20'000;
    const double stiffness = 600e3 * math::kPi / 64 * std::pow(0.8 * diameter_mm, 4), dz = length_mm / kSteps;
    double slope = 0, shift = 0;
    for (int n = 0; n < kSteps; ++n) {
        const double z = length_mm - (n + 0.5) * dz;
        if (z < at_mm) break;
        slope += std::max(0.0, z - force_mm) / stiffness * dz;
        shift += slope * dz;
    }
    return shift;
}

TEST(SteadyBending, leaves_what_slices_and_a_beam_in_steps_give) {
    struct Case {
        double entry_rad, exit_rad, helix_deg;
        int flutes;
    };
    for (const Case& c : {Case{0, 1.2, 0, 6}, Case{2, math::kPi, 0, 3}, Case{0, 1.2, 30, 2},
                          Case{2, math::kPi, 30, 4}, Case{0, 2.5, -40, 3}, Case{0, math::kPi, 15, 3}}) {
        Wall w;
        w.coefficients = {700, 200, 0, 12, 9, 0};
        w.cutter.flutes = c.flutes;
        w.cutter.helix_deg = c.helix_deg;
        w.cutter.length_mm = 35;
        w.depth_mm = 6;
        w.entry_rad = c.entry_rad;
        w.exit_rad = c.exit_rad;
        const surface::ToothTraces all = left_by_bending(w);
        ASSERT_GT(all.traces.size(), 4u);
        double largest = 0, farthest = 0;
        for (const surface::ToothTrace& t : all.traces) {
            const bool left = t.normal.y < 0;
            const double height = t.from_mm.z - 3;
            // Straight edges enter and leave at once: the force that was there just before is what bends.
            const double end = (left ? 0 : math::kPi) - 1e-9;
            const double force = force_by_slices(w, end, height).y;
            const double expected =
                (left ? -1 : 1) * force * yield_by_steps(10, 35, 0.5 * w.depth_mm, height);
            for (std::size_t n = t.first; n < t.first + t.count; ++n)
                farthest =
                    std::max(farthest, std::abs(static_cast<double>(all.marks[n].displaced_mm) - expected));
            largest = std::max(largest, std::abs(expected));
        }
        EXPECT_GT(largest, 1e-4);
        EXPECT_LT(farthest, 0.005 * largest) << c.entry_rad << " " << c.exit_rad << " " << c.helix_deg;
    }
}

// Climb milling pushes the tool off its wall, conventional milling draws it in.
TEST(SteadyBending, leaves_material_in_climb_milling_and_cuts_too_deep_in_conventional_milling) {
    Wall w;
    w.coefficients.krc = 0;
    w.cutter.helix_deg = 30;
    w.depth_mm = 8;
    w.entry_rad = 2.2;
    for (const surface::ToothMark& mark : left_by_bending(w).marks) EXPECT_GT(mark.displaced_mm, 0);
    w.entry_rad = 0;
    w.exit_rad = 0.9;
    for (const surface::ToothMark& mark : left_by_bending(w).marks) EXPECT_LT(mark.displaced_mm, 0);
}

RC_GTEST_PROP(SteadyBending, is_what_modes_leave_that_are_too_fast_to_ring, ()) {
    const auto between = [](int low, int high) { return *rc::gen::inRange(low, high) / 1000.0; };
    Wall w;
    w.coefficients = {between(200'000, 2'000'000), between(50'000, 900'000), between(0, 300'000), 0, 0, 0};
    w.cutter.diameter_mm = between(3'000, 20'000);
    w.cutter.flutes = *rc::gen::inRange(1, 6);
    w.cutter.helix_deg = between(10'000, 45'000);
    w.cutter.length_mm = 4 * w.cutter.diameter_mm;
    w.feed_mm = 0.004 * w.cutter.diameter_mm;
    // Deep in angle, and yet at the tip of the beam.
    w.depth_mm = 0.05 * w.cutter.length_mm;
    w.rpm = 60;
    w.seconds = 4 * row_s(w);
    const bool climbs = *rc::gen::arbitrary<bool>();
    w.entry_rad = climbs ? between(1'700, 2'800) : 0;
    w.exit_rad = climbs ? math::kPi : between(400, 1'500);
    const double tilt = between(-1'500, 1'500), turn = between(-3'000, 3'000);
    w.axis = {std::sin(tilt), 0, std::cos(tilt)};
    w.feed = std::cos(turn) * Vec3{std::cos(tilt), 0, -std::sin(tilt)} + std::sin(turn) * Vec3{0, 1, 0};

    const dynamics::ToolBeam beam = dynamics::tool_beam(w.cutter);
    const double middle = 0.5 * w.depth_mm;
    const double yield = dynamics::yield_mm_per_n(beam, middle, middle);
    // Both records have their marks at the same heights: these depend on the fastest mode.
    constexpr double kHz = 5000, kDamping = 0.7;
    w.modes = {{{1, 0, 0}, kHz, kDamping, 1 / yield}, {{0, 1, 0}, kHz, kDamping, 1 / yield}};
    const surface::ToothTraces bent = left_by_bending(w);
    const MillSetup setup = setup_of(w);
    SurfaceRecorder recorder(setup);
    RowSimulation simulation(setup, false, &recorder);
    for (int n = 0; n < 2; ++n) (void)simulation.run(row_of(w, setup, n * row_s(w), (n + 1) * row_s(w)));
    const surface::ToothTraces rung = recorder.take();

    const Vec3 along = milling::tool_frame(w.axis, w.feed, w.feed).z;
    const auto height_of = [&](const surface::ToothTrace& t) {
        return dot(t.from_mm - Vec3{1, 2, 3}, along);
    };
    std::map<double, double> rung_mm;
    double largest = 0;
    for (const surface::ToothTrace& t : rung.traces) {
        if (t.start_s < 0.5 * row_s(w)) continue;
        const double mark = static_cast<double>(rung.marks[t.first].displaced_mm);
        rung_mm[height_of(t)] = mark;
        largest = std::max(largest, std::abs(mark));
    }
    // The modes follow a force later, by this angle of the tool; an edge that enters raises it at this rate.
    const double late_rad = 2 * kDamping / (2 * math::kPi * kHz) * (2 * math::kPi * w.rpm / 60);
    const double n_per_rad = (w.coefficients.ktc + w.coefficients.krc) * w.feed_mm * 0.5 *
                             w.cutter.diameter_mm / std::tan(w.cutter.helix_deg * math::kRadPerDeg);
    const double inertia_mm = yield * n_per_rad * late_rad;
    RC_ASSERT(!bent.traces.empty());
    for (const surface::ToothTrace& t : bent.traces) {
        const auto rung_there = rung_mm.lower_bound(height_of(t) - 1e-6);
        RC_ASSERT(rung_there != rung_mm.end());
        RC_ASSERT(rung_there->first < height_of(t) + 1e-6);
        // The modes yield everywhere as the beam does at its middle; the beam itself yields more below.
        const double here = dynamics::yield_mm_per_n(beam, middle, height_of(t)) / yield;
        const double expected = here * rung_there->second;
        const double mark = static_cast<double>(bent.marks[t.first].displaced_mm);
        RC_LOG() << height_of(t) << " " << mark << " " << expected << "\n";
        RC_ASSERT(std::abs(mark - expected) < 0.03 * largest + inertia_mm);
    }
}

}  // namespace
}  // namespace tribo::session
