// SPDX-License-Identifier: MIT
// The live view against the session that it shows: its chunks make the part, its rows are the session's.
#include "session/live/live_mill.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <memory>

#include "field/contour/contour.hpp"
#include "field/shape/box_shape.hpp"
#include "milling/tool/materials.hpp"
#include "motion/path/path.hpp"
#include "session/live/frame_cache.hpp"

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
    double duration_s = 0;
    protocol::LiveState state;
    std::size_t path_points = 0;
    std::vector<double> row_times, row_forces, sound_times;
    Vec3 listener;

  private:
    template <class Frame>
    static Frame read(std::span<const std::uint8_t> bytes) {
        Frame frame;
        EXPECT_TRUE(protocol::read_frame(bytes, frame));
        return frame;
    }
    void take(std::span<const std::uint8_t> frame) {
        EXPECT_EQ(frame.size() % 4, 0u);
        const auto kind = protocol::frame_kind(frame);
        ASSERT_TRUE(kind);
        switch (*kind) {
            case protocol::LiveFrame::job:
                job(read<protocol::LiveJob>(frame));
                break;
            case protocol::LiveFrame::path:
                path_points = read<protocol::LivePath>(frame).points.size();
                break;
            case protocol::LiveFrame::chunk: {
                auto chunk = read<protocol::LiveChunk>(frame);
                chunks_[chunk.at] = std::move(chunk.mesh);
                break;
            }
            case protocol::LiveFrame::state:
                state = read<protocol::LiveState>(frame);
                break;
            case protocol::LiveFrame::rows:
                rows(read<protocol::LiveRows>(frame));
                break;
            case protocol::LiveFrame::collision:
                (void)read<protocol::LiveCollision>(frame);
                break;
            case protocol::LiveFrame::sound:
                sound(read<protocol::LiveSoundPieces>(frame));
                break;
            case protocol::LiveFrame::listening:
                listener = read<job::Listening>(frame).listener_mm;
                break;
            default:
                ADD_FAILURE() << "not the mill's";
        }
    }
    void job(const protocol::LiveJob& job) {
        ++jobs;
        chunks_.clear();
        row_times.clear();
        row_forces.clear();
        sound_times.clear();
        duration_s = job.duration_s;
        EXPECT_EQ(job.blank_mm.min, kBlank.min);
        EXPECT_EQ(job.blank_mm.max, kBlank.max);
    }
    void rows(const protocol::LiveRows& told) {
        if (told.anew) {
            row_times.clear();
            row_forces.clear();
        }
        for (const protocol::LiveRow& row : told.rows) {
            row_times.push_back(row.t_s);
            row_forces.push_back(row.mean_force_n);
        }
    }
    void sound(const protocol::LiveSoundPieces& told) {
        for (const protocol::LiveSoundPiece& piece : told.pieces) {
            sound_times.push_back(piece.t_s);
            EXPECT_EQ(piece.order_step, 2);          // two flutes alike
            EXPECT_EQ(piece.harmonics.size(), 17u);  // the mean and 16
            EXPECT_EQ(piece.edges, 2);
            EXPECT_GT(piece.mean_torque_nmm, 0);
        }
    }

    std::map<protocol::LiveChunkPlace, TriangleMesh> chunks_;
};

bool always() {
    return true;
}

TEST(LiveMill, ShowsThePartAsItIsCut) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    live->tick(0, always, viewer.sink());
    EXPECT_EQ(viewer.jobs, 1);
    EXPECT_NEAR(viewer.part_volume_mm3(), kBlank.volume(), 1e-3 * kBlank.volume());
    EXPECT_NEAR(viewer.duration_s, 5 * 50.0 / 20, 1e-9);
    EXPECT_GT(viewer.path_points, 50u);

    live->play(true);
    while (live->playing()) live->tick(1.0 / 60, always, viewer.sink());
    EXPECT_EQ(viewer.jobs, 1);
    EXPECT_DOUBLE_EQ(viewer.state.t_s, viewer.duration_s);
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
    live->tick(0, always, viewer.sink());
    EXPECT_DOUBLE_EQ(viewer.state.t_s, 1.25);
    EXPECT_EQ(viewer.state.line, 7u);
    EXPECT_TRUE(viewer.state.cutting);
    EXPECT_FALSE(viewer.state.playing);
    // A full groove with a ball: the mean force of the rows there.
    EXPECT_GT(length(viewer.state.force_n), 1);
    live->set_clock(0.05);  // in the air before the blank
    live->tick(0, always, viewer.sink());
    EXPECT_EQ(viewer.jobs, 2);
    EXPECT_FALSE(viewer.state.cutting);
    EXPECT_EQ(length(viewer.state.force_n), 0);
    EXPECT_NEAR(viewer.part_volume_mm3(), kBlank.volume(), 0.01 * kBlank.volume());
}

