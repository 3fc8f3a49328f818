// SPDX-License-Identifier: MIT
// A cut that chatters in the live view: its sound, the multipliers of its rows, its chart.
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>

#include "base/math.hpp"
#include "motion/path/path.hpp"
#include "session/block_setup.hpp"
#include "session/live/frame_cache.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

constexpr double kRpm = 8000, kDepthMm = 1, kPictureS = 1.0 / 60;
constexpr int kRate = 48000;

// The slot of the benchmark (tests/app/run/benchmark_slot.hpp), 1 mm deep.
MillSetup benchmark_slot() {
    milling::Cutter cutter;
    cutter.flutes = 2;
    cutter.helix_deg = 0;
    cutter.length_mm = 20;
    MillSetup setup = block_setup({{0, 0, -10}, {60, 20, 0}}, cutter, 0.5);
    setup.coefficients = {600, 200, 0, 0, 0, 0};
    motion::Move cut = straight_cut({-8, 10, -kDepthMm}, {70, 10, -kDepthMm}, 1600);
    cut.line = 3;
    add_cut_in_pieces(setup, cut, LiveMill::kPieceMm, kRpm);
    return setup;
}

const dynamics::Mode kMode{{1, 0, 0}, 922, 0.011, 1340.0496480507};

LiveInput bending_slot() {
    LiveExtras told;
    told.listening = job::Listening{.listener_mm = {30, 10, 0}};
    LiveInput input(benchmark_slot(), std::move(told));
    input.setup.modes_of_cutter = {{kMode}};
    return input;
}

bool goes_on() {
    return true;
}

// Reads the frames of a live mill.
struct ChatterViewer {
    std::vector<protocol::LiveRow> rows;
    std::vector<protocol::LiveChatter> multipliers;
    protocol::LiveChart chart;
    protocol::LiveState state;
    int charts = 0, bendings = 0, unknown_rows = 0;

    void take(std::span<const std::uint8_t> frame) {
        protocol::LiveRows told_rows;
        protocol::LiveMultipliers told;
        protocol::LiveBending bending;
        if (read_frame(frame, told_rows)) {
            if (told_rows.anew) rows.clear();
            rows.insert(rows.end(), told_rows.rows.begin(), told_rows.rows.end());
            if (told_rows.anew) multipliers.clear();
            multipliers.resize(rows.size(), {-1, 0});
        } else if (read_frame(frame, told)) {
            for (std::size_t n = 0; n < told.rows.size(); ++n) {
                if (told.first + n >= rows.size()) {
                    ++unknown_rows;
                    continue;
                }
                multipliers[told.first + n] = told.rows[n];
            }
        } else if (read_frame(frame, bending)) {
            ++bendings;
        } else if (protocol::frame_kind(frame) == protocol::LiveFrame::chart) {
            EXPECT_TRUE(read_frame(frame, chart));
            ++charts;
        } else {
            (void)read_frame(frame, state);
        }
    }
    protocol::FrameSink sink() {
        return [this](std::span<const std::uint8_t> frame) { take(frame); };
    }
};

double multiplier(double rpm, double depth_mm) {
    const MillSetup setup = benchmark_slot();
    const milling::EngagementBand slot{0, depth_mm, 0, math::kPi};
    const dynamics::CutFeedback cut(setup.cutters[0], setup.coefficients, {&slot, 1}, rpm);
    return dynamics::stability({&kMode, 1}, cut).multiplier;
}

// The largest amplitude at the frequencies from 500 to 1500 Hz that are no harmonic of the teeth.
struct Line {
    double hz = 0, size = 0;
};
double amplitude(std::span<const float> sound, double hz) {
    std::complex<double> sum = 0, step = std::polar(1.0, -math::kTwoPi * hz / kRate), turn = 1;
    double weights = 0;
    for (std::size_t n = 0; n < sound.size(); ++n, turn *= step) {
        const double weight =
            1 - std::cos(math::kTwoPi * (static_cast<double>(n) + 0.5) / static_cast<double>(sound.size()));
        sum += weight * static_cast<double>(sound[n]) * turn;
        weights += weight;
    }
    return 2 * std::abs(sum) / weights;
}
Line chatter_line(std::span<const float> sound, double tooth_hz) {
    Line line;
    for (double hz = 500; hz < 1500; hz += 2) {
        if (std::abs(std::remainder(hz, tooth_hz)) < 45) continue;
        const double size = amplitude(sound, hz);
        if (size > line.size) line = {hz, size};
    }
    return line;
}

