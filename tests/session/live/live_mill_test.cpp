// SPDX-License-Identifier: MIT
// The live view against the session that it shows: its chunks make the part, its rows are the session's.
#include "session/live/live_mill.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <memory>

#include "field/contour/contour.hpp"
#include "session/live/live_viewer.hpp"

namespace tribo::session {
namespace {

using namespace test;

LiveMill::MakeInput designed_as(std::shared_ptr<const TriangleMesh> designed) {
    return [=]() -> Result<LiveInput> { return LiveInput(*slot(), {.designed = designed}); };
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
        memory.take(shared(frame));
        viewer.sink()(frame);
    };
    live->play(true);
    for (int n = 0; n < 200; ++n) live->tick(1.0 / 60, always, both);
    for (const FrameCache::Frame& frame : memory.replay()) latecomer.sink()(*frame);
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
    const std::size_t kept = memory.replay().size();
    memory.take(shared(std::array<std::uint8_t, 3>{1, 2, 3}));
    EXPECT_EQ(memory.replay().size(), kept);
}

// The design is the blank, sunk by half a millimetre at its top: what no cut has reached is as far from it
// as it was sunk, the bottom of a groove as deep as it was cut.
TEST(LiveMill, TellsHowFarThePartIsFromTheDesign) {
    constexpr double sunk_mm = 0.5, groove_mm = 2;
    auto designed = std::make_shared<TriangleMesh>();
    const auto top = static_cast<float>(-sunk_mm);
    designed->positions = {{0, 0, top}, {40, 0, top}, {40, 20, top}, {0, 20, top}};
    designed->triangles = {{0, 1, 2}, {0, 2, 3}};
    auto live = *LiveMill::create(designed_as(designed), serial_for);
    std::map<protocol::LiveChunkPlace, protocol::LiveChunk> chunks;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (protocol::read_frame(frame, chunk)) chunks[chunk.at] = chunk;
    };
    live->set_clock(live->duration_s());
    live->tick(0, always, keep);
    // Nobody knows how far a rough chunk is from the design.
    std::size_t rough = 0;
    for (const auto& [at, chunk] : chunks) {
        if (!chunk.rough) continue;
        ++rough;
        EXPECT_EQ(chunk.deviations_mm.size(), chunk.mesh.positions.size());
        for (const float off : chunk.deviations_mm) EXPECT_TRUE(std::isnan(off));
    }
    EXPECT_GT(rough, 0u);
    for (int n = 0; n < 50; ++n) live->tick(0, always, keep);
    double least = 0, most = 0;
    std::size_t far = 0;
    for (const auto& [at, chunk] : chunks) {
        EXPECT_FALSE(chunk.rough);
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

// A picture or a file of all chunks has no slits between them.
TEST(LiveMill, TellsChunksThatMeetExactly) {
    auto live = *LiveMill::create(slot, serial_for);
    std::map<protocol::LiveChunkPlace, protocol::LiveChunk> chunks;
    live->set_clock(0.6 * live->duration_s());
    for (int n = 0; n < 50; ++n) {
        live->tick(0, always, [&](std::span<const std::uint8_t> frame) {
            protocol::LiveChunk chunk;
            if (protocol::read_frame(frame, chunk)) chunks[chunk.at] = chunk;
        });
    }
    TriangleMesh part;
    for (const auto& [at, chunk] : chunks) {
        const auto first = static_cast<std::uint32_t>(part.positions.size());
        part.positions.insert(part.positions.end(), chunk.mesh.positions.begin(), chunk.mesh.positions.end());
        for (const Triangle& t : chunk.mesh.triangles)
            part.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    EXPECT_GT(chunks.size(), 5u);
    weld_exactly(part);
    EXPECT_TRUE(is_watertight(part));
}

// A slot of 2 mm: its floor and walls are cut, the top beside it is not.
TEST(LiveMill, TellsWhichVerticesLieOnTheBlank) {
    auto live = *LiveMill::create(slot, serial_for);
    const Box3 blank = live->session().stock().blank().bounds_mm();
    std::map<protocol::LiveChunkPlace, protocol::LiveChunk> chunks;
    live->set_clock(live->duration_s());
    live->tick(0, always, [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (protocol::read_frame(frame, chunk)) chunks[chunk.at] = chunk;
    });
    std::size_t on = 0, off = 0;
    for (const auto& [at, chunk] : chunks) {
        for (std::uint32_t n = 0; n < chunk.mesh.positions.size(); ++n) {
            const Vec3 p = chunk.mesh.position(n);
            double away_mm = 1e9;
            for (int axis = 0; axis < 3; ++axis) {
                away_mm = std::min(
                    {away_mm, std::abs(p[axis] - blank.min[axis]), std::abs(p[axis] - blank.max[axis])});
            }
            // Positions are rounded on their way.
            if (n < chunk.on_blank) {
                EXPECT_LT(away_mm, 3e-3);
                ++on;
            } else {
                EXPECT_GT(away_mm, 5e-4);
                ++off;
            }
        }
    }
    EXPECT_GT(on, 100u);
    EXPECT_GT(off, 100u);
}

TEST(LiveMill, TellsTheProgramAndTheBandOfItsForces) {
    LiveExtras told;
    told.program = {"p.nc", "G0 X1\n"};
    const auto make = [&] {
        auto setup = *slot();
        setup.force_low_factor = 0.75;
        setup.force_high_factor = 1.5;
        return Result<LiveInput>(LiveInput(std::move(setup), told));
    };
    auto live = *LiveMill::create(make, serial_for);
    std::string text;
    std::vector<protocol::LiveRows> rows;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveProgram program;
        if (protocol::read_frame(frame, program)) text = program.name + ": " + program.text;
        protocol::LiveRows some;
        if (protocol::read_frame(frame, some)) rows.push_back(std::move(some));
    };
    live->set_clock(live->duration_s());
    live->tick(0, always, keep);
    EXPECT_EQ(text, "p.nc: G0 X1\n");
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.front().force_low_factor, 0.75);
    EXPECT_EQ(rows.front().force_high_factor, 1.5);
    const auto rpm = live->session().setup().rpm_of_move.back();
    EXPECT_EQ(rows.front().rows.front().spindle_rpm, rpm);
    // Half the speed and another material with its own band.
    CutChange change;
    change.speed_factor = 0.5;
    change.coefficients = live->session().setup().coefficients;
    change.force_low_factor = 0.5;
    change.force_high_factor = 2;
    live->set_change(change);
    rows.clear();
    for (int n = 0; n < 100 && rows.empty(); ++n) live->tick(0.1, always, keep);
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.back().force_high_factor, 2);
    EXPECT_EQ(rows.back().rows.back().spindle_rpm, 0.5 * rpm);
}