TEST(LiveMill, WaitsForThePart) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer;
    live->play(true);
    live->set_speed(100);
    int asked = 0;
    const auto once = [&] { return ++asked % 2 == 0; };
    live->tick(1, once, viewer.sink());
    EXPECT_LT(viewer.state.t_s, live->duration_s());
    EXPECT_DOUBLE_EQ(viewer.state.t_s, std::min(live->session().milled_s(), live->duration_s()));
    for (int n = 0; n < 1000 && live->playing(); ++n) live->tick(1, once, viewer.sink());
    EXPECT_FALSE(live->playing());
    EXPECT_DOUBLE_EQ(viewer.state.t_s, live->duration_s());
    live->play(true);
    live->tick(0, always, viewer.sink());
    EXPECT_EQ(viewer.state.t_s, 0);
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
    live->tick(0.5, always, viewer.sink());
    EXPECT_DOUBLE_EQ(viewer.state.t_s, 0.5);
}

TEST(LiveMill, IsRememberedForALatecomer) {
    auto live = *LiveMill::create(slot, serial_for);
    Viewer viewer, latecomer;
    FrameCache memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(frame);
        viewer.sink()(frame);
    };
    live->play(true);
    for (int n = 0; n < 200; ++n) live->tick(1.0 / 60, always, both);
    memory.replay(latecomer.sink());
    EXPECT_EQ(latecomer.jobs, 1);
    EXPECT_EQ(latecomer.row_times, viewer.row_times);
    EXPECT_EQ(latecomer.state.t_s, viewer.state.t_s);
    EXPECT_DOUBLE_EQ(latecomer.part_volume_mm3(), viewer.part_volume_mm3());
    // Nothing moves, nothing is told.
    live->play(false);
    live->tick(1, always, both);
    bool told = false;
    live->tick(1, always, [&](std::span<const std::uint8_t>) { told = true; });
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
    FrameCache memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(frame);
        viewer.sink()(frame);
    };
    live->play(true);
    while (live->clock_s() < 0.5 * live->duration_s()) live->tick(1.0 / 60, always, both);
    CutChange change;
    change.feed_factor = 1.5;
    change.speed_factor = 0.5;
    change.helix_deg = 45;
    change.coefficients = milling::find_material("steel")->coefficients;
    live->set_change(change);
    const double before = live->clock_s();
    live->tick(0.1, always, both);
    EXPECT_NEAR(live->clock_s() - before, 0.15, 1e-12);
    while (live->playing()) live->tick(1.0 / 60, always, both);
    EXPECT_EQ(viewer.jobs, 1);
    ASSERT_EQ(viewer.row_forces.size(), forces.size());
    for (std::size_t n = 0; n < forces.size(); ++n)
        ASSERT_NEAR(viewer.row_forces[n], forces[n], 1e-5 * forces[n] + 1e-4) << n;
    Viewer latecomer;
    memory.replay(latecomer.sink());
    EXPECT_EQ(latecomer.row_forces, viewer.row_forces);
}