// Plays the slot into an ear, picture by picture, as the program does.
class Played {
  public:
    explicit Played(LiveInput input) {
        auto ready = std::make_shared<std::optional<LiveInput>>(std::move(input));
        mill = *LiveMill::create([=]() -> Result<LiveInput> { return *std::exchange(*ready, std::nullopt); },
                                 serial_for);
        sound::SoundtrackOptions options;
        options.sample_rate_hz = kRate;
        ear = std::make_unique<LiveSound>(options);
        mill->set_sound_listener([this](LiveSoundUpdate news) {
            std::visit([this](const auto& told) { ear->take(told); }, news);
        });
        mill->play(true);
    }
    std::vector<float> play(double seconds) {
        std::vector<float> left;
        for (const double end_s = heard_s + seconds; heard_s < end_s; heard_s += kPictureS) {
            mill->tick(kPictureS, goes_on, viewer.sink());
            ear->follow(mill->clock_s(), mill->speed(), mill->playing());
            std::vector<float> block(static_cast<std::size_t>(2 * kRate * kPictureS));
            ear->render(block);
            for (std::size_t n = 0; n < block.size(); n += 2) left.push_back(block[n]);
        }
        return left;
    }

    std::unique_ptr<LiveMill> mill;
    std::unique_ptr<LiveSound> ear;
    ChatterViewer viewer;
    double heard_s = 0;
};

TEST(LiveChatter, AnOverrideOfTheSpindleIsHeardWithin100Ms) {
    Played slot(bending_slot());
    slot.play(1);
    const std::vector<float> howl = slot.play(0.2);
    const Line loud = chatter_line(howl, kRpm / 30);
    EXPECT_GT(loud.size, 0.5 * amplitude(howl, kRpm / 30));
    EXPECT_NEAR(slot.viewer.state.chatter->of.multiplier, multiplier(kRpm, kDepthMm), 1e-3);
    CutChange faster;
    faster.speed_factor = 9.0 / 8;
    slot.mill->set_change(faster);
    slot.play(0.1);
    const std::vector<float> hum = slot.play(0.2);
    constexpr double k20Db = 0.1;
    EXPECT_LT(chatter_line(hum, 300).size, k20Db * loud.size);
    EXPECT_LT(amplitude(hum, loud.hz), k20Db * loud.size);
    EXPECT_GT(amplitude(hum, 300), 3 * chatter_line(hum, 300).size);
    EXPECT_NEAR(slot.viewer.state.chatter->of.multiplier, multiplier(9000, kDepthMm), 1e-3);
    // And back.
    slot.mill->set_change({});
    slot.play(0.6);
    EXPECT_GT(chatter_line(slot.play(0.2), kRpm / 30).size, 0.5 * loud.size);
}

TEST(LiveChatter, HowlsInItsTruePitchAtAnySpeedOfPlay) {
    for (const double speed : {0.1, 1.0, 2.0}) {
        Played slot(bending_slot());
        slot.mill->set_clock(0.5);
        slot.mill->set_speed(speed);
        slot.play(0.6);
        const std::vector<float> howl = slot.play(0.2);
        const Line loud = chatter_line(howl, kRpm / 30);
        const double tooth_hz = kRpm / 30;
        EXPECT_GT(loud.size, 0.5 * amplitude(howl, tooth_hz)) << speed;
        // A line of theory: the distance from a chatter frequency is a multiple of the tooth's.
        const double chatter_hz = static_cast<double>(slot.viewer.state.chatter->of.chatter_hz);
        const double off = std::min(std::abs(std::remainder(loud.hz - chatter_hz, tooth_hz)),
                                    std::abs(std::remainder(loud.hz + chatter_hz, tooth_hz)));
        EXPECT_LT(off, 0.01 * loud.hz) << speed << " " << loud.hz;
    }
}

