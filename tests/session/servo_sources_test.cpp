// SPDX-License-Identifier: MIT
// What `tribo feel` and `tribo live` run on the servo's thread neither allocates nor locks, tick by tick, on
// a part that is milled and while it is milled.
#include <gtest/gtest.h>

#include "base/counted_allocations.hpp"
#include "base/counted_locks.hpp"
#include "field/shape/box_shape.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/path.hpp"
#include "session/cut/stock_in_time.hpp"
#include "session/feel/feel_session.hpp"
#include "session/live/live_finger.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

constexpr double kTickS = 1e-3;

// A slot along x at y = 10, 2 mm deep; 100 mm/s.
Result<MillSetup> slot() {
    MillSetup s;
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 8;
    cutter.length_mm = 20;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    const Box3 blank{{0, 0, -8}, {40, 20, 0}};
    s.blank = std::make_unique<field::BoxShape>(blank);
    s.blank_volume_mm3 = blank.volume();
    s.cell_mm = 0.5;
    motion::Move move;
    move.feed_mm_per_min = 6000;
    move.start.tip_mm = {-5, 10, -2};
    move.end.tip_mm = {45, 10, -2};
    for (motion::Move& piece : motion::in_pieces(move, LiveMill::kPieceMm)) {
        s.moves.push_back(piece);
        s.cutter_of_move.push_back(0);
        s.rpm_of_move.push_back(6000);
    }
    return s;
}

haptics::Stroke rub() {
    return haptics::Stroke({{0, {5, 10, 4}}, {0.1, {10, 10, -3}}, {0.7, {30, 14, -3}}, {0.8, {30, 10, 4}}});
}

struct Counted {
    long allocations = 0, locks = 0;
    int touching = 0;
};

// Between the ticks `between(now_s)` may do what it likes.
template <class Between>
Counted run(haptics::ForceSource& source, const Between& between) {
    haptics::SimulatedHand hand(rub(), kTickS);
    haptics::SafetyLimits limits = safety_limits(hand, 1 / kTickS);
    haptics::Servo servo(hand, source, limits, 2e-3);
    Counted counted;
    for (int n = 0; n < 800; ++n) {
        between(n * kTickS);
        const long allocations = test::allocations, locks = test::locks;
        const haptics::ServoTick tick = servo.tick(n * kTickS);
        counted.allocations += test::allocations - allocations;
        counted.locks += test::locks - locks;
        counted.touching += tick.touching ? 1 : 0;
    }
    return counted;
}

void expect_none(const Counted& counted) {
    EXPECT_EQ(counted.allocations, 0);
    EXPECT_EQ(counted.locks, 0);
    EXPECT_GT(counted.touching, 200);
}

TEST(ServoSources, feeling_a_milled_part_neither_allocates_nor_locks) {
    MillSession milled(*slot(), serial_for);
    ASSERT_TRUE(milled.run({}));
    haptics::ContactOptions options;
    options.tick_s = kTickS;
    options.friction_static = options.friction_kinetic = 0.3;
    for (const double radius : {0.0, 0.5}) {
        options.probe_radius_mm = radius;
        InspectSource source(milled.stock(), options);
        expect_none(run(source, [](double) {}));
    }
    options.probe_radius_mm = 0;
    InspectSource finger(milled.stock(), options, haptics::ProbeShape::cylinder(3));
    expect_none(run(finger, [](double) {}));
}

TEST(ServoSources, feeling_the_cut_neither_allocates_nor_locks) {
    class Steady final : public haptics::CuttingForce {
        Vec3 force_n(double) noexcept override { return {0.5, 0, 0}; }
    };
    Steady steady;
    const CutterTrack track(*slot());
    const haptics::TextureMap none;
    StockInTime stock(*slot(), serial_for, 0);
    CutSourceOptions options;
    options.part = &stock.reader();
    options.tick_s = options.contact.tick_s = kTickS;
    CutSource source(track, steady, none, options);
    expect_none(run(source, [&](double now_s) { stock.advance(now_s); }));
}

TEST(ServoSources, the_live_finger_neither_allocates_nor_locks) {
    const auto live = *LiveMill::create(slot, serial_for);
    LiveFinger finger({}, nullptr, {20, 10, 2});
    live->watch([&](MillSession* session) { finger.feel().set_session(session); });
    LiveScene scene;
    Counted counted;
    double force_n = 0;
    for (int n = 0; n < 1500; ++n) {
        if (n % 16 == 0) {
            ASSERT_TRUE(live->tick(16e-3, [] { return true; }, [](auto) {}));
            scene.program_s = live->clock_s();
            scene.pace = live->pace();
            finger.lead({20 + 5e-3 * n, 10, -3}, true);
            finger.show(scene, live->state().tool.tip_mm, [](auto) {});
        }
        const long allocations = test::allocations, locks = test::locks;
        ASSERT_TRUE(finger.tick(n * kTickS));
        counted.allocations += test::allocations - allocations;
        counted.locks += test::locks - locks;
        force_n = std::max(force_n, static_cast<double>(finger.servo().largest_force_n));
    }
    EXPECT_EQ(counted.allocations, 0);
    EXPECT_EQ(counted.locks, 0);
    EXPECT_GT(force_n, 0.1);
    finger.feel().set_session(nullptr);
}

}  // namespace
}  // namespace tribo::session
