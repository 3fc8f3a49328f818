// SPDX-License-Identifier: MIT
// The plate of the examples as the live view shows it in the end, and how it sounds: the bits that tribo.wasm
// and mill_sound.wasm give for it too (web/wasm/test/mill.test.ts holds the modules to the same files).
#include <bit>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>

#include "job/memory_source.hpp"
#include "places.hpp"
#include "session/cut/mill_setup.hpp"
#include "session/live/live_audit.hpp"

namespace tribo::session {
namespace {

std::string file_text(const std::string& name) {
    std::ifstream file(std::string(TRIBO_SOURCE_DIR) + "/" + name, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

constexpr std::uint64_t kHashBegin = 0xcbf29ce484222325;

// FNV-1a
std::uint64_t hash_of(std::span<const std::uint8_t> bytes, std::uint64_t hash = kHashBegin) {
    for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3;
    return hash;
}

std::string hash_text(std::uint64_t hash) {
    char text[18];
    std::snprintf(text, sizeof text, "%016llx\n", static_cast<unsigned long long>(hash));
    return text;
}

FileResult<job::LoadedJob> loaded_plate() {
    job::MemorySource files;
    for (const char* name : {"plate.toml", "plate.nc"})
        files.put(name, file_text(std::string("examples/plate/") + name));
    return job::load_job(files, "plate.toml");
}

Result<MillSetup> plate() {
    const auto loaded = loaded_plate();
    if (!loaded) return std::unexpected(Error(loaded.error()));
    Warnings warnings;
    return prepare_mill(*loaded, {0.25, {}, LiveMill::kPieceMm}, warnings);
}

TEST(LivePlate, IsTheSameInThePage) {
    auto live = LiveMill::create(plate, serial_for);
    ASSERT_TRUE(live) << live.error().text();
    std::map<protocol::LiveChunkPlace, std::uint64_t> chunks;
    std::set<protocol::LiveChunkPlace> rough;
    const auto take = [&](std::span<const std::uint8_t> frame) {
        protocol::LiveChunk chunk;
        if (!protocol::read_frame(frame, chunk)) return;
        chunks[chunk.at] = hash_of(frame.subspan(28));
        rough.erase(chunk.at);
        if (chunk.rough) rough.insert(chunk.at);
    };
    (*live)->set_clock((*live)->duration_s());
    const auto always = [] { return true; };
    (*live)->tick(0, always, take);
    EXPECT_FALSE(rough.empty());
    while (!rough.empty()) (*live)->tick(0, always, take);
    EXPECT_GT(chunks.size(), 10u);
    // Told apart by what they are, not by their order.
    std::uint64_t sum = 0;
    for (const auto& [at, hash] : chunks) sum += hash;
    EXPECT_EQ(hash_text(sum), file_text("tests/golden/plate.txt"));
}

TEST(LivePlate, IsAuditedTheSameInThePage) {
    const auto loaded = loaded_plate();
    ASSERT_TRUE(loaded) << loaded.error().text();
    const auto with_limits = [&]() -> Result<LiveInput> {
        LiveInput input(*plate());
        input.extras.limits = cut_limits(loaded->job, input.setup);
        return input;
    };
    auto live = LiveMill::create(with_limits, serial_for);
    ASSERT_TRUE(live) << live.error().text();
    (*live)->set_clock((*live)->duration_s());
    (*live)->tick(0, [] { return true; }, [](auto) {});
    const LiveAudit audit = audit_of(**live, serial_for);
    std::uint64_t hash = kHashBegin;
    for (const char c : audit.json) hash = hash_of(std::bit_cast<std::array<std::uint8_t, 1>>(c), hash);
    for (const double v : audit.lines)
        hash = hash_of(std::bit_cast<std::array<std::uint8_t, sizeof v>>(v), hash);
    EXPECT_EQ(hash_text(hash), file_text("tests/golden/plate_audit.txt"));
}

// The program tells its ear structs, a page decodes them from frames.
TEST(LivePlate, SoundsTheSameFromStructsAndFromFrames) {
    const auto loaded = loaded_plate();
    ASSERT_TRUE(loaded) << loaded.error().text();
    const job::Listening heard = job::listening_to(loaded->job, loaded->blank.box_mm);
    const auto heard_plate = [&]() -> Result<LiveInput> { return LiveInput(*plate(), {heard}); };
    auto live = LiveMill::create(heard_plate, serial_for);
    ASSERT_TRUE(live) << live.error().text();
    sound::SoundtrackOptions options;
    options.head = sound::Head::sphere(options.sample_rate_hz);
    LiveSound from_structs(options), from_frames(options);
    (*live)->set_sound_listener([&](const LiveSoundUpdate& news) {
        std::visit([&](const auto& told) { from_structs.take(told); }, news);
    });
    int told = 0;
    const auto decode = [&](std::span<const std::uint8_t> frame) {
        job::Listening listening;
        protocol::LiveSoundPieces pieces;
        if (protocol::read_frame(frame, listening)) from_frames.take(listening);
        if (!protocol::read_frame(frame, pieces)) return;
        from_frames.take(pieces);
        ++told;
    };
    (*live)->set_clock(10);
    (*live)->play(true);
    const auto always = [] { return true; };
    std::vector<float> program(1600), page(1600);
    float loudest = 0;
    std::uint64_t hash = kHashBegin;
    for (int picture = 0; picture < 120; ++picture) {
        (*live)->tick(1.0 / 60, always, decode);
        const protocol::LiveState state = (*live)->state();
        for (LiveSound* ear : {&from_structs, &from_frames})
            ear->follow(state.t_s, state.speed, state.playing);
        from_structs.render(program);
        from_frames.render(page);
        ASSERT_EQ(program, page) << picture;
        for (const float v : program) {
            loudest = std::max(loudest, std::abs(v));
            hash = hash_of(std::bit_cast<std::array<std::uint8_t, sizeof v>>(v), hash);
        }
    }
    EXPECT_GT(told, 10);
    EXPECT_GT(loudest, 0.01f);
    EXPECT_EQ(hash_text(hash), file_text("tests/golden/plate_sound.txt"));
}

}  // namespace
}  // namespace tribo::session
