// SPDX-License-Identifier: MIT
// The difference of two milled parts, on cuts whose difference is known, and on random ones.
#include "surface/part_difference.hpp"

#include <gtest/gtest.h>

#include "field/contour/contour.hpp"
#include "session/block_setup.hpp"
#include "session/cut/mill_session.hpp"
#include "session/random_cut.hpp"

namespace tribo::session {
namespace {

constexpr Box3 kBlock{{0, 0, -10}, {40, 20, 0}};

milling::Cutter flat_cutter(double diameter_mm) {
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::flat;
    cutter.diameter_mm = diameter_mm;
    cutter.length_mm = 30;
    cutter.flutes = 2;
    return cutter;
}

MillSetup slot(double y_mm, double z_mm, double cell_mm = 0.25) {
    MillSetup setup = block_setup(kBlock, flat_cutter(6), cell_mm);
    add_cut(setup, straight_cut({-10, y_mm, z_mm}, {50, y_mm, z_mm}, 600));
    return setup;
}

// A milled part and what is left of it by the count of the session.
struct Milled {
    explicit Milled(MillSetup setup) : session(std::move(setup), serial_for) { session.run({}); }
    double remaining_mm3() const { return session.totals().remaining_mm3; }
    surface::ComparedPart part() const { return {session.stock(), field::contour(session.stock())}; }

    MillSession session;
};

TEST(PartDifference, is_the_floor_between_two_slots_of_different_depth) {
    const Milled a(slot(10, -2)), b(slot(10, -2.5));
    const auto volumes = surface::volume_difference(a.session.stock(), b.session.stock());
    EXPECT_NEAR(volumes.only_a_mm3, 6 * 0.5 * 40, 0.01 * 6 * 0.5 * 40);
    EXPECT_EQ(volumes.only_b_mm3, 0);
    const auto surfaces = surface::surface_difference(a.part(), b.part());
    EXPECT_FALSE(surfaces.more);
    ASSERT_TRUE(surfaces.less);
    EXPECT_NEAR(surfaces.less->mm, -0.5, 1e-5);
    EXPECT_NEAR(surfaces.less->on_a_mm.z, -2, 1e-5);
    EXPECT_NEAR(surfaces.less->on_b_mm.z, -2.5, 1e-5);
}

TEST(PartDifference, counts_both_sides_of_slots_beside_each_other) {
    // The slots do not touch.
    const Milled a(slot(5, -2)), b(slot(15, -3));
    const auto volumes = surface::volume_difference(a.session.stock(), b.session.stock());
    EXPECT_NEAR(volumes.only_a_mm3, 6 * 3 * 40, 0.01 * 6 * 3 * 40);
    EXPECT_NEAR(volumes.only_b_mm3, 6 * 2 * 40, 0.01 * 6 * 2 * 40);
    const auto surfaces = surface::surface_difference(a.part(), b.part());
    ASSERT_TRUE(surfaces.more && surfaces.less);
    EXPECT_NEAR(surfaces.more->mm, 2, 1e-5);
    EXPECT_NEAR(surfaces.more->on_a_mm.z, -2, 1e-5);
    EXPECT_NEAR(surfaces.less->mm, -3, 1e-5);
    EXPECT_NEAR(surfaces.less->on_b_mm.z, -3, 1e-5);
}

// Another cut of about the same size, with a stock of its own.
RandomCut random_cut_like(const RandomCut& cut, std::uint64_t seed) {
    while (true) {
        RandomCut other = random_cut(++seed);
        const double ratio = other.setup.cutters[0].diameter_mm / cut.setup.cutters[0].diameter_mm;
        if (ratio > 0.6 && ratio < 1.6) return other;
    }
}

TEST(PartDifference, of_random_cuts_is_that_of_their_volumes) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        RandomCut first = random_cut(seed), second = random_cut_like(first, 1000 * seed);
        const std::string words = first.words + "\nagainst " + second.words;
        const Milled a(std::move(first.setup)), b(std::move(second.setup));
        const auto v = surface::volume_difference(a.session.stock(), b.session.stock());
        const double most = std::max(a.remaining_mm3(), b.remaining_mm3());
        EXPECT_NEAR(v.only_a_mm3 - v.only_b_mm3, a.remaining_mm3() - b.remaining_mm3(), 0.005 * most)
            << words;
        EXPECT_NEAR(v.only_a_mm3 - v.only_b_mm3, v.a_mm3 - v.b_mm3, 1e-9 * most) << words;
        EXPECT_GE(v.only_a_mm3, 0);
        EXPECT_GE(v.only_b_mm3, 0);
    }
}

TEST(PartDifference, changes_sign_with_the_order_of_the_parts) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        RandomCut first = random_cut(seed), second = random_cut_like(first, 1000 * seed);
        const Milled a(std::move(first.setup)), b(std::move(second.setup));
        const auto ab = surface::volume_difference(a.session.stock(), b.session.stock());
        const auto ba = surface::volume_difference(b.session.stock(), a.session.stock());
        EXPECT_EQ(ab.only_a_mm3, ba.only_b_mm3);
        EXPECT_EQ(ab.only_b_mm3, ba.only_a_mm3);
    }
}

TEST(PartDifference, of_a_part_with_itself_is_exactly_zero) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        const Milled a(random_cut(seed).setup), again(random_cut(seed).setup);
        const auto v = surface::volume_difference(a.session.stock(), again.session.stock());
        EXPECT_EQ(v.only_a_mm3, 0);
        EXPECT_EQ(v.only_b_mm3, 0);
        const auto surfaces = surface::surface_difference(a.part(), again.part());
        EXPECT_FALSE(surfaces.more) << surfaces.more->mm << " " << random_cut(seed).words;
        EXPECT_FALSE(surfaces.less) << surfaces.less->mm << " " << random_cut(seed).words;
    }
}

}  // namespace
}  // namespace tribo::session
