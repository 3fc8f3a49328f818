// SPDX-License-Identifier: MIT
// The live view against the session that it shows: its chunks make the part, its rows are the session's.
#include "session/live/live_mill.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/path.hpp"
#include "session/live/live_memory.hpp"

namespace tribo::session {
namespace {

constexpr Box3 kBlank{{0, 0, -8}, {40, 20, 0}};

Result<MillSetup> slot() {
    MillSetup s;
    milling::Cutter cutter;
    cutter.kind = milling::CutterKind::ball;
    cutter.diameter_mm = 6;
    cutter.length_mm = 20;
    s.cutters = {cutter};
    s.coefficients = milling::find_material("al7075-t6")->coefficients;
    s.blank = std::make_unique<field::BoxShape>(kBlank);
    s.blank_volume_mm3 = kBlank.volume();
    s.cell_mm = 0.5;
    motion::Move move;
    move.feed_mm_per_min = 1200;
    move.line = 7;
    for (const double y : {4.0, 7.0, 10.0, 13.0, 16.0}) {
        move.start.tip_mm = {-5, y, -2};
        move.end.tip_mm = {45, y, -2};
        for (motion::Move& piece : motion::in_pieces(move, LiveMill::kPieceMm)) {
            s.moves.push_back(piece);
            s.cutter_of_move.push_back(0);
            s.rpm_of_move.push_back(9000);
        }
    }
    return s;
}

// Reads frames as a viewer does, from their bytes alone.
class Viewer {
  public:
    protocol::FrameSink sink() {
        return [this](std::span<const std::uint8_t> frame) { take(frame); };
    }
    double part_volume_mm3() const {
        TriangleMesh whole;
        for (const auto& [at, mesh] : chunks_) {
            const auto first = static_cast<std::uint32_t>(whole.positions.size());
            whole.positions.insert(whole.positions.end(), mesh.positions.begin(), mesh.positions.end());
            for (const Triangle& t : mesh.triangles)
                whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        }
        return volume_mm3(whole);
    }

    int jobs = 0;
    double duration_s = 0, state_s = 0, force_n = 0;
    std::uint32_t flags = 0, line = 0, path_points = 0;
    std::vector<double> row_times, row_forces, sound_times;
    Vec3 listener;

  private:
    void take(std::span<const std::uint8_t> frame) {
        frame_ = frame;
        at_ = 16;
        ASSERT_GE(frame.size(), 16u);
        EXPECT_EQ(frame[1], protocol::kLiveFrameVersion);
        EXPECT_EQ(frame.size() % 4, 0u);
        switch (static_cast<protocol::LiveFrame>(frame[0])) {
            case protocol::LiveFrame::job:
                job();
                break;
            case protocol::LiveFrame::path:
                path_points = u32();
                at_ += 20 * path_points;
                break;
            case protocol::LiveFrame::chunk:
                chunk();
                break;
            case protocol::LiveFrame::state:
                state();
                break;
            case protocol::LiveFrame::rows:
                rows();
                break;
            case protocol::LiveFrame::collision:
                at_ += 20;
                break;
            case protocol::LiveFrame::sound:
                sound();
                break;
            case protocol::LiveFrame::listening:
                listener = vec3();
                at_ += 56;
                break;
            default:
                ADD_FAILURE() << "not the mill's";
        }
        EXPECT_EQ(at_, frame.size());
    }
    std::uint64_t bits(int bytes) {
        std::uint64_t v = 0;
        for (int n = 0; n < bytes; ++n) v |= std::uint64_t{frame_[at_++]} << (8 * n);
        return v;
    }
    std::uint32_t u32() { return static_cast<std::uint32_t>(bits(4)); }
    double f32() { return static_cast<double>(std::bit_cast<float>(u32())); }
    double f64() { return std::bit_cast<double>(bits(8)); }
    Vec3 vec3() {
        const double x = f32(), y = f32();
        return {x, y, f32()};
    }
    void job() {
        ++jobs;
        chunks_.clear();
        row_times.clear();
        row_forces.clear();
        sound_times.clear();
        duration_s = f64();
        f32();
        EXPECT_EQ(vec3(), kBlank.min);
        EXPECT_EQ(vec3(), kBlank.max);
        const std::uint32_t cutters = u32();
        for (std::uint32_t n = 0; n < cutters; ++n) {
            at_ += 20;
            at_ += 8 * u32();
        }
    }
    void chunk() {
        std::array<std::uint32_t, 3> coord;
        for (std::uint32_t& c : coord) c = u32();
        TriangleMesh mesh;
        mesh.positions.resize(u32());
        mesh.triangles.resize(u32());
        const Vec3 origin = vec3();
        const double step = f32();
        for (Point3f& p : mesh.positions) {
            for (int axis = 0; axis < 3; ++axis) {
                p[static_cast<std::size_t>(axis)] =
                    static_cast<float>(origin[axis] + step * static_cast<double>(bits(2)));
            }
        }
        at_ += (4 - at_ % 4) % 4;
        for (Triangle& t : mesh.triangles) {
            for (std::uint32_t& v : t) {
                v = static_cast<std::uint32_t>(bits(2));
                ASSERT_LT(v, mesh.positions.size());
            }
        }
        at_ += (4 - at_ % 4) % 4;
        chunks_[coord] = mesh;
    }
    void state() {
        state_s = std::bit_cast<double>([this] {
            const std::size_t kept = std::exchange(at_, 8);
            const std::uint64_t v = bits(8);
            at_ = kept;
            return v;
        }());
        at_ += 24;
        force_n = length(vec3());
        at_ += 32;
        line = u32();
        u32();
        flags = u32();
    }
    void rows() {
        if (frame_[2] != 0) {
            row_times.clear();
            row_forces.clear();
        }
        const std::uint32_t count = u32();
        for (std::uint32_t n = 0; n < count; ++n) {
            row_times.push_back(f64());
            at_ += 16;
            row_forces.push_back(f32());
            at_ += 28;
        }
    }

