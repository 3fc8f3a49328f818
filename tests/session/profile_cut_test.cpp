// SPDX-License-Identifier: MIT
// Cuts with cutters that have a profile: volumes against closed forms, and the work of the spindle against
// the metal that left.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "base/math.hpp"
#include "milling/tool/cutter_shape.hpp"
#include "session/block_setup.hpp"
#include "session/cut/mill_session.hpp"

namespace tribo::session {
namespace {

using milling::Cutter;
using milling::CutterKind;

Cutter made(Cutter cutter) {
    const auto done = milling::make_profile(cutter);
    EXPECT_TRUE(done) << done.error().text();
    return cutter;
}

const Box3 kBlock{{0, 0, -8}, {20, 16, 0}};
constexpr double kCell = 0.1, kShare = 0.003;

MillTotals mill(const Cutter& cutter, const motion::Move& move, const Box3& block = kBlock,
                double cell = kCell) {
    MillSetup setup = block_setup(block, cutter, cell);
    add_cut(setup, move);
    MillSession session(std::move(setup), serial_for);
    session.run({[](const milling::CutRow&, const milling::RowForce&) {}, {}});
    return session.totals();
}

// From outside of the block through it.
motion::Move through(double depth_mm) {
    return straight_cut({-12, 8, -depth_mm}, {32, 8, -depth_mm}, 600);
}
motion::Move plunge(double depth_mm) {
    return straight_cut({10, 8, 1}, {10, 8, -depth_mm}, 200);
}

constexpr double kWay = 20;  // of a groove through the block

TEST(ProfileCut, removes_the_volume_of_a_v_groove) {
    const Cutter v = made({.kind = CutterKind::v, .diameter_mm = 10, .length_mm = 12, .point_deg = 90});
    EXPECT_NEAR(mill(v, through(3)).removed_mm3 / (9 * kWay), 1, kShare);
    const Cutter flat_tip =
        made({.kind = CutterKind::chamfer, .diameter_mm = 10, .length_mm = 12, .tip_mm = 2});
    EXPECT_NEAR(mill(flat_tip, through(3)).removed_mm3 / ((9 + 6) * kWay), 1, kShare);
}

TEST(ProfileCut, removes_the_volume_of_a_cone_and_of_a_drilled_hole) {
    const Cutter v = made({.kind = CutterKind::countersink, .diameter_mm = 12, .length_mm = 12});
    EXPECT_NEAR(mill(v, plunge(4)).removed_mm3 / (math::kPi / 3 * 64), 1, kShare);
    const Cutter drill = made({.kind = CutterKind::drill, .diameter_mm = 6, .length_mm = 20});
    const double point = 3 / std::tan(59 * math::kRadPerDeg);
    EXPECT_NEAR(mill(drill, plunge(6)).removed_mm3 / (math::kPi * 9 * (6 - point + point / 3)), 1, kShare);
}

TEST(ProfileCut, removes_the_volume_of_a_dovetail_slot_and_leaves_what_hangs_over_it) {
    const Cutter dovetail =
        made({.kind = CutterKind::dovetail, .diameter_mm = 10, .taper_deg = 30, .height_mm = 4});
    const double top = 5 - 4 * std::tan(30 * math::kRadPerDeg);
    EXPECT_NEAR(mill(dovetail, through(4)).removed_mm3 / ((5 + top) * 4 * kWay), 1, kShare);
    // The neck does not cut: of the slot below a roof of 2 mm only the dovetail goes, and the shank collides.
    EXPECT_NEAR(mill(dovetail, through(6)).removed_mm3 / ((5 + top) * 4 * kWay), 1, kShare);
}

// The area of a circle below a chord at this height above its middle.
double below_chord(double radius, double height) {
    return radius * radius * (math::kHalfPi + std::asin(height / radius)) +
           height * std::sqrt(radius * radius - height * height);
}

TEST(ProfileCut, removes_the_volume_of_a_lens_and_of_a_lollipop) {
    const Cutter lens = made({.kind = CutterKind::lens, .diameter_mm = 12, .length_mm = 12, .side_mm = 12});
    EXPECT_NEAR(mill(lens, through(1.2)).removed_mm3 / (below_chord(12, -10.8) * kWay), 1, kShare);
    const Cutter lollipop = made({.kind = CutterKind::lollipop, .diameter_mm = 5, .neck_mm = 3});
    EXPECT_NEAR(mill(lollipop, through(7)).removed_mm3 / (below_chord(2.5, 2) * kWay), 1, kShare);
}

TEST(ProfileCut, removes_the_volume_of_a_tapered_hole) {
    const Cutter taper =
        made({.kind = CutterKind::taper, .diameter_mm = 8, .length_mm = 20, .tip_mm = 3, .taper_deg = 10});
    const double slope = std::tan(10 * math::kRadPerDeg), depth = 4;
    // A plunge leaves the frustum of its last place.
    const double r0 = 1.5, r1 = 1.5 + depth * slope;
    EXPECT_NEAR(
        mill(taper, plunge(depth)).removed_mm3 / (math::kPi / 3 * depth * (r0 * r0 + r0 * r1 + r1 * r1)), 1,
        kShare);
}

struct Kind {
    const char* name;
    Cutter cutter;
};
std::vector<Kind> kinds() {
    Cutter form{.kind = CutterKind::profile, .length_mm = 0};
    form.profile = {{1.5, 0, 0}, {1.5, 1.5, -std::tan(math::kPi / 8)}, {3, 3, 0}, {4, 3, 0}, {4, 12, 0}};
    std::vector<Kind> all{
        {"taper",
         {.kind = CutterKind::taper,
          .diameter_mm = 8,
          .corner_mm = 1,
          .length_mm = 20,
          .tip_mm = 3,
          .taper_deg = 10}},
        {"v", {.kind = CutterKind::v, .diameter_mm = 10, .length_mm = 12, .point_deg = 60}},
        {"drill", {.kind = CutterKind::drill, .diameter_mm = 8, .length_mm = 20}},
        {"chamfer", {.kind = CutterKind::chamfer, .diameter_mm = 10, .length_mm = 12, .tip_mm = 2}},
        {"dovetail", {.kind = CutterKind::dovetail, .diameter_mm = 10, .taper_deg = 30, .height_mm = 4}},
        {"lens",
         {.kind = CutterKind::lens, .diameter_mm = 10, .corner_mm = 1, .length_mm = 12, .side_mm = 15}},
        {"barrel",
         {.kind = CutterKind::barrel, .diameter_mm = 10, .corner_mm = 1, .length_mm = 12, .side_mm = 40}},
        {"lollipop", {.kind = CutterKind::lollipop, .diameter_mm = 6, .neck_mm = 3}},
        {"thread", {.kind = CutterKind::thread, .diameter_mm = 10, .neck_mm = 7, .tip_mm = 0.5}},
        {"engraver",
         {.kind = CutterKind::engraver, .diameter_mm = 6, .length_mm = 12, .tip_mm = 0.4, .point_deg = 40}},
        {"profile", form}};
    for (Kind& kind : all) kind.cutter = made(kind.cutter);
    return all;
}

TEST(ProfileCut, does_the_work_of_the_metal_in_slots_side_cuts_plunges_and_tilted_cuts) {
    const Vec3 lean = normalized({0.2, 0.15, 1});
    for (const Kind& kind : kinds()) {
        motion::Move side = straight_cut({-10, 0.5 - 0.5 * kind.cutter.diameter_mm, -2.5},
                                         {26, 0.5 - 0.5 * kind.cutter.diameter_mm, -2.5}, 600);
        motion::Move tilted = through(1.5);
        tilted.start.axis = tilted.end.axis = lean;
        motion::Move turning = through(1.5);
        turning.start.axis = lean;
        turning.end.axis = normalized({0.1, -0.1, 1});
        motion::Move ramp = straight_cut({4, 8, 0.2}, {16, 8, -2}, 300);
        const bool has_dead_centre = kind.cutter.core_mm > 0;
        const std::pair<const char*, motion::Move> cuts[] = {{"slot", through(2)},    {"side", side},
                                                             {"plunge", plunge(2.5)}, {"tilted", tilted},
                                                             {"turning", turning},    {"ramp", ramp}};
        for (const auto& [words, cut] : cuts) {
            if (has_dead_centre && (std::string(words) == "plunge" || std::string(words) == "ramp")) continue;
            MillSetup setup = block_setup(kBlock, kind.cutter, 0.2);
            for (const motion::Move& piece : motion::to_elementary(cut)) add_cut(setup, piece);
            MillSession session(std::move(setup), serial_for);
            session.run({[](const milling::CutRow&, const milling::RowForce&) {}, {}});
            const MillTotals& totals = session.totals();
            if (totals.fed_mm3 < 1) continue;
            ASSERT_TRUE(totals.energy_balance) << kind.name << " " << words;
            EXPECT_NEAR(*totals.energy_balance, 1, 0.01) << kind.name << " " << words;
        }
    }
}

}  // namespace
}  // namespace tribo::session