// The design is the blank, sunk by half a millimetre at its top: what no cut has reached is as far from it
// as it was sunk, the bottom of a groove as deep as it was cut.
TEST(LiveMill, TellsHowFarThePartIsFromTheDesign) {
    constexpr double sunk_mm = 0.5, groove_mm = 2;
    auto designed = std::make_shared<TriangleMesh>();
    const auto top = static_cast<float>(-sunk_mm);
    designed->positions = {{0, 0, top}, {40, 0, top}, {40, 20, top}, {0, 20, top}};
    designed->triangles = {{0, 1, 2}, {0, 2, 3}};
    auto live = *LiveMill::create(slot, serial_for, {{}, designed});
    std::map<protocol::LiveChunkPlace, protocol::LiveChunk> chunks;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (protocol::read_frame(frame, chunk)) chunks[chunk.at] = chunk;
    };
    live->set_clock(live->duration_s());
    live->tick(0, always, keep);
    double least = 0, most = 0;
    std::size_t far = 0;
    for (const auto& [at, chunk] : chunks) {
        ASSERT_EQ(chunk.deviations_mm.size(), chunk.mesh.positions.size());
        for (std::size_t n = 0; n < chunk.deviations_mm.size(); ++n) {
            const Vec3 p = chunk.mesh.position(static_cast<std::uint32_t>(n));
            const auto off = static_cast<double>(chunk.deviations_mm[n]);
            // Over the surface, whose plane is nearest there.
            const double height = p.z + sunk_mm;
            if (std::abs(height) > PartPicture::kReachMm + 1e-3) {
                EXPECT_TRUE(std::isnan(off)) << p.z;
                ++far;
            } else if (std::abs(height) < PartPicture::kReachMm - 1e-3) {
                ASSERT_NEAR(off, height, 1e-3);
                const bool inside = p.x > 1 && p.x < 39 && p.y > 1 && p.y < 19;
                if (inside) least = std::min(least, off);
                most = std::max(most, off);
            }
        }
    }
    EXPECT_GT(far, 0u);
    EXPECT_NEAR(least, sunk_mm - groove_mm, 2e-3);
    EXPECT_NEAR(most, sunk_mm, 1e-3);
    // Without a design there is none to be told.
    const auto expect_none = [](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        (void)protocol::read_frame(frame, chunk);
        EXPECT_TRUE(chunk.deviations_mm.empty());
    };
    (*LiveMill::create(slot, serial_for))->tick(0, always, expect_none);
}

TEST(LiveMill, TellsThatAPartIsAsItWasDesigned) {
    MillSession alone(*slot(), serial_for);
    ASSERT_TRUE(alone.run({}));
    const auto designed = std::make_shared<const TriangleMesh>(field::contour(alone.stock()));
    auto live = *LiveMill::create(slot, serial_for, {{}, designed});
    std::size_t compared = 0;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (!protocol::read_frame(frame, chunk)) return;
        for (const float off : chunk.deviations_mm) {
            ASSERT_LT(std::abs(off), 1e-5f);
            ++compared;
        }
    };
    live->set_clock(live->duration_s());
    live->tick(0, always, keep);
    EXPECT_GT(compared, 100u);
}

TEST(LiveMill, MillsTheOldSetupAgainWhileTheNewOneIsWrong) {
    bool good = true;
    double feed_factor = 1;
    const auto from_files = [&]() -> Result<MillSetup> {
        if (!good) return fail_at("p.nc", 3, 1, "no word 'H1'", "correct it");
        auto setup = slot();
        for (motion::Move& move : setup->moves) move.feed_mm_per_min *= feed_factor;
        return setup;
    };
    auto live = *LiveMill::create(from_files, serial_for);
    Viewer viewer;
    const auto mill_all = [&] {
        live->set_clock(0);
        live->tick(0, always, viewer.sink());
        live->set_clock(live->duration_s());
        live->tick(0, always, viewer.sink());
        return viewer.row_times;
    };
    const std::vector<double> times = mill_all();
    good = false;
    EXPECT_FALSE(live->input_error());
    for (int n = 0; n < 2; ++n) {
        EXPECT_EQ(mill_all(), times);
        ASSERT_TRUE(live->input_error());
        EXPECT_EQ(live->input_error()->line, 3);
        EXPECT_NEAR(viewer.part_volume_mm3() / live->session().totals().remaining_mm3, 1, 2e-3);
    }
    good = true;
    feed_factor = 2;
    mill_all();
    EXPECT_FALSE(live->input_error());
    EXPECT_NEAR(viewer.duration_s, 0.5 * 5 * 50.0 / 20, 1e-9);
}

TEST(LiveMill, OfAJobThatCannotBeSetUpIsRefused) {
    const auto live = LiveMill::create([] { return Result<MillSetup>(fail("no", "try")); }, serial_for);
    EXPECT_FALSE(live);
}

}  // namespace
}  // namespace tribo::session