TEST(LiveChatter, EndsWithThePauseAndWithTheCut) {
    Played slot(bending_slot());
    slot.play(1);
    slot.mill->play(false);
    std::vector<float> rest = slot.play(0.5);
    for (std::size_t n = kRate / 4; n < rest.size(); ++n) ASSERT_EQ(rest[n], 0) << n;
    slot.mill->play(true);
    slot.mill->set_clock(slot.mill->duration_s() - 0.1);
    slot.play(1);
    rest = slot.play(0.2);
    for (const float v : rest) ASSERT_EQ(v, 0);
}

TEST(LiveChatter, TellsTheMultiplierOfEveryRow) {
    Played slot(bending_slot());
    slot.mill->set_clock(slot.mill->duration_s());
    slot.play(0.5);
    const auto expect_all = [&](double rpm) {
        ASSERT_EQ(slot.viewer.multipliers.size(), slot.viewer.rows.size());
        for (std::size_t n = 0; n < slot.viewer.rows.size(); ++n)
            ASSERT_GE(slot.viewer.multipliers[n].multiplier, 0) << n;
        const std::size_t middle = slot.viewer.rows.size() / 2;
        EXPECT_NEAR(slot.viewer.multipliers[middle].multiplier, multiplier(rpm, kDepthMm), 1e-3);
    };
    expect_all(kRpm);
    CutChange faster;
    faster.speed_factor = 9.0 / 8;
    slot.mill->set_change(faster);
    slot.play(1);
    expect_all(9000);
    EXPECT_EQ(slot.viewer.unknown_rows, 0);
    EXPECT_EQ(slot.viewer.bendings, 1);
    CutChange helical = faster;
    helical.helix_deg = 30;
    slot.mill->set_change(helical);
    slot.play(0.1);
    EXPECT_EQ(slot.viewer.bendings, 2);
}

TEST(LiveChatter, WhoComesLateSeesTheSame) {
    Played slot(bending_slot());
    FrameCache memory;
    const protocol::FrameSink both = [&](std::span<const std::uint8_t> frame) {
        memory.take(std::make_shared<const std::vector<std::uint8_t>>(frame.begin(), frame.end()));
        slot.viewer.take(frame);
    };
    const auto pass = [&](int pictures) {
        for (int n = 0; n < pictures; ++n) slot.mill->tick(kPictureS, goes_on, both);
    };
    pass(90);
    CutChange faster;
    faster.speed_factor = 9.0 / 8;
    slot.mill->set_change(faster);
    pass(90);
    ChatterViewer late;
    for (const FrameCache::Frame& frame : memory.replay()) late.take(*frame);
    ASSERT_EQ(late.multipliers.size(), slot.viewer.multipliers.size());
    for (std::size_t n = 0; n < late.multipliers.size(); ++n)
        ASSERT_EQ(late.multipliers[n].multiplier, slot.viewer.multipliers[n].multiplier) << n;
    EXPECT_EQ(late.chart.multipliers, slot.viewer.chart.multipliers);
    EXPECT_EQ(late.bendings, 1);
}

TEST(LiveChatter, DrawsTheChartOfTheCutAtTheClock) {
    Played slot(bending_slot());
    slot.mill->set_clock(1);
    slot.play(1.5);
    const protocol::LiveChart& chart = slot.viewer.chart;
    const std::size_t speeds = chart.limits_mm.size(), depths = chart.depths;
    ASSERT_GE(speeds, 60u);
    ASSERT_EQ(chart.multipliers.size(), speeds * depths);
    std::size_t checked = 0;
    for (std::size_t n = 0; n < speeds; n += 7) {
        const double rpm = chart.from_rpm + static_cast<double>(n) * chart.step_rpm;
        for (std::size_t d = 0; d < depths; d += 5) {
            const double mu = static_cast<double>(chart.multipliers[n * depths + d]);
            EXPECT_NEAR(mu, multiplier(rpm, static_cast<double>(d + 1) * chart.step_mm), 0.02 * mu);
            ++checked;
        }
        const double limit = static_cast<double>(chart.limits_mm[n]);
        if (!std::isnan(limit)) {
            EXPECT_NEAR(multiplier(rpm, limit), 1, 0.02) << rpm;
        }
    }
    EXPECT_GT(checked, 50u);
    // The demo that everyone understands: at 9000 rpm there is a pocket.
    ASSERT_FALSE(chart.pockets.empty());
    EXPECT_LT(chart.from_rpm, 8000);
    const int charts = slot.viewer.charts;
    slot.play(0.5);
    EXPECT_EQ(slot.viewer.charts, charts);  // it stays
    CutChange faster;
    faster.speed_factor = 9.0 / 8;
    slot.mill->set_change(faster);
    slot.play(0.5);
    EXPECT_EQ(slot.viewer.charts, charts);  // the point moves in it
}

