// SPDX-License-Identifier: MIT
// What `tribo feel` and `tribo live` run on the servo's thread neither allocates, locks nor prints, tick by
// tick, on a part that is milled and while it is milled.
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <utility>

#include "base/counted_allocations.hpp"
#include "base/counted_locks.hpp"
#include "haptics/servo/force_table_player.hpp"
#include "haptics/servo/simulated_hand.hpp"
#include "session/block_setup.hpp"
#include "session/chatter/program_chatter.hpp"
#include "session/cut/stock_at_time.hpp"
#include "session/feel/feel_session.hpp"
#include "session/feel/vibration_track.hpp"
#include "session/live/force_look_ahead.hpp"
#include "session/live/live_finger.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

constexpr double kTickS = 1e-3;

// A slot along x at y = 10, 2 mm deep; 100 mm/s.
Result<MillSetup> slot() {
    MillSetup s = block_setup({{0, 0, -8}, {40, 20, 0}},
                              {.kind = milling::CutterKind::ball, .diameter_mm = 8, .length_mm = 20}, 0.5);
    add_cut_in_pieces(s, straight_cut({-5, 10, -2}, {45, 10, -2}, 6000), LiveMill::kPieceMm);
    return s;
}

haptics::Stroke rub() {
    return haptics::Stroke({{0, {5, 10, 4}}, {0.1, {10, 10, -3}}, {0.7, {30, 14, -3}}, {0.8, {30, 10, 4}}});
}

// What a tick may not do, summed over all ticks. A throw would end this program: a tick is noexcept.
struct Counted {
    long allocations = 0, locks = 0;
    int touching = 0;
    std::string output;
};
static_assert(noexcept(std::declval<haptics::Servo&>().tick(0)));
static_assert(noexcept(std::declval<LiveFinger&>().tick(0)));

// Calls `tick(n)` for each n and `between(n)` before it, which may do what it likes.
template <class Tick, class Between>
Counted count(int ticks, const Between& between, const Tick& tick) {
    Counted counted;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    for (int n = 0; n < ticks; ++n) {
        between(n);
        const long allocations = test::allocations, locks = test::locks;
        const bool touching = tick(n);
        counted.allocations += test::allocations - allocations;
        counted.locks += test::locks - locks;
        counted.touching += touching ? 1 : 0;
    }
    counted.output = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    return counted;
}

void expect_none(const Counted& counted) {
    EXPECT_EQ(counted.allocations, 0);
    EXPECT_EQ(counted.locks, 0);
    EXPECT_EQ(counted.output, "");
    EXPECT_GT(counted.touching, 200);
}

// The rub on a servo, with a jump of its clock at the end.
template <class Between>
Counted run(haptics::ForceSource& source, const Between& between) {
    haptics::SimulatedHand hand(rub(), kTickS);
    haptics::Servo servo(hand, source, safety_limits(hand, 1 / kTickS), 2e-3);
    Counted counted = count(
        800, [&](int n) { between(n * kTickS); },
        [&](int n) { return servo.tick(n < 780 ? n * kTickS : n * kTickS + 10).touching; });
    EXPECT_EQ(servo.safety().count(haptics::Fault::clock_jump), 1U);
    return counted;
}

TEST(ServoSources, feeling_a_milled_part_neither_allocates_nor_locks_nor_prints) {
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

// With the waves that a bending tool left, and with the force of its vibration.
TEST(ServoSources, feeling_what_bends_neither_allocates_nor_locks_nor_prints) {
    MillSetup setup = *slot();
    setup.modes_of_cutter = {{{{0.3, 1, 0}, 900, 0.02, 2000}}};
    MillSession milled(std::move(setup), serial_for);
    VibrationTrack track(1 / kTickS, milled.duration_s());
    ProgramChatter chatter(
        milled.setup(), {true, true}, serial_for,
        [&](const milling::CutRow& row, const milling::RowForce&, const RowChatter& of_row) {
            if (of_row.vibration) track.add(*of_row.vibration, row.pose.frame);
        });
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce& force) { chatter.add(row, force); };
    ASSERT_TRUE(milled.run(sinks));
    chatter.finish();
    const surface::FormError error(chatter.take_surface(), milled.stock());
    ASSERT_FALSE(error.empty());
    haptics::ContactOptions options;
    options.tick_s = kTickS;
    InspectSource source(milled.stock(), options, {}, &error);
    expect_none(run(source, [](double) {}));

    const CutterTrack cutter(*slot());
    haptics::ForceTablePlayer table(1 / kTickS);
    VibratingForce force(table, track, {});
    const haptics::TextureMap textures;
    CutSource cut(cutter, force, textures, {.tick_s = kTickS});
    expect_none(run(cut, [](double) {}));
}