TEST(LiveMill, TellsThatAPartIsAsItWasDesigned) {
    MillSession alone(*slot(), serial_for);
    ASSERT_TRUE(alone.run({}));
    const auto designed = std::make_shared<const TriangleMesh>(field::contour(alone.stock()));
    auto live = *LiveMill::create(designed_as(designed), serial_for);
    std::size_t compared = 0;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (!protocol::read_frame(frame, chunk) || chunk.rough) return;
        for (const float off : chunk.deviations_mm) {
            ASSERT_LT(std::abs(off), 1e-5f);
            ++compared;
        }
    };
    live->set_clock(live->duration_s());
    for (int n = 0; n < 50; ++n) live->tick(0, always, keep);
    EXPECT_GT(compared, 100u);
}

// What the files said before is forgotten with them.
TEST(LiveMill, TellsListenerAndDesignOfTheFilesAsTheyAreNow) {
    LiveExtras told;
    told.listening.emplace();
    told.listening->listener_mm = {1, 2, 3};
    told.designed = std::make_shared<const TriangleMesh>(
        TriangleMesh{{{0, 0, -1}, {40, 0, -1}, {40, 20, -1}, {0, 20, -1}}, {{0, 1, 2}, {0, 2, 3}}, {}});
    told.warnings = {{"p.nc", 3, "no S word"}};
    auto live = *LiveMill::create([&] { return Result<LiveInput>(LiveInput(*slot(), told)); }, serial_for);
    Vec3 ear;
    float below_mm = 0;
    int designs = 0, compared = 0;
    const auto keep = [&](std::span<const std::uint8_t> frame) {
        job::Listening listening;
        protocol::LiveDesigned designed;
        protocol::LiveChunk chunk;
        if (protocol::read_frame(frame, listening)) ear = listening.listener_mm;
        if (protocol::read_frame(frame, designed)) {
            ++designs;
            below_mm = designed.mesh.positions.front()[2];
        }
        if (protocol::read_frame(frame, chunk)) compared += chunk.deviations_mm.empty() ? 0 : 1;
    };
    const auto mill_again = [&] {
        live->set_clock(1);
        live->tick(0, always, keep);
        designs = compared = 0;
        live->set_clock(0);
        live->tick(0, always, keep);
    };
    live->tick(0, always, keep);
    EXPECT_EQ(ear, (Vec3{1, 2, 3}));
    EXPECT_EQ(below_mm, -1);
    EXPECT_EQ(live->extras().warnings.size(), 1u);

    told.listening->listener_mm = {7, 8, 9};
    TriangleMesh lower = *told.designed;
    for (Point3f& p : lower.positions) p[2] = -2;
    told.designed = std::make_shared<const TriangleMesh>(lower);
    told.warnings.clear();
    mill_again();
    EXPECT_EQ(ear, (Vec3{7, 8, 9}));
    EXPECT_EQ(below_mm, -2);
    EXPECT_GT(compared, 0);
    EXPECT_TRUE(live->extras().warnings.empty());

    told.designed = nullptr;
    mill_again();
    EXPECT_EQ(designs, 0);
    EXPECT_EQ(compared, 0);
}

TEST(LiveMill, OfAJobThatCannotBeSetUpIsRefused) {
    const auto live = LiveMill::create([] { return Result<MillSetup>(fail("no", "try")); }, serial_for);
    EXPECT_FALSE(live);
}

}  // namespace
}  // namespace tribo::session