TEST(LiveChatter, AJobWithoutModesSaysNothingOfIt) {
    LiveInput rigid = bending_slot();
    rigid.setup.modes_of_cutter.clear();
    Played slot(std::move(rigid));
    slot.play(1);
    EXPECT_EQ(slot.viewer.bendings + slot.viewer.charts, 0);
    EXPECT_FALSE(slot.viewer.state.chatter);
    for (const protocol::LiveChatter& of : slot.viewer.multipliers) EXPECT_EQ(of.multiplier, -1);
    EXPECT_LT(chatter_line(slot.play(0.2), kRpm / 30).size, 1e-3);
}

TEST(LiveChatter, ComputesInSlicesAlsoWithoutTime) {
    auto ready = std::make_shared<std::optional<LiveInput>>(bending_slot());
    auto mill = *LiveMill::create([=]() -> Result<LiveInput> { return *std::exchange(*ready, std::nullopt); },
                                  serial_for);
    ChatterViewer viewer;
    mill->set_clock(mill->duration_s());
    mill->tick(0, goes_on, viewer.sink());
    mill->set_change({.speed_factor = 1.5});
    const auto never = [] { return false; };
    for (int n = 0; n < 300; ++n) mill->tick(kPictureS, never, viewer.sink());
    for (std::size_t n = 0; n < viewer.rows.size(); ++n) ASSERT_GE(viewer.multipliers[n].multiplier, 0) << n;
}

// What comes over a network may be anything.
TEST(LiveChatter, LeavesNonsenseAlone) {
    sound::SoundtrackOptions options;
    options.sample_rate_hz = kRate;
    LiveSound ear(options);
    protocol::LiveBending bending;
    bending.coefficients = {600, 200, 0, 0, 0, 0};
    bending.cutters = {{milling::Cutter{}, 24000, {kMode}}};
    protocol::LiveSoundPiece good;
    good.duration_s = 1;
    good.spindle_rad_per_s = 800;
    good.harmonics.resize(2);
    good.teeth.across_mm = 0.1f;
    good.teeth.bands = {{0, 1, 0, 3}};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto spoil = [&](auto&& change) {
        protocol::LiveSoundPiece piece = good;
        change(piece);
        ear.take(bending);
        ear.take(protocol::LiveSoundPieces{{piece}});
        ear.follow(0.1, 1, true);
        std::vector<float> out(4096);
        ear.render(out);
        for (const float v : out) ASSERT_TRUE(std::isfinite(v));
    };
    spoil([](protocol::LiveSoundPiece&) {});
    spoil([&](protocol::LiveSoundPiece& p) { p.teeth.across_mm = nan; });
    spoil([&](protocol::LiveSoundPiece& p) { p.teeth.down_mm = nan; });
    spoil([&](protocol::LiveSoundPiece& p) { p.teeth.feed = {nan, 0, 0}; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.feed = {0, 0, 1}; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.axis = {}; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.head = {0, 0, 1}; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.cutter = 9; });
    spoil([&](protocol::LiveSoundPiece& p) { p.teeth.bands[0].z1_mm = nan; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.bands[0].z1_mm = 1e9f; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.bands[0].exit_rad = 100; });
    spoil([](protocol::LiveSoundPiece& p) { p.teeth.bands.resize(5000, {0, 1, 0, 3}); });
    spoil([](protocol::LiveSoundPiece& p) { p.spindle_rad_per_s = 1e9f; });
    spoil([](protocol::LiveSoundPiece& p) { p.spindle_rad_per_s = 1e-9f; });
    bending.cutters[0].modes[0].frequency_hz = -1;
    spoil([](protocol::LiveSoundPiece&) {});
    bending.cutters[0].modes = {kMode};
    bending.cutters[0].cutter.flutes = 100000;
    spoil([](protocol::LiveSoundPiece&) {});
}

}  // namespace
}  // namespace tribo::session