// The table of forces and the textures of the slot, as the program and the live view make them.
class ServoSourcesOfACut : public testing::Test {
  protected:
    ServoSourcesOfACut() : ahead_(*slot(), serial_for) {
        (void)ahead_.run([] { return true; });
        force_.replace(ahead_.table({}, {}), {});
        textures_ = ahead_.textures();
    }
    ForceLookAhead ahead_;
    haptics::ForceTablePlayer force_{1 / kTickS};
    haptics::TextureMap textures_;
};

TEST_F(ServoSourcesOfACut, feeling_the_cut_neither_allocates_nor_locks_nor_prints) {
    const CutterTrack track(*slot());
    ASSERT_FALSE(textures_.records().empty());
    StockAtTime stock(*slot(), serial_for, 0);
    CutSourceOptions options;
    options.part = &stock.reader();
    options.tick_s = options.contact.tick_s = kTickS;
    options.finger_mm = 8;
    CutSource source(track, force_, textures_, options);
    expect_none(run(source, [&](double now_s) { stock.advance(now_s); }));
}

// With another table, other textures, the switches and a stop on the way.
TEST_F(ServoSourcesOfACut, the_live_finger_neither_allocates_nor_locks_nor_prints) {
    const auto live = *LiveMill::create(slot, serial_for);
    LiveForceOptions options;
    options.finger_mm = 8;
    LiveFinger finger(options, nullptr, {20, 10, 2});
    live->set_session_observer([&](MillSession* session) { finger.force_source().set_session(session); });
    finger.force_source().set_force(ahead_.table({}, {}), {});
    finger.force_source().set_textures(ahead_.textures());
    live->play(true);
    LiveScene scene;
    double force_n = 0;
    const auto picture = [&](int n) {
        if (n % 16 != 0) return;
        live->tick(16e-3, [] { return true; }, [](auto) {});
        if (n == 160) finger.force_source().set_force(ahead_.table({}, {}), {});
        if (n == 320) finger.force_source().set_textures(ahead_.textures());
        scene.program_s = live->clock_s();
        scene.pace = live->pace();
        scene.cutting_force = n < 480 || n > 640;
        if (n == 1440) finger.stop(scene);
        finger.set_pointer({20 + 5e-3 * n, 10, -3}, true);
        finger.show(scene, live->state().tip_mm, [](auto) {});
    };
    expect_none(count(1500, picture, [&](int n) {
        EXPECT_TRUE(finger.tick(n * kTickS));
        force_n = std::max(force_n, finger.servo().largest_force_n);
        return finger.force_source().touch_state().contact;
    }));
    EXPECT_GT(force_n, 0.1);
    finger.force_source().set_session(nullptr);
}

TEST(ServoSources, the_counters_count) {
#ifdef TRIBO_NOT_COUNTED
    GTEST_SKIP() << "the sanitizer has these functions";
#endif
    const long allocations_before = test::allocations, locks_before = test::locks;
    // Called by name: a new-expression without use may be left out by the compiler.
    ::operator delete(::operator new(8));
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
    EXPECT_GT(test::allocations, allocations_before);
    EXPECT_EQ(test::locks, locks_before + 1);
    EXPECT_EQ(count(1, [](int) {}, [](int) { return std::puts("") > 0; }).output, "\n");
}

}  // namespace
}  // namespace tribo::session
