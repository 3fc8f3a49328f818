// SPDX-License-Identifier: MIT
// The plate of the examples as the live view shows it in the end: the bits that tribo.wasm gives for it too
// (web/wasm/test/mill.test.ts holds the module to the same file).
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "field/shape/box_shape.hpp"
#include "readers/gcode/reader.hpp"
#include "session/cut/mill_setup.hpp"
#include "session/live/live_mill.hpp"

namespace tribo::session {
namespace {

std::string file_text(const std::string& name) {
    std::ifstream file(std::string(TRIBO_SOURCE_DIR) + "/" + name, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

// As examples/plate/plate.toml has it.
Result<MillSetup> plate() {
    job::Job job;
    job.file = "plate.toml";
    job.stock.box_mm = {{0, 0, -12}, {80, 60, 0}};
    milling::Cutter cutter;
    cutter.number = 1;
    cutter.diameter_mm = 8;
    cutter.flutes = 3;
    cutter.helix_deg = 35;
    cutter.length_mm = 22;
    job.cutters = {cutter};
    job.material.name = "al6082-t6";
    job.process = {8000, 900};
    job.path.kind = job::PathKind::gcode;
    readers::GcodeOptions options;
    options.source_name = "plate.nc";
    options.default_feed_mm_per_min = 900;
    options.tools.push_back({1, 8, {}});
    auto program = readers::read_gcode(file_text("examples/plate/plate.nc"), options);
    if (!program) return std::unexpected(program.error());
    MillInputs inputs;
    inputs.program = *std::move(program);
    inputs.blank = std::make_unique<field::BoxShape>(job.stock.box_mm);
    inputs.blank_volume_mm3 = job.stock.box_mm.volume();
    Warnings warnings;
    return prepare_mill(job, std::move(inputs), {0.25, {}, LiveMill::kPieceMm}, warnings);
}

TEST(LivePlate, IsTheSameInThePage) {
    auto live = LiveMill::create(plate, serial_for);
    ASSERT_TRUE(live) << live.error().text();
    std::map<std::array<std::int32_t, 3>, std::uint64_t> chunks;
    const auto take = [&](std::span<const std::uint8_t> frame) {
        if (frame[0] != static_cast<std::uint8_t>(protocol::LiveFrame::chunk)) return;
        std::array<std::int32_t, 3> at{};
        for (std::size_t n = 0; n < 12; ++n)
            at[n / 4] |= static_cast<std::int32_t>(std::uint32_t{frame[16 + n]} << (8 * (n % 4)));
        std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
        for (const std::uint8_t byte : frame.subspan(28)) hash = (hash ^ byte) * 0x100000001b3;
        chunks[at] = hash;
    };
    (*live)->set_clock((*live)->duration_s());
    const auto always = [] { return true; };
    ASSERT_TRUE((*live)->tick(0, always, take));
    EXPECT_GT(chunks.size(), 10u);
    // Told apart by what they are, not by their order.
    std::uint64_t sum = 0;
    for (const auto& [at, hash] : chunks) sum += hash;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
    EXPECT_EQ(std::string(text) + "\n", file_text("tests/golden/plate.txt"));
}

}  // namespace
}  // namespace tribo::session