    void sound() {
        const std::uint32_t count = u32();
        for (std::uint32_t n = 0; n < count; ++n) {
            sound_times.push_back(f64());
            at_ += 32;
            EXPECT_EQ(u32(), 2u);  // orders a harmonic: two flutes alike
            const std::uint32_t harmonics = u32();
            EXPECT_EQ(harmonics, 17u);  // the mean and 16
            at_ += 24 * harmonics;
        }
        for (std::uint32_t n = 0; n < count; ++n) {
            EXPECT_EQ(u32(), 2u);  // edges
            EXPECT_GT(f32(), 0);   // torque
        }
    }

    std::span<const std::uint8_t> frame_;
    std::size_t at_ = 0;
    std::map<std::array<std::uint32_t, 3>, TriangleMesh> chunks_;
};

bool always() {
    return true;
}

TEST(LiveMill, ShowsThePartAsItIsCut) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    ASSERT_TRUE(live->tick(0, always, viewer.sink()));
    EXPECT_EQ(viewer.jobs, 1);
    EXPECT_NEAR(viewer.part_volume_mm3(), kBlank.volume(), 1e-3 * kBlank.volume());
    EXPECT_NEAR(viewer.duration_s, 5 * 50.0 / 20, 1e-9);
    EXPECT_GT(viewer.path_points, 50u);

    live->play(true);
    while (live->playing()) ASSERT_TRUE(live->tick(1.0 / 60, always, viewer.sink()));
    EXPECT_EQ(viewer.jobs, 1);
    EXPECT_DOUBLE_EQ(viewer.state_s, viewer.duration_s);
    EXPECT_NEAR(viewer.part_volume_mm3() / live->session().totals().remaining_mm3, 1, 2e-3);
    // The same rows as a session that nobody watches.
    MillSession alone(*slot(), serial_for);
    std::vector<double> times;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow& row, const milling::RowForce&) { times.push_back(row.start_s); };
    alone.run(sinks);
    EXPECT_EQ(viewer.row_times, times);
    EXPECT_EQ(viewer.sound_times, times);
    EXPECT_EQ(viewer.listener, (Vec3{20, 10, 0}));
    EXPECT_DOUBLE_EQ(alone.totals().removed_mm3, live->session().totals().removed_mm3);
}

TEST(LiveMill, SaysWhatTheToolDoesNow) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    live->set_clock(1.25);  // 25 mm on: in the middle of the first groove
    ASSERT_TRUE(live->tick(0, always, viewer.sink()));
    EXPECT_DOUBLE_EQ(viewer.state_s, 1.25);
    EXPECT_EQ(viewer.line, 7u);
    EXPECT_EQ(viewer.flags, 1u);  // cutting, not playing
    // A full groove with a ball: the mean force of the rows there.
    EXPECT_GT(viewer.force_n, 1);
    live->set_clock(0.05);  // in the air before the blank
    ASSERT_TRUE(live->tick(0, always, viewer.sink()));
    EXPECT_EQ(viewer.jobs, 2);
    EXPECT_EQ(viewer.flags, 0u);
    EXPECT_EQ(viewer.force_n, 0);
    EXPECT_NEAR(viewer.part_volume_mm3(), kBlank.volume(), 0.01 * kBlank.volume());
}

