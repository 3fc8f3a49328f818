// SPDX-License-Identifier: MIT
// The finger of the live view: what a led hand feels of the blank, of the cut, and of its switches.
#include "session/live/live_finger.hpp"

#include <atomic>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <thread>

#include "base/math.hpp"
#include "session/block_setup.hpp"
#include "session/live/force_look_ahead.hpp"
#include "session/live/live_mill.hpp"
#include "session/live/single_threaded_touch.hpp"

namespace tribo::session {
namespace {

constexpr double kRateHz = 1000;

// A slot along x at y = 10, 2 mm deep, from 0.25 s on; 12.5 mm/s.
Result<MillSetup> finger_slot() {
    MillSetup s = block_setup({{0, 0, -8}, {40, 20, 0}}, {.diameter_mm = 8, .length_mm = 20}, 0.5);
    add_cut_in_pieces(s, straight_cut({-5, 10, -2}, {45, 10, -2}, 750), LiveMill::kPieceMm);
    return s;
}

bool never_stops() {
    return true;
}

void drop(std::span<const std::uint8_t>) {}

// Mill, picture and servo in one thread: a picture, then the ticks until the next.
class Bench {
  public:
    Bench() : live(*LiveMill::create(finger_slot, serial_for)), finger({}, nullptr, {20, 10, 5}) {
        live->set_session_observer(
            [this](MillSession* session) { finger.force_source().set_session(session); });
    }
    ~Bench() { finger.force_source().set_session(nullptr); }

    void run(double seconds, double pictures_per_s = 60) {
        for (int n = 0; n < std::lround(pictures_per_s * seconds); ++n) {
            live->tick(1 / pictures_per_s, never_stops, drop);
            scene.program_s = live->clock_s();
            scene.pace = live->pace();
            finger.show(scene, live->state().tip_mm, [this](auto frame) { take(frame); });
            pictures_ += 1 / pictures_per_s;
            while (ticks_ / kRateHz < pictures_) ASSERT_TRUE(finger.tick(ticks_++ / kRateHz));
        }
        finger.show(scene, live->state().tip_mm, [this](auto frame) { take(frame); });
    }

    std::unique_ptr<LiveMill> live;
    LiveFinger finger;
    LiveScene scene;
    protocol::LiveTouch touch;
    int textures = 0;

  private:
    void take(std::span<const std::uint8_t> frame) {
        protocol::LiveTexture texture;
        if (protocol::read_frame(frame, texture)) {
            EXPECT_TRUE(texture.triangles.empty() || texture.triangles.size() == 8);
            textures += texture.triangles.empty() ? 0 : 1;
            return;
        }
        ASSERT_TRUE(protocol::read_frame(frame, touch));
    }

