// SPDX-License-Identifier: MIT
// The face for programs: a cut as it is opened, milled and looked at from outside.
#include "tribo/mill.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

#include "files/scratch.hpp"
#include "haptics/contact/field_contact.hpp"
#include "places.hpp"
#include "tribo/sound.hpp"

namespace tribo {
namespace {

constexpr const char* kPlate = TRIBO_SOURCE_DIR "/examples/plate/plate.toml";
// A slot of 12 mm, 2 mm deep and 60 mm long through a blank of 40 x 20 x 10.
constexpr const char* kSlotJob =
    "[stock]\nbox_mm = [[0, 0, -10], [40, 20, 0]]\n[cutter]\nkind = \"flat\"\ndiameter_mm = 12\nflutes = "
    "2\nlength_mm = 30\n"
    "[material]\nname = \"al7075-t6\"\n[path]\ngcode = \"slot.nc\"\n";
constexpr const char* kSlotProgram = "G21 G90 S6000 M3 F600\nG0 X-10 Y10 Z5\nG1 Z-2\nG1 X50\n";

Mill slot(const test::Scratch& folder, MillOptions options = {}) {
    folder.put("slot.nc", kSlotProgram);
    folder.put("slot.toml", kSlotJob);
    if (!options.cell_mm) options.cell_mm = 0.5;
    auto mill = Mill::open(folder / "slot.toml", options);
    if (!mill) throw std::runtime_error(mill.error().text());
    return std::move(*mill);
}

TEST(Mill, takes_the_metal_that_the_cutter_sweeps) {
    const test::Scratch folder;
    Mill mill = slot(folder);
    double removed = 0, last_s = 0, progress = 0;
    ASSERT_TRUE(mill.run(
        [&](const milling::CutRow& row, const milling::RowForce& force) {
            EXPECT_GE(row.start_s, last_s - 1e-9);
            last_s = row.start_s;
            EXPECT_GT(force.peaks.peak_force_n, 0);
            removed += row.removed_mm3;
        },
        [&](double fraction) {
            progress = std::max(progress, fraction);
            return true;
        }));
    EXPECT_NEAR(removed, 40 * 12 * 2, 0.003 * 960);
    EXPECT_NEAR(mill.totals().removed_mm3, removed, 1e-5 * removed);
    EXPECT_NEAR(volume_mm3(mill.part()), 8000 - 960, 3);
    ASSERT_TRUE(mill.totals().energy_balance);
    EXPECT_NEAR(*mill.totals().energy_balance, 1, 0.01);
    EXPECT_GT(progress, 0.5);
    EXPECT_EQ(mill.cutters().size(), 1u);
    EXPECT_GT(mill.duration_s(), last_s);
}

TEST(Mill, gives_the_same_rows_whatever_the_threads_and_the_calls) {
    const test::Scratch folder;
    const auto rows_of = [&](Mill mill, bool in_parts) {
        std::vector<double> numbers;
        const auto keep = [&](const milling::CutRow& row, const milling::RowForce& force) {
            numbers.insert(numbers.end(), {row.start_s, row.chip_mm3, force.peaks.peak_force_n});
        };
        for (double t = 0; in_parts && t < mill.duration_s(); t += 0.7) EXPECT_TRUE(mill.run_to(t, keep));
        EXPECT_TRUE(mill.run(keep));
        return numbers;
    };
    const auto one = rows_of(slot(folder, {.threads = 1}), false);
    EXPECT_FALSE(one.empty());
    EXPECT_EQ(one, rows_of(slot(folder, {.threads = 3}), false));
    EXPECT_EQ(one, rows_of(slot(folder, {.threads = 2}), true));
}

TEST(Mill, is_touched_where_it_was_cut) {
    const test::Scratch folder;
    Mill mill = slot(folder);
    ASSERT_TRUE(mill.run());
    haptics::FieldContact contact(mill.surface(), {.stiffness_n_per_mm = 0.5});
    for (int n = 0; n < 400; ++n) {
        const double z = 2 - 0.01 * n;
        const haptics::ProbeContact felt = contact.update({20, 10, z});
        // The slot's floor.
        EXPECT_NEAR(felt.force_n.z, 0.5 * std::max(0.0, -2 - z), 0.01) << z;
    }
}

TEST(Mill, stops_and_says_so) {
    const test::Scratch folder;
    Mill mill = slot(folder);
    EXPECT_FALSE(mill.run({}, [](double) { return false; }));
}

TEST(Mill, refuses_in_words) {
    const test::Scratch folder;
    const auto refused = [](const std::string& file, const MillOptions& options, const char* what) {
        const auto mill = Mill::open(file, options);
        ASSERT_FALSE(mill) << what;
        EXPECT_NE(mill.error().text().find(what), std::string::npos) << mill.error().text();
    };
    refused(folder / "none.toml", {}, "none.toml");
    folder.put("bad.toml", "[stok]\n");
    folder.put("bad.nc", "G1 X[\n");
    refused(folder / "bad.toml", {}, "bad.toml:1");
    refused(folder / "bad.nc", {}, "bad.nc:1");
    refused(kPlate, {.cell_mm = 1e-5}, "cell_mm");
    refused(kPlate, {.cell_mm = std::nan("")}, "cell_mm");
    refused(kPlate, {.until_s = -1}, "until_s");
    refused(kPlate, {.threads = -1}, "threads");
    refused(kPlate, {.cell_mm = 0.01, .memory_mb = 40}, "try cell_mm");
}

TEST(CutSound, has_the_tone_of_the_teeth_and_keeps_it_within_full_scale) {
    const test::Scratch folder;
    for (const Ears ears : {Ears::sphere, Ears::panning}) {
        Mill mill = slot(folder);
        auto sound = CutSound::of(mill, {.listener_mm = Vec3{20, -300, 0}, .ears = ears});
        ASSERT_TRUE(sound) << sound.error().text();
        std::vector<float> heard;
        ASSERT_TRUE(mill.run([&](const milling::CutRow& row, const milling::RowForce& force) {
            ASSERT_TRUE(sound->excite(mill.contact(row, force, row.start_s)));
            std::vector<float> block(2 * static_cast<std::size_t>(sound->frames_left()));
            sound->render(block);
            heard.insert(heard.end(), block.begin(), block.end());
        }));
        ASSERT_GT(heard.size(), 2u * 48000u * 4u);
        // A second of the cut: 6000 turns a minute and two teeth are 200 Hz; half way to the next line is
        // none.
        const auto tone = [&](double hz) {
            double re = 0, im = 0;
            for (std::size_t n = 0; n < 48000; ++n) {
                const double x = heard[2 * (n + 3 * 48000)];
                const double phase = 2 * M_PI * hz * static_cast<double>(n) / 48000;
                re += x * std::cos(phase), im += x * std::sin(phase);
            }
            return std::hypot(re, im) / 24000;
        };
        EXPECT_GT(tone(200), 1e-3);
        EXPECT_GT(tone(200), 10 * tone(250));
        for (const float x : heard) ASSERT_LE(std::abs(x), 1.0F);
        contact::ContactSample broken;
        broken.t_s = std::nan("");
        EXPECT_FALSE(sound->excite(broken));
    }
}

TEST(CutSound, refuses_what_it_cannot_play) {
    const test::Scratch folder;
    const Mill mill = slot(folder);
    EXPECT_FALSE(CutSound::of(mill, {.sample_rate_hz = 5}));
    EXPECT_FALSE(CutSound::of(mill, {.listener_mm = Vec3{std::nan(""), 0, 0}}));
}

}  // namespace
}  // namespace tribo