TEST(LiveMill, WaitsForThePart) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    live->play(true);
    live->set_speed(100);
    int asked = 0;
    const auto once = [&] { return ++asked % 2 == 0; };
    ASSERT_TRUE(live->tick(1, once, viewer.sink()));
    EXPECT_LT(viewer.state_s, live->duration_s());
    EXPECT_DOUBLE_EQ(viewer.state_s, std::min(live->session().milled_s(), live->duration_s()));
    for (int n = 0; n < 1000 && live->playing(); ++n) ASSERT_TRUE(live->tick(1, once, viewer.sink()));
    EXPECT_FALSE(live->playing());
    EXPECT_DOUBLE_EQ(viewer.state_s, live->duration_s());
    live->play(true);
    ASSERT_TRUE(live->tick(0, always, viewer.sink()));
    EXPECT_EQ(viewer.state_s, 0);
}

TEST(LiveMill, KeepsItsClockWhateverItIsTold) {
    auto live = *LiveMill::create(slot, serial_for);
    live->set_clock(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(live->clock_s(), 0);
    live->set_clock(-3);
    EXPECT_EQ(live->clock_s(), 0);
    live->set_clock(1e300);
    EXPECT_EQ(live->clock_s(), live->duration_s());
    live->set_clock(0);
    live->set_speed(-1);
    live->set_speed(std::numeric_limits<double>::infinity());
    Viewer viewer;
    live->play(true);
    ASSERT_TRUE(live->tick(0.5, always, viewer.sink()));
    EXPECT_DOUBLE_EQ(viewer.state_s, 0.5);
}

TEST(LiveMill, IsRememberedForALatecomer) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer, latecomer;
    LiveMemory memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(frame);
        viewer.sink()(frame);
    };
    live->play(true);
    for (int n = 0; n < 200; ++n) ASSERT_TRUE(live->tick(1.0 / 60, always, both));
    memory.replay(latecomer.sink());
    EXPECT_EQ(latecomer.jobs, 1);
    EXPECT_EQ(latecomer.row_times, viewer.row_times);
    EXPECT_EQ(latecomer.state_s, viewer.state_s);
    EXPECT_DOUBLE_EQ(latecomer.part_volume_mm3(), viewer.part_volume_mm3());
    // Nothing moves, nothing is told.
    live->play(false);
    ASSERT_TRUE(live->tick(1, always, both));
    bool told = false;
    ASSERT_TRUE(live->tick(1, always, [&](std::span<const std::uint8_t>) { told = true; }));
    EXPECT_FALSE(told);
    memory.take(std::array<std::uint8_t, 3>{1, 2, 3});
}

// Overrides change what was cut and what will be as if the program had been written so.
TEST(LiveMill, TellsTheForcesOfAChangedCut) {
    const auto changed = []() -> Result<MillSetup> {
        auto s = slot();
        for (motion::Move& move : s->moves) move.feed_mm_per_min *= 1.5;
        for (double& rpm : s->rpm_of_move) rpm *= 0.5;
        for (milling::Cutter& cutter : s->cutters) cutter.helix_deg = 45;
        s->coefficients = milling::find_material("steel")->coefficients;
        return s;
    };
    MillSession alone(*changed(), serial_for);
    std::vector<double> forces;
    MillSinks sinks;
    sinks.row = [&](const milling::CutRow&, const milling::RowForce& force) {
        forces.push_back(length(force.peaks.mean_n));
    };
    alone.run(sinks);

    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    LiveMemory memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(frame);
        viewer.sink()(frame);
    };
    live->play(true);
    while (live->clock_s() < 0.5 * live->duration_s()) ASSERT_TRUE(live->tick(1.0 / 60, always, both));
    CutChange change;
    change.feed_factor = 1.5;
    change.speed_factor = 0.5;
    change.helix_deg = 45;
    change.coefficients = milling::find_material("steel")->coefficients;
    live->set_change(change);
    const double before = live->clock_s();
    ASSERT_TRUE(live->tick(0.1, always, both));
    EXPECT_NEAR(live->clock_s() - before, 0.15, 1e-12);
    while (live->playing()) ASSERT_TRUE(live->tick(1.0 / 60, always, both));
    EXPECT_EQ(viewer.jobs, 1);
    ASSERT_EQ(viewer.row_forces.size(), forces.size());
    for (std::size_t n = 0; n < forces.size(); ++n)
        ASSERT_NEAR(viewer.row_forces[n], forces[n], 1e-5 * forces[n] + 1e-4) << n;
    Viewer latecomer;
    memory.replay(latecomer.sink());
    EXPECT_EQ(latecomer.row_forces, viewer.row_forces);
}

TEST(LiveMill, OfAJobThatCannotBeSetUpIsRefused) {
    const auto live = LiveMill::create([] { return Result<MillSetup>(fail("no", "try")); }, serial_for);
    EXPECT_FALSE(live);
}

}  // namespace
}  // namespace tribo::session