    double pictures_ = 0;
    int ticks_ = 0;
};

// Two springs in a row: the hand's, drawn 1 mm below the surface, and the surface's.
TEST(LiveFinger, RestsOnTheSurfaceWithTheForceOfItsSprings) {
    Bench bench;
    bench.scene.cut_mode = false;
    bench.finger.set_pointer({20, 4, -1}, true);
    bench.run(2);
    const double hand = haptics::HandModel{}.stiffness_n_per_mm, surface = 0.5;
    EXPECT_NEAR(bench.touch.force_n.z, hand * surface / (hand + surface), 1e-3);
    EXPECT_NEAR(bench.touch.probe_mm.z, -hand / (hand + surface), 2e-3);
    EXPECT_NEAR(bench.touch.proxy_mm.z, 0, 1e-6);
    EXPECT_TRUE(bench.touch.contact && bench.touch.cutting_force && bench.touch.hand);
    EXPECT_FALSE(bench.touch.cut_mode || bench.touch.stopped);
}

TEST(LiveFinger, StandsOnTheNewSurfaceWhereMaterialIsCutAwayUnderIt) {
    Bench bench;
    bench.scene.cut_mode = false;
    bench.finger.set_pointer({20, 10, -3}, true);
    bench.run(1);
    EXPECT_NEAR(bench.touch.proxy_mm.z, 0, 1e-6);
    bench.live->play(true);
    bench.run(1.1 * bench.live->duration_s());
    EXPECT_NEAR(bench.touch.proxy_mm.z, -2, 1e-6);  // the slot's floor
    EXPECT_NEAR(bench.touch.force_n.z, 1 * 0.3 * 0.5 / 0.8, 1e-3);
}

// The table that a servo plays is the cut's: the mean over turns of what the hand feels is the row's mean
// force, scaled, while the finger is at the cutter.
TEST(LiveFinger, FeelsTheCutNearTheCutterAndNothingFarFromIt) {
    ForceLookAhead ahead(*finger_slot(), serial_for);
    ASSERT_TRUE(ahead.run(never_stops));
    Bench bench;
    bench.finger.force_source().set_force(ahead.table({}, {}), {});
    bench.finger.force_source().set_textures(ahead.textures());
    bench.live->play(true);
    bench.run(1);
    bench.finger.set_pointer(bench.live->state().tip_mm + Vec3{8, 0, 8}, true);  // where the tool will be
    bench.run(0.5);
    Vec3 sum;
    constexpr int count = 200;  // ticks: twenty turns
    for (int n = 0; n < count; ++n) {
        bench.run(1 / kRateHz, kRateHz);
        sum += bench.touch.force_n;
    }
    const Vec3 cut = bench.live->state().force_n;
    ASSERT_GT(length(cut), 50);
    EXPECT_NEAR(length(sum / count - 0.01 * cut), 0, 0.05 * 0.01 * length(cut));
    EXPECT_GT(bench.textures, 0);

    bench.scene.cutting_force = false;
    bench.run(0.2);
    EXPECT_EQ(length(bench.touch.force_n), 0);
    bench.scene.cutting_force = true;
    bench.finger.set_pointer({20, 10, 60}, true);
    bench.run(0.5);
    EXPECT_EQ(length(bench.touch.force_n), 0);
}

TEST(LiveFinger, GivesNoForceFromTheNextTickOnWhenStopped) {
    Bench bench;
    bench.scene.cut_mode = false;
    bench.finger.set_pointer({20, 4, -1}, true);
    bench.run(1);
    ASSERT_GT(bench.touch.force_n.z, 0.1);
    bench.finger.stop(bench.scene);
    bench.scene.stopped = true;
    bench.run(2.0 / 60);
    EXPECT_EQ(length(bench.touch.force_n), 0);
    // Released, the surface stays away until the finger has left it.
    bench.scene.stopped = false;
    bench.run(0.5);
    EXPECT_EQ(length(bench.touch.force_n), 0);
    bench.finger.set_pointer({20, 4, 2}, true);
    bench.run(0.5);
    bench.finger.set_pointer({20, 4, -1}, true);
    bench.run(1);
    EXPECT_GT(bench.touch.force_n.z, 0.1);
    // Nobody there: nothing is felt, and nothing is told.
    bench.finger.set_pointer({}, false);
    bench.run(0.2);
    EXPECT_FALSE(bench.touch.hand);
    EXPECT_EQ(length(bench.touch.force_n), 0);
}

// At equal times of the program the tooth's phase in the force felt is that of the spindle that is shown.
TEST(LiveFinger, FeelsTheTeethWhereTheSpindleShowsThem) {
    ForceLookAhead ahead(*finger_slot(), serial_for);
    ASSERT_TRUE(ahead.run(never_stops));
    for (const double feed_factor : {1.0, 1.7}) {
        CutChange change;
        change.feed_factor = feed_factor;
        change.speed_factor = 0.8;
        const contact::ForceTable table = ahead.table(change, {});
        auto live = *LiveMill::create(finger_slot, serial_for);
        live->set_change(change);
        const milling::Cutter cutter = finger_slot()->cutters[0];
        milling::ForceModel model(cutter, finger_slot()->coefficients);
        milling::Engagement full;  // a slot 2 mm deep
        full.bands = {{0, 2, 0, math::kPi}};
        const double feed_per_tooth = 750.0 / 6000 / cutter.flutes * change.chip_factor();
        model.engage(full, {feed_per_tooth, 0});
        for (const double t : {1.5, 2.0, 2.5}) {
            live->set_clock(t);
            live->tick(0, never_stops, drop);
            const double shown = live->state().spindle_angle_rad;
            // Tooth harmonics of both over a turn, the table's by its clock, the model's by the angle shown.
            const double turn_s = 60 / 6000.0 / change.angle_factor();
            std::complex<double> felt, cut;
            constexpr int steps = 720;
            for (int n = 0; n < steps; ++n) {
                const double share = static_cast<double>(n) / steps;
                contact::ForceTable::Cursor cursor;
                Vec3 force;
                ASSERT_TRUE(table.force_at(t + share * turn_s, 1e6, cursor, force));
                const auto wave = std::polar(1.0, -cutter.flutes * math::kTwoPi * share);
                felt += force.x * wave;
                cut += model.at(shown + math::kTwoPi * share).force_n.x * wave;
            }
            EXPECT_NEAR(std::abs(felt / cut), 1, 0.05);
            EXPECT_NEAR(std::arg(felt / cut), 0, 5 * math::kRadPerDeg);
        }
    }
}

// A servo on a thread of its own while the part is cut, begun again and taken away: for the sanitizer.
TEST(LiveFinger, GoesOnWhileAnotherThreadMills) {
    auto live = *LiveMill::create(finger_slot, serial_for);
    LiveFinger finger({}, nullptr, {20, 10, 5});
    live->set_session_observer([&](MillSession* session) { finger.force_source().set_session(session); });
    std::atomic<bool> over{false};
    std::thread servo([&] {
        for (int n = 0; !over.load(); ++n) finger.tick(n / kRateHz);
    });
    finger.set_pointer({20, 10, -3}, true);
    live->play(true);
    live->set_speed(4);
    LiveScene scene;
    bool begun_again = false;
    while (live->playing()) {
        live->tick(1.0 / 60, never_stops, drop);
        scene.program_s = live->clock_s();
        scene.pace = live->pace();
        finger.show(scene, live->state().tip_mm, drop);
        if (!begun_again && live->clock_s() > 0.8 * live->duration_s()) {
            begun_again = true;
            live->set_clock(0.5);
        }
    }
    EXPECT_TRUE(begun_again);
    live->set_session_observer({});
    finger.force_source().set_session(nullptr);
    live.reset();
    over = true;
    servo.join();
    EXPECT_GT(finger.servo().ticks, 0u);
}

TEST(LiveFinger, IsLeftAloneByAPictureThatStops) {
    Bench bench;
    bench.scene.cut_mode = false;
    bench.finger.set_pointer({20, 4, -1}, true);
    bench.run(1);
    // A quarter of a second without a scene: the guard takes the force away.
    for (int n = 0; n < 300; ++n) bench.finger.tick(1.1 + n / kRateHz);
    bench.finger.show(bench.scene, {}, drop);
    EXPECT_EQ(bench.finger.servo().fault, static_cast<std::uint32_t>(haptics::Fault::simulation_stalled));
}

// Where there is one thread: both come from what was cut in the last moments.
TEST(SingleThreadedTouch, ShowsTheGroovesAndGivesTheForceOfWhatWasJustCut) {
    const auto live = *LiveMill::create(finger_slot, serial_for);
    LiveController controller(*live, {}, nullptr, {});
    SingleThreadedTouch touch(controller);
    int textures = 0;
    double most_n = 0;
    live->play(true);
    for (int picture = 0; picture < 120; ++picture) {
        live->tick(1.0 / 60, never_stops, drop);
        controller.finger().set_pointer(live->state().tip_mm, true);
        touch.tick(1.0 / 60, [&](std::span<const std::uint8_t> frame) {
            protocol::LiveTexture texture;
            protocol::LiveTouch felt;
            if (protocol::read_frame(frame, texture)) textures += texture.triangles.size() == 8 ? 1 : 0;
            if (protocol::read_frame(frame, felt)) most_n = std::max(most_n, length(felt.force_n));
        });
    }
    EXPECT_GT(textures, 5);
    EXPECT_GT(most_n, 0.2);
    EXPECT_LE(most_n, haptics::kSimulatedLimits.max_force_n);
}

}  // namespace
}  // namespace tribo::session
