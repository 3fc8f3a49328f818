// SPDX-License-Identifier: MIT
#include "dynamics/tool_beam.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.hpp"
#include "milling/tool/cutter_shape.hpp"

namespace tribo::dynamics {
namespace {

double round_inertia_mm4(double diameter_mm) {
    return math::kPi / 64 * std::pow(diameter_mm, 4);
}

// The bending line, integrated from the clamped end down to the tip in many small steps.
struct Integrated {
    double stress_per_mm2 = 0, yield_mm = 0;
};
Integrated integrated(const ToolBeam& beam, double height_mm) {
    std::vector<BeamSection> sections = beam.body;
    sections.insert(sections.end(), beam.holder.begin(), beam.holder.end());
    double top = 0;
    for (const BeamSection& s : sections) top += s.length_mm;
    Integrated all;
    double slope = 0, shift = 0;
    for (std::size_t n = sections.size(); n-- > 0;) {
        const BeamSection& s = sections[n];
        constexpr int kSteps = 20'000;
        const double dz = s.length_mm / kSteps;
        for (int step = 0; step < kSteps; ++step) {
            const double z = top - (step + 0.5) * dz, moment = std::max(0.0, z - height_mm);
            const double bend = moment / (s.material.young_n_per_mm2 * round_inertia_mm4(s.diameter_mm)) * dz;
            shift += slope * dz + 0.5 * bend * dz;
            slope += bend;
            if (n < beam.body.size())
                all.stress_per_mm2 = std::max(all.stress_per_mm2,
                                              moment * s.diameter_mm / 2 / round_inertia_mm4(s.diameter_mm));
        }
        top -= s.length_mm;
    }
    all.yield_mm = shift;
    return all;
}

milling::Cutter cutter(double diameter_mm, double length_mm, double stickout_mm) {
    milling::Cutter c{.diameter_mm = diameter_mm, .length_mm = length_mm};
    c.stickout_mm = stickout_mm;
    return c;
}

double between(int low, int high) {
    return *rc::gen::inRange(low, high) / 100.0;
}
milling::Cutter any_cutter() {
    milling::Cutter c = cutter(between(10, 5000), between(100, 10'000), 0);
    c.stickout_mm = c.length_mm * between(100, 500);
    return c;
}

TEST(ToolBeam, of_one_section_bends_as_a_cantilever) {
    const ToolBeam beam = tool_beam(milling::Cutter{.diameter_mm = 10, .length_mm = 30});
    const BendingByForce bending = bending_by_force(beam, 0);
    const double d = 8;  // 0.8 of the diameter
    EXPECT_NEAR(bending.yield_mm, std::pow(30.0, 3) / (3 * 600e3 * round_inertia_mm4(d)), 1e-12);
    EXPECT_NEAR(bending.stress_per_mm2, 32 * 30 / (math::kPi * d * d * d), 1e-9);
    EXPECT_EQ(bending.stress_height_mm, 30);
}

TEST(ToolBeam, of_two_sections_is_weakest_where_the_edges_end_or_at_the_holder) {
    milling::Cutter c = cutter(10, 20, 50);
    c.shank_mm = 10;
    // At the end of the edges 32 * 20 / (pi 8^3) = 0.398, at the holder 32 * 50 / (pi 10^3) = 0.509.
    EXPECT_EQ(bending_by_force(tool_beam(c), 0).stress_height_mm, 50);
    c.shank_mm = 16;
    EXPECT_EQ(bending_by_force(tool_beam(c), 0).stress_height_mm, 20);
}

TEST(ToolBeam, agrees_with_the_integrated_bending_line_of_ten_stepped_tools) {
    std::vector<milling::Cutter> tools{cutter(6, 12, 30), cutter(12, 26, 50), cutter(1, 3, 20),
                                       cutter(20, 40, 90), cutter(3, 8, 38)};
    tools[0].shank_mm = 8;
    tools[1].neck_mm = 11;
    tools[1].reach_mm = 40;
    tools[2].shank_mm = 3;
    tools[3].body = milling::CutterBody::high_speed_steel;
    tools[3].holder = {{40, 30}, {63, 60}};
    tools[4].neck_mm = 2.8;
    int cases = 0;
    for (const milling::Cutter& c : tools) {
        const ToolBeam beam = tool_beam(c);
        for (const double height : {0.0, 0.4 * c.length_mm}) {
            const Integrated expected = integrated(beam, height);
            const BendingByForce bending = bending_by_force(beam, height);
            EXPECT_NEAR(bending.yield_mm / expected.yield_mm, 1, 1e-3);
            EXPECT_NEAR(bending.stress_per_mm2 / expected.stress_per_mm2, 1, 1e-3);
            ++cases;
        }
    }
    EXPECT_EQ(cases, 10);
}

RC_GTEST_PROP(ToolBeam, bends_less_the_nearer_the_force_is_to_the_holder, ()) {
    const milling::Cutter c = any_cutter();
    const ToolBeam beam = tool_beam(c);
    const double low = c.stickout_mm * between(0, 50), high = c.stickout_mm * between(50, 100);
    const BendingByForce of_low = bending_by_force(beam, low), of_high = bending_by_force(beam, high);
    RC_ASSERT(of_high.yield_mm <= of_low.yield_mm);
    RC_ASSERT(of_high.stress_per_mm2 <= of_low.stress_per_mm2);
}

// Maxwell and Betti.
RC_GTEST_PROP(ToolBeam, yields_at_one_height_by_a_force_at_another_as_the_other_way_round, ()) {
    const milling::Cutter c = any_cutter();
    const ToolBeam beam = tool_beam(c);
    const double one = c.stickout_mm * between(0, 100), other = c.stickout_mm * between(0, 100);
    const double yield = yield_mm_per_n(beam, one, other), back = yield_mm_per_n(beam, other, one);
    RC_ASSERT(yield >= 0);
    RC_ASSERT(std::abs(yield - back) <= 1e-9 * yield);
    RC_ASSERT(std::abs(yield_mm_per_n(beam, one, 0) - bending_by_force(beam, one).yield_mm) <=
              1e-12 * yield + 1e-15);
}

TEST(ToolBeam, is_not_bent_by_a_force_above_it) {
    const BendingByForce bending = bending_by_force(tool_beam(cutter(6, 10, 20)), 25);
    EXPECT_EQ(bending.yield_mm, 0);
    EXPECT_EQ(bending.stress_per_mm2, 0);
}

// A tapered cantilever under a force at its thin end yields by 64 F L^3 / (3 pi E d0 d1^3).
TEST(ToolBeam, of_a_taper_bends_as_a_tapered_cantilever) {
    milling::Cutter taper{
        .kind = milling::CutterKind::taper, .diameter_mm = 10, .length_mm = 40, .tip_mm = 4, .taper_deg = 1};
    taper.taper_deg = std::atan(3.0 / 40) * 180 / math::kPi;
    taper.tip_mm = 4;
    ASSERT_TRUE(milling::make_profile(taper));
    const BendingByForce bending = bending_by_force(tool_beam(taper), 0);
    const double d0 = kFlutedShare * 4, d1 = kFlutedShare * 10, length = 40, young = 600e3;
    const double expected = 64 * length * length * length / (3 * math::kPi * young * d0 * d1 * d1 * d1);
    EXPECT_NEAR(bending.yield_mm / expected, 1, 0.01);
}

}  // namespace
}  // namespace tribo::dynamics
